// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/condensed_contact.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/contact/residual.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/dense.hpp"
#include "rondo/core/index.hpp"

namespace rondo::statics {
namespace {

using contact::Status;
using Eigen::Index;

// A look costs a direct solve, so it waits for other findings, though not for ever.
constexpr int sweeps_between_looks = 4, sweeps_without_news = 100;

Vec2 vec2_at(const Eigen::VectorXd& v, Index j) {
  return {v[2 * j], v[2 * j + 1]};
}

/// What a sweep finds of a candidate; `side` is that of a slipping one's tangential force.
struct Finding {
  Status status = Status::open;
  double side = 1.0;
  bool operator==(const Finding&) const = default;
};
using Findings = std::vector<Finding>;

void sweep(const CondensedProblem& p, Eigen::VectorXd& r, Findings& found) {
  const Eigen::MatrixXd& g = p.compliance;
  for (Index j = 0; j < r.size() / 2; ++j) {
    const Index n = 2 * j, t = n + 1;
    const BlockProblem block{{p.free[n] + g.col(n).dot(r) - g(n, n) * r[n] - g(n, t) * r[t],
                              p.free[t] + g.col(t).dot(r) - g(t, n) * r[n] - g(t, t) * r[t]},
                             g(n, n),
                             g(n, t),
                             g(t, t)};
    const contact::LocalSolution local = solve_block(block, p.friction[at(j)]);
    r[n] = local.impulse.x;
    r[t] = local.impulse.y;
    const bool slips = local.status == Status::slip;
    found[at(j)] = {local.status, slips && r[t] < 0.0 ? -1.0 : 1.0};
  }
}

/// The forces that go with the findings: w = 0 where a candidate sticks, w_n = 0 and
/// r_t = ± μ r_n where it slips. Not finite where those equations are singular.
Eigen::VectorXd solve_directly(const CondensedProblem& p, const Findings& found) {
  std::vector<Index> rows;
  for (std::size_t j = 0; j < found.size(); ++j) {
    if (found[j].status == Status::open) continue;
    rows.push_back(static_cast<Index>(2 * j));
    if (found[j].status == Status::stick) rows.push_back(static_cast<Index>(2 * j + 1));
  }
  Eigen::VectorXd r = Eigen::VectorXd::Zero(p.free.size());
  if (rows.empty()) return r;
  const auto edge = [&](Index row) {  // μ with its sign where the row's candidate slips
    const Finding& f = found[at(row / 2)];
    return f.status == Status::slip ? f.side * p.friction[at(row / 2)] : 0.0;
  };
  const auto size = static_cast<Index>(rows.size());
  Eigen::MatrixXd a(size, size);
  for (Index k = 0; k < size; ++k) {
    const Index column = rows[at(k)];
    a.col(k) = p.compliance.col(column)(rows);
    if (edge(column) != 0.0) a.col(k) += edge(column) * p.compliance.col(column + 1)(rows);
  }
  const Eigen::VectorXd part = solve(a, -p.free(rows));
  for (Index k = 0; k < size; ++k) {
    const Index row = rows[at(k)];
    r[row] = part[k];
    if (edge(row) != 0.0) r[row + 1] = edge(row) * part[k];
  }
  return r;
}

double residual_of(const CondensedProblem& p, const Eigen::VectorXd& r) {
  return condensed_residual(p, r, p.free + p.compliance * r);
}

Eigen::VectorXd coefficients(const CandidateFriction& of, Index m) {
  Eigen::VectorXd all(m);
  for (Index j = 0; j < m; ++j) all[j] = of[at(j)];
  return all;
}

/// Looks whether the findings, or the forces as swept, are the solution; keeps the better ones.
void look(const CondensedProblem& p, const Findings& found, Eigen::VectorXd& r,
          CondensedReport& report) {
  report.residual = residual_of(p, r);
  Eigen::VectorXd direct = solve_directly(p, found);
  ++report.direct_solves;
  const double residual = direct.allFinite() ? residual_of(p, direct) : report.residual;
  if (!(residual < report.residual)) return;
  report.residual = residual;
  r = std::move(direct);
}

/// What the basis of (6.4f) says of each candidate. Where r_n is basic and none of its slacks is,
/// r_n is zero: open.
Findings findings_of(const LcpSolution& lcp, const CandidateFriction& friction) {
  const std::size_t m = lcp.basic.size() / 3;
  Findings found(m);
  for (std::size_t j = 0; j < m; ++j) {
    const bool off_lower = lcp.basic[m + j] != 0, off_upper = lcp.basic[2 * m + j] == 0;
    if (lcp.basic[j] == 0 || (!off_lower && !off_upper)) continue;
    found[j].side = off_lower ? 1.0 : -1.0;
    found[j].status = off_lower && off_upper && friction[j] > 0.0 ? Status::stick : Status::slip;
  }
  return found;
}

/// Solves (6.4f) by pivoting and polishes; r stays where that is not better.
void pivot(const CondensedProblem& p, Eigen::VectorXd& r, Findings& found,
           CondensedReport& report) {
  const ComplementaryForm form = make_complementary(p);
  if (!(form.length > 0.0)) return;
  const Index m = p.free.size() / 2;
  const int max_pivots = static_cast<int>(std::min<Index>(30 * m + 100, 1000000));
  LcpSolution lcp;
  const LemkeReport ended = solve_lemke(form.lcp, max_pivots, lcp);
  report.pivots = ended.pivots;
  report.pivoting = ended.end == LemkeEnd::solved ? Pivoting::used : Pivoting::failed;
  if (ended.end != LemkeEnd::solved) return;
  Eigen::VectorXd pivoted(2 * m);
  for (Index j = 0; j < m; ++j) {
    const double normal = form.force * lcp.z[j], lower = form.force * lcp.z[m + j];
    pivoted.segment<2>(2 * j) << normal, lower - p.friction[at(j)] * normal;
  }
  const double swept = report.residual;
  const Findings of_basis = findings_of(lcp, p.friction);
  look(p, of_basis, pivoted, report);
  if (report.residual < swept) {
    r = std::move(pivoted);
    found = of_basis;
  } else {
    report.residual = swept;
  }
}

}  // namespace

contact::LocalSolution solve_block(const BlockProblem& p, double friction) noexcept {
  if (p.free.x >= 0.0) return {};
  // Over `normal`, so that no square of a compliance leaves the range of the numbers.
  const double shear = p.shear / p.normal, mixed = p.mixed / p.normal;
  const double det = (shear - mixed * mixed) * p.normal;
  const Vec2 stick = {-(shear * p.free.x - mixed * p.free.y) / det,
                      -(p.free.y - mixed * p.free.x) / det};
  if (friction > 0.0 && std::abs(stick.y) <= friction * stick.x) return {stick, Status::stick};
  // The sense is that of the force which sticking would need, as in contact::solve_local.
  const double edge = stick.y > 0.0 ? friction : -friction;
  const double compliance = p.normal + edge * p.mixed;
  if (!(compliance > 0.0)) return {};
  const double rn = -p.free.x / compliance;
  return {{rn, edge * rn}, Status::slip};
}

double condensed_residual(const CondensedProblem& p, const Eigen::VectorXd& r,
                          const Eigen::VectorXd& w) {
  double largest = 0.0, force = 0.0, free = 0.0;
  for (Index j = 0; j < r.size() / 2; ++j) {
    const double stiffness = 1.0 / p.compliance(2 * j, 2 * j);
    const double residual =
        contact::law_residual(vec2_at(r, j), vec2_at(w, j), 0.0, p.friction[at(j)], stiffness);
    if (!std::isfinite(residual)) return residual;
    largest = std::max(largest, residual);
    force = std::max(force, norm(vec2_at(r, j)));
    free = std::max(free, stiffness * norm(vec2_at(p.free, j)));
  }
  return largest == 0.0 ? 0.0 : largest / (force > 0.0 ? force : free);
}

ComplementaryForm make_complementary(const CondensedProblem& p) {
  const Index m = p.free.size() / 2;
  const auto normal = Eigen::seqN(0, m, 2), tangential = Eigen::seqN(1, m, 2);
  ComplementaryForm f;
  Eigen::MatrixXd& matrix = f.lcp.matrix;
  const double compliance = p.compliance.diagonal().mean();
  f.length = p.free.cwiseAbs().maxCoeff();
  f.force = f.length / compliance;
  matrix = Eigen::MatrixXd::Zero(3 * m, 3 * m);
  const Eigen::MatrixXd nt = p.compliance(normal, tangential) / compliance,
                        tn = p.compliance(tangential, normal) / compliance,
                        tt = p.compliance(tangential, tangential) / compliance;
  const Eigen::VectorXd friction = coefficients(p.friction, m);
  const auto edge = friction.asDiagonal();
  matrix.topLeftCorner(m, m) = p.compliance(normal, normal) / compliance - nt * edge;
  matrix.block(0, m, m, m) = nt;
  matrix.block(m, 0, m, m) = tn - tt * edge;
  matrix.block(m, m, m, m) = tt;
  matrix.block(m, 2 * m, m, m).setIdentity();
  matrix.bottomLeftCorner(m, m).diagonal() = 2.0 * friction;
  matrix.block(2 * m, m, m, m).diagonal().setConstant(-1.0);
  f.lcp.q = Eigen::VectorXd::Zero(3 * m);
  f.lcp.q.head(m) = p.free(normal) / f.length;
  f.lcp.q.segment(m, m) = p.free(tangential) / f.length;
  // With the normal part at least μ times the tangential one there is no ray (6.4).
  f.lcp.cover = Eigen::VectorXd::Ones(3 * m);
  f.lcp.cover.segment(m, m) = friction.cwiseMax(1.0).cwiseInverse();
  return f;
}

CondensedReport solve_condensed(const CondensedProblem& p, const CondensedLimits& limits,
                                CondensedSolution& solution) {
  const Index size = p.free.size();
  RONDO_DEMAND(p.compliance.rows() == size && p.compliance.cols() == size &&
                   solution.force.size() == size && size % 2 == 0 && p.friction.suits(at(size / 2)),
               p.compliance.rows(), p.compliance.cols(), solution.force.size(), size);
  CondensedReport report;
  Findings found(static_cast<std::size_t>(size / 2)), looked_at;
  while (!report.converged && report.sweeps < limits.sweeps) {
    sweep(p, solution.force, found);
    ++report.sweeps;
    const bool last = report.sweeps == limits.sweeps;
    const bool pivots = report.sweeps == limits.sweeps_before_pivoting;
    const int wait = found == looked_at ? sweeps_without_news : sweeps_between_looks;
    if (report.sweeps % wait != 0 && !last && !pivots) continue;
    looked_at = found;
    look(p, found, solution.force, report);
    if (pivots && !(report.residual <= limits.tolerance)) pivot(p, solution.force, found, report);
    report.converged = report.residual <= limits.tolerance;
  }
  solution.status.clear();
  for (const Finding& f : found) solution.status.push_back(f.status);
  return report;
}

}  // namespace rondo::statics
