// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/rubber_crush.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rondo/core/index.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;

constexpr int most_iterations = 40, most_halvings = 8;
constexpr double smallest_part = 1.0 / 256.0;  ///< of an increment
constexpr double equilibrium_bound = 1e-11;    ///< ends the iteration at once
constexpr double equilibrium_floor = 1e-9;     ///< ends it where round-off is reached

}  // namespace

/// What an increment is solved to, and how far it is.
struct RubberCrush::Trial {
  double depth = 0.0, slide = 0.0;  ///< [m]
  std::vector<Vec2> u, gradient;    ///< (n) [m], [N/m]
  fem::Hyperelasticity::Pass pass;
  fem::Look look;              ///< at u
  CondensedSolution solution;  ///< of the set
  std::vector<Vec2> slip;      ///< (nb) gap, increment of slip [m]
  double rest = 0.0;           ///< ‖f(u) - Hᵀ r‖ / ‖Hᵀ r‖
};

RubberCrush::RubberCrush(const CrushModel& model, std::shared_ptr<const fem::Hyperelasticity> body,
                         std::vector<int> free, double reach)
    : model_(model), body_(std::move(body)), free_(std::move(free)) {
  for (std::size_t k = 0; k < model.nodes.size(); ++k)
    if (model.clearance[k] <= reach) set_.push_back(k);
}

/// f(u) at the trial's u, and what it leaves with the contact forces.
void RubberCrush::find_forces(Trial& trial) const {
  trial.look = body_->gradient(trial.u, {}, trial.gradient, trial.pass);
  std::vector<Vec2> rest = trial.gradient;
  double force = 0.0, sum = 0.0;
  for (std::size_t j = 0; j < set_.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    const Vec2 r{trial.solution.force[row], trial.solution.force[row + 1]};
    rest[at(model_.nodes[set_[j]])] -= Vec2{-r.y, r.x};
    force += dot(r, r);
  }
  for (const int node : free_) sum += dot(rest[at(node)], rest[at(node)]);
  trial.rest = sum == 0.0 ? 0.0 : std::sqrt(sum / force);
}

/// The contact law with the tangent's compliance; gaps and slips of the whole field with its forces
/// added. @param rest (n) displacement that the forces that are left over would make [m]
void RubberCrush::solve_contact(Trial& trial, const Condensation& tangent,
                                const std::vector<Vec2>& rest, const CrushState& state,
                                CrushReport& report) {
  CondensedProblem p{tangent.compliance(), Eigen::VectorXd(static_cast<Index>(2 * set_.size())),
                     friction_from(model_, state, set_)};
  const auto slip_of = [&](std::size_t k, Vec2 u) {
    const std::size_t node = at(model_.nodes[k]);
    const Vec2 now = in_contact_frame(u), before = in_contact_frame(state.u[node]);
    return Vec2{model_.clearance[k] - trial.depth + now.x,
                now.y - before.y - (trial.slide - state.slide)};
  };
  for (std::size_t j = 0; j < set_.size(); ++j) {
    const Vec2 free =
        slip_of(set_[j], trial.u[at(model_.nodes[set_[j]])] + rest[at(model_.nodes[set_[j]])]);
    p.free.segment<2>(static_cast<Index>(2 * j)) << free.x, free.y;
  }
  const CondensedReport solved = solve_condensed(p, model_.limits, trial.solution);
  report.sweeps += solved.sweeps;
  report.pivots += solved.pivots;
  if (solved.pivoting != Pivoting::none) report.pivoting = solved.pivoting;
  const std::vector<Vec2> pushed = tangent.field(trial.solution.force).u;
  for (const int node : free_) trial.u[at(node)] += rest[at(node)] + pushed[at(node)];
  trial.slip.resize(model_.nodes.size());
  for (std::size_t k = 0; k < trial.slip.size(); ++k)
    trial.slip[k] = slip_of(k, trial.u[at(model_.nodes[k])]);
  Eigen::VectorXd w(p.free.size());
  for (std::size_t j = 0; j < set_.size(); ++j)
    w.segment<2>(static_cast<Index>(2 * j)) << trial.slip[set_[j]].x, trial.slip[set_[j]].y;
  report.residual = condensed_residual(p, trial.solution.force, w);
}

/// Pressed, a body may be stable by its contact alone: where it was pressed last, springs are put
/// on gaps of zero, which leave the solution as it is.
void RubberCrush::hold_down(const Trial& trial, fem::BlockCsr& k, std::vector<Vec2>& rest) const {
  constexpr double springs = 10.0;  // over what the body has there
  for (std::size_t j = 0; j < set_.size(); ++j) {
    if (!(trial.solution.force[static_cast<Index>(2 * j)] > 0.0)) continue;
    const int node = model_.nodes[set_[j]];
    double& stiffness = (*fem::find_block(k, node, node))[3];
    const double gap = model_.clearance[set_[j]] - trial.depth + trial.u[at(node)].y;
    rest[at(node)].y += springs * stiffness * gap;
    stiffness += springs * stiffness;
  }
}

