// SPDX-License-Identifier: BSD-3-Clause
/// V34: the heterogeneous asynchronous scheme (docs/theory.md, section 12) on V2's bar with a tip
/// of fine elements, and on a disk that rolls. Expected: the figures of an independent program of
/// the scheme (docs/validation.md); with one fine step in a coarse one, those of implicit elements
/// in one step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "support/parts.hpp"
#include "support/traps.hpp"

namespace v34_asynchronous {

using namespace rondo;
using namespace rondo::dynamics;

namespace {

constexpr double speed = 10.0;                         // of the fall
constexpr double energy = 0.5 * 10.0 * speed * speed;  // per unit area
constexpr double earlier = 0.48;  // the fall begins that much later than V2's, and is shorter

/// 1 m of elements of 0.1/m m, 9 m of elements of 0.1 m.
test::Bar bar() {
  return {.gap = speed * (0.5 - earlier)};
}

struct Row {
  int ratio;
  double loss, mean, rms, rebound;
};

/// Of the force on the wall in .56 s < t < 1.12 s of V2, of all fine steps.
struct Force {
  double mean = 0.0, rms = 0.0;
  int count = 0;

  void add(double pressure) {
    mean += pressure;
    rms += (pressure - 300.0) * (pressure - 300.0);
    ++count;
  }
};

void observe(const HatiIntegrator& run, const Model& model, long long step, Force& force) {
  const double fine = explicit_step(model);
  const std::span contacts = run.fine_contacts();
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    const double fine_steps = static_cast<double>(j) + 0.5;
    const double time = earlier + static_cast<double>(step - 1) * model.dt + fine_steps * fine;
    if (time > 0.56 && time < 1.12) force.add(contacts[j].report.impulse.y / fine / bar().width());
  }
}

class AsynchronousBar : public testing::TestWithParam<Row> {};

}  // namespace

TEST_P(AsynchronousBar, HitsTheWall) {
  const Row row = GetParam();
  const test::TippedBar b = test::tipped_bar(bar(), 1.0, 10 * row.ratio);
  const Model model = test::tipped_model(b, row.ratio, bar().step());
  State state = start(model, std::vector<Vec2>(model.n_nodes()),
                      std::vector<Vec2>(model.n_nodes(), Vec2{0.0, -speed}));
  HatiIntegrator run(model, state);
  const test::FloatingPointTraps traps;
  Force force;
  StepReport report;
  for (long long step = 1; step <= 300; ++step) {
    run.advance({&report, 1}, &state);
    observe(run, model, step, force);
    ASSERT_FALSE(report.contact_felt_joint);
  }
  EXPECT_NEAR(force.mean / force.count, row.mean, 0.005);  // the figures that are given
  EXPECT_NEAR(std::sqrt(force.rms / force.count), row.rms, 0.05);
  EXPECT_NEAR(test::momentum(model, state).linear.y / bar().mass(), row.rebound, 5e-5);
  const Works& works = report.balance.works;
  EXPECT_NEAR(works.loss_impact / energy / bar().width(), row.loss, 5e-6);
  EXPECT_LT(report.balance.relative, 1e-12);
  EXPECT_LT(std::abs(works.interface), 1e-13 * report.balance.exchanged);
}

INSTANTIATE_TEST_SUITE_P(All, AsynchronousBar,
                         testing::Values(Row{1, .00500, 300.04, 17.6, 9.8201},
                                         Row{2, .00250, 299.89, 33.7, 9.8184},
                                         Row{5, .00100, 299.92, 44.6, 9.8334},
                                         Row{10, .00049, 299.86, 50.1, 9.8313}),
                         [](const auto& p) { return fmt::format("m{}", p.param.ratio); });

namespace {

/// The same bar with implicit elements in one step, all matrices full:
/// [M + Δt²/4 K_I](v⁺ - v⁻) = -Δt K u + i_c, with the contacts of two nodes of explicit elements.
class ImplicitElements {
 public:
  explicit ImplicitElements(const Model& model)
      : dt_(model.dt),
        mass_(2 * model.n_nodes()),
        stiffness_(fem::free_matrix(model.stiffness, model.free)),
        u_(mass_.size()),
        v_(mass_.size()),
        gap_(model.reference[0].y) {
    for (Eigen::Index i = 0; i < mass_.size(); ++i)
      mass_[i] = model.mass[static_cast<std::size_t>(i / 2)];
    Eigen::MatrixXd a = mass_.asDiagonal();
    a += 0.25 * dt_ * dt_ *
         Eigen::MatrixXd(fem::free_matrix(model.subdomains->coarse.stiffness, model.free));
    matrix_.compute(a);
    for (Eigen::Index i = 0; i < v_.size(); ++i) v_[i] = i % 2 == 1 ? -speed : 0.0;
    u_ = 0.5 * dt_ * v_;
  }

