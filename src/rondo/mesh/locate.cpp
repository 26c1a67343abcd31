// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::mesh {
namespace {

constexpr double slack = 1e-9;  ///< in a cell's own coordinates: its edges belong to it

std::array<double, 4> barycentric(std::span<const Vec2> x, Vec2 p) {
  const double area = cross(x[1] - x[0], x[2] - x[0]);
  const double b = cross(p - x[0], x[2] - x[0]) / area, c = cross(x[1] - x[0], p - x[0]) / area;
  return {1.0 - b - c, b, c, 0.0};
}

/// Bilinear shape functions at (ξ, η) in [-1, 1]².
std::array<double, 4> bilinear(double xi, double eta) {
  return {0.25 * (1.0 - xi) * (1.0 - eta), 0.25 * (1.0 + xi) * (1.0 - eta),
          0.25 * (1.0 + xi) * (1.0 + eta), 0.25 * (1.0 - xi) * (1.0 + eta)};
}

std::optional<std::array<double, 4>> bilinear_at(std::span<const Vec2> x, Vec2 p) {
  constexpr int most = 30;  // about 5 are enough inside a convex cell
  const Vec2 a = 0.25 * (x[1] + x[2] - x[0] - x[3]), b = 0.25 * (x[2] + x[3] - x[0] - x[1]),
             c = 0.25 * (x[0] + x[2] - x[1] - x[3]),
             middle = 0.25 * ((x[0] + x[1]) + (x[2] + x[3]));
  double xi = 0.0, eta = 0.0;
  for (int k = 0; k < most; ++k) {
    const Vec2 miss = p - middle - xi * a - eta * b - (xi * eta) * c;
    const Vec2 by_xi = a + eta * c, by_eta = b + xi * c;
    const double jacobian = cross(by_xi, by_eta);
    if (!(jacobian > 0.0)) return std::nullopt;  // outside the cell, where the map folds
    const double step_xi = cross(miss, by_eta) / jacobian, step_eta = cross(by_xi, miss) / jacobian;
    xi += step_xi;
    eta += step_eta;
    if (std::abs(step_xi) + std::abs(step_eta) < 1e-14) break;
  }
  if (!(std::abs(xi) <= 1.0 + slack && std::abs(eta) <= 1.0 + slack)) return std::nullopt;
  return bilinear(xi, eta);
}

double distance_to_segment(Vec2 a, Vec2 b, Vec2 p) {
  const Vec2 d = b - a;
  const double along = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return norm(p - a - along * d);
}

}  // namespace

Vec2 middle_of(std::span<const Vec2> coordinates, const Cell& cell) noexcept {
  Vec2 sum;
  const int n = n_corners(cell);
  for (int a = 0; a < n; ++a) sum += coordinates[at(cell[static_cast<std::size_t>(a)])];
  return sum / n;
}

std::optional<std::array<double, 4>> shape_functions(std::span<const Vec2> corners, Vec2 p) {
  if (corners.size() == 4) return bilinear_at(corners, p);
  const auto n = barycentric(corners, p);
  if (std::min({n[0], n[1], n[2]}) >= -slack) return n;
  return std::nullopt;
}

CellGrid::Corners CellGrid::corners(std::size_t e) const {
  Corners c;
  c.n = static_cast<std::size_t>(n_corners(cells_[e]));
  for (std::size_t a = 0; a < c.n; ++a) c.at[a] = coordinates_[at(cells_[e][a])];
  return c;
}

CellGrid::CellGrid(std::span<const Vec2> coordinates, std::span<const Cell> cells)
    : coordinates_(coordinates), cells_(cells), low_(coordinates[0]), high_(coordinates[0]) {
  RONDO_DEMAND(!cells.empty(), coordinates.size());
  for (const Vec2 x : coordinates) {
    low_ = {std::min(low_.x, x.x), std::min(low_.y, x.y)};
    high_ = {std::max(high_.x, x.x), std::max(high_.y, x.y)};
  }
  const Vec2 size = high_ - low_;
  const double most = 2.0 * static_cast<double>(cells.size()) + 1.0;
  const double side = std::max({std::sqrt(size.x * size.y / static_cast<double>(cells.size())),
                                size.x / most, size.y / most});
  inverse_ = 1.0 / side;
  columns_ = static_cast<int>(size.x * inverse_) + 1;
  rows_ = static_cast<int>(size.y * inverse_) + 1;
  const std::size_t squares = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  start_.assign(squares + 2, 0);  // one more entry while they are counted
  for (std::size_t e = 0; e < cells.size(); ++e)
    each_square(e, [&](std::size_t s) { ++start_[s + 2]; });
  for (std::size_t s = 2; s < start_.size(); ++s) start_[s] += start_[s - 1];
  items_.resize(start_.back());
  for (std::size_t e = 0; e < cells.size(); ++e)
    each_square(e, [&](std::size_t s) { items_[start_[s + 1]++] = static_cast<int>(e); });
  start_.pop_back();
}

std::array<int, 2> CellGrid::square_of(Vec2 p) const {
  const auto place = [&](double x, double low, int n) {
    return static_cast<int>(std::clamp((x - low) * inverse_, 0.0, static_cast<double>(n - 1)));
  };
  return {place(p.x, low_.x, columns_), place(p.y, low_.y, rows_)};
}

/// Visits the squares that the bounding box of cell e, widened by the slack, touches.
template <class Visit>
void CellGrid::each_square(std::size_t e, Visit&& visit) const {
  const Corners c = corners(e);
  Vec2 low = c.at[0], high = c.at[0];
  for (std::size_t a = 1; a < c.n; ++a) {
    low = {std::min(low.x, c.at[a].x), std::min(low.y, c.at[a].y)};
    high = {std::max(high.x, c.at[a].x), std::max(high.y, c.at[a].y)};
  }
  const double wider = 4.0 * slack * norm(high - low);
  const auto [first_x, first_y] = square_of(low - Vec2{wider, wider});
  const auto [last_x, last_y] = square_of(high + Vec2{wider, wider});
  for (int j = first_y; j <= last_y; ++j)
    for (int i = first_x; i <= last_x; ++i)
      visit(static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
            static_cast<std::size_t>(i));
}

std::span<const int> CellGrid::near(Vec2 p) const {
  const auto [i, j] = square_of(p);
  const std::size_t s = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(i);
  return std::span(items_).subspan(start_[s], start_[s + 1] - start_[s]);
}

std::optional<std::array<double, 4>> CellGrid::within(int e, Vec2 p) const {
  const Corners c = corners(static_cast<std::size_t>(e));
  return shape_functions({c.at.data(), c.n}, p);
}

double CellGrid::distance(Vec2 p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < cells_.size(); ++e) {
    const Corners c = corners(e);
    for (std::size_t a = 0; a < c.n; ++a)
      nearest = std::min(nearest, distance_to_segment(c.at[a], c.at[(a + 1) % c.n], p));
  }
  return nearest;
}

}  // namespace rondo::mesh
