// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/hati/hati_integrator.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/integrators/general/step_traps.hpp"
#include "rondo/integrators/hati/coarse_contact.hpp"

namespace rondo::dynamics {
namespace {

PartFields fields_of(const State& start) {
  RONDO_DEMAND(start.u.size() == start.v.size(), start.u.size(), start.v.size());
  return {start.u, start.v};
}

Eigen::Index row_of_node(std::size_t node) noexcept {
  return static_cast<Eigen::Index>(2 * node);
}

}  // namespace

HatiIntegrator::HatiIntegrator(const Model& model, const State& start)
    : model_(model),
      parts_(*model.subdomains),
      fine_(model, fields_of(start)),
      coarse_(model, fields_of(start)),
      multiplier_(parts_.interface.size()),
      apart_(row_of_node(parts_.interface.size())),
      change_(apart_.size()) {
  RONDO_DEMAND(!parts_.interface.empty());
  factor_interface();
  ledger_.compare(energy());
}

/// H of (12.4), column by column: by how much a multiplier moves A's side of the interface away
/// from B's.
void HatiIntegrator::factor_interface() {
  Eigen::MatrixXd h(apart_.size(), apart_.size());
  Vectors unit(multiplier_.size()), fine(unit.size()), coarse(unit.size());
  for (std::size_t i = 0; i < unit.size(); ++i)
    for (const int component : {0, 1}) {
      unit[i] = component == 0 ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0};
      fine_.respond(unit, fine);
      coarse_.respond(unit, coarse);
      for (std::size_t j = 0; j < unit.size(); ++j) {
        h(row_of_node(j), row_of_node(i) + component) = fine[j].x - coarse[j].x;
        h(row_of_node(j) + 1, row_of_node(i) + component) = fine[j].y - coarse[j].y;
      }
      unit[i] = {};
    }
  interface_.compute(h);
}

/// λ -= H⁻¹ (L_A[u_A] - L_B[u_B])
void HatiIntegrator::correct_multiplier() noexcept {
  for (std::size_t i = 0; i < multiplier_.size(); ++i) {
    const Vec2 apart = fine_.travel()[i] - coarse_.travel()[i];
    apart_[row_of_node(i)] = apart.x;
    apart_[row_of_node(i) + 1] = apart.y;
  }
  change_ = interface_.solve(apart_);
  for (std::size_t i = 0; i < multiplier_.size(); ++i)
    multiplier_[i] -= Vec2{change_[row_of_node(i)], change_[row_of_node(i) + 1]};
}

/// Works of A's last attempt, and of B's step that was accepted last.
Works HatiIntegrator::works() const noexcept {
  Works w = fine_.works();
  w.frame += coarse_.works().frame;
  w.dissipation_mass += coarse_.works().dissipation_mass;
  w.dissipation_stiffness += coarse_.works().dissipation_stiffness;
  for (std::size_t i = 0; i < multiplier_.size(); ++i)
    w.interface += dot(multiplier_[i], fine_.travel()[i] - coarse_.travel()[i]);
  return w;
}

StepEnergy HatiIntegrator::energy() noexcept {
  StepEnergy e;
  fine_.add_energy(e.kinetic, e.strain);
  coarse_.add_energy(e.kinetic, e.strain);
  return e;
}

StepReport HatiIntegrator::step() noexcept {
  const StepTraps traps;
  ++step_;
  fine_.attempt(step_, multiplier_);
  coarse_.attempt(fine_.pull(), multiplier_);
  correct_multiplier();
  fine_.attempt(step_, multiplier_);
  coarse_.attempt(fine_.pull(), multiplier_);
  fine_.accept();
  coarse_.accept();
  ledger_.add_works(works());
  ledger_.compare(energy());
  StepReport report;
  report.step = step_;
  report.frame = frame_step(model_.motion, step_, model_.dt);
  report.contact = contact_of(fine_.contacts());
  report.balance = ledger_.last();
  report.contact_felt_joint = !fine_.same_impulses();
  return report;
}

void HatiIntegrator::advance(std::span<StepReport> reports, State* last) noexcept {
  RONDO_DEMAND(!reports.empty());
  for (StepReport& report : reports) report = step();
  if (!last) return;
  last->step = step_;
  last->frame = reports.back().frame;
  fill_displacement(last->u);
  if (!last->v.empty()) fill_velocity(last->v);
  if (!last->v_next.empty()) fill_velocity(last->v_next);
  merge_contacts(fine_.contacts(), last->active);
}

/// Nodes where the parts meet get A's displacement, which is B's to round-off, and a mean velocity.
void HatiIntegrator::fill_displacement(Field& u) const noexcept {
  u = coarse_.fields().u;
  for (const int node : parts_.fine.free) u.plane()[at(node)] = fine_.fields().u.plane()[at(node)];
}

void HatiIntegrator::fill_velocity(Field& v) const noexcept {
  v = coarse_.fields().v;
  for (const int node : parts_.fine.free) {
    const std::size_t k = at(node);
    const double a = parts_.fine.mass[k], b = parts_.coarse.mass[k];
    RONDO_ASSERT(a > 0.0 && b >= 0.0, k, a, b);
    v.plane()[k] = b == 0.0 ? fine_.fields().v.plane()[k]
                            : (a * fine_.fields().v.plane()[k] + b * v.plane()[k]) / (a + b);
  }
}

void HatiIntegrator::fields(State& state) const noexcept {
  fill_displacement(state.u);
  fill_velocity(state.v_next);
}

SavedState HatiIntegrator::save() const {
  SavedState saved;
  saved.step = step_;
  saved.u = coarse_.fields().u;
  saved.v = coarse_.fields().v;
  for (const Field* of : {&saved.u, &saved.v})
    for (const int node : parts_.interface) saved.interface.push_back(of->plane()[at(node)]);
  saved.interface.insert(saved.interface.end(), multiplier_.begin(), multiplier_.end());
  for (const int node : parts_.fine.free) {
    saved.u.plane()[at(node)] = fine_.fields().u.plane()[at(node)];
    saved.v.plane()[at(node)] = fine_.fields().v.plane()[at(node)];
  }
  saved.impulses = fine_.impulses();
  saved.ledger = ledger_.save();
  return saved;
}

void HatiIntegrator::restore(const SavedState& saved) {
  const std::size_t n = multiplier_.size();
  RONDO_DEMAND(saved.u.size() == model_.n_nodes() && saved.v.size() == model_.n_nodes() &&
                   saved.interface.size() == 3 * n,
               saved.u.size(), saved.v.size(), saved.interface.size(), n);
  const Field zero(saved.u.size(), 2);
  PartFields fine{zero, zero}, coarse = fine;
  for (const int node : parts_.fine.free) {
    fine.u.plane()[at(node)] = saved.u.plane()[at(node)];
    fine.v.plane()[at(node)] = saved.v.plane()[at(node)];
  }
  for (const int node : parts_.coarse.free) {
    coarse.u.plane()[at(node)] = saved.u.plane()[at(node)];
    coarse.v.plane()[at(node)] = saved.v.plane()[at(node)];
  }
  for (std::size_t i = 0; i < n; ++i) {
    coarse.u.plane()[at(parts_.interface[i])] = saved.interface[i];
    coarse.v.plane()[at(parts_.interface[i])] = saved.interface[n + i];
    multiplier_[i] = saved.interface[2 * n + i];
  }
  step_ = saved.step;
  fine_.set(std::move(fine), saved.impulses);
  coarse_.set(std::move(coarse));
  ledger_.restore(saved.ledger);
}

}  // namespace rondo::dynamics