  /// A step; the impulse of the wall [N·s/m].
  double step() {
    Eigen::VectorXd next = v_ - matrix_.solve(dt_ * (stiffness_ * u_));
    double impulse = 0.0;
    for (const Eigen::Index foot : {1, 3}) {
      if (gap_ + u_[foot] > 0.0 || next[foot] >= 0.0) continue;
      impulse -= mass_[foot] * next[foot];
      next[foot] = 0.0;
    }
    v_ = next;
    u_ += dt_ * v_;
    return impulse;
  }
  [[nodiscard]] double velocity(std::size_t node) const {
    return v_[static_cast<Eigen::Index>(2 * node + 1)];
  }

 private:
  double dt_;
  Eigen::VectorXd mass_;
  Eigen::SparseMatrix<double> stiffness_;
  Eigen::VectorXd u_, v_;
  double gap_;
  Eigen::PartialPivLU<Eigen::MatrixXd> matrix_;
};

}  // namespace

/// One fine step in a coarse one: the same as implicit elements in one step.
TEST(Asynchronous, WithOneFineStepIsThatOfImplicitElements) {
  const test::TippedBar b = test::tipped_bar(bar(), 1.0, 10);
  const Model model = test::tipped_model(b, 1, bar().step());
  State state = start(model, std::vector<Vec2>(model.n_nodes()),
                      std::vector<Vec2>(model.n_nodes(), Vec2{0.0, -speed}));
  HatiIntegrator run(model, state);
  ImplicitElements expected(model);
  const double force = 300.0 * bar().width() * model.dt;
  StepReport report;
  for (int step = 0; step < 300; ++step) {
    run.advance({&report, 1}, &state);
    ASSERT_NEAR(report.contact.impulse.y, expected.step(), 1e-9 * force) << step;
    for (std::size_t k = 0; k < model.n_nodes(); ++k)
      ASSERT_NEAR(state.v.plane()[k].y, expected.velocity(k), 1e-9 * speed) << step << " " << k;
  }
}

namespace {

/// 12 by 60 elements, the outer 6 layers fine.
test::Built rolling_disk(int ratio, double safety) {
  auto c = test::rolling_disk(12, 60);
  c.motion.height = Table(0.2965);
  auto b = test::build(c);
  test::divide(b.model, b.mesh, b.materials.front(), test::cells_beyond(b.mesh, 0.2249), ratio,
               1.0);
  b.model.dt = ratio * safety * test::fine_critical_step(b.model, b.mesh, b.materials.front());
  return b;
}

/// The disk with the coarse part as implicit elements, turned by as much as the rim turns in half a
/// step: their kicks are at whole steps, those of two parts half a step before.
test::Built with_implicit_elements(const test::Built& parts) {
  auto c = test::rolling_disk(12, 60);
  c.motion.height = Table(0.2965);
  mesh::Mesh mesh = parts.mesh;
  const Complex turn = rotation(0.5 * parts.model.dt * c.motion.angular_velocity.at(0.0));
  for (Vec2& x : mesh.coordinates) x = turn * x;
  const Subdomain& coarse = parts.model.subdomains->coarse;
  std::vector<char> is_coarse = test::cells_beyond(parts.mesh, 0.2249);
  for (char& cell : is_coarse) cell = !cell;
  auto b = test::build(c, std::move(mesh));
  b.model.implicit.emplace(ImplicitPart{
      fem::assemble_stiffness(mesh_of_cells(b.mesh, is_coarse), b.materials), coarse.free});
  b.model.dt = parts.model.dt;
  return b;
}

}  // namespace

/// The same on the disk that rolls: but for the centrifugal term, which the coarse part takes at
/// the mean of a step, of the order of (s Δt)² of all.
TEST(Asynchronous, WithOneFineStepADiskRollsAsWithImplicitElements) {
  auto parts = rolling_disk(1, 0.8);
  auto b = with_implicit_elements(parts);
  test::add_ground(parts, {}, {0.3, 0.0});
  test::add_ground(b, {}, {0.3, 0.0});
  HatiIntegrator run(parts.model, test::start_at_rest(parts.model));
  const std::vector<Vec2> zero(b.model.n_nodes());
  test::Stepping expected(b.model, start(b.model, zero, zero, zero));
  StepReport report;
  double scale = 0.0, off = 0.0;
  for (int step = 0; step < 1000; ++step) {
    run.advance({&report, 1});
    const Vec3 impulse = expected.advance().impulse;
    scale = std::max(scale, norm(impulse));
    off = std::max(off, norm(report.contact.impulse - impulse));
  }
  RecordProperty("off", fmt::format("{:.3g}", off / scale));
  EXPECT_GT(scale, 0.0);
  EXPECT_LT(off, 1e-6 * scale);
}

namespace {

struct Rolling {
  int ratio;
  double force_y, force_x;
};

class AsynchronousDisk : public testing::TestWithParam<Rolling> {};

}  // namespace

