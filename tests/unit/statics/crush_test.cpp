// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/crush.hpp"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <Eigen/Cholesky>
#include <algorithm>

#include "rondo/contact/friction_table.hpp"
#include "rondo/contact/residual.hpp"
#include "rondo/mesh/disk.hpp"

namespace crush_test {

using namespace rondo;

namespace {

struct Pressed {
  mesh::Mesh mesh;
  fem::BlockCsr k;
  std::vector<int> free;
  statics::CrushModel model;
};

Pressed make(double friction, bool tread = false) {
  mesh::Disk disk;
  disk.radial = 4;
  disk.circumferential = 60;
  if (tread) disk.tread = {.pitches = 20, .depth = 0.02, .land_columns = 2};
  Pressed p{mesh::make_disk(disk), {}, {}, {}};
  const fem::Material rubber{2.0e7, 0.3, 1100.0, fem::Plane::strain};
  p.k = fem::assemble_stiffness(p.mesh, {&rubber, 1});
  p.free = fem::free_nodes(p.mesh);
  p.model = statics::make_crush_model(p.mesh.coordinates, p.mesh.boundary, friction);
  return p;
}

struct Ran {
  std::vector<statics::CrushState> states;
  std::vector<statics::CrushReport> reports;
};

Pressed with_table(contact::FrictionTable table) {
  Pressed p = make(0.0);
  p.model.friction = contact::friction_of(std::move(table));
  p.model.extent = p.mesh.tributary;
  return p;
}

/// @param slide in all [m]
Ran run(const Pressed& p, double depth, int increments, double reach, double slide = 0.0) {
  statics::Condensation body(p.k, p.free, p.model.nodes);
  statics::append_within(p.model, reach, body);
  Ran out{{statics::start_crush(p.model, p.mesh.n_nodes())}, {}};
  for (int k = 1; k <= increments; ++k) {
    out.states.push_back(out.states.back());
    out.reports.push_back(statics::bring_to(p.model, depth * k / increments, slide * k / increments,
                                            body, out.states.back()));
    EXPECT_TRUE(out.reports.back().converged) << k << ": " << out.reports.back().residual;
  }
  return out;
}

Vec2 total(const statics::CrushState& s) {
  Vec2 sum;
  for (const Vec2 r : s.force) sum += r;
  return sum;
}

}  // namespace

TEST(Condensation, ComplianceIsThatOfTheDenseInverse) {
  const Pressed p = make(0.3);
  statics::Condensation body(p.k, p.free, p.model.nodes);
  body.append(std::vector<std::size_t>{2, 7});
  body.append(std::vector<std::size_t>{0});
  const Eigen::MatrixXd k = fem::free_matrix(p.k, p.free);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(6, k.rows());
  for (Eigen::Index j = 0; j < 3; ++j) {
    const int node = p.model.nodes[body.set()[static_cast<std::size_t>(j)]];
    const auto place = std::find(p.free.begin(), p.free.end(), node) - p.free.begin();
    h(2 * j, 2 * place + 1) = 1.0;
    h(2 * j + 1, 2 * place) = -1.0;
  }
  const Eigen::MatrixXd dense = h * k.ldlt().solve(h.transpose());
  EXPECT_LT((body.compliance() - dense).norm(), 1e-11 * dense.norm());  // condition of K: 1e4
  EXPECT_EQ((body.compliance() - body.compliance().transpose()).norm(), 0.0);
}

/// One increment solved by Uzawa's fixed point r = P_K(r - ρ w) on the dense body, which knows
/// nothing of blocks, statuses or condensation.
std::vector<Vec2> fixed_point(const Pressed& p, double depth) {
  const Eigen::LLT<Eigen::MatrixXd> k(Eigen::MatrixXd(fem::free_matrix(p.k, p.free)));
  const std::size_t nb = p.model.nodes.size();
  const double friction = p.model.friction.constant();
  std::vector<std::ptrdiff_t> place;
  for (const int node : p.model.nodes)
    place.push_back(std::find(p.free.begin(), p.free.end(), node) - p.free.begin());
  std::vector<Vec2> r(nb);
  const double rho = 5e6;  // below 2 over the largest eigenvalue of G, about 1.5e-7 m²/N
  double moved = 1.0;
  for (int i = 0; i < 3000 && moved > 1e-9; ++i) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(2 * p.free.size()));
    for (std::size_t c = 0; c < nb; ++c) {
      load[2 * place[c]] = -r[c].y;
      load[2 * place[c] + 1] = r[c].x;
    }
    const Eigen::VectorXd u = k.solve(load);
    moved = 0.0;
    for (std::size_t c = 0; c < nb; ++c) {
      const Vec2 w = {p.model.clearance[c] - depth + u[2 * place[c] + 1], -u[2 * place[c]]};
      const Vec2 shifted = {w.x + friction * std::abs(w.y), w.y};
      const Vec2 next = contact::project_on_cone(r[c] - rho * shifted, friction);
      moved = std::max(moved, norm(next - r[c]));
      r[c] = next;
    }
  }
  EXPECT_LE(moved, 1e-9);  // N/m, of some 1e4
  return r;
}

