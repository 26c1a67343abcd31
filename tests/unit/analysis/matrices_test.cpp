// SPDX-License-Identifier: BSD-3-Clause
/// The matrices of a motion against the program's own forces, spins and steps.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <random>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/matrices/contact_rows.hpp"
#include "rondo/analysis/matrices/matrices.hpp"
#include "rondo/analysis/matrices/operators.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/solid/solid_sector.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/model/internal_force.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::matrices_test {
namespace {

using Eigen::VectorXd;

/// The spin grows, the center sinks evenly: it touches the ground after 1 ms.
const std::string disk = R"(schema = 1
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 3
circumferential = 60
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = [[0, 30.0], [0.01, 60.0]]
speed = 9.0
height = [[0, 0.3], [0.01, 0.29]]
[ground]
profile = "flat"
friction = 0.3
[time]
end = 0.01
)";
const std::vector<std::string> with_width{"disk.width=0.1", "disk.mesh.axial=2",
                                          "motion.camber=0.05", "motion.slip_angle=0.03"};

Case of(const std::vector<std::string>& settings = {}) {
  return test::read_text(disk, settings);
}

/// The values of a field at the unknowns.
VectorXd at_unknowns(const Operators& o, FieldView field) {
  VectorXd x(static_cast<Eigen::Index>(o.n_unknowns()));
  for (std::size_t k = 0; k < o.nodes.size(); ++k)
    for (std::size_t i = 0; i < o.components; ++i)
      x[static_cast<Eigen::Index>(o.components * k + i)] = field[at(o.nodes[k])][i];
  return x;
}

Eigen::Map<const VectorXd> reference_of(const Operators& o) {
  return {o.reference.data(), static_cast<Eigen::Index>(o.reference.size())};
}

/// 0 at clamped nodes.
Field random_field(const Operators& o, std::size_t n_nodes) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  Field u(n_nodes, o.components);
  u.visit([&](auto values) {
    for (const int node : o.nodes) {
      values[at(node)].x = normal(engine);
      values[at(node)].y = normal(engine);
      if constexpr (requires { values[0].z; }) values[at(node)].z = normal(engine);
    }
  });
  return u;
}

double off(const VectorXd& found, const VectorXd& wanted) {
  return (found - wanted).norm() / wanted.norm();
}

TEST(Matrices, StiffnessGivesTheInternalForces) {
  for (const std::vector<std::string>& settings : {std::vector<std::string>{},
                                                   {"material.stress_stiffening=\"centrifugal\""},
                                                   {"solver.contact_mass=\"singular\""}}) {
    const Case c = of(settings);
    auto s = build(c, 1);
    const Operators o = make_operators(c, s);
    const Field u = random_field(o, s.model.n_nodes());
    const auto force = dynamics::make_internal_force(s.model, u.plane(), {});
    const VectorXd wanted = at_unknowns(o, force->gradient());
    EXPECT_LT(off(o.stiffness * at_unknowns(o, u), wanted), 1e-13);
    s.model.stiffness = {};  // the blocks of one sector are enough
    const Operators of_sector = make_operators(c, s);
    EXPECT_LT(off(of_sector.stiffness * at_unknowns(o, u), wanted), 1e-12);
  }
}

TEST(Matrices, StiffnessOfAWheelGivesTheInternalForces) {
  const Case c = of(with_width);
  const auto s = build(c, 1);
  const Operators o = make_operators(c, s);
  const Field u = random_field(o, s.model.n_nodes());
  std::vector<Vec3> force(s.model.n_nodes());
  fem::apply(s.model.solid->sector, u.space(), force);
  EXPECT_LT(off(o.stiffness * at_unknowns(o, u), at_unknowns(o, force)), 1e-12);
}

