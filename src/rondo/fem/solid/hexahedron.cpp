// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/solid/hexahedron.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::fem {
namespace {

constexpr std::array<Vec3, 8> hexahedron_xi{{{-1, -1, -1},
                                             {1, -1, -1},
                                             {1, 1, -1},
                                             {-1, 1, -1},
                                             {-1, -1, 1},
                                             {1, -1, 1},
                                             {1, 1, 1},
                                             {-1, 1, 1}}};

const double gauss_place = 1.0 / std::sqrt(3.0);

double shape(std::size_t i, Vec3 xi) noexcept {
  const Vec3 c = hexahedron_xi[i];
  return 0.125 * (1 + c.x * xi.x) * (1 + c.y * xi.y) * (1 + c.z * xi.z);
}

/// Gradients of the shape functions with respect to x, and det(∂x/∂ξ).
struct HexahedronGradients {
  std::array<Vec3, 8> n;
  double jacobian;
};

HexahedronGradients gradients(const HexahedronCorners& x, Vec3 xi) noexcept {
  std::array<Vec3, 8> local;  // ∂N_i/∂ξ
  Vec3 dx, dy, dz;            // ∂x/∂ξ, ∂x/∂η, ∂x/∂ζ
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec3 c = hexahedron_xi[i], a{1 + c.x * xi.x, 1 + c.y * xi.y, 1 + c.z * xi.z};
    local[i] = 0.125 * Vec3{c.x * (a.y * a.z), c.y * (a.z * a.x), c.z * (a.x * a.y)};
    dx += local[i].x * x[i];
    dy += local[i].y * x[i];
    dz += local[i].z * x[i];
  }
  const Vec3 to_x = cross(dy, dz), to_y = cross(dz, dx), to_z = cross(dx, dy);
  HexahedronGradients g{{}, dot(dx, to_x)};
  for (std::size_t i = 0; i < 8; ++i)
    g.n[i] = (local[i].x * to_x + local[i].y * to_y + local[i].z * to_z) / g.jacobian;
  return g;
}

/// σ = first tr(ε) + 2 shear ε + mean_bulk · (mean of tr(ε) over the element).
struct Law {
  double first, shear, mean_bulk;
};

Law law_of(const Material& m) noexcept {
  const double e = m.youngs_modulus, nu = m.poissons_ratio;
  const double shear = e / (2.0 * (1.0 + nu)), lame = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  if (m.integration == Integration::full) return {lame, shear, 0.0};
  return {-2.0 / 3.0 * shear, shear, m.only_shear ? 0.0 : lame + 2.0 / 3.0 * shear};
}

std::array<double, 3> components(Vec3 v) noexcept {
  return {v.x, v.y, v.z};
}

using Block = std::array<std::array<double, 3>, 3>;

/// Adds first a bᵀ + second b aᵀ + second (a·b) I: the coupling of two corners with the gradients a
/// and b.
void add_block(double first, double second, Vec3 a, Vec3 b, Block& sum) noexcept {
  const std::array<double, 3> p = components(a), q = components(b);
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) sum[r][c] += first * (p[r] * q[c]) + second * (q[r] * p[c]);
  const double both = second * dot(a, b);
  for (std::size_t r = 0; r < 3; ++r) sum[r][r] += both;
}

/// Weights of the values at the points in the trilinear field at the corners.
struct AtCorner {
  std::array<PointNumbers, 8> weight;
  AtCorner() {
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t q = 0; q < 8; ++q)
        weight[i][q] = shape(q, std::sqrt(3.0) * hexahedron_xi[i]);
  }
};

const AtCorner at_corner;

/// σ at all points at once; this takes most of the time of a snapshot.
std::array<PointNumbers, 6> stress_at_points(const HexahedronPoints& points,
                                             const HexahedronCorners& u, const Law& law) noexcept {
  PointNumbers xx{}, yy{}, zz{}, xy{}, yz{}, zx{};  // strains; γ in the last three
  for (std::size_t i = 0; i < 8; ++i) {
    const auto& [dx, dy, dz] = points.gradient[i];
    for (std::size_t q = 0; q < 8; ++q) {
      xx[q] += dx[q] * u[i].x;
      yy[q] += dy[q] * u[i].y;
      zz[q] += dz[q] * u[i].z;
      xy[q] += dy[q] * u[i].x + dx[q] * u[i].y;
      yz[q] += dz[q] * u[i].y + dy[q] * u[i].z;
      zx[q] += dx[q] * u[i].z + dz[q] * u[i].x;
    }
  }
  double volume = 0.0, dilatation = 0.0;
  for (std::size_t q = 0; q < 8; ++q) {
    volume += points.volume[q];
    dilatation += points.volume[q] * (xx[q] + yy[q] + zz[q]);
  }
  const double mean = law.mean_bulk * dilatation / volume, two = 2.0 * law.shear;
  for (std::size_t q = 0; q < 8; ++q) {
    const double pressure = law.first * (xx[q] + yy[q] + zz[q]) + mean;
    xx[q] = pressure + two * xx[q];
    yy[q] = pressure + two * yy[q];
    zz[q] = pressure + two * zz[q];
    xy[q] *= law.shear;
    yz[q] *= law.shear;
    zx[q] *= law.shear;
  }
  return {xx, yy, zz, xy, yz, zx};
}

}  // namespace

