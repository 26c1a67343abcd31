// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/element.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::fem {
namespace {

using Strain = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 8>;  ///< B: corner u -> (ε, γ)

constexpr std::array<Vec2, 4> corner_xi{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// Gradients of the shape functions with respect to x, and det(∂x/∂ξ).
struct Gradients {
  std::array<Vec2, 4> n;
  double jacobian;
};

Gradients quadrilateral_gradients(std::span<const Vec2> x, Vec2 xi) {
  std::array<Vec2, 4> local;  // ∂N_a/∂ξ, N_a = (1 + ξ_a ξ)(1 + η_a η)/4   (2.2)
  Vec2 dx_dxi, dx_deta;
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec2 c = corner_xi[a];
    local[a] = {0.25 * c.x * (1 + c.y * xi.y), 0.25 * c.y * (1 + c.x * xi.x)};
    dx_dxi += local[a].x * x[a];
    dx_deta += local[a].y * x[a];
  }
  Gradients g{{}, cross(dx_dxi, dx_deta)};
  for (std::size_t a = 0; a < 4; ++a)
    g.n[a] = Vec2{dx_deta.y * local[a].x - dx_dxi.y * local[a].y,
                  dx_dxi.x * local[a].y - dx_deta.x * local[a].x} /
             g.jacobian;
  return g;
}

Gradients triangle_gradients(std::span<const Vec2> x) {
  Gradients g{{}, cross(x[1] - x[0], x[2] - x[0])};
  for (std::size_t a = 0; a < 3; ++a) g.n[a] = turn90(x[(a + 2) % 3] - x[(a + 1) % 3]) / g.jacobian;
  return g;
}

Strain strain_matrix(const Gradients& g, std::size_t n) {
  Strain b = Strain::Zero(3, static_cast<Eigen::Index>(2 * n));
  for (std::size_t a = 0; a < n; ++a) {
    const auto column = static_cast<Eigen::Index>(2 * a);
    b(0, column) = b(2, column + 1) = g.n[a].x;
    b(1, column + 1) = b(2, column) = g.n[a].y;
  }
  return b;
}

Eigen::Matrix3d matrix(const Hooke& d) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  m(0, 0) = m(1, 1) = d.d11;
  m(0, 1) = m(1, 0) = d.d12;
  m(2, 2) = d.d33;
  return m;
}

const double gauss = 1.0 / std::sqrt(3.0);

/// Quadrature points of the stiffness; `jacobian` here is the area that belongs to a point.
struct Points {
  std::array<Gradients, 4> at{};
  std::size_t n = 4;
};

Points quadrature(std::span<const Vec2> x) {
  Points points;
  if (x.size() == 3) {
    points.n = 1;
    points.at[0] = triangle_gradients(x);
    points.at[0].jacobian *= 0.5;
  } else {
    for (std::size_t q = 0; q < 4; ++q)
      points.at[q] = quadrilateral_gradients(x, gauss * corner_xi[q]);
  }
  return points;
}

/// Stress of a triangle.
Stress stress_of(const Gradients& g, std::span<const Vec2> u, const ElementLaw& law) {
  const Hooke& d = law.point;
  double exx = 0.0, eyy = 0.0, gxy = 0.0;
  for (std::size_t a = 0; a < u.size(); ++a) {
    exx += g.n[a].x * u[a].x;
    eyy += g.n[a].y * u[a].y;
    gxy += g.n[a].y * u[a].x + g.n[a].x * u[a].y;
  }
  const double xx = d.d11 * exx + d.d12 * eyy, yy = d.d12 * exx + d.d11 * eyy;
  const double mean = law.mean_bulk * (exx + eyy);
  return {xx + mean, yy + mean, d.zz * (xx + yy) + mean, d.d33 * gxy};
}

using Lanes = std::array<double, 4>;  ///< one number per Gauss point

/// Data that are the same for all quadrilaterals.
struct GaussPoints {
  std::array<Lanes, 4> dxi, deta;  ///< gradient of the shape function of each corner   (2.2)
  std::array<Lanes, 4> at_corner;  ///< weights of the bilinear field through the points

  GaussPoints() {
    const double reach = std::sqrt(3.0);
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t q = 0; q < 4; ++q) {
        const Vec2 c = corner_xi[a], xi = gauss * corner_xi[q];
        dxi[a][q] = 0.25 * c.x * (1 + c.y * xi.y);
        deta[a][q] = 0.25 * c.y * (1 + c.x * xi.x);
        at_corner[a][q] =
            0.25 * (1 + reach * c.x * corner_xi[q].x) * (1 + reach * c.y * corner_xi[q].y);
      }
  }
};

const GaussPoints gauss_points;