TEST_P(AsynchronousDisk, Rolls) {
  const Rolling row = GetParam();
  auto b = rolling_disk(row.ratio, 0.8);
  test::add_ground(b, {}, {0.3, 0.0});
  HatiIntegrator run(b.model, test::start_at_rest(b.model));
  const test::FloatingPointTraps traps;
  Vec2 impulse;
  double time = 0.0;
  StepReport report;
  while (report.frame.time < 0.2) {
    run.advance({&report, 1});
    ASSERT_FALSE(report.contact_felt_joint);
    if (report.frame.time <= 0.1) continue;
    impulse += report.contact.impulse.plane();
    time += b.model.dt;
  }
  // The reference has another step, with which such means change by more than that.
  EXPECT_NEAR(impulse.y / time, row.force_y, 0.002 * row.force_y);
  EXPECT_NEAR(impulse.x / time, row.force_x, 0.002 * std::abs(row.force_x));
  EXPECT_LT(report.balance.relative, 1e-13);
  EXPECT_LT(std::abs(report.balance.works.interface), 1e-15 * report.balance.exchanged);
}

INSTANTIATE_TEST_SUITE_P(All, AsynchronousDisk,
                         testing::Values(Rolling{1, 48155.0, -8563.0}, Rolling{2, 48134.0, -8543.0},
                                         Rolling{5, 48145.0, -8473.0}),
                         [](const auto& p) { return fmt::format("m{}", p.param.ratio); });

namespace {

/// Energy after some fine steps from velocities of all frequencies, over that at the start.
double growth(int ratio, double share) {
  auto c = test::rolling_disk(10, 40);
  c.disk.grading = 2.0;  // the finest elements are outermost, away from the coarse part
  c.alpha = c.beta = 0.0;
  auto b = test::build(c);
  test::divide(b.model, b.mesh, b.materials.front(), test::cells_beyond(b.mesh, 0.24), ratio, 1.0);
  b.model.dt = share * ratio * test::fine_critical_step(b.model, b.mesh, b.materials.front());
  std::vector<Vec2> u(b.model.n_nodes()), v(u.size());
  for (std::size_t k = 0; k < v.size(); ++k) {
    const auto number = static_cast<double>(k);
    v[k] = {std::sin(number * number), std::cos(3.0 * number * number)};
  }
  HatiIntegrator run(b.model, start(b.model, u, v));
  StepReport report;
  run.advance({&report, 1});
  const double before = report.balance.kinetic + report.balance.strain;
  for (int step = 0; step < 1000 / ratio; ++step) {
    run.advance({&report, 1});
    const double now = report.balance.kinetic + report.balance.strain;
    if (now > 1e6 * before || now < 0.0) return 1e6;
  }
  return (report.balance.kinetic + report.balance.strain) / before;
}

}  // namespace

TEST(Asynchronous, IsStableUpToTheCriticalStepOfTheFinePart) {
  for (const int ratio : {1, 2, 4}) {
    EXPECT_NEAR(growth(ratio, 0.99), 1.0, 0.5) << ratio;
    EXPECT_GE(growth(ratio, 1.01), 1e6) << ratio;
  }
}

/// What the rim's tables do to the coarse part is what they do to the fine one: the body follows
/// them as one that is explicit everywhere.
TEST(Asynchronous, FollowsTablesOfSpeedAndHeight) {
  for (const int ratio : {1, 3, 5}) {
    auto b = rolling_disk(ratio, 0.5);
    b.model.motion.angular_velocity = Table(5.0);
    b.model.motion.speed = Table({{0.0, 0.0}, {0.01, 2.0}});
    b.model.motion.height = Table({{0.0, 0.4}, {0.004, 0.4}, {0.006, 0.39}});
    b.model.motion.gravity = Table({{0.0, 0.0}, {0.012, 20.0}});
    Model plain = b.model;
    plain.subdomains.reset();
    plain.scheme = Scheme::symplectic;
    plain.dt = explicit_step(b.model);
    HatiIntegrator run(b.model, test::start_at_rest(b.model));
    test::Stepping expected(plain, test::start_at_rest(plain));
    State state(b.model);
    StepReport report;
    double largest = 0.0, off = 0.0;
    while (report.frame.time < 0.015) {
      run.advance({&report, 1}, &state);
      expected.advance(ratio);
      for (std::size_t k = 0; k < state.u.size(); ++k) {
        largest = std::max(largest, norm(state.u.plane()[k]));
        off = std::max(off, norm(state.u.plane()[k] - expected.state().u.plane()[k]));
      }
    }
    RecordProperty(fmt::format("off_{}", ratio), fmt::format("{:.4f}", off / largest));
    EXPECT_LT(off, 0.02 * largest) << ratio;
    EXPECT_GT(largest, 1e-4);
    EXPECT_LT(report.balance.relative, 1e-13);
  }
}

}  // namespace v34_asynchronous
