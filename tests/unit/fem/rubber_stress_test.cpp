// SPDX-License-Identifier: BSD-3-Clause
/// Stress of rubber: that of small strain, closed forms, the energy in three dimensions, the forces
/// that it belongs to.
#include <gtest/gtest.h>

#include "rondo/fem/hyperelastic/triangle.hpp"
#include "rondo/fem/stress.hpp"
#include "unit/fem/rubber_fixture.hpp"

namespace rondo::fem::rubber_stress_test {
namespace {

namespace hyper = hyperelastic;

constexpr Cells all_cells[] = {Cells::quadrilaterals, Cells::triangles, Cells::both};

/// Of every cell its corners.
std::vector<std::array<Stress, 4>> stresses(const mesh::Mesh& m, const Material& material,
                                            const std::vector<Vec2>& u) {
  const NodalDilatation dilatation(m, {&material, 1});
  const auto displacement = [&](int node) { return u[static_cast<std::size_t>(node)]; };
  std::vector<std::array<Stress, 4>> found;
  for (std::size_t e = 0; e < m.cells.size(); ++e) {
    found.push_back(cell_stress(m, e, stress_law(material), dilatation, displacement));
    if (m.cells[e][3] < 0) found.back()[3] = found.back()[0];
  }
  return found;
}

double largest_difference(const std::vector<std::array<Stress, 4>>& a,
                          const std::vector<std::array<Stress, 4>>& b) {
  double largest = 0.0;
  for (std::size_t e = 0; e < a.size(); ++e)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 4; ++k)
        largest = std::max(largest, std::abs(a[e][c][k] - b[e][c][k]));
  return largest;
}

void expect_uniform(const std::vector<std::array<Stress, 4>>& found, const Stress& expected,
                    double bound, const std::string& of) {
  for (const auto& corners : found)
    for (const Stress& s : corners)
      for (std::size_t k = 0; k < 4; ++k) ASSERT_NEAR(s[k], expected[k], bound) << of << " " << k;
}

/// All laws by all elements: visit(material, mesh, what).
template <class Visit>
void for_all(Visit&& visit) {
  for (Rubber r : all_rubbers())
    for (const bool one_point : {false, true})
      for (const Cells cells : all_cells) {
        r.one_point = one_point;
        visit(material_with(r), patch_mesh(3, cells), name_of(r));
      }
}

/// Strains of 1e-6; one point does not see what is bilinear.
TEST(RubberStress, OfSmallStrainIsThatOfBBar) {
  for_all([](const Material& material, const mesh::Mesh& m, const std::string& name) {
    const std::vector<Vec2> u =
        material.rubber->one_point ? linear(m, 4e-7, 8e-7, -2e-7, -7e-7) : wavy(m, 3e-7);
    Material small = material;
    small.rubber.reset();
    const auto expected = stresses(m, small, u);
    double scale = 0.0;
    for (const auto& corners : expected)
      for (const Stress& s : corners) scale = std::max({scale, std::abs(s[0]), std::abs(s[3])});
    EXPECT_LT(largest_difference(stresses(m, material, u), expected), 2e-6 * scale) << name;
  });
}

/// σ = 2 c10 dev B - 2 c01 dev B⁻¹; of Ogden by the principal stretches λ - 1/λ = γ.
TEST(RubberStress, SimpleShear) {
  constexpr double gamma = 0.7, g2 = gamma * gamma;
  for_all([](const Material& material, const mesh::Mesh& m, const std::string& name) {
    const Rubber& r = *material.rubber;
    const double c1 = 2.0 * (r.c10 + 2.0 * r.c20 * g2 + 3.0 * r.c30 * g2 * g2), c2 = 2.0 * r.c01;
    Stress expected{c1 * 2.0 / 3.0 * g2 + c2 / 3.0 * g2, -c1 / 3.0 * g2 - c2 * 2.0 / 3.0 * g2,
                    (c2 - c1) / 3.0 * g2, (c1 + c2) * gamma};
    if (r.law == RubberLaw::ogden) {
      const double stretch = 0.5 * gamma + std::sqrt(1.0 + 0.25 * g2);
      const double cosine = 1.0 / std::sqrt(1.0 + 1.0 / (stretch * stretch)),
                   sine = cosine / stretch;
      double high = 0.0, low = 0.0;
      expected = {};
      for (const OgdenTerm& t : r.terms) {
        const double a = std::pow(stretch, t.exponent), mean = (a + 1.0 / a + 1.0) / 3.0;
        high += t.modulus * (a - mean);
        low += t.modulus * (1.0 / a - mean);
        expected[2] += t.modulus * (1.0 - mean);
      }
      expected[0] = high * cosine * cosine + low * sine * sine;
      expected[1] = high * sine * sine + low * cosine * cosine;
      expected[3] = (high - low) * sine * cosine;
    }
    expect_uniform(stresses(m, material, linear(m, 0.0, gamma, 0.0, 0.0)), expected, 1e-12, name);
  });
}

/// W + U of three principal stretches, for a derivative across the plane as well.
double energy_of(const Rubber& r, const std::array<double, 3>& stretch) {
  const double j = stretch[0] * stretch[1] * stretch[2];
  const double u = 0.25 * r.bulk_modulus * (j * j - 1.0 - 2.0 * std::log(j));
  double i1 = -3.0, i2 = -3.0, ogden = 0.0;
  for (const double l : stretch) {
    const double isochoric = l / std::cbrt(j);
    i1 += isochoric * isochoric;
    i2 += 1.0 / (isochoric * isochoric);
    for (const OgdenTerm& t : r.terms)
      ogden += t.modulus / t.exponent * (std::pow(isochoric, t.exponent) - 1.0);
  }
  return u + r.c10 * i1 + r.c01 * i2 + r.c20 * i1 * i1 + r.c30 * i1 * i1 * i1 + ogden;
}

/// σ_k = λ_k/J ∂W/∂λ_k.
TEST(RubberStress, UniformStretchIsTheSlopeOfTheEnergy) {
  constexpr std::array<double, 3> stretch{1.6, 0.7, 1.0};
  for_all([&](const Material& material, const mesh::Mesh& m, const std::string& name) {
    Stress expected{};
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double h = 1e-5;
      std::array<double, 3> more = stretch, less = stretch;
      more[k] += h;
      less[k] -= h;
      const double slope =
          (energy_of(*material.rubber, more) - energy_of(*material.rubber, less)) / (2.0 * h);
      expected[k] = stretch[k] / (stretch[0] * stretch[1]) * slope;
    }
    const auto u = linear(m, stretch[0] - 1.0, 0.0, 0.0, stretch[1] - 1.0);
    expect_uniform(stresses(m, material, u), expected, 1e-8, name);
  });
}

