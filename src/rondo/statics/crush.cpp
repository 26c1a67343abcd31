// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/crush.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/keep_larger.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;

/// H u of a node.
Vec2 displaced(const CrushModel& model, std::size_t candidate, const std::vector<Vec2>& u) {
  return in_contact_frame(u[at(model.nodes[candidate])]);
}

/// What an increment is solved from and to, before it becomes the state.
struct Trial {
  double depth = 0.0;  ///< [m]
  double slide = 0.0;  ///< [m]
  CondensedSolution solution;
  CondensedField field;
  std::vector<Vec2> slip;  ///< (nb) gap, increment of slip [m]
};

/// Along the tangent the center's travel counts backwards: t = (-1, 0).
CondensedProblem make_problem(const CrushModel& model, const Trial& trial, const Condensation& body,
                              const CrushState& state) {
  const auto& set = body.set();
  CondensedProblem p{body.compliance(), Eigen::VectorXd(static_cast<Index>(2 * set.size())),
                     friction_from(model, state, set)};
  for (std::size_t j = 0; j < set.size(); ++j) {
    p.free[static_cast<Index>(2 * j)] = model.clearance[set[j]] - trial.depth;
    p.free[static_cast<Index>(2 * j + 1)] =
        -displaced(model, set[j], state.u).y - (trial.slide - state.slide);
  }
  return p;
}

/// The last increment's forces, for a warm start.
Eigen::VectorXd last_force(const Condensation& body, const CrushState& state) {
  const auto& set = body.set();
  Eigen::VectorXd r(static_cast<Index>(2 * set.size()));
  for (std::size_t j = 0; j < set.size(); ++j)
    r.segment<2>(static_cast<Index>(2 * j)) << state.force[set[j]].x, state.force[set[j]].y;
  return r;
}

/// Gap and increment of slip of every candidate, from the state before to a field.
std::vector<Vec2> slip_of(const CrushModel& model, const CrushState& before, double depth,
                          double slide, const std::vector<Vec2>& u) {
  std::vector<Vec2> slip(model.nodes.size());
  for (std::size_t k = 0; k < slip.size(); ++k) {
    const Vec2 now = displaced(model, k, u), then = displaced(model, k, before.u);
    slip[k] = {model.clearance[k] - depth + now.x, now.y - then.y - (slide - before.slide)};
  }
  return slip;
}

/// The field under the forces found, and what it does at every candidate.
void find_field(const CrushModel& model, const Condensation& body, const CrushState& state,
                Trial& trial) {
  trial.field = body.field(trial.solution.force);
  trial.slip = slip_of(model, state, trial.depth, trial.slide, trial.field.u);
}

std::vector<std::size_t> penetrating_outside(const Condensation& body, const Trial& trial) {
  std::vector<std::size_t> found = body.outside();
  std::erase_if(found, [&](std::size_t k) { return !(trial.slip[k].x < 0.0); });
  return found;
}

/// The law's residual with gaps and slips of the whole field, which the solver never saw.
double field_residual(const CondensedProblem& problem, const Condensation& body,
                      const Trial& trial) {
  Eigen::VectorXd w(trial.solution.force.size());
  for (std::size_t j = 0; j < body.set().size(); ++j)
    w.segment<2>(static_cast<Index>(2 * j)) << trial.slip[body.set()[j]].x,
        trial.slip[body.set()[j]].y;
  return condensed_residual(problem, trial.solution.force, w);
}

CrushState accept(const CrushModel& model, const Condensation& body, const CrushState& state,
                  Trial& trial) {
  CrushEquilibrium found{trial.depth,
                         trial.slide,
                         std::move(trial.field.u),
                         std::vector<Vec2>(model.nodes.size()),
                         std::vector<Status>(model.nodes.size(), Status::open),
                         trial.field.strain};
  for (std::size_t j = 0; j < body.set().size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    found.force[body.set()[j]] = {trial.solution.force[row], trial.solution.force[row + 1]};
    found.status[body.set()[j]] = trial.solution.status[j];
  }
  return next_state(model, state, std::move(found));
}

}  // namespace

CandidateFriction friction_from(const CrushModel& model, const CrushState& state,
                                std::span<const std::size_t> set) {
  if (model.friction.is_constant()) return model.friction.constant();
  RONDO_DEMAND(model.extent.size() == model.nodes.size(), model.extent.size(), model.nodes.size());
  std::vector<double> each;
  for (const std::size_t k : set) {
    const Vec2 u = state.u[at(model.nodes[k])];
    const contact::SlidingState of{
        .place = {model.reference[k].x + u.x + state.slide, 0.0, 0.0},
        .pressure = model.extent[k] > 0.0 ? state.force[k].x / model.extent[k] : 0.0};
    each.push_back(model.friction.coefficient(of));
  }
  return CandidateFriction(std::move(each));
}