/// Stress at the Gauss points of a quadrilateral, at all points at once; this takes most of the
/// time of a snapshot.
std::array<Stress, 4> gauss_stress(std::span<const Vec2> x, std::span<const Vec2> u,
                                   const ElementLaw& law) {
  const GaussPoints& g = gauss_points;
  const Hooke& d = law.point;
  Lanes x_xi{}, y_xi{}, x_eta{}, y_eta{}, jacobian{}, exx{}, eyy{}, gxy{};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t q = 0; q < 4; ++q) {
      x_xi[q] += g.dxi[a][q] * x[a].x;
      y_xi[q] += g.dxi[a][q] * x[a].y;
      x_eta[q] += g.deta[a][q] * x[a].x;
      y_eta[q] += g.deta[a][q] * x[a].y;
    }
  for (std::size_t q = 0; q < 4; ++q) jacobian[q] = x_xi[q] * y_eta[q] - y_xi[q] * x_eta[q];
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t q = 0; q < 4; ++q) {
      const double dx = (y_eta[q] * g.dxi[a][q] - y_xi[q] * g.deta[a][q]) / jacobian[q];
      const double dy = (x_xi[q] * g.deta[a][q] - x_eta[q] * g.dxi[a][q]) / jacobian[q];
      exx[q] += dx * u[a].x;
      eyy[q] += dy * u[a].y;
      gxy[q] += dy * u[a].x + dx * u[a].y;
    }
  double volume = 0.0, dilatation = 0.0;
  for (std::size_t q = 0; q < 4; ++q) {
    volume += jacobian[q];
    dilatation += jacobian[q] * (exx[q] + eyy[q]);
  }
  const double mean = law.mean_bulk * dilatation / volume;
  std::array<Stress, 4> stress;
  for (std::size_t q = 0; q < 4; ++q) {
    const double xx = d.d11 * exx[q] + d.d12 * eyy[q], yy = d.d12 * exx[q] + d.d11 * eyy[q];
    stress[q] = {xx + mean, yy + mean, d.zz * (xx + yy) + mean, d.d33 * gxy[q]};
  }
  return stress;
}

}  // namespace

ElementMatrix element_stiffness(std::span<const Vec2> corners, const ElementLaw& law) {
  RONDO_DEMAND(corners.size() == 3 || corners.size() == 4, corners.size());
  const Eigen::Matrix3d material = matrix(law.point);
  const auto size = static_cast<Eigen::Index>(2 * corners.size());
  ElementMatrix k = ElementMatrix::Zero(size, size);
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 8> volumetric =
      Eigen::RowVectorXd::Zero(size);  // corner u -> ∫ ε_v
  double volume = 0.0;
  const Points points = quadrature(corners);
  for (std::size_t q = 0; q < points.n; ++q) {
    const Gradients& g = points.at[q];
    const Strain b = strain_matrix(g, corners.size());
    k += g.jacobian * b.transpose() * material * b;
    volumetric += g.jacobian * (b.row(0) + b.row(1));
    volume += g.jacobian;
  }
  if (law.mean_bulk > 0.0) k += law.mean_bulk / volume * volumetric.transpose() * volumetric;
  return k;
}

ElementMatrix element_geometric_stiffness(std::span<const Vec2> corners, std::span<const Vec2> u,
                                          const ElementLaw& law, double mean_stress) {
  const Points points = quadrature(corners);
  std::array<Stress, 4> stress{};
  if (points.n == 1)
    stress[0] = stress_of(points.at[0], u, law);
  else
    stress = gauss_stress(corners, u, law);
  const auto size = static_cast<Eigen::Index>(2 * corners.size());
  ElementMatrix k = ElementMatrix::Zero(size, size);
  for (std::size_t q = 0; q < points.n; ++q) {
    const Gradients& g = points.at[q];
    const auto& [xx, yy, zz, xy] = stress[q];
    for (std::size_t a = 0; a < corners.size(); ++a)
      for (std::size_t b = 0; b < corners.size(); ++b) {
        const Vec2 traction = Vec2{xx * g.n[b].x + xy * g.n[b].y, xy * g.n[b].x + yy * g.n[b].y} +
                              mean_stress * g.n[b];
        const double value = g.jacobian * dot(g.n[a], traction);
        const auto row = static_cast<Eigen::Index>(2 * a),
                   column = static_cast<Eigen::Index>(2 * b);
        k(row, column) += value;
        k(row + 1, column + 1) += value;
      }
  }
  return k;
}

std::array<double, 4> element_masses(std::span<const Vec2> corners, double density) {
  if (corners.size() == 3) {
    const double third = density * triangle_gradients(corners).jacobian / 6.0;
    return {third, third, third, 0.0};
  }
  std::array<double, 4> masses{};
  for (std::size_t a = 0; a < 4; ++a)
    masses[a] = density * quadrilateral_gradients(corners, corner_xi[a]).jacobian;
  return masses;
}

std::array<Stress, 4> element_stress(std::span<const Vec2> corners, std::span<const Vec2> u,
                                     const ElementLaw& law) {
  if (corners.size() == 4) return extrapolated(gauss_stress(corners, u, law));
  std::array<Stress, 4> out;
  out.fill(stress_of(triangle_gradients(corners), u, law));
  return out;
}

std::array<Stress, 4> extrapolated(const std::array<Stress, 4>& at_gauss) noexcept {
  std::array<Stress, 4> out{};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t q = 0; q < 4; ++q)
      for (std::size_t k = 0; k < 4; ++k)
        out[a][k] += gauss_points.at_corner[a][q] * at_gauss[q][k];
  return out;
}

double smallest_jacobian(std::span<const Vec2> corners) noexcept {
  if (corners.size() == 3) return triangle_gradients(corners).jacobian;
  double smallest = quadrilateral_gradients(corners, corner_xi[0]).jacobian;
  for (const Vec2 xi : corner_xi)
    smallest = std::min(smallest, quadrilateral_gradients(corners, xi).jacobian);
  return smallest;
}

}  // namespace rondo::fem