TEST(RubberStress, TurnsWithTheBody) {
  const Complex r = rotation(2.1);
  for_all([&](const Material& material, const mesh::Mesh& m, const std::string& name) {
    const std::vector<Vec2> u = wavy(m, 0.1);
    std::vector<Vec2> moved;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const Vec2 x = m.coordinates[k] + u[k];
      moved.push_back(r * x + Vec2{0.3, -0.2} - m.coordinates[k]);
    }
    auto expected = stresses(m, material, u);
    for (auto& corners : expected)
      for (Stress& s : corners) s = turned(s, r);
    EXPECT_LT(largest_difference(stresses(m, material, moved), expected), 1e-12) << name;
  });
}

hyper::Pair<double> pair(Vec2 v) {
  return {v.x, v.y};
}

/// σ : ∇w at a point of the deformed cell, times its area. @param share of the area over det
double power(const hyper::Gradient<double>& x, const hyper::Gradient<double>& w, const Stress& s,
             double share) {
  const double det = cross(x.x, x.y);
  const auto f = hyper::point_state(x, w, 1.0 / det).f;
  return share * det * (s[0] * (f.x.x - 1.0) + s[1] * (f.y.y - 1.0) + s[3] * (f.x.y + f.y.x));
}

/// In the way of a field w of the deformed body.
double power_of(const std::array<Stress, 4>& corners, const hyper::Corners<double>& x,
                const hyper::Corners<double>& w, bool triangle) {
  double sum = 0.0;
  if (triangle) {
    Stress mean{};
    for (std::size_t k = 0; k < 4; ++k)
      mean[k] = (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0;
    return power(hyper::edges_of<double>({x[0], x[1], x[2]}),
                 hyper::edges_of<double>({w[0], w[1], w[2]}), mean, 0.5);
  }
  constexpr double ends[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const auto& [xi, eta] : hyper::points) {
    Stress s{};
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t k = 0; k < 4; ++k)
        s[k] += 0.25 * (1.0 + ends[a][0] * xi) * (1.0 + ends[a][1] * eta) * corners[a][k];
    sum +=
        power(local_gradient(bilinear(x), xi, eta), local_gradient(bilinear(w), xi, eta), s, 1.0);
  }
  return sum;
}

