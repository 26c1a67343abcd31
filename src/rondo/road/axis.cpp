// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/axis.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::road {
namespace {

/// Positions are even if none is farther from its place than this share of a step: rounding of the
/// numbers in the file is not.
constexpr double even_share = 1e-9;
/// Beyond an end by less than this share of the axis is on it: sums of steps have round-off.
constexpr double on_the_end = 1e-12;

bool are_even(const std::vector<double>& positions, double step) noexcept {
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (std::abs(positions[i] - (positions.front() + static_cast<double>(i) * step)) >
        even_share * step)
      return false;
  return true;
}

}  // namespace

Axis::Axis(double first, double step, std::size_t n, Border border, double offset)
    : first_(first),
      last_(first + static_cast<double>(n - 1) * step),
      step_(step),
      per_step_(1.0 / step),
      cells_(n - 1),
      border_(border),
      offset_(offset) {
  RONDO_DEMAND(n >= 2 && step > 0.0, n, step);
}

Axis::Axis(const std::vector<double>& positions, Border border, double offset)
    : Axis(positions.front(),
           (positions.back() - positions.front()) / static_cast<double>(positions.size() - 1),
           positions.size(), border, offset) {
  last_ = positions.back();
  if (are_even(positions, step_)) return;
  positions_ = positions;
  make_table();
}

/// The table has as many steps as there are cells, or up to eight times as many if the cells differ
/// much.
void Axis::make_table() {
  double narrowest = last_ - first_;
  for (std::size_t i = 0; i < cells_; ++i)
    narrowest = std::min(narrowest, positions_[i + 1] - positions_[i]);
  const double wanted = std::ceil((last_ - first_) / narrowest);
  const double n =
      std::clamp(wanted, static_cast<double>(cells_), 8.0 * static_cast<double>(cells_));
  step_ = (last_ - first_) / n;
  per_step_ = 1.0 / step_;
  table_.resize(static_cast<std::size_t>(n) + 1);
  std::size_t cell = 0;
  for (std::size_t k = 0; k < table_.size(); ++k) {
    const double x = first_ + static_cast<double>(k) * step_;
    while (cell + 1 < cells_ && positions_[cell + 1] <= x) ++cell;
    // One earlier: the step in which a coordinate lies is found with round-off.
    table_[k] = static_cast<std::uint32_t>(cell > 0 ? cell - 1 : 0);
  }
}

double Axis::position(std::size_t i) const noexcept {
  return positions_.empty() ? first_ + static_cast<double>(i) * step_ : positions_[i];
}

/// @pre first_ <= x <= last_
AxisPlace Axis::within(double x) const noexcept {
  AxisPlace place;
  const double steps = (x - first_) * per_step_;
  const auto whole = static_cast<std::size_t>(static_cast<std::int64_t>(steps));
  if (positions_.empty()) {
    place.cell = std::min(whole, cells_ - 1);
    place.fraction = std::min(steps - static_cast<double>(place.cell), 1.0);
    place.width = step_;
    return place;
  }
  std::size_t cell = table_[std::min(whole, table_.size() - 1)];
  while (cell + 1 < cells_ && positions_[cell + 1] <= x) ++cell;
  place.cell = cell;
  place.width = positions_[cell + 1] - positions_[cell];
  place.fraction = (x - positions_[cell]) / place.width;
  return place;
}

AxisPlace Axis::locate(double x) const noexcept {
  if (x >= first_ && x <= last_) [[likely]]
    return within(x);
  return beyond(x);
}

AxisPlace Axis::beyond(double x) const noexcept {
  if (std::isnan(x)) return {.outside = true};
  const double length = last_ - first_;
  const double slack = on_the_end * (length + std::abs(first_) + std::abs(last_));
  const double nearest = x < first_ ? first_ : last_;
  if (std::abs(x - nearest) <= slack) return within(nearest);
  if (border_ == Border::keep) {
    AxisPlace place = within(nearest);
    place.direction = 0.0;
    place.offset = offset_;
    return place;
  }
  if (!std::isfinite(x) || border_ == Border::none || border_ == Border::zero) {
    AxisPlace place;
    place.outside = true;
    return place;
  }
  const double period = border_ == Border::repeat ? length : 2.0 * length;
  double along = std::fmod(x - first_, period);
  if (along < 0.0) along += period;
  const bool mirrored = along > length;
  AxisPlace place = within(std::clamp(first_ + (mirrored ? period - along : along), first_, last_));
  place.direction = mirrored ? -1.0 : 1.0;
  return place;
}

}  // namespace rondo::road
