// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/solid/swept_part.hpp"

#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::dynamics {

fem::finite::SweptForces swept_forces(const Model& model) {
  RONDO_DEMAND(model.solid && model.solid->swept, model.n_nodes());
  std::vector<Vec3> x;
  for (std::size_t k = 0; k < model.n_nodes(); ++k)
    x.emplace_back(model.reference[k], model.solid->axial[k]);
  return {model.solid->swept->faces, std::move(x), model.solid->sector.n_sectors};
}

SweptWheel::SweptWheel(const SweptPart& part, std::vector<Vec3> x)
    : part_(part), faces_(part.faces, std::move(x), part.sector.n_sectors) {
  if (!part.rubber) return;
  rubber_.emplace(*part.rubber, part.sector.turn);
  const auto columns = static_cast<std::size_t>(part.sector.n_sectors);
  weight_before_.assign(columns, 0.0);
  energy_before_.assign(columns, 0.0);
  weight_.assign(columns, 0.0);
  energy_.assign(columns, 0.0);
}

double SweptWheel::find(std::span<const Vec3> u, double angle, std::span<Vec3> force) noexcept {
  fem::apply(part_.sector, u, force);
  double energy = 0.0;
  for (std::size_t k = 0; k < u.size(); ++k) energy += 0.5 * dot(u[k], force[k]);
  energy += faces_.add_to(u, force);
  return rubber_ ? energy + find_rubber(u, angle, force) : energy;
}

void SweptWheel::tangent(std::span<const Vec3> u, double angle, std::span<const double> near,
                         const fem::finite::TakeBlock& take) const {
  const fem::SolidSector& k = part_.sector;
  const std::size_t n = k.turn.size();
  for (std::size_t j = 0; j < n; ++j) {
    if (near[j] == 0.0) continue;
    for (std::size_t a = 0; a < k.n_local(); ++a)
      for (const fem::SolidSector::Entry& e : k.row(a)) {
        const std::size_t to = (j + n + static_cast<std::size_t>(e.shift + 1) - 1) % n;
        take(k.node(a, j), k.node(static_cast<std::size_t>(e.column), to),
             fem::finite::about_axle(k.turn[j]) *
                 Eigen::Map<const Eigen::Matrix3d>(e.block.data()) *
                 fem::finite::about_axle(k.turn[to]).transpose());
      }
  }
  faces_.tangent(u, near, take);
  if (!rubber_) return;
  std::vector<double> weight(n);
  part_.window.find(angle, weight);
  for (std::size_t j = 0; j < n; ++j) weight[j] *= near[j];
  rubber_->tangent(u, weight, take);
}

/// @return the energy of the remainders in their window
double SweptWheel::find_rubber(std::span<const Vec3> u, double angle,
                               std::span<Vec3> force) noexcept {
  std::swap(weight_, weight_before_);
  std::swap(energy_, energy_before_);
  part_.window.find(angle, weight_);
  rubber_->add_to(u, weight_, force, energy_);
  double energy = 0.0;
  window_work_ = 0.0;
  for (std::size_t j = 0; j < weight_.size(); ++j) {
    energy += weight_[j] * energy_[j];
    window_work_ += 0.5 * (weight_[j] - weight_before_[j]) * (energy_[j] + energy_before_[j]);
  }
  return energy;
}

double stored_energy(const Model& model, std::span<const Vec3> u) {
  std::vector<Vec3> force(model.n_nodes());
  fem::apply(model.solid->linear(), u, force);
  double linear = 0.0;
  for_free_nodes(model, [&](std::size_t k) { linear += 0.5 * dot(u[k], force[k]); });
  return linear + swept_forces(model).add_to(u, force);
}

}  // namespace rondo::dynamics
