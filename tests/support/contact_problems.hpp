// SPDX-License-Identifier: BSD-3-Clause
/// @file  Coupled contact problems for tests and benchmarks: typical of meshes with lumped masses,
/// and more difficult ones. Each takes its random seed.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "rondo/contact/coupled/node_to_segment.hpp"
#include "rondo/contact/coupled/rows.hpp"
#include "rondo/core/complex.hpp"

namespace rondo::test {

using contact::ContactRows;
using contact::CoupledProblem;

/// Contacts and the nodes that they act on.
struct Scene {
  std::vector<Complex> response;  ///< (nodes) velocity per impulse, a complex number [m/kg]
  std::vector<Vec2> velocity;     ///< (nodes) without impulses                       [m/s]
  std::vector<ContactRows> contacts;
  std::vector<double> friction, bounce;

  int add_node(double mass, Vec2 v, double turn = 0.0) {
    response.push_back(rotation(turn) / mass);
    velocity.push_back(v);
    return static_cast<int>(response.size()) - 1;
  }
  void add(const ContactRows& rows, double mu, double e_wn = 0.0) {
    contacts.push_back(rows);
    friction.push_back(mu);
    bounce.push_back(e_wn);
  }
};

inline Vec2 free_velocity(const Scene& scene, const ContactRows& c) {
  Vec2 w;
  for (std::size_t k = 0; k < static_cast<std::size_t>(c.count); ++k)
    w += contact::apply(c.block[k], scene.velocity[static_cast<std::size_t>(c.node[k])]);
  return w;
}

inline CoupledProblem problem_of(const Scene& scene) {
  CoupledProblem p;
  contact::DelassusBuilder().build(scene.contacts, scene.response, p);
  for (const ContactRows& c : scene.contacts) p.free.push_back(free_velocity(scene, c));
  p.friction = scene.friction;
  p.bounce = scene.bounce;
  return p;
}

/// Two rows of nodes pressed together: nodes of one on segments of the other, or of both.
struct ChainShape {
  int upper = 100, lower = 100;  ///< nodes
  double offset = 0.3;           ///< of the lower row, in lengths of its segments
  double mass_ratio = 1.0;       ///< mass of a lower node / mass of an upper one
  bool both_ways = false;
  double friction = 0.3, restitution = 0.0;
  double press = 1.0, shear = 0.5, noise = 0.3;  ///< velocities [m/s]
  double turn = 0.0;                             ///< angle of the responses [rad]
  unsigned seed = 1;
};

inline Scene chain(const ChainShape& s) {
  std::mt19937 random(s.seed);
  std::uniform_real_distribution<double> r(-1.0, 1.0);
  Scene scene;
  std::vector<Vec2> x;
  const auto row = [&](int n, double shift, double y, double mass, Vec2 v) {
    for (int i = 0; i < n; ++i) {
      const double at_end = i == 0 || i + 1 == n ? 0.5 : 1.0;
      x.push_back({(i + shift) / n, y + 1e-4 / n * r(random)});
      const Vec2 noise{r(random), r(random)};
      scene.add_node(mass * at_end, v + s.noise * noise, s.turn);
    }
  };
  row(s.upper, 0.0, 0.0, 1.0 / s.upper, {s.shear, -s.press});
  row(s.lower, s.offset, 1e-3 / s.lower, s.mass_ratio / s.lower, {});
  const auto against = [&](int p, int a, int b) {
    const auto at = [&](int k) { return x[static_cast<std::size_t>(k)]; };
    const auto touch = contact::touch_segment(at(p), at(a), at(b), 1.0);
    if (!touch) return;
    const ContactRows rows = contact::node_rows(*touch, norm(at(b) - at(a)), p, a, b);
    scene.add(rows, s.friction, s.restitution * std::min(free_velocity(scene, rows).x, 0.0));
  };
  for (int p = 0; p < s.upper; ++p)  // the lower body is below its row: the row runs to the left
    for (int k = 0; k + 1 < s.lower; ++k) against(p, s.upper + k + 1, s.upper + k);
  for (int p = s.upper; s.both_ways && p < s.upper + s.lower; ++p)
    for (int k = 0; k + 1 < s.upper; ++k) against(p, k, k + 1);
  return scene;
}

/// Each node of the upper row also touches two facets, with an angle of `turn` [rad] between them.
inline Scene chain_in_valleys(const ChainShape& s, double turn) {
  Scene scene = chain(s);
  for (int p = 0; p < s.upper; ++p)
    for (const double side : {-0.5, 0.5})
      scene.add(contact::ground_rows(p, direction_at(0.5 * 3.141592653589793 + side * turn)),
                s.friction);
  return scene;
}

/// Each contact occurs n times.
inline Scene repeated(Scene scene, int n) {
  const Scene once = scene;
  for (int i = 1; i < n; ++i)
    for (std::size_t j = 0; j < once.contacts.size(); ++j)
      scene.add(once.contacts[j], once.friction[j], once.bounce[j]);
  return scene;
}

}  // namespace rondo::test
