// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/reduced/spin_matrices.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace rondo::reduced {
namespace {

constexpr Index first_slots = 32;

MatrixXd inverse_of_step(const reduction::ReducedModel& m, const StepMatrixKey& k) {
  const Index r = m.size();
  const double h = 0.5 * k.dt, s = k.spin;
  const MatrixXd unit = MatrixXd::Identity(r, r);
  MatrixXd a(2 * r, 2 * r);
  a.topLeftCorner(r, r) = unit - h * s * m.generator;
  a.topRightCorner(r, r) = -h * unit;
  a.bottomLeftCorner(r, r) = h * (m.stiffness - s * s * unit + k.spin_rate * m.turn);
  a.bottomRightCorner(r, r) = (1.0 + h * k.mass_damping) * unit +
                              h * (2.0 * s * m.turn - s * m.generator) +
                              h * k.stiffness_damping * m.stiffness;
  return a.partialPivLu().inverse();
}

}  // namespace

SpinMatrices::SpinMatrices(const reduction::ReducedModel& model, const StepMatrixKey& key)
    : model_(model),
      key_(key),
      inverse_(inverse_of_step(model, key)),
      place_rows_(key.spin * model.rows * model.generator),
      slot_(model.contact_points.size(), -1) {}

void SpinMatrices::prepare(std::span<const int> points) {
  for (const int point : points)
    if (slot_[static_cast<std::size_t>(point)] < 0) add(point);
}

void SpinMatrices::add(int point) {
  const Index r = model_.size();
  const auto slot = static_cast<Index>(known_.size());
  if (2 * (slot + 1) > response_.cols()) {
    const Index size = std::max(2 * first_slots, 2 * response_.cols());
    response_.conservativeResize(2 * r, size);
    normal_.conservativeResize(size, size);
    tangential_.conservativeResize(size, size);
  }
  slot_[static_cast<std::size_t>(point)] = static_cast<int>(slot);
  known_.push_back(point);
  response_.middleCols(2 * slot, 2) =
      inverse_.rightCols(r) * model_.rows.middleRows(2 * point, 2).transpose();
  const auto make = [&](Index to, Index from) {
    const Index at = 2 * static_cast<Index>(known_[static_cast<std::size_t>(to)]);
    const auto q = response_.block(0, 2 * from, r, 2);
    const Eigen::Matrix2d material =
        model_.rows.middleRows(at, 2) * response_.block(r, 2 * from, r, 2);
    const Eigen::Matrix2d moved = model_.rows.middleRows(at, 2) * q;
    Eigen::Matrix2d turned;
    turned << -moved.row(1), moved.row(0);
    normal_.block(2 * to, 2 * from, 2, 2) = material + place_rows_.middleRows(at, 2) * q;
    tangential_.block(2 * to, 2 * from, 2, 2) = material + key_.spin * turned;
  };
  for (Index other = 0; other < slot; ++other) {
    make(slot, other);
    make(other, slot);
  }
  make(slot, slot);
}

DelassusPair SpinMatrices::pair(int at, int from) const noexcept {
  const Index i = 2 * slot_[static_cast<std::size_t>(at)];
  const Index j = 2 * slot_[static_cast<std::size_t>(from)];
  return {normal_.block<2, 2>(i, j), tangential_.block<2, 2>(i, j)};
}

}  // namespace rondo::reduced
