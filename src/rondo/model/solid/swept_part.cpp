// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/model/solid/swept_part.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/solid_sector.hpp"

namespace rondo::dynamics {

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

void SweptWheel::tangent(std::span<const Vec3> u, double angle,
                         const fem::finite::TakeBlock& take) const {
  const fem::SolidSector& k = part_.sector;
  const std::size_t n = k.turn.size();
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t a = 0; a < k.n_local(); ++a)
      for (const fem::SolidSector::Entry& e : k.row(a)) {
        const std::size_t to = (j + n + static_cast<std::size_t>(e.shift + 1) - 1) % n;
        take(k.node(a, j), k.node(static_cast<std::size_t>(e.column), to),
             fem::finite::about_axle(k.turn[j]) *
                 Eigen::Map<const Eigen::Matrix3d>(e.block.data()) *
                 fem::finite::about_axle(k.turn[to]).transpose());
      }
  faces_.tangent(u, take);
  if (!rubber_) return;
  std::vector<double> weight(n);
  part_.window.find(angle, weight);
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

void SweptWheel::save(std::vector<double>& numbers) const {
  numbers.insert(numbers.end(), weight_.begin(), weight_.end());
  numbers.insert(numbers.end(), energy_.begin(), energy_.end());
}

void SweptWheel::restore(std::span<const double> numbers) {
  RONDO_DEMAND(numbers.size() == 2 * weight_.size(), numbers.size(), weight_.size());
  std::ranges::copy(numbers.first(weight_.size()), weight_.begin());
  std::ranges::copy(numbers.last(weight_.size()), energy_.begin());
}

SweptWheel swept_wheel(const Model& model) {
  RONDO_DEMAND(model.solid && model.solid->swept, model.n_nodes());
  std::vector<Vec3> x;
  for (std::size_t k = 0; k < model.n_nodes(); ++k)
    x.emplace_back(model.reference[k], model.solid->axial[k]);
  return {*model.solid->swept, std::move(x)};
}

double stored_energy(const Model& model, std::span<const Vec3> u, double angle) {
  std::vector<Vec3> force(model.n_nodes());
  return swept_wheel(model).find(u, angle, force);
}

bool has_window(const Model& model) noexcept {
  return model.solid && model.solid->swept && model.solid->swept->rubber &&
         !model.solid->swept->window.is_whole();
}

std::size_t window_numbers(const Model& model) noexcept {
  return has_window(model) ? 2 + 2 * static_cast<std::size_t>(model.solid->sector.n_sectors) : 0;
}

}  // namespace rondo::dynamics
