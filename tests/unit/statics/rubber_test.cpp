// SPDX-License-Identifier: BSD-3-Clause
/// Rubber at finite strain, quasi-static: stationary spin and crush by Newton's method.
#include <gtest/gtest.h>

#include "rondo/core/complex.hpp"
#include "rondo/mesh/disk.hpp"
#include "rondo/statics/rubber_crush.hpp"
#include "rondo/statics/stationary_spin.hpp"
#include "unit/fem/rubber_fixture.hpp"

namespace rubber_test {

using namespace rondo;

namespace {

struct Ring {
  mesh::Mesh mesh;
  std::vector<fem::Material> materials;
  std::vector<double> mass;
  std::vector<int> free;
  std::shared_ptr<const fem::Hyperelasticity> body;
};

Ring make_ring(const mesh::Disk& disk, const fem::Rubber& rubber) {
  Ring r{mesh::make_disk(disk), {fem::material_with(rubber)}, {}, {}, {}};
  r.mass = fem::lumped_mass(r.mesh, r.materials);
  r.free = fem::free_nodes(r.mesh);
  r.body = std::make_shared<const fem::Hyperelasticity>(r.mesh, r.materials);
  return r;
}

mesh::Disk roller(int radial, int circumferential) {
  mesh::Disk d;
  d.outer_radius = 0.035;
  d.inner_radius = 0.0175;
  d.radial = radial;
  d.circumferential = circumferential;
  return d;
}

/// E .275 MPa, ν .475.
fem::Rubber soft() {
  fem::Rubber r;
  const double e = 0.275e6, nu = 0.475, mu = e / (2.0 * (1.0 + nu));
  r.c10 = 0.5 * mu;
  r.bulk_modulus = e / (3.0 * (1.0 - 2.0 * nu));
  return r;
}

double normal_force(const statics::CrushState& state) {
  double sum = 0.0;
  for (const Vec2 r : state.force) sum += r.x;
  return sum;
}

}  // namespace

/// Of little spin it is the linear one; of more the forces balance.
TEST(RubberSpin, IsTheEquilibriumAtFiniteStrain) {
  const Ring r = make_ring(roller(4, 40), soft());
  const fem::BlockCsr k = fem::assemble_stiffness(r.mesh, r.materials);
  const auto linear = statics::stationary_spin(k, r.mass, r.mesh.coordinates, r.free, 0.5);
  const auto little = statics::stationary_spin(*r.body, r.mass, r.mesh.coordinates, r.free, 0.5);
  ASSERT_EQ(little.status, statics::SpinStatus::solved);
  double error = 0.0;
  for (std::size_t i = 0; i < linear.u.size(); ++i)
    error = std::max(error, norm(linear.u.plane()[i] - little.u.plane()[i]));
  EXPECT_LT(error, 1e-4 * fem::largest_of(to_vector(linear.u.plane())));
  const double spin = 600.0;
  const auto much = statics::stationary_spin(*r.body, r.mass, r.mesh.coordinates, r.free, spin);
  ASSERT_EQ(much.status, statics::SpinStatus::solved);
  EXPECT_LT(much.residual, 1e-11);
  const std::vector<Vec2> f = fem::gradient_of(*r.body, to_vector(much.u.plane()));
  double worst = 0.0, size = 0.0;
  for (const int node : r.free) {
    const auto i = static_cast<std::size_t>(node);
    const Vec2 pull = spin * spin * r.mass[i] * (r.mesh.coordinates[i] + much.u.plane()[i]);
    worst = std::max(worst, norm(pull - f[i]));
    size = std::max(size, norm(pull));
  }
  EXPECT_LT(worst, 1e-11 * size);
  EXPECT_GT(fem::largest_of(to_vector(much.u.plane())), 0.015 * 0.035);
  EXPECT_EQ(statics::stationary_spin(*r.body, r.mass, r.mesh.coordinates, r.free, 3000.0).status,
            statics::SpinStatus::unstable);
}

TEST(RubberCrush, OfLittleDepthIsThatOfALinearBody) {
  const Ring r = make_ring(roller(3, 60), soft());
  const statics::CrushModel model =
      statics::make_crush_model(r.mesh.coordinates, r.mesh.boundary, 0.3);
  const double depth = 1e-7;
  statics::Condensation linear(fem::assemble_stiffness(r.mesh, r.materials), r.free, model.nodes);
  statics::append_within(model, 2.0 * depth, linear);
  statics::CrushState small = start_crush(model, r.mesh.n_nodes()), finite = small;
  ASSERT_TRUE(statics::bring_to(model, depth, 0.0, linear, small).converged);
  statics::RubberCrush rubber(model, r.body, r.free, 2.0 * depth);
  ASSERT_TRUE(rubber.bring_to(depth, 0.0, finite).converged);
  EXPECT_NEAR(normal_force(finite), normal_force(small), 1e-4 * normal_force(small));
  EXPECT_NEAR(finite.works.strain, small.works.strain, 1e-4 * small.works.strain);
}

/// With friction and a slide; what was stored is what the contact did, but for the path.
TEST(RubberCrush, IsInEquilibriumAndItsEnergyBalances) {
  const Ring r = make_ring(roller(4, 72), soft());
  const statics::CrushModel model =
      statics::make_crush_model(r.mesh.coordinates, r.mesh.boundary, 0.5);
  const auto pressed = [&](int parts) {
    statics::RubberCrush crush(model, r.body, r.free, 0.01);
    statics::CrushState state = start_crush(model, r.mesh.n_nodes());
    for (int k = 1; k <= parts; ++k) {
      const statics::CrushReport report = crush.bring_to(0.004 * k / parts, 0.0, state);
      EXPECT_TRUE(report.converged);
      EXPECT_LT(report.residual, 1e-10);
      EXPECT_LT(report.equilibrium, 1e-9);
      EXPECT_LT(report.penetration, 1e-15);
    }
    const statics::CrushReport slid = crush.bring_to(0.004, 0.001, state);
    EXPECT_TRUE(slid.converged);
    return state;
  };
  const statics::CrushState coarse = pressed(4), fine = pressed(8);
  for (const statics::CrushState* s : {&coarse, &fine}) EXPECT_LT(s->works.relative, 1e-9);
  const std::vector<Vec2> f = fem::gradient_of(*r.body, fine.u);
  Vec2 reaction;
  for (const int node : r.mesh.clamped) reaction += f[static_cast<std::size_t>(node)];
  EXPECT_NEAR(reaction.y, -normal_force(fine), 1e-9 * normal_force(fine));
  EXPECT_LT(std::abs(fine.works.internal - fine.works.strain), 2e-2 * fine.works.strain);
  EXPECT_LT(std::abs(fine.works.internal - fine.works.strain),
            0.7 * std::abs(coarse.works.internal - coarse.works.strain));
}

/// There is no force then that a residual could be over.
TEST(RubberCrush, LiftedToFirstTouchItIsUndeformed) {
  const Ring r = make_ring(roller(4, 72), soft());
  for (const double friction : {0.0, 0.3}) {
    const statics::CrushModel model =
        statics::make_crush_model(r.mesh.coordinates, r.mesh.boundary, friction);
    statics::RubberCrush crush(model, r.body, r.free, 0.01);
    statics::CrushState state = start_crush(model, r.mesh.n_nodes());
    double largest = 0.0;
    for (const int k : {1, 2, 3, 4, 3, 2, 1, 0, 0, 1, 0}) {
      const statics::CrushReport report = crush.bring_to(0.001 * k, 0.0, state);
      ASSERT_TRUE(report.converged) << friction << ", " << k;
      EXPECT_LT(report.equilibrium, 1e-9);
      EXPECT_LT(report.sweeps, 500);
      largest = std::max(largest, state.works.strain);
    }
    for (const Vec2 force : state.force) EXPECT_EQ(force, Vec2{});
    EXPECT_EQ(fem::largest_of(state.u), 0.0);
    EXPECT_LT(std::abs(state.works.strain), 1e-15 * largest);
    EXPECT_LT(std::abs(state.works.internal), 1e-2 * largest);  // path of mean forces
    EXPECT_LT(state.works.relative, 1e-9);
  }
}

namespace {

/// Of what is pressed, as it lies.
struct Imprint {
  double length = 0.0;    ///< of half the edges beside each node [m]
  double pressure = 0.0;  ///< largest [Pa]
};

Imprint imprint(const Ring& r, const statics::CrushState& state) {
  const std::size_t n = r.mesh.boundary.size();
  const auto place = [&](std::size_t i) {
    const auto node = static_cast<std::size_t>(r.mesh.boundary[i % n]);
    return r.mesh.coordinates[node] + state.u[node];
  };
  Imprint found;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(state.force[i].x > 0.0)) continue;
    const double length = 0.5 * (norm(place(i + 1) - place(i)) + norm(place(i) - place(i + n - 1)));
    found.length += length;
    found.pressure = std::max(found.pressure, state.force[i].x / length);
  }
  return found;
}

}  // namespace

/// A roller of 35 mm pressed with 13,571 N/m, without friction: published computations have a
/// contact of 49.9 to 50.9 mm and a pressure of 0.431 to 0.434 MPa. More than half of the rubber's
/// thickness, and stable by its contact alone.
TEST(RubberCrush, OfAPublishedRoller) {
  const Ring r = make_ring(roller(8, 120), soft());
  const statics::CrushModel model =
      statics::make_crush_model(r.mesh.coordinates, r.mesh.boundary, 0.0);
  statics::RubberCrush crush(model, r.body, r.free, 0.01);
  statics::CrushState state = start_crush(model, r.mesh.n_nodes());
  for (int k = 1; k <= 4; ++k)
    ASSERT_TRUE(crush.bring_to(0.00946126 * k / 4, 0.0, state).converged);
  EXPECT_NEAR(normal_force(state), 13571.0, 2.0);
  const Imprint found = imprint(r, state);
  EXPECT_NEAR(found.length, 0.0504, 0.0006);
  EXPECT_NEAR(found.pressure, 0.4325e6, 0.0025e6);
}

}  // namespace rubber_test