TEST(Matrices, AreDiagonalSymmetricAndSkew) {
  for (const auto& settings : {std::vector<std::string>{}, with_width}) {
    const Case c = of(settings);
    const auto s = build(c, 1);
    const Operators o = make_operators(c, s);
    const auto transposed = [](const Csr& m) { return Csr(m.transpose()); };
    EXPECT_EQ((o.stiffness - transposed(o.stiffness)).norm(), 0.0);
    EXPECT_EQ((o.gyroscopic + transposed(o.gyroscopic)).norm(), 0.0);
    EXPECT_GT(o.gyroscopic.norm(), 0.0);
    EXPECT_EQ((o.damping - (200.0 * o.mass + 2e-5 * o.stiffness)).norm(), 0.0);
    const VectorXd mass = o.mass.diagonal(), plane = o.centrifugal.diagonal();
    for (std::size_t k = 0; k < o.n_unknowns(); ++k) {
      const auto at_k = static_cast<Eigen::Index>(k);
      const double m = s.model.mass[at(o.nodes[k / o.components])];
      EXPECT_EQ(mass[at_k], m);
      EXPECT_EQ(plane[at_k], k % o.components == 2 ? 0.0 : m);
    }
    EXPECT_EQ(o.mass.nonZeros(), mass.size());
  }
}

TEST(Matrices, FulfilTheStationarySpin) {
  for (const auto& more : {std::vector<std::string>{}, with_width}) {
    std::vector<std::string> settings = more;
    settings.insert(settings.end(), {"initial.state=\"stationary\"", "motion.height=0.4"});
    const Case c = of(settings);
    const auto s = build(c, 1);
    const Operators o = make_operators(c, s);
    const double squared = 30.0 * 30.0;
    const VectorXd u = at_unknowns(o, s.displacement);
    EXPECT_LT(off(o.stiffness * u - squared * (o.centrifugal * u),
                  squared * (o.centrifugal * reference_of(o))),
              1e-10);
  }
}

/// (3.3) of a step with contacts, by the matrices; its residual over the largest term.
double residual_of_a_step(const Case& c, std::size_t& contacts) {
  const auto s = build(c, 1);
  const Operators o = make_operators(c, s);
  dynamics::State state = dynamics::start(s.model, s.displacement, s.velocity);
  const auto integrator = dynamics::make_integrator(s.model, state);
  std::vector<dynamics::StepReport> reports(static_cast<std::size_t>(0.006 / s.model.dt));
  integrator->advance(reports, &state);
  const dynamics::FrameStep& f = state.frame;
  const VectorXd u = at_unknowns(o, state.u), before = at_unknowns(o, state.v),
                 after = at_unknowns(o, state.v_next), mean = 0.5 * (before + after),
                 arm = u + reference_of(o);
  const ContactRows rows = contact_rows(c, s.model, {f.angle, f.center}, state.u);
  VectorXd impulse = VectorXd::Zero(rows.rows.rows());
  for (const dynamics::ActiveContact& contact : state.active) {
    const auto row = static_cast<Eigen::Index>(o.components * contact.candidate);
    impulse[row] += contact.impulse.x;
    impulse[row + 1] += contact.impulse.y;
    if (o.components == 3) impulse[row + 2] += contact.impulse.z;
    EXPECT_NEAR(rows.gap[contact.candidate], contact.gap, 1e-15);
  }
  contacts = state.active.size();
  const double dt = s.model.dt, alpha = c.damping.mass;
  const VectorXd damping = o.damping * before + alpha * (o.mass * (mean - before));
  const VectorXd force = f.spin * f.spin * (o.centrifugal * arm) -
                         0.5 * f.spin_rate * (o.gyroscopic * arm) - o.stiffness * u - damping -
                         f.spin * (o.gyroscopic * mean);
  const VectorXd push = rows.rows.transpose() * impulse, change = o.mass * (after - before);
  EXPECT_GT(push.norm(), 0.01 * change.norm());
  EXPECT_GT((f.spin_rate * (o.gyroscopic * arm)).norm() * dt, 1e-3 * push.norm());
  return (change - dt * force - push).norm() / push.norm();
}

TEST(Matrices, FulfilAStepOfTheProgramWithContacts) {
  for (const auto& settings : {std::vector<std::string>{}, with_width}) {
    std::size_t contacts = 0;
    EXPECT_LT(residual_of_a_step(of(settings), contacts), 1e-10);
    EXPECT_GT(contacts, 1U);
  }
}

