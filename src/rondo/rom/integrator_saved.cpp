// SPDX-License-Identifier: BSD-3-Clause
/// Saves and restores a reduced run (saved_reduced.hpp).
#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/rom/integrator.hpp"

namespace rondo::rom {
namespace {

std::vector<double> numbers_of(const VectorXd& v) {
  return {v.begin(), v.end()};
}

void take(const std::vector<double>& numbers, VectorXd& to) {
  to = Eigen::Map<const VectorXd>(numbers.data(), static_cast<Index>(numbers.size()));
}

}  // namespace

SavedReducedState ReducedIntegrator::save() const {
  SavedReducedState s;
  s.step = n_;
  s.displacement = numbers_of(q_);
  s.velocity = numbers_of(p_);
  s.velocity_middle = numbers_of(p_mid_);
  s.velocity_carried = numbers_of(carried_);
  if (matrices_) {
    const StepMatrixKey& key = matrices_->key();
    s.matrices = {key.carry, key.spin, key.spin_rate};
  }
  if (contact_) s.contact = contact_->save();
  if (rim_) s.rim = rim_->save();
  s.ledger = ledger_.save();
  return s;
}

bool ReducedIntegrator::fits(const SavedReducedState& s) const noexcept {
  const auto r = static_cast<std::size_t>(q_.size());
  const auto all = {&s.displacement, &s.velocity, &s.velocity_middle, &s.velocity_carried};
  const bool modes = std::ranges::all_of(all, [&](const auto* v) { return v->size() == r; });
  const bool rim =
      rim_ ? s.rim && s.rim->late.size() == r &&
                 (s.rim->displacement_before.empty() || s.rim->displacement_before.size() == r)
           : !s.rim;
  const bool contact = contact_ ? s.contact && contact_->fits(*s.contact) : !s.contact;
  return modes && rim && contact && s.step >= 0;
}

void ReducedIntegrator::restore(const SavedReducedState& s) {
  RONDO_DEMAND(fits(s));
  n_ = s.step;
  take(s.displacement, q_);
  take(s.velocity, p_);
  take(s.velocity_middle, p_mid_);
  take(s.velocity_carried, carried_);
  if (!s.matrices) matrices_.reset();
  if (s.matrices) {
    Motion m{};
    m.dt = input_.model.dt;
    m.carry = (*s.matrices)[0];
    m.spin = (*s.matrices)[1];
    m.spin_rate = (*s.matrices)[2];
    use_matrices(m);
  }
  if (s.contact) contact_->restore(*s.contact, matrices_.get());
  if (s.rim) rim_->restore(n_, *s.rim);
  frame_ = rim_ ? rim_->frame() : dynamics::frame_step(input_.model.motion, n_, input_.model.dt);
  ledger_.restore(s.ledger);
}

void ReducedIntegrator::lead(const RimVector& end) {
  RONDO_DEMAND(rim_ != nullptr);
  rim_->lead(end);
}

}  // namespace rondo::rom
