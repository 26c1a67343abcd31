// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/contact_table.hpp"

#include <algorithm>

namespace rondo::rom {
namespace {

constexpr Index first_slots = 32;

Vec2 times(const RowMatrix& rows, int k, const VectorXd& coefficients) {
  const Index row = 2 * static_cast<Index>(k);
  return {rows.row(row).dot(coefficients), rows.row(row + 1).dot(coefficients)};
}

/// Adds rate · J of each pair of rows to `to`.
void add_turned(double rate, const MatrixXd& rows, Eigen::Ref<MatrixXd> to) {
  for (Index k = 0; k < rows.rows(); k += 2) {
    to.row(k) -= rate * rows.row(k + 1);
    to.row(k + 1) += rate * rows.row(k);
  }
}

}  // namespace

ContactTable::ContactTable(const rom::ContactRows& rows, const MatrixXd& carried)
    : rows_(rows.rows),
      carried_(carried),
      points_(rows.points),
      share_(rows.share),
      beside_(rows.beside),
      slot_(points_.size(), -1) {
  for (Index k = 0; k < rows_.rows(); k += 2) reach_.push_back(rows_.middleRows(k, 2).norm());
}

Vec2 ContactTable::at(int k, const VectorXd& coefficients) const {
  return times(rows_, k, coefficients);
}

double ContactTable::length(int k, const VectorXd& q) const {
  const double share = share_[static_cast<std::size_t>(k)];
  const Vec2 u = at(k, q);
  double undeformed = 0.0, deformed = 0.0;
  for (const int other : beside_[static_cast<std::size_t>(k)]) {
    if (other < 0) continue;
    const Vec2 way = point(other) - point(k);
    undeformed += norm(way);
    deformed += norm(way + at(other, q) - u);
  }
  return undeformed > 0.0 ? share * (deformed / undeformed) : share;
}

Vec2 ContactTable::carried(int k, const VectorXd& coefficients) const {
  return times(carried_, k, coefficients);
}

void ContactTable::add_push(int k, Vec2 impulse, VectorXd& push) const {
  const Index row = 2 * static_cast<Index>(k);
  push += impulse.x * rows_.row(row).transpose();
  push += impulse.y * rows_.row(row + 1).transpose();
}

void ContactTable::grow(Index slots) {
  if (2 * slots <= dq_.cols()) return;
  const Index size = std::max({2 * first_slots, 2 * slots, 2 * dq_.cols()});
  const Index r = rows_.cols();
  slot_rows_.conservativeResize(size, r);
  if (stands_still()) slot_carried_.conservativeResize(size, r);
  dq_.conservativeResize(r, size);
  dp_.conservativeResize(r, size);
  normal_.conservativeResize(size, size);
  if (stands_still()) tangential_.conservativeResize(size, size);
}

void ContactTable::prepare(std::span<const int> points, const StepMatrices& matrices) {
  const auto before = static_cast<Index>(known_.size());
  for (const int point : points) {
    int& slot = slot_[static_cast<std::size_t>(point)];
    if (slot >= 0) continue;
    slot = static_cast<int>(known_.size());
    known_.push_back(point);
  }
  const auto now = static_cast<Index>(known_.size());
  if (now == before) return;
  portion_ends_.push_back(known_.size());
  grow(now);
  for (Index s = before; s < now; ++s) {
    const Index row = 2 * static_cast<Index>(known_[static_cast<std::size_t>(s)]);
    slot_rows_.middleRows(2 * s, 2) = rows_.middleRows(row, 2);
    if (stands_still()) slot_carried_.middleRows(2 * s, 2) = carried_.middleRows(row, 2);
  }
  const Index fresh = 2 * (now - before), old = 2 * before, all = 2 * now;
  MatrixXd dq, dp;
  matrices.respond(slot_rows_.middleRows(old, fresh).transpose(), dq, dp);
  dq_.middleCols(old, fresh) = dq;
  dp_.middleCols(old, fresh) = dp;
  const double spin = matrices.key().carry;
  // Fill all rows of the new columns, then the new rows of the old columns.
  const auto fill = [&](Index row, Index rows, Index column, Index columns) {
    if (rows == 0 || columns == 0) return;
    const auto h = slot_rows_.middleRows(row, rows);
    const MatrixXd material = h * dp_.middleCols(column, columns);
    const MatrixXd moved = h * dq_.middleCols(column, columns);
    MatrixXd& slip = stands_still() ? tangential_ : normal_;
    slip.block(row, column, rows, columns) = material;
    add_turned(spin, moved, slip.block(row, column, rows, columns));
    if (stands_still())
      normal_.block(row, column, rows, columns) =
          material + spin * (slot_carried_.middleRows(row, rows) * dq_.middleCols(column, columns));
  };
  fill(0, all, old, fresh);
  fill(old, fresh, 0, old);
}

DelassusPair ContactTable::pair(int at, int from) const noexcept {
  const Index i = 2 * slot_[static_cast<std::size_t>(at)];
  const Index j = 2 * slot_[static_cast<std::size_t>(from)];
  const MatrixXd& slip = stands_still() ? tangential_ : normal_;
  return {normal_.block<2, 2>(i, j), slip.block<2, 2>(i, j)};
}

void ContactTable::forget() noexcept {
  for (const int point : known_) slot_[static_cast<std::size_t>(point)] = -1;
  known_.clear();
  portion_ends_.clear();
}

std::vector<std::vector<int>> ContactTable::portions() const {
  std::vector<std::vector<int>> portions;
  auto from = known_.begin();
  for (const std::size_t end : portion_ends_) {
    const auto to = known_.begin() + static_cast<std::ptrdiff_t>(end);
    portions.emplace_back(from, to);
    from = to;
  }
  return portions;
}

double ContactTable::bytes(std::size_t m, Index modes, std::size_t points) noexcept {
  const double r = static_cast<double>(modes), n = 2.0 * static_cast<double>(points);
  return 8.0 * (2.0 * static_cast<double>(m) * r + 3.0 * n * r + n * n);
}

}  // namespace rondo::rom
