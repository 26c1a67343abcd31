// SPDX-License-Identifier: BSD-3-Clause
/// Viscous branches in time: the complex modulus of a body that is shaken, and what becomes of the
/// work that is done on it.
#include "rondo/model/viscous_branches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/stiffness_product.hpp"
#include "rondo/mesh/disk.hpp"

namespace rondo::dynamics::viscous_branches_test {
namespace {

using Parts = std::vector<fem::ViscousPart<fem::BlockCsr>>;

struct Body {
  mesh::Mesh mesh = mesh::make_disk({.outer_radius = 0.3,
                                     .inner_radius = 0.2,
                                     .radial = 2,
                                     .circumferential = 12,
                                     .grading = 1.0,
                                     .tread = {}});
  fem::Material material{1e6, 0.3, 1000.0, fem::Plane::strain};
  Parts parts;

  Body() {
    material.branches = {{0.8, 2e-3}, {0.3, 1e-2}};
    parts =
        fem::viscous_parts<fem::BlockCsr>(mesh, std::vector{material}, fem::ViscousBy::branches);
  }
};

std::vector<Vec2> random_field(std::size_t n, std::mt19937& engine) {
  std::uniform_real_distribution<double> number(-1e-3, 1e-3);
  std::vector<Vec2> field(n);
  for (Vec2& x : field) x = {number(engine), number(engine)};
  return field;
}

double product(std::span<const Vec2> a, std::span<const Vec2> b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += dot(a[k], b[k]);
  return sum;
}

}  // namespace

/// u = s sin ωt after many times of relaxation: the force over V s is Re g sin ωt + Im g cos ωt.
TEST(ViscousBranches, HaveTheirComplexModulus) {
  const Body body;
  std::mt19937 engine(1);
  const std::vector<Vec2> shape = random_field(body.mesh.n_nodes(), engine);
  std::vector<Vec2> stiff(shape.size());
  fem::apply(body.parts[0].stiffness, shape, stiff, 1);
  const double scale = product(shape, stiff), omega = 300.0;
  constexpr int in_cycle = 4000, cycles = 16;
  const double dt = 2.0 * std::numbers::pi / (omega * in_cycle);
  std::vector<Vec2> u(shape.size());
  ViscousBranches<fem::BlockCsr> branches(body.parts, u, dt, 1);
  double in_phase = 0.0, ahead = 0.0;
  for (int step = 1; step <= cycles * in_cycle; ++step) {
    const double angle = omega * step * dt;
    for (std::size_t k = 0; k < u.size(); ++k) u[k] = std::sin(angle) * shape[k];
    branches.move(u);
    const std::span<const Vec2> force = branches.force();
    if (step <= (cycles - 1) * in_cycle) continue;
    const double stress = product(shape, force) / scale;
    in_phase += 2.0 / in_cycle * stress * std::sin(angle);
    ahead += 2.0 / in_cycle * stress * std::cos(angle);
  }
  const std::complex<double> g = fem::branch_modulus(body.material.branches, omega);
  EXPECT_NEAR(in_phase, g.real(), 1e-6);
  EXPECT_NEAR(ahead, g.imag(), 1e-6);
}

TEST(ViscousBranches, SplitTheWorkIntoWhatIsStoredAndLost) {
  const Body body;
  std::mt19937 engine(2);
  std::vector<Vec2> u = random_field(body.mesh.n_nodes(), engine), before(u.size());
  ViscousBranches<fem::BlockCsr> branches(body.parts, u, 1e-3, 1);  // half of the fast time
  double stored = 0.0;
  for (int step = 0; step < 50; ++step) {
    const std::vector<Vec2> next = random_field(u.size(), engine);
    branches.move(next);
    const std::vector<Vec2> force(branches.force().begin(), branches.force().end());
    double work = 0.0;
    for (std::size_t k = 0; k < u.size(); ++k)
      work += 0.5 * dot(before[k] + force[k], next[k] - u[k]);
    EXPECT_GE(branches.lost(), 0.0);
    EXPECT_NEAR(work, branches.stored() - stored + branches.lost(), 1e-13 * branches.stored());
    stored = branches.stored();
    u = next;
    before = force;
  }
}

TEST(ViscousBranches, GoOnFromWhatTheySaved) {
  const Body body;
  std::mt19937 engine(3);
  const std::size_t n = body.mesh.n_nodes();
  const std::vector<Vec2> zero(n), a = random_field(n, engine), b = random_field(n, engine);
  ViscousBranches<fem::BlockCsr> whole(body.parts, zero, 1e-3, 1),
      second(body.parts, zero, 1e-3, 1);
  whole.move(a);
  const std::vector<double> saved = whole.save();
  EXPECT_EQ(saved.size(), ViscousBranches<fem::BlockCsr>::numbers(body.parts, n));
  second.restore(a, saved);
  whole.move(b);
  second.move(b);
  EXPECT_TRUE(std::ranges::equal(whole.force(), second.force()));
  EXPECT_TRUE(std::ranges::equal(whole.force_before(), second.force_before()));
  EXPECT_EQ(whole.lost(), second.lost());
  EXPECT_EQ(whole.stored(), second.stored());
}

}  // namespace rondo::dynamics::viscous_branches_test