TEST(Crush, OneIncrementIsThatOfAFixedPointOnTheDenseBody) {
  for (const double friction : {0.3, 0.05}) {  // nearly all sticks; much slips
    const Pressed p = make(friction);
    const Ran ran = run(p, 0.01, 1, 0.02);
    const std::vector<Vec2> r = fixed_point(p, 0.01);
    int slipping = 0;
    for (std::size_t c = 0; c < r.size(); ++c) {
      EXPECT_LT(norm(r[c] - ran.states[1].force[c]), 1e-5) << c;  // the fixed point creeps
      slipping += ran.states[1].status[c] == contact::Status::slip ? 1 : 0;
    }
    if (friction < 0.1) {
      EXPECT_GE(slipping, 2);
    }
  }
}

TEST(Crush, ClosesItsEnergyAndItsLaw) {
  for (const bool tread : {false, true}) {
    const Ran ran = run(make(0.05, tread), 0.02, 10, 0.02);
    for (const auto& report : ran.reports) {
      EXPECT_LT(report.sweeps, 60);  // the direct solve ends it
      EXPECT_LT(report.residual, 1e-12);
      EXPECT_LT(report.equilibrium, 1e-13);
      EXPECT_LT(report.penetration, 1e-15);  // m, of 0.3
    }
    const statics::CrushWorks& w = ran.states.back().works;
    EXPECT_GT(w.strain, 1.0);
    EXPECT_LT(w.relative, 1e-13);  // ten increments of round-off
    EXPECT_NEAR(w.rim - w.friction - w.impact, w.contact, 1e-13 * w.rim);
    EXPECT_GT(w.friction, 1e-4 * w.strain);  // little friction: much slips
    EXPECT_LT(std::abs(w.impact), 0.1 * w.strain);
  }
}

/// The balance is no tautology: a work changed behind its back opens it.
TEST(Crush, BalanceSeesAWorkThatIsNotThere) {
  const Pressed p = make(0.3);
  statics::Condensation body(p.k, p.free, p.model.nodes);
  statics::append_within(p.model, 0.04, body);
  auto state = statics::start_crush(p.model, p.mesh.n_nodes());
  EXPECT_TRUE(statics::bring_to(p.model, 0.01, 0.0, body, state).converged);
  EXPECT_LT(state.works.relative, 1e-13);
  state.works.contact *= 1.0 + 1e-6;
  EXPECT_TRUE(statics::bring_to(p.model, 0.02, 0.0, body, state).converged);
  EXPECT_GT(state.works.relative, 1e-8);
}

/// Drawn far either way: it slips everywhere, the friction against the way; energy and works close.
TEST(Crush, DrawnFarItCarriesFrictionTimesLoad) {
  const Pressed p = make(0.3);
  for (const double way : {0.02, -0.02}) {
    statics::Condensation body(p.k, p.free, p.model.nodes);
    statics::append_within(p.model, 0.04, body);
    auto state = statics::start_crush(p.model, p.mesh.n_nodes());
    for (int k = 1; k <= 4; ++k)
      EXPECT_TRUE(statics::bring_to(p.model, 0.005 * k, 0.0, body, state).converged);
    const double pressed = state.works.rim;
    for (int k = 1; k <= 4; ++k)
      EXPECT_TRUE(statics::bring_to(p.model, 0.02, 0.25 * k * way, body, state).converged);
    EXPECT_EQ(state.depth, 0.02);
    EXPECT_EQ(state.slide, way);
    const Vec2 force = total(state);  // +t is towards -x
    EXPECT_NEAR(force.y, std::copysign(0.3, way) * force.x, 1e-10 * force.x);
    const statics::CrushWorks& w = state.works;
    EXPECT_LT(w.relative, 1e-13);
    EXPECT_NEAR(w.rim - w.friction - w.impact, w.contact, 1e-12 * w.rim);
    EXPECT_GT(w.rim - pressed, 0.08 * force.x * 0.02);  // of μP times the way
    EXPECT_GT(w.friction, 0.08 * force.x * 0.02);
  }
}

