// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/coupled_pair.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "rondo/contact/residual.hpp"

namespace rondo::contact {
namespace {

constexpr int pair_refinements = 2;
constexpr double much_nearer = 1e-3;

using Vec4 = Eigen::Vector4d;
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

/// Both contacts: normal and tangential of the one, then of the other.
struct Pair {
  Eigen::Matrix4d delassus = Eigen::Matrix4d::Zero();
  Vec4 free;  ///< with the bounce
  std::array<double, 2> friction, mass;
};

Pair pair_of(const CoupledProblem& p, std::array<std::size_t, 2> contact,
             std::span<const Vec2> impulse) noexcept {
  Pair out;
  for (int a = 0; a < 2; ++a) {
    const std::size_t j = contact[static_cast<std::size_t>(a)];
    Vec2 free = p.free[j] + Vec2{p.bounce[j], 0.0};
    for (auto k = static_cast<std::size_t>(p.row_start[j]);
         k < static_cast<std::size_t>(p.row_start[j + 1]); ++k) {
      const auto l = static_cast<std::size_t>(p.column[k]);
      const Block& w = p.blocks[k];
      if (l == contact[0] || l == contact[1])
        out.delassus.block<2, 2>(2 * a, l == contact[0] ? 0 : 2) << w[0], w[1], w[2], w[3];
      else
        free += apply(w, impulse[l]);
    }
    out.free.segment<2>(2 * a) << free.x, free.y;
    out.friction[static_cast<std::size_t>(a)] = p.friction[j];
    out.mass[static_cast<std::size_t>(a)] = p.mass[j];
  }
  return out;
}

double residual_of(const Pair& p, const Vec4& r) noexcept {
  const Vec4 w = p.delassus * r + p.free;
  const double one = law_residual({r[0], r[1]}, {w[0], w[1]}, 0.0, p.friction[0], p.mass[0]);
  const double other = law_residual({r[2], r[3]}, {w[2], w[3]}, 0.0, p.friction[1], p.mass[1]);
  return std::max(one, other);
}

/// The impulses that these statuses mean, within the cones: 0 open, 1 sticks, 2 and 3 slip.
Vec4 try_statuses(const Pair& p, const Vec4& from, std::array<int, 2> status) noexcept {
  Eigen::Matrix4d columns = Eigen::Matrix4d::Zero();  // impulses of the unknowns
  std::array<int, 4> row{};
  int n = 0;
  Vec4 r = Vec4::Zero();
  for (int a = 0; a < 2; ++a) {
    const int s = status[static_cast<std::size_t>(a)], normal = 2 * a;
    if (s == 0) continue;
    const double edge = (s == 2 ? 1.0 : -1.0) * p.friction[static_cast<std::size_t>(a)];
    r[normal] = from[normal];
    r[normal + 1] = s == 1 ? from[normal + 1] : edge * from[normal];
    columns(normal, n) = 1.0;
    if (s != 1) columns(normal + 1, n) = edge;
    row[static_cast<std::size_t>(n++)] = normal;
    if (s != 1) continue;
    columns(normal + 1, n) = 1.0;
    row[static_cast<std::size_t>(n++)] = normal + 1;
  }
  if (n > 0) {
    const Eigen::Matrix4d product = p.delassus * columns;
    Small matrix(n, n);
    for (int i = 0; i < n; ++i) {
      const int at = row[static_cast<std::size_t>(i)];
      for (int k = 0; k < n; ++k) matrix(i, k) = product(at, k);
    }
    const Eigen::CompleteOrthogonalDecomposition<Small> factors(matrix);
    for (int i = 0; i < pair_refinements; ++i) {
      const Vec4 w = p.delassus * r + p.free;
      Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1> lack(n);
      for (int k = 0; k < n; ++k) lack[k] = -w[row[static_cast<std::size_t>(k)]];
      const auto step = factors.solve(lack).eval();
      for (int k = 0; k < n; ++k) r += step[k] * columns.col(k);
    }
  }
  for (int a = 0; a < 2; ++a) {
    const Vec2 on =
        project_on_cone({r[2 * a], r[2 * a + 1]}, p.friction[static_cast<std::size_t>(a)]);
    r.segment<2>(2 * a) << on.x, on.y;
  }
  return r;
}

}  // namespace

int partner_of(const CoupledProblem& p, std::size_t j) noexcept {
  double strongest = 0.5;
  int partner = -1;
  for (auto k = static_cast<std::size_t>(p.row_start[j]);
       k < static_cast<std::size_t>(p.row_start[j + 1]); ++k) {
    const auto l = static_cast<std::size_t>(p.column[k]);
    const double strength = std::abs(p.blocks[k][0]) * std::sqrt(p.mass[j] * p.mass[l]);
    if (l == j || strength <= strongest) continue;
    strongest = strength;
    partner = p.column[k];
  }
  return partner;
}

bool update_pair(const CoupledProblem& p, std::array<std::size_t, 2> contacts, double enough,
                 std::span<Vec2> impulse) noexcept {
  Vec2 &one = impulse[contacts[0]], &other = impulse[contacts[1]];
  const Pair pair = pair_of(p, contacts, impulse);
  const Vec4 from(one.x, one.y, other.x, other.y);
  const double before = residual_of(pair, from);
  if (before <= enough) return true;
  double least = before;
  Vec4 best = from;
  for (int s = 0; s < 16 && least > enough; ++s) {
    const Vec4 r = try_statuses(pair, from, {s % 4, s / 4});
    const double residual = residual_of(pair, r);
    if (!(residual < least)) continue;
    least = residual;
    best = r;
  }
  if (least > std::max(much_nearer * before, enough)) return false;
  one = {best[0], best[1]};
  other = {best[2], best[3]};
  return true;
}

}  // namespace rondo::contact