/// Volumes of triangles are those of their nodes: what is shown at the corners adds up to it.
TEST(RubberStress, ItsPowerIsThatOfTheForces) {
  for (const Rubber& r : all_rubbers())
    for (const Cells cells : all_cells) {
      const Material material = material_with(r);
      const mesh::Mesh m = patch_mesh(4, cells);
      const std::vector<Vec2> u = wavy(m, 0.12);
      const Hyperelasticity body(m, {&material, 1});
      const std::vector<Vec2> f = gradient_of(body, u);
      std::vector<Vec2> w;
      for (const Vec2 x : m.coordinates) w.push_back({x.y * x.y, x.x - x.x * x.y});
      double expected = 0.0, found = 0.0;
      for (std::size_t k = 0; k < w.size(); ++k) expected += dot(f[k], w[k]);
      const auto stress = stresses(m, material, u);
      for (std::size_t e = 0; e < m.cells.size(); ++e) {
        hyper::Corners<double> x{}, of_w{};
        for (std::size_t a = 0; a < static_cast<std::size_t>(mesh::n_corners(m.cells[e])); ++a) {
          const auto node = static_cast<std::size_t>(m.cells[e][a]);
          x[a] = pair(m.coordinates[node] + u[node]);
          of_w[a] = pair(w[node]);
        }
        found += power_of(stress[e], x, of_w, m.cells[e][3] < 0);
      }
      EXPECT_NEAR(found, expected, 1e-11 * std::abs(expected)) << name_of(r);
    }
}

/// Two squares: the right one is folded over, the left one is not.
TEST(RubberStress, OfWhatIsInvertedThereIsNone) {
  mesh::Mesh m;
  m.coordinates = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  m.cells = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  const std::vector<Vec2> u{{}, {}, {-1.5, 0}, {}, {}, {-1.5, 0}};
  for (Rubber r : all_rubbers())
    for (const bool one_point : {false, true}) {
      r.one_point = one_point;
      const Material material = material_with(r);
      StressRecovery recovery(m, {&material, 1});
      const auto nodal = recovery(u);
      for (const double s : nodal[0]) EXPECT_NEAR(s, 0.0, 1e-14) << name_of(r);
      for (const std::size_t node : {1U, 2U}) EXPECT_TRUE(std::isnan(nodal[node][0])) << name_of(r);
    }
}

/// A square of a fifth of its area, a corner of it pushed beyond the middle: one of its points.
TEST(RubberStress, OfAnInvertedPointThereIsNone) {
  mesh::Mesh m;
  m.coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  m.cells = {{0, 1, 2, 3}};
  for (Rubber r : all_rubbers())
    for (const bool one_point : {false, true}) {
      r.one_point = one_point;
      const auto found = stresses(m, material_with(r), {{}, {}, {-0.8, -0.8}, {}});
      EXPECT_EQ(std::isnan(found[0][0][0]), !one_point) << name_of(r);
    }
}

/// A cell of each: the linear one is as ever, and a node between them has the mean.
TEST(RubberStress, BesideLinearCells) {
  mesh::Mesh m;
  m.coordinates = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  m.cells = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  m.region = {1, 0};
  m.region_names = {"tread", "belt"};
  Material belt = material_with(rubber_of(RubberLaw::neo_hooke));
  belt.rubber.reset();
  const std::vector<Material> materials{material_with(rubber_of(RubberLaw::neo_hooke)), belt};
  StressRecovery recovery(m, materials);
  const double gamma = 0.5, mu = materials[0].rubber->shear_modulus();
  const auto nodal = recovery(linear(m, 0.0, gamma, 0.0, 0.0));
  EXPECT_NEAR(nodal[0][0], 0.0, 1e-14);
  EXPECT_NEAR(nodal[2][0], 2.0 / 3.0 * mu * gamma * gamma, 1e-14);
  EXPECT_NEAR(nodal[1][0], 1.0 / 3.0 * mu * gamma * gamma, 1e-14);
  for (const Stress& s : nodal) EXPECT_NEAR(s[3], mu * gamma, 1e-14);
}

}  // namespace
}  // namespace rondo::fem::rubber_stress_test