/// Both travels in one increment: the works close, the rim's is that of mean forces by both.
TEST(Crush, IsPressedAndDrawnAtOnce) {
  const Pressed p = make(0.3);
  statics::Condensation body(p.k, p.free, p.model.nodes);
  statics::append_within(p.model, 0.04, body);
  auto state = statics::start_crush(p.model, p.mesh.n_nodes());
  double rim = 0.0;
  for (int k = 1; k <= 8; ++k) {
    const Vec2 before = total(state);
    EXPECT_TRUE(statics::bring_to(p.model, 0.0025 * k, 0.001 * k, body, state).converged);
    const Vec2 mean = 0.5 * (before + total(state));
    rim += mean.x * 0.0025 + mean.y * 0.001;
  }
  EXPECT_EQ(state.depth, 0.02);
  EXPECT_EQ(state.slide, 0.008);
  const statics::CrushWorks& w = state.works;
  EXPECT_NEAR(w.rim, rim, 1e-12 * rim);
  EXPECT_LT(w.relative, 1e-13);
  EXPECT_NEAR(w.rim - w.friction - w.impact, w.contact, 1e-12 * w.rim);
  EXPECT_GT(total(state).y, 0.1 * total(state).x);  // of 0.3
}

/// Lifted off again nothing is left, and what friction took is what the rim did.
TEST(Crush, LiftedToFirstTouchItIsUndeformed) {
  const Pressed p = make(0.1);
  statics::Condensation body(p.k, p.free, p.model.nodes);
  statics::append_within(p.model, 0.04, body);
  auto state = statics::start_crush(p.model, p.mesh.n_nodes());
  for (const int k : {1, 2, 3, 4, 3, 2, 1, 0, 0, 1, 0})
    EXPECT_TRUE(statics::bring_to(p.model, 0.005 * k, 0.0, body, state).converged) << k;
  for (const Vec2 r : state.force) EXPECT_EQ(r, Vec2{});
  for (const Vec2 u : state.u) EXPECT_EQ(u, Vec2{});
  const statics::CrushWorks& w = state.works;
  EXPECT_EQ(w.strain, 0.0);
  EXPECT_LT(std::abs(w.contact), 1e-13 * w.exchanged);
  EXPECT_LT(w.relative, 1e-13);
  EXPECT_NEAR(w.rim, w.friction + w.impact, 1e-13 * w.exchanged);
  EXPECT_GT(w.friction, 1e-5 * w.exchanged);
}

TEST(Crush, AnEvenDiskIsPressedEvenly) {
  const Ran ran = run(make(0.3), 0.02, 10, 0.02);
  for (const auto& state : ran.states) {
    EXPECT_LT(std::abs(total(state).y), 1e-12 * std::max(1.0, total(state).x));
    for (std::size_t k = 1; k < 10; ++k) {  // candidate 0 is straight below
      const Vec2 a = state.force[k], b = state.force[60 - k];
      EXPECT_NEAR(a.x, b.x, 1e-8);  // N/m, of some 1e4
      EXPECT_NEAR(a.y, -b.y, 1e-8);
    }
  }
  EXPECT_GT(total(ran.states.back()).x, 1e4);
}

TEST(Crush, ASetThatIsTooSmallGrows) {
  const Pressed p = make(0.3);
  const Ran wide = run(p, 0.02, 4, 0.04), narrow = run(p, 0.02, 4, 0.0);
  std::size_t appended = 0;
  for (const auto& report : narrow.reports) appended += report.appended;
  EXPECT_EQ(appended, 4U);  // two on either side of the one that touches first
  for (const auto& report : wide.reports) EXPECT_EQ(report.appended, 0U);
  for (std::size_t k = 0; k < p.model.nodes.size(); ++k)
    EXPECT_LT(norm(wide.states[4].force[k] - narrow.states[4].force[k]), 1e-8);  // N/m, of 1e4
}

/// Ice under the right half or under the left: mirrored, and not the same as ice under nothing.
TEST(CrushFriction, PatchesUnderEitherHalfAreMirrored) {
  const contact::FrictionTable dry{.coefficient = 0.1, .slip = {}, .patches = {}};
  contact::FrictionTable behind = dry, before = dry;
  // Of the node in the middle, at x = 0 to round-off, neither has a part.
  behind.patches = {{.from = 1e-6, .to = 1.0, .factor = 0.2}};
  before.patches = {{.from = -1.0, .to = -1e-6, .factor = 0.2}};
  const Ran a = run(with_table(behind), 0.02, 8, 0.04), b = run(with_table(before), 0.02, 8, 0.04),
            all = run(with_table(dry), 0.02, 8, 0.04);
  for (std::size_t i = 1; i < a.states.size(); ++i) {
    const Vec2 force = total(a.states[i]), mirrored = total(b.states[i]);
    EXPECT_NEAR(force.x, mirrored.x, 1e-10 * force.x);
    EXPECT_NEAR(force.y, -mirrored.y, 1e-10 * force.x);
    EXPECT_LT(a.states[i].works.relative, 1e-12);
  }
  EXPECT_GT(std::abs(total(a.states.back()).y), 1e-3 * total(a.states.back()).x);
  EXPECT_LT(std::abs(total(all.states.back()).y), 1e-12 * total(all.states.back()).x);
}

