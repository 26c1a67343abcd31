// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/hyperelastic/element.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/fem/hyperelastic/one_point.hpp"
#include "rondo/fem/hyperelastic/triangle.hpp"

namespace rondo::fem::hyperelastic {
namespace {

Vec2 vector(Pair<double> v) noexcept {
  return {v.x, v.y};
}

/// The field with the corner values as unknowns; constants have no derivatives.
template <class T, std::size_t N>
std::array<Pair<T>, N> constants(const std::array<Vec2, 4>& v) noexcept {
  std::array<Pair<T>, N> field;
  for (std::size_t a = 0; a < N; ++a) field[a] = {T(v[a].x), T(v[a].y)};
  return field;
}
template <std::size_t N>
std::array<Pair<Dual<2 * N>>, N> unknowns(const std::array<Vec2, 4>& v) noexcept {
  std::array<Pair<Dual<2 * N>>, N> field;
  for (std::size_t a = 0; a < N; ++a)
    field[a] = {Dual<2 * N>::unknown(v[a].x, 2 * a), Dual<2 * N>::unknown(v[a].y, 2 * a + 1)};
  return field;
}

/// Calls work(law) with the law in numbers of type T.
template <class T, class Work>
auto with_law(const Rubber& rubber, Work&& work) {
  if (rubber.law == RubberLaw::ogden) return work(Ogden(rubber));
  if (rubber.law == RubberLaw::neo_hooke) return work(NeoHooke<T>(rubber));
  return work(Polynomial<T>(rubber));
}

template <class T>
ElementResult<T> quadrilateral(const Rubber& rubber, const Corners<T>& x, const Corners<T>& u) {
  const Bilinear<T> of_x = bilinear(x), of_u = bilinear(u);
  const T bulk(rubber.bulk_modulus), shear(rubber.shear_modulus());
  return with_law<T>(rubber, [&](const auto& law) {
    return rubber.one_point ? one_point(of_x, of_u, law, bulk, shear)
                            : mean_dilatation(of_x, of_u, law, bulk);
  });
}

template <std::size_t N>
ElementMatrix slopes_of(const std::array<Pair<Dual<2 * N>>, N>& forces) {
  constexpr auto n = static_cast<Eigen::Index>(2 * N);
  ElementMatrix k(n, n);
  for (std::size_t a = 0; a < N; ++a)
    for (std::size_t j = 0; j < 2 * N; ++j) {
      const auto row = static_cast<Eigen::Index>(2 * a), column = static_cast<Eigen::Index>(j);
      k(row, column) = forces[a].x.slope[j];
      k(row + 1, column) = forces[a].y.slope[j];
    }
  return k;
}

/// ∂/∂(ξ, η) of a field at the center, and the area that belongs to the point.
struct Frame {
  Gradient<double> x, u;
  double share = 0.0;  ///< area / det ∂X/∂(ξ, η)
};

Frame frame_of(const DeformedCell& cell) noexcept {
  if (cell.n_corners == 3)
    return {edges_of(constants<double, 3>(cell.x)), edges_of(constants<double, 3>(cell.u)), 0.5};
  const Bilinear<double> x = bilinear(constants<double, 4>(cell.x)),
                         u = bilinear(constants<double, 4>(cell.u));
  return {{x.along, x.across}, {u.along, u.across}, 4.0};
}

double branch_modulus(const Rubber& rubber, const ViscousBranch& branch) noexcept {
  return branch.relative_modulus * rubber.shear_modulus();
}

/// Stresses of all branches at constant histories. @param g ∂X/∂(ξ, η) at the center; h ∂u/∂(ξ, η)
template <class T>
Gradient<T> branch_stresses(const Rubber& rubber, const Gradient<T>& g, const Gradient<T>& h,
                            std::span<const Symmetric<double>> history) noexcept {
  const PointState<T> state = point_state(g, h, T(1.0) / cross(g.x, g.y));
  const T y = inverse_cube_root(T(1.0) + state.j_less_1);
  Gradient<T> stress{};
  for (std::size_t b = 0; b < history.size(); ++b) {
    const Symmetric<T> c{T(history[b].xx), T(history[b].yy), T(history[b].xy)};
    const Gradient<T> p =
        branch_stress(state.f, c, y, T(branch_modulus(rubber, rubber.branches[b])));
    stress = {stress.x + p.x, stress.y + p.y};
  }
  return stress;
}

}  // namespace

Center center_of(const DeformedCell& cell) noexcept {
  const Frame frame = frame_of(cell);
  const double det = cross(frame.x.x, frame.x.y);
  const PointState<double> state = point_state(frame.x, frame.u, 1.0 / det);
  return {state.f, state.j_less_1, frame.share * det};
}

double least_volume_ratio(const Rubber& rubber, const DeformedCell& cell) noexcept {
  double least = center_of(cell).j_less_1;
  if (cell.n_corners == 3 || rubber.one_point) return 1.0 + least;
  const Bilinear<double> x = bilinear(constants<double, 4>(cell.x)),
                         u = bilinear(constants<double, 4>(cell.u));
  for (const auto& [xi, eta] : points) {
    const Gradient<double> g = local_gradient(x, xi, eta);
    const Gradient<double> h = local_gradient(u, xi, eta);
    least = std::min(least, point_state(g, h, 1.0 / cross(g.x, g.y)).j_less_1);
  }
  return 1.0 + least;
}

CellResult result_of(const Rubber& rubber, const DeformedCell& cell, double mean) {
  CellResult result;
  const auto take = [&](const auto& found, double energy) {
    for (std::size_t a = 0; a < found.size(); ++a) result.forces[a] = vector(found[a]);
    result.energy = energy;
  };
  if (cell.n_corners == 4) {
    const auto found =
        quadrilateral(rubber, constants<double, 4>(cell.x), constants<double, 4>(cell.u));
    take(at_corners(found.by), found.energy);
    return result;
  }
  const auto found = with_law<double>(rubber, [&](const auto& law) {
    return triangle(constants<double, 3>(cell.x), constants<double, 3>(cell.u), law, mean);
  });
  take(found.by, found.energy);
  return result;
}

ElementMatrix tangent_of(const Rubber& rubber, const DeformedCell& cell, double mean,
                         std::span<const Symmetric<double>> history) {
  if (cell.n_corners == 4) {
    const auto x = constants<Dual<8>, 4>(cell.x), u = unknowns<4>(cell.u);
    ElementMatrix k = slopes_of<4>(at_corners(quadrilateral(rubber, x, u).by));
    if (history.empty()) return k;
    const Bilinear<Dual<8>> of_x = bilinear(x), of_u = bilinear(u);
    const Gradient<Dual<8>> g{of_x.along, of_x.across};
    Bilinear<Dual<8>> by{};
    add_stress(branch_stresses(rubber, g, {of_u.along, of_u.across}, history), g, 0.0, 0.0, by);
    const Dual<8> four(4.0);  // factor of det ∂X/∂(ξ, η) in the area
    return k +
           slopes_of<4>(at_corners(Bilinear<Dual<8>>{four * by.along, four * by.across, by.twist}));
  }
  const auto x = constants<Dual<6>, 3>(cell.x), u = unknowns<3>(cell.u);
  ElementMatrix k = slopes_of<3>(with_law<Dual<6>>(
      rubber, [&](const auto& law) { return triangle(x, u, law, Dual<6>(mean)).by; }));
  if (history.empty()) return k;
  const Gradient<Dual<6>> g = edges_of(x);
  return k + slopes_of<3>(triangle_forces(branch_stresses(rubber, g, edges_of(u), history), g));
}

CornerForces area_gradient(const DeformedCell& triangle) noexcept {
  CornerForces gradient{};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    gradient[a] = 0.5 * turn90((triangle.x[c] - triangle.x[b]) + (triangle.u[c] - triangle.u[b]));
  }
  return gradient;
}

