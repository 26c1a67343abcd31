// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/pod/pod_snapshots.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"

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
    for (const int node : run.mesh().boundary)
      weight.push_back(mass[static_cast<std::size_t>(node)]);
  else
    weight = mass;
  for (double& w : weight) {
    if (choice.weight == Weight::none) w = 1.0;
    if (choice.weight == Weight::delassus) w = 1.0 / w;
  }
  return weight;
}

/// Squares of larger numbers are out of range.
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
  for (const int point : order_)
    root_.push_back(std::sqrt(weight_[static_cast<std::size_t>(point)]));
  row_.resize(n_points);
  field_.resize(n_points);
  scratch_.resize(rows());
}

Index RunSnapshots::rows() const noexcept {
  return static_cast<Index>(2 * order_.size());
}

Index RunSnapshots::columns() const noexcept {
  return static_cast<Index>(columns_.size());
}

Index RunSnapshots::row_grain() const noexcept {
  return choice_.rectified ? 2 * rings_.n_sectors : 2;
}

/// The places [first, first + count) of one snapshot, in the frame asked for, into field_.
void RunSnapshots::read_order(const SnapshotColumn& column, std::size_t first, std::size_t count) {
  const io::RunReader& run = runs_[column.run];
  const std::span<Vec2> field = std::span(field_).first(count);
  if (!choice_.rectified) {
    run.read(choice_.quantity, column.snapshot, first, field);
  } else {
    run.read(choice_.quantity, column.snapshot, 0, row_);
    for (std::size_t i = 0; i < count; ++i)
      field[i] = row_[static_cast<std::size_t>(order_[first + i])];
    const std::size_t n_rings = count / static_cast<std::size_t>(rings_.n_sectors);
    if (!rectifier_ || rectifier_rings_ != n_rings) {
      using pod::Components;
      const bool contact = choice_.quantity == io::Quantity::contact;
      rectifier_.emplace(rings_.n_sectors, n_rings,
                         contact ? Components::scalars : Components::cartesian, *choice_.rectified);
      rectifier_rings_ = n_rings;
    }
    rectifier_->apply(column.angle, field);
  }
  for (const Vec2& v : field)
    if (!(std::abs(v.x) < largest && std::abs(v.y) < largest)) out_of_range(run, column.time);
}

void RunSnapshots::store(Eigen::Ref<Eigen::VectorXd> out, const SnapshotColumn& column,
                         std::size_t first, std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i) {
    const double root = column.weight * root_[first + i];
    out[static_cast<Index>(2 * i)] = root * field_[i].x;
    out[static_cast<Index>(2 * i + 1)] = root * field_[i].y;
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
  const std::size_t place = size(first) / 2, count = size(out.rows()) / 2;
  for (Index j = 0; j < out.cols(); ++j) {
    read_order(columns_[size(j)], place, count);
    store(out.col(j), columns_[size(j)], place, count);
  }
}

void RunSnapshots::unweight(Eigen::Ref<Eigen::VectorXd> rows) {
  scratch_ = rows;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Index to = 2 * order_[i], from = static_cast<Index>(2 * i);
    rows[to] = scratch_[from] / root_[i];
    rows[to + 1] = scratch_[from + 1] / root_[i];
  }
}

}  // namespace rondo::study