TEST(Matrices, ContactRowsAreThoseOfTheGroundAtATime) {
  const Case c = of({"ground.profile=[[-1, 0], [0.02, 0], [0.02, -0.1], [1, -0.1]]"});
  const auto s = build(c, 1);
  const Operators o = make_operators(c, s);
  const FramePlace frame = frame_at(s.model, 0.005, "--time");
  EXPECT_NEAR(frame.angle, -0.005 * 37.5, 1e-15);
  EXPECT_NEAR(frame.center.y, 0.295, 1e-15);
  const ContactRows rows = contact_rows(c, s.model, frame, {});
  const std::vector<int>& nodes = s.model.contact->nodes;
  ASSERT_EQ(rows.gap.size(), nodes.size());
  std::size_t beside = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec2 x = frame.center.plane() + rotation(frame.angle) * s.model.reference[at(nodes[k])];
    const contact::Touch touch = s.model.contact->ground.facet_near(x);
    EXPECT_EQ(rows.gap[k], touch.gap);
    EXPECT_EQ(rows.normal[2 * k], touch.normal.x);
    beside += touch.normal.x == 0.0 ? 0 : 1;
    const Vec2 n = conj(rotation(frame.angle)) * touch.normal;
    EXPECT_EQ(rows.normal_corotating[2 * k + 1], n.y);
    const auto* const place = std::ranges::find(o.nodes, nodes[k]).base();
    const auto column = static_cast<Eigen::Index>(2 * (place - o.nodes.data()));
    const auto row = static_cast<Eigen::Index>(2 * k);
    EXPECT_EQ(rows.rows.coeff(row, column), n.x);
    EXPECT_EQ(rows.rows.coeff(row + 1, column), -n.y);
    EXPECT_EQ(rows.rows.coeff(row + 1, column + 1), n.x);
  }
  EXPECT_GT(beside, 0U);
}

/// What a call refuses, as a text; empty: nothing.
template <class Call>
std::string refused(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Matrices, AreRefusedWithoutAConstantStiffness) {
  const auto matrices = [](const char* file, const std::vector<std::string>& settings) {
    return refused([&] {
      const Case c = read_case(std::filesystem::path(RONDO_CASES) / file, settings);
      static_cast<void>(make_operators(c, build(c, 1)));
    });
  };
  const std::string rubber =
      matrices("rubber-roller.toml", {"disk.mesh={radial = 2, circumferential = 24}"});
  EXPECT_NE(rubber.find("material.model = \"neo-hooke\": is rubber at finite strain"),
            std::string::npos)
      << rubber;
  EXPECT_NE(rubber.find("allowed: material.model = \"linear\""), std::string::npos) << rubber;
  const std::string free = matrices("thrown-disk.toml", {});
  EXPECT_NE(free.find("disk.rim = \"free\": leaves bodies free"), std::string::npos) << free;
  EXPECT_NE(free.find("allowed: disk.rim = \"bonded\""), std::string::npos) << free;
}

TEST(Matrices, AreThoseOfAMotionInTime) {
  for (const char* file : {"crush-smooth.toml", "steady-rolling.toml"}) {
    const Case c = read_case(std::filesystem::path(RONDO_CASES) / file);
    const std::string text = refused([&] {
      static_cast<void>(write_matrices(c, {"none.h5", 0.0, {}}));
    });
    EXPECT_NE(text.find("is no motion in time"), std::string::npos) << text;
  }
}

TEST(Matrices, ContactRowsAreRefusedWithoutGroundOrTime) {
  const Case c = of();
  auto s = build(c, 1);
  for (const double time : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(refused([&] {
                static_cast<void>(frame_at(s.model, time, "--time"));
              }).find("is no time of the motion"),
              std::string::npos);
  s.model.rim.emplace();
  EXPECT_NO_THROW(static_cast<void>(frame_at(s.model, 0.0, "--time")));
  EXPECT_NO_THROW(static_cast<void>(frame_at(s.model, 0.1, "--time")));  // tables move it
  s.model.rim->free_y = true;
  EXPECT_NE(refused([&] {
              static_cast<void>(frame_at(s.model, 0.1, "--time"));
            }).find("forces move the rim"),
            std::string::npos);
  s.model.contact.reset();
  EXPECT_NE(refused([&] {
              static_cast<void>(contact_rows(c, s.model, {}, {}));
            }).find("there are no contact rows"),
            std::string::npos);
}

}  // namespace
}  // namespace rondo::study::matrices_test
