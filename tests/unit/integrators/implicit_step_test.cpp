// SPDX-License-Identifier: BSD-3-Clause
/// Implicit elements in the steps of all integrators: the same as in the reference, and as a dense
/// solution of (3.9) has them.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "comparison.hpp"
#include "integrator_cases.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/integrators/fused/sparse_integrator.hpp"
#include "support/implicit.hpp"
#include "support/stepping.hpp"
#include "support/traps.hpp"

namespace implicit_step_test {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

struct ImplicitCase {
  test::RollingCase rolling;
  std::vector<int> layers;  ///< implicit ones, 1 at the rim
  double stiffer = 25.0;    ///< they than the others
};

/// For the names that the tests print.
void PrintTo(const ImplicitCase& c, std::ostream* out) {
  *out << c.rolling.name;
}

std::vector<ImplicitCase> implicit_cases() {
  std::vector<ImplicitCase> all;
  const auto add = [&](const char* name, std::vector<int> layers) -> test::RollingCase& {
    return all.emplace_back(ImplicitCase{test::everything(name, 6, 90), std::move(layers)}).rolling;
  };
  add("inside", {4}).pressed = true;
  add("at_the_rim", {1});
  add("two_apart", {2, 5});
  add("at_the_ground", {6}).pressed = true;
  add("thick_at_the_ground", {4, 5, 6});
  add("everything", {1, 2, 3, 4, 5, 6});
  add("frictionless", {6}).law = {};
  test::RollingCase& bounces = add("restitution", {6});
  bounces.law = {0.3, 0.5};
  bounces.ground = test::ledge();
  add("flying", {2, 3}).ground.reset();
  test::RollingCase& undamped = add("undamped", {4});
  undamped.disk.alpha = undamped.disk.beta = 0.0;
  test::RollingCase& steady = add("undamped_at_the_ground", {6});
  steady.disk.alpha = steady.disk.beta = 0.0;
  steady.disk.motion = test::rolling_disk(6, 90).motion;
  steady.disk.motion.start_x = -0.05;
  add("stiffened", {4}).stiffened = true;
  const mesh::Tread tread{20, 0.02, 3, 1, 2};
  all.push_back({test::everything("treaded", 3, tread), {2}});
  all.push_back({test::everything("treaded_below_the_tread", 3, tread), {3}});
  all.push_back({test::everything("columns_61", 4, 61), {4}});
  return all;
}

test::Built build(const ImplicitCase& c) {
  test::Built b = test::build(c.rolling);
  const test::DiskCase& disk = c.rolling.disk;
  const std::vector<char> cells = test::cells_of_layers(b.mesh, c.layers);
  fem::Material stiff = disk.material;
  stiff.youngs_modulus *= c.stiffer;
  const double plain = b.model.dt;  // of the soft body
  test::set_region(b, disk, cells, stiff);
  b.model.implicit = test::implicit_part(b.mesh, b.materials, cells, b.prestress);
  b.model.dt = plain;
  return b;
}

/// Still, but for nodes of explicit elements: a start that a half step of an explicit scheme can
/// do.
std::vector<Vec2> gentle_velocity(const test::Built& b) {
  std::vector<Vec2> v = test::some_velocity(b);
  for (const int node : b.model.implicit->nodes) v[static_cast<std::size_t>(node)] = {};
  return v;
}

class ImplicitSteps : public testing::TestWithParam<ImplicitCase> {};

constexpr int few = 10, many = 500;  // steps

struct Seen {
  std::vector<StepReport> reports;
  State early, late;
};

Seen by_reference(const test::Built& b) {
  Seen seen;
  const std::vector<Vec2> rest(b.model.n_nodes());
  test::Reference run(b.model, start(b.model, rest, gentle_velocity(b)));
  for (int n = 1; n <= many; ++n) {
    seen.reports.push_back(run.step());
    if (n == few) seen.early = run.state;
  }
  seen.late = run.state;
  return seen;
}

Seen by_operator(const test::Built& b, StiffnessOperator of) {
  Seen seen;
  test::Stepping run(b, of, std::vector<Vec2>(b.model.n_nodes()), gentle_velocity(b));
  const auto look = [&](const StepReport& report) { seen.reports.push_back(report); };
  run.advance(few, look);
  seen.early = run.state();
  run.advance(many - few, look);
  seen.late = run.state();
  return seen;
}

}  // namespace

