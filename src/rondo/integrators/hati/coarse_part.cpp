// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/hati/coarse_part.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/stiffness_product.hpp"

namespace rondo::dynamics {
namespace {

Eigen::Index row_of(std::size_t place) noexcept {
  return static_cast<Eigen::Index>(2 * place);
}

}  // namespace

CoarsePart::CoarsePart(const Model& whole, const PartFields& start)
    : whole_(whole),
      part_(whole.subdomains->coarse),
      interface_(whole.subdomains->interface),
      spin_(-whole.motion.angular_velocity.at(0.0)),
      fields_{std::vector<Vec2>(whole.n_nodes()), std::vector<Vec2>(whole.n_nodes())},
      rest_(fields_),
      travel_(interface_.size()),
      at_(whole.n_nodes()),
      force_(whole.n_nodes()),
      load_(row_of(part_.free.size())),
      change_(load_.size()) {
  RONDO_DEMAND(part_.mass.size() == whole.n_nodes() && start.u.size() == whole.n_nodes() &&
                   part_.stiffness.row_start.size() == whole.n_nodes() + 1,
               part_.mass.size(), start.u.size(), part_.stiffness.row_start.size(),
               whole.n_nodes());
  RONDO_ASSERT(std::ranges::includes(part_.free, interface_), part_.free.size(),
               interface_.size());  // both ascending
  for (const int node : part_.free) {
    fields_.u.plane()[at(node)] = start.u.plane()[at(node)];
    fields_.v.plane()[at(node)] = start.v.plane()[at(node)];
  }
  for (const int node : interface_)
    place_.push_back(static_cast<int>(std::lower_bound(part_.free.begin(), part_.free.end(), node) -
                                      part_.free.begin()));
  factor_.compute(matrix());
  RONDO_DEMAND(factor_.info() == Eigen::Success, part_.free.size());
}

/// (12.3): 2M + Δ(αM + 2sMJ) + Δ(Δ/2 + β)K - Δ²/2 s²M, of v̄ - v
CoarsePart::Matrix CoarsePart::matrix() const {
  const double dt = whole_.dt, s = spin_;
  const double of_mass = 2.0 + dt * whole_.mass_damping - 0.5 * dt * dt * s * s;
  Matrix a =
      dt * (0.5 * dt + whole_.stiffness_damping) * fem::free_matrix(part_.stiffness, part_.free);
  Matrix inertia(a.rows(), a.cols());
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < part_.free.size(); ++i) {
    const double mass = part_.mass[at(part_.free[i])];
    RONDO_ASSERT(mass > 0.0, part_.free[i], mass);
    const auto row = static_cast<int>(row_of(i));
    entries.emplace_back(row, row, mass * of_mass);
    entries.emplace_back(row + 1, row + 1, mass * of_mass);
    entries.emplace_back(row, row + 1, -2.0 * dt * s * mass);
    entries.emplace_back(row + 1, row, 2.0 * dt * s * mass);
  }
  inertia.setFromTriplets(entries.begin(), entries.end());
  a += inertia;
  a.makeCompressed();
  return a;
}

void CoarsePart::attempt(Vec2 pull, std::span<const Vec2> multiplier) {
  pull_ = pull;
  find_load(pull);
  take_multiplier(multiplier);
  solve();
  find_travel(fields_, travel_);
}

/// Δ [-K(u + (Δ/2 + β)v) - M(αI + 2sJ)v + M s²(X + u + Δ/2 v) - M pull]: the step with v̄ = v
void CoarsePart::find_load(Vec2 pull) {
  const double dt = whole_.dt, ahead = 0.5 * dt + whole_.stiffness_damping;
  const Complex drag{whole_.mass_damping, 2.0 * spin_};
  const std::span u = fields_.u.plane(), v = fields_.v.plane();
  for (const int node : part_.free) at_[at(node)] = u[at(node)] + ahead * v[at(node)];
  apply(part_.stiffness, at_, force_, whole_.threads);
  for (std::size_t i = 0; i < part_.free.size(); ++i) {
    const std::size_t k = at(part_.free[i]);
    const Vec2 arm = whole_.reference[k] + u[k] + 0.5 * dt * v[k];
    const Vec2 acceleration = spin_ * spin_ * arm - drag * v[k] - pull;
    const Vec2 load = dt * (part_.mass[k] * acceleration - force_[k]);
    load_[row_of(i)] = load.x;
    load_[row_of(i) + 1] = load.y;
  }
}