Symmetric<double> relaxed_history(const Center& center) noexcept {
  const double y = inverse_cube_root(1.0 + center.j_less_1);
  const Symmetric<double> c = right_cauchy_green(center.f);
  return {y * y * c.xx, y * y * c.yy, y * y * c.xy};
}

double relax(const Rubber& rubber, const Center& center, double half_step,
             std::span<Symmetric<double>> history) noexcept {
  const double y = inverse_cube_root(1.0 + center.j_less_1);
  const Symmetric<double> c = right_cauchy_green(center.f);
  double lost = 0.0;
  for (std::size_t b = 0; b < history.size(); ++b) {
    const ViscousBranch& branch = rubber.branches[b];
    const double before = unrelaxed(history[b], c, y);
    history[b] = relaxed(history[b], c, y, std::expm1(half_step / branch.time));
    lost += 0.5 * branch_modulus(rubber, branch) * (before - unrelaxed(history[b], c, y));
  }
  return center.area * lost;
}

double branch_energy(const Rubber& rubber, const Center& center,
                     std::span<const Symmetric<double>> history) noexcept {
  const double y = inverse_cube_root(1.0 + center.j_less_1);
  const Symmetric<double> c = right_cauchy_green(center.f);
  double energy = 0.0;
  for (std::size_t b = 0; b < history.size(); ++b)
    energy +=
        0.5 * branch_modulus(rubber, rubber.branches[b]) * (unrelaxed(history[b], c, y) - 3.0);
  return center.area * energy;
}

void add_branch_forces(const Rubber& rubber, const DeformedCell& cell,
                       std::span<const Symmetric<double>> history, CornerForces& forces) noexcept {
  if (history.empty()) return;
  const Frame frame = frame_of(cell);
  const Gradient<double> stress = branch_stresses(rubber, frame.x, frame.u, history);
  if (cell.n_corners == 3) {
    const auto more = triangle_forces(stress, frame.x);
    for (std::size_t a = 0; a < 3; ++a) forces[a] += vector(more[a]);
    return;
  }
  Bilinear<double> by{{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
  add_stress(stress, frame.x, 0.0, 0.0, by);
  const auto more = at_corners(Bilinear<double>{4.0 * by.along, 4.0 * by.across, by.twist});
  for (std::size_t a = 0; a < 4; ++a) forces[a] += vector(more[a]);
}

}  // namespace rondo::fem::hyperelastic
