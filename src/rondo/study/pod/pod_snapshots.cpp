// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/pod/pod_snapshots.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

using pod::Index;

std::size_t size(Index n) {
  return static_cast<std::size_t>(n);
}

std::vector<double> point_weights(const io::RunReader& run, const SnapshotChoice& choice) {
  const std::vector<double>& mass = run.mass();
  std::vector<double> weight;
  if (choice.quantity == io::Quantity::contact)
    for (const int node : run.mesh().boundary) weight.push_back(mass[at(node)]);
  else
    weight = mass;
  for (double& w : weight) {
    if (choice.weight == Weight::none) w = 1.0;
    if (choice.weight == Weight::delassus) w = 1.0 / w;
  }
  return weight;
}

/// Squares of larger numbers would overflow.
constexpr double largest = 1e100;

[[noreturn]] void out_of_range(const io::RunReader& run, double time) {
  throw InputError(
      Fault{run.directory().string(), 0, 0, "", "",
            fmt::format("the snapshot at t = {:.9g} s holds numbers that are not finite, or above "
                        "{:.0e}",
                        time, largest),
            "a window that ends before it (--to)"});
}

}  // namespace

RunSnapshots::RunSnapshots(std::span<const io::RunReader> runs, std::vector<SnapshotColumn> columns,
                           const SnapshotChoice& choice)
    : runs_(runs), columns_(std::move(columns)), choice_(choice) {
  RONDO_DEMAND(!runs_.empty() && !columns_.empty(), runs_.size(), columns_.size());
  const io::RunReader& run = runs_.front();
  const bool contact = choice.quantity == io::Quantity::contact;
  const std::size_t n_points = run.n_points(choice.quantity);
  if (choice.rectified) {
    rings_ = contact ? pod::boundary_rings(run.mesh()) : pod::node_rings(run.mesh());
    order_ = rings_.point;
  } else {
    order_.resize(n_points);
    std::iota(order_.begin(), order_.end(), 0);
  }
  weight_ = point_weights(run, choice);
  RONDO_DEMAND(order_.size() == n_points && weight_.size() == n_points, order_.size(),
               weight_.size(), n_points);
  for (const int point : order_) root_.push_back(std::sqrt(weight_[at(point)]));
  components_ = run.n_components(choice.quantity);
  RONDO_DEMAND(components_ == 2 || components_ == 3, components_);
  row_.resize(n_points);
  field_.resize(n_points);
  if (components_ == 3) {
    axial_row_.resize(n_points);
    axial_.resize(n_points);
    numbers_.resize(3 * n_points);
  }
  scratch_.resize(rows());
}

Index RunSnapshots::rows() const noexcept {
  return static_cast<Index>(components_ * order_.size());
}

Index RunSnapshots::columns() const noexcept {
  return static_cast<Index>(columns_.size());
}

Index RunSnapshots::row_grain() const noexcept {
  const auto components = static_cast<Index>(components_);
  return choice_.rectified ? components * rings_.n_sectors : components;
}

/// Reads points of one snapshot in the order of the file, from `first` on.
void RunSnapshots::read_points(const SnapshotColumn& column, std::size_t first,
                               std::span<Vec2> plane, std::span<double> axial) {
  const io::RunReader& run = runs_[column.run];
  if (components_ == 2) return run.read(choice_.quantity, column.snapshot, first, plane);
  const std::span<double> numbers = std::span(numbers_).first(3 * plane.size());
  run.read(choice_.quantity, column.snapshot, first, {numbers, 3});
  for (std::size_t i = 0; i < plane.size(); ++i) {
    plane[i] = {numbers[3 * i], numbers[3 * i + 1]};
    axial[i] = numbers[3 * i + 2];
  }
}

/// Computes the points [first, first + count) of one snapshot, in the requested frame and order,
/// into field_ and axial_.
void RunSnapshots::read_order(const SnapshotColumn& column, std::size_t first, std::size_t count) {
  const std::span<Vec2> field = std::span(field_).first(count);
  const std::span<double> axial = std::span(axial_).first(components_ == 3 ? count : 0);
  if (!choice_.rectified) {
    read_points(column, first, field, axial);
  } else {
    read_points(column, 0, row_, axial_row_);
    for (std::size_t i = 0; i < count; ++i) field[i] = row_[at(order_[first + i])];
    for (std::size_t i = 0; i < axial.size(); ++i) axial[i] = axial_row_[at(order_[first + i])];
    rectify(column, field, axial);
  }
  bool in_range = true;
  for (const Vec2& v : field)
    in_range = in_range && std::abs(v.x) < largest && std::abs(v.y) < largest;
  for (const double w : axial) in_range = in_range && std::abs(w) < largest;
  if (!in_range) out_of_range(runs_[column.run], column.time);
}

/// Moves complete rings, in order, to the rectified frame.
void RunSnapshots::rectify(const SnapshotColumn& column, std::span<Vec2> plane,
                           std::span<double> axial) {
  const std::size_t n_rings = plane.size() / static_cast<std::size_t>(rings_.n_sectors);
  if (!rectifier_ || rectifier_rings_ != n_rings) {
    using pod::Components;
    const bool contact = choice_.quantity == io::Quantity::contact;
    rectifier_.emplace(rings_.n_sectors, n_rings,
                       contact ? Components::scalars : Components::cartesian, *choice_.rectified);
    rectifier_rings_ = n_rings;
  }
  rectifier_->apply(column.angle, plane);
  if (!axial.empty()) rectifier_->apply(column.angle, axial);
}

void RunSnapshots::store(Eigen::Ref<Eigen::VectorXd> out, const SnapshotColumn& column,
                         std::size_t first, std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i) {
    const double root = column.weight * root_[first + i];
    const auto at = static_cast<Index>(components_ * i);
    out[at] = root * field_[i].x;
    out[at + 1] = root * field_[i].y;
    if (components_ == 3) out[at + 2] = root * axial_[i];
  }
}

void RunSnapshots::read_columns(Index first, Eigen::Ref<Eigen::MatrixXd> out) {
  for (Index j = 0; j < out.cols(); ++j) {
    const SnapshotColumn& column = columns_[size(first + j)];
    read_order(column, 0, order_.size());
    store(out.col(j), column, 0, order_.size());
  }
}

void RunSnapshots::read_rows(Index first, Eigen::Ref<Eigen::MatrixXd> out) {
  const std::size_t place = size(first) / components_, count = size(out.rows()) / components_;
  for (Index j = 0; j < out.cols(); ++j) {
    read_order(columns_[size(j)], place, count);
    store(out.col(j), columns_[size(j)], place, count);
  }
}

void RunSnapshots::unweight(Eigen::Ref<Eigen::VectorXd> rows) {
  scratch_ = rows;
  const auto components = static_cast<Index>(components_);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Index to = components * order_[i], from = components * static_cast<Index>(i);
    for (Index c = 0; c < components; ++c) rows[to + c] = scratch_[from + c] / root_[i];
  }
}

}  // namespace rondo::study
