// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/viscous_branches.hpp"

#include <algorithm>
#include <type_traits>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/fem/stiffness_product.hpp"

namespace rondo::dynamics {

template <class Stiffness>
ViscousBranches<Stiffness>::ViscousBranches(Parts parts, std::span<const Vec> u, double dt,
                                            int threads)
    : dt_(dt),
      threads_(threads),
      u_(u.begin(), u.end()),
      strain_(u.size()),
      force_(u.size()),
      total_(u.size()),
      total_before_(u.size()) {
  RONDO_DEMAND(dt > 0.0, dt);
  for (const fem::ViscousPart<Stiffness>& part : parts)
    for (const fem::ViscousBranch& b : part.branches)
      branches_.push_back({part.stiffness, b.relative_modulus, b.time, u_,
                           std::vector<Vec>(u.size()), std::vector<Vec>(u.size())});
}

template <class Stiffness>
void ViscousBranches<Stiffness>::product(const Stiffness& v, std::span<const Vec> u,
                                         std::span<Vec> out) const noexcept {
  if constexpr (std::is_same_v<Stiffness, fem::BlockCsr>)
    fem::apply(v, u, out, threads_);
  else
    fem::apply(v, u, out);
}

/// By the midpoint rule q⁺ = [(1 - a) q + a (u + u⁺)]/(1 + a), a = Δt/2τ; the loss is Δt r/τ ēᵀ V ē
/// of the mean ē of u - q.
template <class Stiffness>
void ViscousBranches<Stiffness>::move(std::span<const Vec> u) noexcept {
  RONDO_ASSERT(u.size() == u_.size(), u.size(), u_.size());
  stored_ = lost_ = 0.0;
  for (Branch& b : branches_) {
    const double a = 0.5 * dt_ / b.time, kept = (1.0 - a) / (1.0 + a), taken = a / (1.0 + a);
    for (std::size_t k = 0; k < u.size(); ++k) {
      b.q[k] = kept * b.q[k] + taken * (u_[k] + u[k]);
      strain_[k] = u[k] - b.q[k];
    }
    product(b.stiffness, strain_, force_);
    double energy = 0.0, mean = 0.0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      energy += dot(strain_[k], force_[k]);
      mean += dot(b.strain[k] + strain_[k], b.force[k] + force_[k]);
    }
    stored_ += 0.5 * b.modulus * energy;
    lost_ += 0.25 * dt_ * b.modulus / b.time * mean;
    std::swap(b.strain, strain_);
    std::swap(b.force, force_);
  }
  std::ranges::copy(u, u_.begin());
  std::swap(total_, total_before_);
  add_up();
}

template <class Stiffness>
void ViscousBranches<Stiffness>::add_up() noexcept {
  std::ranges::fill(total_, Vec{});
  for (const Branch& b : branches_)
    for (std::size_t k = 0; k < total_.size(); ++k) total_[k] += b.modulus * b.force[k];
}

template <class Stiffness>
std::size_t ViscousBranches<Stiffness>::numbers(Parts parts, std::size_t n) noexcept {
  std::size_t branches = 0;
  for (const fem::ViscousPart<Stiffness>& part : parts) branches += part.branches.size();
  return branches * n * (sizeof(Vec) / sizeof(double));
}

template <class Stiffness>
std::vector<double> ViscousBranches<Stiffness>::save() const {
  std::vector<double> all;
  for (const Branch& b : branches_)
    for (const Vec& q : b.q) {
      all.insert(all.end(), {q.x, q.y});
      if constexpr (std::is_same_v<Vec, Vec3>) all.push_back(q.z);
    }
  return all;
}

template <class Stiffness>
void ViscousBranches<Stiffness>::restore(std::span<const Vec> u, std::span<const double> saved) {
  constexpr std::size_t components = sizeof(Vec) / sizeof(double);
  RONDO_DEMAND(u.size() == u_.size() && saved.size() == branches_.size() * u.size() * components,
               u.size(), saved.size());
  u_.assign(u.begin(), u.end());
  for (Branch& b : branches_) {
    for (std::size_t k = 0; k < u.size(); ++k) {
      const double* from = saved.data() + components * k;
      if constexpr (std::is_same_v<Vec, Vec3>)
        b.q[k] = {from[0], from[1], from[2]};
      else
        b.q[k] = {from[0], from[1]};
      b.strain[k] = u[k] - b.q[k];
    }
    product(b.stiffness, b.strain, b.force);
    saved = saved.subspan(components * u.size());
  }
  add_up();
}

template class ViscousBranches<fem::BlockCsr>;
template class ViscousBranches<fem::SolidSector>;

}  // namespace rondo::dynamics