void CoarsePart::take_multiplier(std::span<const Vec2> multiplier) {
  RONDO_ASSERT(multiplier.size() == interface_.size(), multiplier.size(), interface_.size());
  for (std::size_t i = 0; i < interface_.size(); ++i) {
    load_[row_of(at(place_[i]))] -= whole_.dt * multiplier[i].x;
    load_[row_of(at(place_[i])) + 1] -= whole_.dt * multiplier[i].y;
  }
}

void CoarsePart::solve() {
  change_ = factor_.solve(load_);
}

Vec2 CoarsePart::mean_velocity(const PartFields& from, std::size_t place) const noexcept {
  const Vec2 change{change_[row_of(place)], change_[row_of(place) + 1]};
  return from.v.plane()[at(part_.free[place])] + change;
}

/// Δ v̄ of the interface.
void CoarsePart::find_travel(const PartFields& from, std::span<Vec2> travel) const noexcept {
  RONDO_ASSERT(travel.size() == interface_.size(), travel.size(), interface_.size());
  for (std::size_t i = 0; i < interface_.size(); ++i)
    travel[i] = whole_.dt * mean_velocity(from, at(place_[i]));
}

void CoarsePart::accept() {
  find_works(pull_);
  const std::span u = fields_.u.plane(), v = fields_.v.plane();
  for (std::size_t i = 0; i < part_.free.size(); ++i) {
    const std::size_t k = at(part_.free[i]);
    u[k] += whole_.dt * mean_velocity(fields_, i);
    v[k] += 2.0 * Vec2{change_[row_of(i)], change_[row_of(i) + 1]};
  }
}

/// The works (5.3) of a coarse step as in 12.4, without the work of the multiplier.
void CoarsePart::find_works(Vec2 pull) {
  const double dt = whole_.dt, alpha = whole_.mass_damping, beta = whole_.stiffness_damping;
  works_ = {};
  for (std::size_t i = 0; i < part_.free.size(); ++i)
    at_[at(part_.free[i])] = mean_velocity(fields_, i);
  if (beta > 0.0) apply(part_.stiffness, at_, force_, whole_.threads);
  const std::span u = fields_.u.plane();
  for (const int node : part_.free) {
    const std::size_t k = at(node);
    const Vec2 mean = at_[k], middle = u[k] + 0.5 * dt * mean;
    const double mass = part_.mass[k];
    works_.frame += dt * mass * dot(mean, spin_ * spin_ * (whole_.reference[k] + middle) - pull);
    works_.dissipation_mass += dt * alpha * mass * dot(mean, mean);
    if (beta > 0.0) works_.dissipation_stiffness += dt * beta * dot(mean, force_[k]);
  }
}

/// (12.4): ½ vᵀM v + ½ uᵀK u
void CoarsePart::add_energy(double& kinetic, double& strain) {
  const std::span u = fields_.u.plane(), v = fields_.v.plane();
  apply(part_.stiffness, u, force_, whole_.threads);
  for (const int node : part_.free) {
    const std::size_t k = at(node);
    kinetic += 0.5 * part_.mass[k] * dot(v[k], v[k]);
    strain += 0.5 * dot(u[k], force_[k]);
  }
}

void CoarsePart::respond(std::span<const Vec2> multiplier, std::span<Vec2> travel) {
  load_.setZero();
  take_multiplier(multiplier);
  solve();
  find_travel(rest_, travel);
}

}  // namespace rondo::dynamics
