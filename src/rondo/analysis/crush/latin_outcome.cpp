// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/latin_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/index.hpp"
#include "rondo/core/sum.hpp"
#include "rondo/fem/stiffness_product.hpp"

namespace rondo::study {

using contact::Status;
using Eigen::Index;

LatinOutcome::LatinOutcome(const CrushSetup& setup, const fem::BlockCsr& stiffness,
                           const statics::Condensation& body, LatinHistories histories)
    : setup_(setup),
      stiffness_(stiffness),
      body_(body),
      outside_(body.outside()),
      histories_(std::move(histories)) {}

Index LatinOutcome::modes() const noexcept {
  return histories_.separated ? histories_.separated->sigma.size() : 0;
}

std::vector<Vec2> LatinOutcome::field(Index column) const {
  if (!histories_.separated) return body_.field(histories_.balanced.force.col(column)).u;
  const statics::Separated& s = *histories_.separated;
  const Eigen::VectorXd u =
      s.modes.field * (s.sigma.asDiagonal() * s.temporal.row(column).transpose());
  std::vector<Vec2> nodes(setup_.mesh.n_nodes());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    nodes[i] = {u[row], u[row + 1]};
  }
  return nodes;
}

/// Energy and balance of the whole field, apart from the works.
void LatinOutcome::measure(statics::CrushEquilibrium& e, statics::CrushReport& report) {
  std::vector<Vec2> rest(e.u.size());
  fem::apply(stiffness_, e.u, rest, 1);
  CompensatedSum energy;
  for (std::size_t i = 0; i < rest.size(); ++i) energy.add(0.5 * dot(rest[i], e.u[i]));
  e.strain = energy.value();
  double force = 0.0, off = 0.0;
  for (std::size_t j = 0; j < setup_.model.nodes.size(); ++j) {
    const Vec2 r = from_frame({0.0, 1.0}, e.force[j]);
    rest[at(setup_.model.nodes[j])] -= r;
    force += dot(r, r);
  }
  for (const Vec2 f : rest) off += dot(f, f);
  largest_force_ = std::max(largest_force_, std::sqrt(force));
  report.equilibrium = largest_force_ > 0.0 ? std::sqrt(off) / largest_force_ : 0.0;
}

statics::CrushEquilibrium LatinOutcome::equilibrium(int k) const {
  statics::CrushEquilibrium e{setup_.path.depth(k), setup_.path.slide(k), field(k - 1), {}, {}};
  e.force.resize(setup_.model.nodes.size());
  e.status.resize(e.force.size(), Status::open);
  const auto column = static_cast<Index>(k - 1);
  for (std::size_t j = 0; j < body_.set().size(); ++j) {
    const auto n = static_cast<Index>(2 * j);
    const std::size_t place = body_.set()[j];
    e.force[place] = {histories_.balanced.force(n, column),
                      histories_.balanced.force(n + 1, column)};
    const double normal = histories_.lawful(n, column),
                 shear = std::abs(histories_.lawful(n + 1, column));
    if (normal > 0.0)
      e.status[place] =
          shear < setup_.model.friction.constant() * normal ? Status::stick : Status::slip;
  }
  return e;
}

/// A candidate that is in the ground without being one of the condensed.
std::string LatinOutcome::missed(const statics::CrushState& state, double tolerance) const {
  const double allowed = tolerance * setup_.path.largest_depth();
  for (const std::size_t j : outside_) {
    if (state.slip[j].x >= -allowed) continue;
    const Vec2 at = setup_.mesh.coordinates[static_cast<std::size_t>(setup_.model.nodes[j])];
    return fmt::format(
        "the contact node at ({:.4g}, {:.4g}) m comes {:.3g} m into the ground and was not "
        "condensed, because it is {:.4g} m above it at first touch, more than twice the depth; "
        "analysis.solver = \"direct\" condenses such nodes during the crush",
        at.x, at.y, -state.slip[j].x, setup_.model.clearance[j]);
  }
  return {};
}

statics::CrushReport LatinOutcome::take(int k, double tolerance, statics::CrushState& state,
                                        std::string& trouble) {
  statics::CrushReport report;
  statics::CrushEquilibrium e = equilibrium(k);
  measure(e, report);
  state = statics::next_state(setup_.model, state, std::move(e));
  report.converged = true;
  report.residual = histories_.residuals[static_cast<Index>(k - 1)];
  for (const Vec2 w : state.slip) report.penetration = std::max(report.penetration, -w.x);
  trouble = crush_trouble(report, state.works, tolerance);
  if (trouble.empty()) trouble = missed(state, tolerance);
  return report;
}

}  // namespace rondo::study