Eigen::Matrix<double, 24, 24> hexahedron_stiffness(const HexahedronCorners& x,
                                                   const Material& material) {
  const Law law = law_of(material);
  std::array<std::array<Block, 8>, 8> blocks{};
  std::array<Vec3, 8> volumetric{};  // ∫ ∇N
  double volume = 0.0;
  for (const Vec3 corner : hexahedron_xi) {
    const HexahedronGradients g = gradients(x, gauss_place * corner);
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t j = i; j < 8; ++j)
        add_block(g.jacobian * law.first, g.jacobian * law.shear, g.n[i], g.n[j], blocks[i][j]);
    for (std::size_t i = 0; i < 8; ++i) volumetric[i] += g.jacobian * g.n[i];
    volume += g.jacobian;
  }
  if (law.mean_bulk > 0.0)
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t j = i; j < 8; ++j)
        add_block(law.mean_bulk / volume, 0.0, volumetric[i], volumetric[j], blocks[i][j]);
  Eigen::Matrix<double, 24, 24> k;
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = i; j < 8; ++j)
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = i == j ? r : 0; c < 3; ++c) {
          const auto row = static_cast<Eigen::Index>(3 * i + r),
                     column = static_cast<Eigen::Index>(3 * j + c);
          k(row, column) = k(column, row) = blocks[i][j][r][c];
        }
  return k;
}

std::array<double, 8> hexahedron_volumes(const HexahedronCorners& x) noexcept {
  std::array<double, 8> share{};
  double volume = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    volume += gradients(x, gauss_place * hexahedron_xi[i]).jacobian;
    share[i] = gradients(x, hexahedron_xi[i]).jacobian;
    sum += share[i];
  }
  for (double& s : share) s *= volume / sum;
  return share;
}

double smallest_jacobian(const HexahedronCorners& x) noexcept {
  double smallest = gradients(x, hexahedron_xi[0]).jacobian;
  for (const Vec3 corner : hexahedron_xi)
    smallest = std::min(smallest, gradients(x, corner).jacobian);
  return smallest;
}

HexahedronPoints hexahedron_points(const HexahedronCorners& x) noexcept {
  HexahedronPoints points{};
  for (std::size_t q = 0; q < 8; ++q) {
    const HexahedronGradients g = gradients(x, gauss_place * hexahedron_xi[q]);
    points.volume[q] = g.jacobian;
    for (std::size_t i = 0; i < 8; ++i)
      for (std::size_t c = 0; c < 3; ++c) points.gradient[i][c][q] = components(g.n[i])[c];
  }
  return points;
}

std::array<SolidStress, 8> hexahedron_stress(const HexahedronPoints& points,
                                             const HexahedronCorners& u,
                                             const Material& material) noexcept {
  const std::array<PointNumbers, 6> stress = stress_at_points(points, u, law_of(material));
  std::array<SolidStress, 8> out{};
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t c = 0; c < 6; ++c)
      for (std::size_t q = 0; q < 8; ++q) out[i][c] += at_corner.weight[i][q] * stress[c][q];
  return out;
}

std::array<SolidStress, 8> hexahedron_stress(const HexahedronCorners& x, const HexahedronCorners& u,
                                             const Material& material) noexcept {
  return hexahedron_stress(hexahedron_points(x), u, material);
}

double hexahedron_eigenvalue_bound(const HexahedronCorners& x, const Material& material) {
  Eigen::Matrix<double, 24, 24> k = hexahedron_stiffness(x, material);
  const std::array<double, 8> volume = hexahedron_volumes(x);
  for (Eigen::Index i = 0; i < 24; ++i)
    for (Eigen::Index j = 0; j < 24; ++j)
      k(i, j) /= material.density * std::sqrt(volume[at(i / 3)] * volume[at(j / 3)]);
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 24, 24>>;
  return Solver(k, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace rondo::fem