/// The contact law with the candidates of the set, until no other candidate is inside the ground.
bool RubberCrush::close_gaps(Trial& trial, Condensation& tangent, const std::vector<Vec2>& rest,
                             const CrushState& state, CrushReport& report) {
  const std::vector<Vec2> before = trial.u;
  for (;;) {
    trial.u = before;
    solve_contact(trial, tangent, rest, state, report);
    if (!(report.residual <= model_.bound)) return false;
    std::vector<char> inside(trial.slip.size(), 0);
    for (const std::size_t k : set_) inside[k] = 1;
    std::vector<std::size_t> more;
    for (std::size_t k = 0; k < trial.slip.size(); ++k)
      if (!inside[k] && trial.slip[k].x < 0.0) more.push_back(k);
    if (more.empty()) return true;
    tangent.append(more);
    set_.insert(set_.end(), more.begin(), more.end());
    report.appended += more.size();
    trial.solution.force.conservativeResizeLike(
        Eigen::VectorXd::Zero(static_cast<Index>(2 * set_.size())));
  }
}

/// One Newton step, halved until no cell is inverted.
bool RubberCrush::improve(Trial& trial, const CrushState& state, CrushReport& report) {
  fem::BlockCsr stiffness = body_->tangent(trial.u);
  std::vector<Vec2> rest = trial.gradient;
  hold_down(trial, stiffness, rest);
  Condensation tangent(stiffness, free_, model_.nodes);
  if (!tangent.factorised()) return false;
  tangent.append(set_);
  rest = tangent.displacement(rest);
  for (Vec2& u : rest) u = -u;
  const std::vector<Vec2> before = trial.u;
  if (!close_gaps(trial, tangent, rest, state, report)) return false;
  const std::vector<Vec2> whole = trial.u;
  double part = 1.0;
  for (int halving = 0; halving < most_halvings; ++halving, part *= 0.5) {
    for (std::size_t k = 0; k < whole.size(); ++k)
      trial.u[k] = before[k] + part * (whole[k] - before[k]);
    find_forces(trial);
    if (trial.look.least.ratio > 0.0 && std::isfinite(trial.rest)) break;
  }
  if (part < 1.0) trial.rest = std::numeric_limits<double>::infinity();  // gaps are not closed yet
  return trial.look.least.ratio > 0.0;
}

/// At first touch the undeformed body fits over the ground: there is no force that a residual could
/// be over.
void RubberCrush::lift_off(Trial& trial, CrushReport& report) const {
  trial.u.assign(trial.u.size(), {});
  trial.look = body_->gradient(trial.u, {}, trial.gradient, trial.pass);
  trial.solution.force.setZero();
  trial.solution.status.assign(set_.size(), contact::Status::open);
  for (const double clearance : model_.clearance) trial.slip.push_back({clearance, 0.0});
  report.residual = report.equilibrium = 0.0;
}

/// From the state to the trial's depth and slide.
bool RubberCrush::solve(Trial& trial, const CrushState& state, CrushReport& report) {
  trial.u = state.u;
  trial.gradient.resize(trial.u.size());
  trial.solution.force.resize(static_cast<Index>(2 * set_.size()));
  for (std::size_t j = 0; j < set_.size(); ++j)
    trial.solution.force.segment<2>(static_cast<Index>(2 * j)) << state.force[set_[j]].x,
        state.force[set_[j]].y;
  if (trial.depth == 0.0) return lift_off(trial, report), true;
  find_forces(trial);
  double best = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    if (!improve(trial, state, report)) return false;
    report.equilibrium = trial.rest;
    if (trial.rest <= equilibrium_bound) return true;
    if (trial.rest <= equilibrium_floor && trial.rest >= 0.5 * best) return true;
    best = std::min(best, trial.rest);
  }
  return false;
}

/// Works by mean forces: of the contact as of a linear body, those of the body beside.
void RubberCrush::accept(Trial& trial, CrushState& state) const {
  const CrushState before = state;
  state.depth = trial.depth;
  state.slide = trial.slide;
  state.u = std::move(trial.u);
  state.slip = std::move(trial.slip);
  std::fill(state.force.begin(), state.force.end(), Vec2{});
  std::fill(state.status.begin(), state.status.end(), contact::Status::open);
  for (std::size_t j = 0; j < set_.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    state.force[set_[j]] = {trial.solution.force[row], trial.solution.force[row + 1]};
    state.status[set_[j]] = trial.solution.status[j];
  }
  fem::Hyperelasticity::Pass pass;
  std::vector<Vec2> gradient(before.u.size());
  body_->gradient(before.u, {}, gradient, pass);
  CompensatedSum internal(before.works.internal, 0.0);
  for (const int node : free_)
    internal.add(0.5 * dot(gradient[at(node)] + trial.gradient[at(node)],
                           state.u[at(node)] - before.u[at(node)]));
  state.works.strain = trial.look.energy;
  state.works.internal = internal.value();
  add_works(model_, before, state);
}

CrushReport RubberCrush::bring_to(double depth, double slide, CrushState& state) {
  const CrushState first = state;
  double done = 0.0, part = 1.0;
  CrushReport report;
  while (done < 1.0) {
    const double next = std::min(1.0, done + part);
    Trial trial;
    trial.depth = next == 1.0 ? depth : first.depth + next * (depth - first.depth);
    trial.slide = next == 1.0 ? slide : first.slide + next * (slide - first.slide);
    report.converged = solve(trial, state, report);
    if (report.converged) {
      accept(trial, state);
      done = next;
    } else if ((part *= 0.5) < smallest_part) {
      state = first;
      return report;
    }
  }
  for (const Vec2 w : state.slip) report.penetration = std::max(report.penetration, -w.x);
  return report;
}

}  // namespace rondo::statics