/// All pressures are below a tenth of the reference, or above ten times: the factor is a constant,
/// and so are the bits.
TEST(CrushFriction, PressuresBeyondTheRangeGiveAConstant) {
  for (const auto& [reference, factor] :
       {std::pair{1e9, std::pow(0.1, -0.2)}, std::pair{1e-3, std::pow(10.0, -0.2)}}) {
    const Pressed by_table = with_table({.coefficient = 0.1,
                                         .slip = {},
                                         .pressure_exponent = -0.2,
                                         .pressure_reference = reference,
                                         .patches = {}}),
                  by_number = make(0.1 * factor), other = make(0.1);
    // By tables what does not touch yet has the factor of no pressure.
    const double first = 0.1 * std::pow(0.1, -0.2);
    const Ran a = run(by_table, 0.02, 6, 0.04, 0.003);
    if (reference > 1.0) {
      const Ran b = run(by_number, 0.02, 6, 0.04, 0.003), c = run(other, 0.02, 6, 0.04, 0.003);
      EXPECT_EQ(a.states.back().force, b.states.back().force);
      EXPECT_NE(a.states.back().force, c.states.back().force);
      continue;
    }
    for (std::size_t i = 1; i < a.states.size(); ++i)
      for (std::size_t k = 0; k < a.states[i].force.size(); ++k) {
        const Vec2 r = a.states[i].force[k];
        if (a.states[i].status[k] != contact::Status::slip) continue;
        const double mu = a.states[i - 1].force[k].x > 0.0 ? 0.1 * factor : first;
        EXPECT_NEAR(std::abs(r.y), mu * r.x, 1e-12 * r.x) << i << " " << k;
      }
  }
}

/// Each node slides by the coefficient of its own pressure and place in the increment before.
TEST(CrushFriction, EachNodeHasTheCoefficientOfItsPressureAndPlace) {
  const contact::FrictionTable table{.coefficient = 0.2,
                                     .slip = {},
                                     .pressure_exponent = -0.3,
                                     .pressure_reference = 4e4,
                                     .patches = {{.from = 0.01, .to = 0.03, .factor = 0.5}}};
  const Pressed p = with_table(table);
  const Ran ran = run(p, 0.02, 12, 0.04, 0.02);
  double least = 1.0, most = 0.0;
  for (std::size_t i = 1; i < ran.states.size(); ++i) {
    const statics::CrushState &before = ran.states[i - 1], &now = ran.states[i];
    EXPECT_LT(ran.reports[i - 1].residual, 1e-12);
    for (std::size_t k = 0; k < now.force.size(); ++k) {
      const std::size_t node = static_cast<std::size_t>(p.model.nodes[k]);
      const double x = p.mesh.coordinates[node].x + before.u[node].x + before.slide;
      const double mu =
          contact::friction_at(
              table, {.place = {x, 0, 0}, .pressure = before.force[k].x / p.mesh.tributary[k]})
              .coefficient;
      EXPECT_LE(std::abs(now.force[k].y), mu * now.force[k].x * (1.0 + 1e-12)) << i << " " << k;
      if (now.status[k] != contact::Status::slip) continue;
      EXPECT_NEAR(std::abs(now.force[k].y), mu * now.force[k].x, 1e-12 * now.force[k].x);
      least = std::min(least, mu);
      most = std::max(most, mu);
    }
  }
  EXPECT_GT(most, 3.0 * least);
  EXPECT_LT(ran.states.back().works.relative, 1e-12);
}

TEST(Crush, KeepsTheStateWhereItDoesNotConverge) {
  Pressed p = make(0.3);
  p.model.limits.sweeps = 1;
  statics::Condensation body(p.k, p.free, p.model.nodes);
  statics::append_within(p.model, 0.04, body);
  auto state = statics::start_crush(p.model, p.mesh.n_nodes());
  const auto report = statics::bring_to(p.model, 0.02, 0.0, body, state);
  EXPECT_FALSE(report.converged);
  EXPECT_GT(report.residual, p.model.bound);
  EXPECT_EQ(report.sweeps, 1);
  EXPECT_EQ(state.depth, 0.0);
  EXPECT_EQ(total(state), Vec2{});
}

}  // namespace crush_test