/// As Operators.DoTheStepOfTheReference. Contacts of implicit nodes are solved together to 1e-12.
TEST_P(ImplicitSteps, AreThoseOfTheReference) {
  const test::Built b = build(GetParam());
  const test::FloatingPointTraps traps;
  const Seen reference = by_reference(b);
  int in_contact = 0;
  double residual = 0.0, scale = 1e-3;
  for (const StepReport& report : reference.reports) {
    in_contact += report.contact.nodes;
    residual = std::max(residual, report.contact.residual);
    scale = std::max(scale, report.contact.free_velocity);
    EXPECT_EQ(report.contact.clusters_not_converged, 0);
  }
  EXPECT_EQ(in_contact > 0, b.model.contact.has_value());
  EXPECT_LT(residual, 1e-11 * scale);
  EXPECT_LT(reference.reports.back().balance.relative, 1e-12);
  for (const StiffnessOperator of : test::both_operators) {
    SCOPED_TRACE(test::name(of));
    const Seen found = by_operator(b, of);
    ASSERT_EQ(found.reports.size(), reference.reports.size());
    test::Comparison early, all;
    for (std::size_t n = 0; n < found.reports.size(); ++n) {
      if (n < few) early.see(reference.reports[n], found.reports[n]);
      all.see(reference.reports[n], found.reports[n]);
      if (HasFatalFailure()) return;
    }
    early.see(reference.early, found.early);
    all.see(reference.early, found.early);
    all.see(reference.late, found.late);
    early.expect_within(1e-12);
    all.expect_within(1e-9);
    EXPECT_LT(found.reports.back().balance.relative, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ImplicitSteps, testing::ValuesIn(implicit_cases()),
                         [](const auto& p) { return p.param.rolling.name; });

namespace {

/// v⁺ of all free nodes by (3.9), without contact and loads: dense matrices, no explicit pass.
Eigen::VectorXd dense_step(const Model& m, const State& at) {
  const auto n = static_cast<Eigen::Index>(2 * m.free.size());
  const Eigen::MatrixXd k = fem::free_matrix(m.stiffness, m.free);
  const Eigen::MatrixXd ki = fem::free_matrix(m.implicit->stiffness, m.free);
  const FrameStep frame = frame_step(m.motion, at.step, m.dt);
  Eigen::VectorXd u(n), v(n), inertia(n);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n), spin = mass;
  for (Eigen::Index i = 0; i < n / 2; ++i) {
    const auto node = static_cast<std::size_t>(m.free[static_cast<std::size_t>(i)]);
    const Vec2 a = frame_acceleration(frame, m.reference[node] + at.u.plane()[node]);
    u.segment<2>(2 * i) << at.u.plane()[node].x, at.u.plane()[node].y;
    v.segment<2>(2 * i) << at.v.plane()[node].x, at.v.plane()[node].y;
    inertia.segment<2>(2 * i) << m.mass[node] * a.x, m.mass[node] * a.y;
    mass(2 * i, 2 * i) = mass(2 * i + 1, 2 * i + 1) = m.mass[node];
    spin(2 * i + 1, 2 * i) = m.mass[node] * frame.spin;  // M J s, J (x, y) = (-y, x)
    spin(2 * i, 2 * i + 1) = -m.mass[node] * frame.spin;
  }
  const double dt = m.dt, alpha = m.mass_damping, beta = m.stiffness_damping;
  const Eigen::MatrixXd a =
      (1.0 + 0.5 * dt * alpha) * mass + dt * spin + (0.25 * dt * dt + 0.5 * dt * beta) * ki;
  const Eigen::VectorXd b = dt * (-k * (u + beta * v) - (alpha * mass + 2.0 * spin) * v - inertia);
  return v + a.partialPivLu().solve(b);
}

}  // namespace

/// With a spin that changes, so that the factor is not of the spin of the step.
TEST(ImplicitStep, IsEquation39) {
  ImplicitCase c{test::everything("", 3, 21), {2}, 400.0};
  c.rolling.ground.reset();
  c.rolling.disk.motion.angular_velocity = Table({{0.0, 30.0}, {1e-3, 200.0}});
  const test::Built b = build(c);
  test::Reference run(b.model,
                      start(b.model, std::vector<Vec2>(b.model.n_nodes()), gentle_velocity(b)));
  for (int n = 0; n < 20; ++n) {
    run.step();
    const Eigen::VectorXd expected = dense_step(b.model, run.state);
    double error = 0.0;
    for (std::size_t i = 0; i < b.model.free.size(); ++i) {
      const Vec2 v = run.state.v_next.plane()[static_cast<std::size_t>(b.model.free[i])];
      const auto at = static_cast<Eigen::Index>(2 * i);
      error = std::max({error, std::abs(v.x - expected[at]), std::abs(v.y - expected[at + 1])});
    }
    ASSERT_LT(error, 1e-12 * expected.cwiseAbs().maxCoeff()) << n;
  }
}

/// Of some elements by chance, on a mesh without sectors.
TEST(ImplicitStep, OfAnyElements) {
  const ImplicitCase c{test::everything("", 5, 60), {5}};
  test::Built b = build(c);
  std::vector<char> cells(b.mesh.cells.size());
  for (std::size_t e = 0; e < cells.size(); ++e) cells[e] = e % 7 == 0 || e % 5 == 4 ? 1 : 0;
  b.model.implicit = test::implicit_part(b.mesh, b.materials, cells);
  b.model.dt *= 0.15;  // some stiff ones are explicit
  const State at = start(b.model, std::vector<Vec2>(b.model.n_nodes()), gentle_velocity(b));
  test::Reference reference(b.model, at);
  SparseIntegrator integrator(b.model, at, kernel_table());
  State last(b.model);
  test::Comparison comparison;
  std::vector<StepReport> reports(100);
  for (int call = 0; call < 5; ++call) {
    integrator.advance(reports, &last);
    for (const StepReport& report : reports) comparison.see(reference.step(), report);
    if (HasFatalFailure()) return;
    comparison.see(reference.state, last);
    EXPECT_LT(last.step > 0 ? reports.back().balance.relative : 1.0, 1e-12);
  }
  comparison.expect_within(1e-9);
}

/// The reference, as the fused steps do (integrator_bits_test.cpp).
TEST(ImplicitStep, OfTheReferenceGoesOnFromASavedStateToTheSameBits) {
  ImplicitCase c{test::everything("", 4, 61), {4}};
  const test::Built b = build(c);
  const std::vector<Vec2> rest(b.model.n_nodes());
  const State at = start(b.model, rest, gentle_velocity(b));
  GeneralIntegrator whole(b.model, at), first(b.model, at),
      second(b.model, start(b.model, rest, rest));
  std::vector<StepReport> reports(300), others(300);
  whole.advance(reports);
  first.advance(std::span(others).first(151));
  const SavedState saved = first.save();
  EXPECT_FALSE(saved.impulses.empty());
  second.restore(saved);
  second.advance(std::span(others).subspan(151));
  State a(b.model), d(b.model);
  whole.fields(a);
  second.fields(d);
  EXPECT_EQ(a.u, d.u);
  EXPECT_EQ(a.v_next, d.v_next);
  EXPECT_EQ(reports.back().balance.residual, others.back().balance.residual);
  EXPECT_EQ(reports.back().contact.impulse, others.back().contact.impulse);
}

}  // namespace implicit_step_test
