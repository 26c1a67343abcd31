// SPDX-License-Identifier: BSD-3-Clause
/// Rubbers of all laws, and meshes to deform.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "rondo/fem/hyperelastic/hyperelasticity.hpp"

namespace rondo::fem {

inline Rubber rubber_of(RubberLaw law) {
  Rubber r;
  r.law = law;
  r.bulk_modulus = 40.0;
  if (law == RubberLaw::neo_hooke) r.c10 = 0.5;
  if (law == RubberLaw::mooney_rivlin) r.c10 = 0.4, r.c01 = 0.1;
  if (law == RubberLaw::yeoh) r.c10 = 0.5, r.c20 = -0.02, r.c30 = 0.01;
  if (law == RubberLaw::ogden) r.terms = {{0.63, 1.3}, {0.0012, 5.0}, {-0.01, -2.0}};
  return r;
}

inline std::vector<Rubber> all_rubbers() {
  std::vector<Rubber> all;
  for (const RubberLaw law :
       {RubberLaw::neo_hooke, RubberLaw::mooney_rivlin, RubberLaw::yeoh, RubberLaw::ogden})
    all.push_back(rubber_of(law));
  return all;
}

inline std::string name_of(const Rubber& r) {
  constexpr const char* names[] = {"neo-hooke", "mooney-rivlin", "yeoh", "ogden"};
  return std::string(names[static_cast<int>(r.law)]) + (r.one_point ? ", one point" : "");
}

/// With the small-strain constants that go with it.
inline Material material_with(const Rubber& r) {
  const double mu = r.shear_modulus(), k = r.bulk_modulus;
  Material m;
  m.youngs_modulus = 9.0 * k * mu / (3.0 * k + mu);
  m.poissons_ratio = (3.0 * k - 2.0 * mu) / (2.0 * (3.0 * k + mu));
  m.density = 1000.0;
  m.integration = Integration::b_bar;
  m.rubber = r;
  return m;
}

enum class Cells { quadrilaterals, triangles, both };

/// n × n distorted squares on the unit square; nothing is clamped.
inline mesh::Mesh patch_mesh(int n, Cells cells) {
  mesh::Mesh m;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      m.coordinates.push_back({1.0 * i / n + 0.15 * std::sin(2.0 * j + i) / n,
                               1.0 * j / n + 0.15 * std::cos(3.0 * i + j) / n});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = c - 1;
      if (cells == Cells::quadrilaterals || (cells == Cells::both && (i + j) % 2 == 0))
        m.cells.push_back({a, b, c, d});
      else
        m.cells.insert(m.cells.end(), {{a, b, c, -1}, {a, c, d, -1}});
    }
  return m;
}

/// Some smooth displacement of a patch.
inline std::vector<Vec2> wavy(const mesh::Mesh& m, double size) {
  std::vector<Vec2> u;
  for (const Vec2 x : m.coordinates)
    u.push_back({size * std::sin(2.0 * x.x + x.y), size * x.x * std::cos(x.y * x.y)});
  return u;
}

/// (∇u) X
inline std::vector<Vec2> linear(const mesh::Mesh& m, double xx, double xy, double yx, double yy) {
  std::vector<Vec2> u;
  for (const Vec2 x : m.coordinates) u.push_back({xx * x.x + xy * x.y, yx * x.x + yy * x.y});
  return u;
}

inline Eigen::VectorXd as_vector(const std::vector<Vec2>& u) {
  Eigen::VectorXd v(2 * static_cast<Eigen::Index>(u.size()));
  for (std::size_t i = 0; i < u.size(); ++i)
    v.segment<2>(static_cast<Eigen::Index>(2 * i)) = Eigen::Vector2d(u[i].x, u[i].y);
  return v;
}

inline std::vector<Vec2> gradient_of(const Hyperelasticity& body, const std::vector<Vec2>& u,
                                     Hyperelasticity::Histories histories = {}) {
  std::vector<Vec2> f(u.size());
  Hyperelasticity::Pass pass;
  body.gradient(u, histories, f, pass);
  return f;
}

inline double energy_of(const Hyperelasticity& body, const std::vector<Vec2>& u,
                        Hyperelasticity::Histories histories = {}) {
  std::vector<Vec2> f(u.size());
  Hyperelasticity::Pass pass;
  return body.gradient(u, histories, f, pass).energy;
}

inline double largest_of(const std::vector<Vec2>& f) {
  double largest = 0.0;
  for (const Vec2 v : f) largest = std::max(largest, norm(v));
  return largest;
}

}  // namespace rondo::fem