CrushState next_state(const CrushModel& model, const CrushState& before, CrushEquilibrium found) {
  CrushState next = before;
  next.depth = found.depth;
  next.slide = found.slide;
  next.slip = slip_of(model, before, found.depth, found.slide, found.u);
  next.u = std::move(found.u);
  next.force = std::move(found.force);
  next.status = std::move(found.status);
  next.works.strain = next.works.internal = found.strain;
  add_works(model, before, next);
  return next;
}

void add_works(const CrushModel& model, const CrushState& before, CrushState& after) {
  CompensatedSum contact;
  const Vec2 travel = {after.depth - before.depth, after.slide - before.slide};
  for (std::size_t k = 0; k < after.force.size(); ++k) {
    const Vec2 mean = 0.5 * (before.force[k] + after.force[k]);
    if (mean == Vec2{}) continue;
    const double opening = after.slip[k].x - before.slip[k].x;
    after.sums[0].add(dot(mean, travel));
    after.sums[1].add(-mean.y * after.slip[k].y);
    after.sums[2].add(-mean.x * opening);
    contact.add(dot(mean, displaced(model, k, after.u) - displaced(model, k, before.u)));
  }
  CrushWorks& w = after.works;
  w.contact += contact.value();
  w.rim = after.sums[0].value();
  w.friction = after.sums[1].value();
  w.impact = after.sums[2].value();
  w.residual = w.internal - w.contact;
  w.exchanged = std::max(w.exchanged, w.strain + std::abs(w.contact));
  const double relative = w.residual != 0.0 ? std::abs(w.residual) / w.exchanged : 0.0;
  w.relative = keep_larger(w.relative, relative);
}

CrushModel make_crush_model(std::span<const Vec2> reference, std::span<const int> nodes,
                            contact::Friction friction) {
  CrushModel model;
  model.nodes.assign(nodes.begin(), nodes.end());
  model.friction = std::move(friction);
  double lowest = std::numeric_limits<double>::infinity();
  for (const int node : nodes) lowest = std::min(lowest, reference[at(node)].y);
  for (const int node : nodes) {
    model.clearance.push_back(reference[at(node)].y - lowest);
    model.reference.push_back(reference[at(node)]);
  }
  return model;
}

CrushState start_crush(const CrushModel& model, std::size_t n_nodes) {
  CrushState state;
  state.u.resize(n_nodes);
  state.force.resize(model.nodes.size());
  state.status.resize(model.nodes.size(), Status::open);
  for (const double clearance : model.clearance) state.slip.push_back({clearance, 0.0});
  return state;
}

std::size_t append_within(const CrushModel& model, double reach, Condensation& body) {
  std::vector<std::size_t> added = body.outside();
  std::erase_if(added, [&](std::size_t k) { return !(model.clearance[k] <= reach); });
  body.append(added);
  return added.size();
}

CrushReport bring_to(const CrushModel& model, double depth, double slide, Condensation& body,
                     CrushState& state) {
  RONDO_DEMAND(body.factorised() && state.force.size() == model.nodes.size(), state.force.size());
  Trial trial;
  trial.depth = depth;
  trial.slide = slide;
  CrushReport report;
  for (;;) {
    const CondensedProblem problem = make_problem(model, trial, body, state);
    trial.solution.force = last_force(body, state);
    const CondensedReport solved = solve_condensed(problem, model.limits, trial.solution);
    report.sweeps += solved.sweeps;
    report.pivots += solved.pivots;
    if (solved.pivoting != Pivoting::none) report.pivoting = solved.pivoting;
    find_field(model, body, state, trial);
    report.residual = field_residual(problem, body, trial);
    report.equilibrium = trial.field.residual;
    report.converged = report.residual <= model.bound;
    const std::vector<std::size_t> outside = penetrating_outside(body, trial);
    if (!report.converged || outside.empty()) break;
    body.append(outside);
    report.appended += outside.size();
  }
  for (const Vec2 w : trial.slip) report.penetration = std::max(report.penetration, -w.x);
  if (report.converged) state = accept(model, body, state, trial);
  return report;
}

}  // namespace rondo::statics
