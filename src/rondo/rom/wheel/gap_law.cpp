// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/gap_law.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/statics/condensed_contact.hpp"

namespace rondo::rom {
namespace {

using contact::Status;
using Eigen::Index;

constexpr int iterations_at_once = 12;  ///< on all statuses
constexpr int most_iterations = 60;
constexpr double solved = 1e-9;  ///< residual, over the largest force

}  // namespace

GapLaw::GapLaw(std::size_t most_contacts)
    : most_(most_contacts),
      compliance_(4 * most_ * most_),
      matrix_(4 * most_ * most_),
      unknown_(2 * most_),
      force_(2 * most_),
      pivots_(2 * most_) {}

Eigen::Map<Eigen::MatrixXd> GapLaw::compliance(std::size_t n) {
  RONDO_DEMAND(n <= most_, n, most_);
  size_ = static_cast<Index>(2 * n);
  return {compliance_.data(), size_, size_};
}

/// Forces of the statuses at hand: gaps of those that press are closed, those that stick stay.
void GapLaw::settle(std::span<GapContact> contacts, double friction) {
  const Eigen::Map<const Eigen::MatrixXd> w(compliance_.data(), size_, size_);
  const auto presses = [](const GapContact& c) { return c.status != Status::open; };
  const auto sticks = [](const GapContact& c) { return c.status == Status::stick; };
  Index n = 0;
  for (const GapContact& c : contacts) n += presses(c) + sticks(c);
  if (n == 0) {
    for (GapContact& c : contacts) c.normal = c.shear = 0.0;
    return;
  }
  Eigen::Map<Eigen::MatrixXd> a(matrix_.data(), n, n);
  Index column = 0;
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    const GapContact& c = contacts[j];
    if (!presses(c)) continue;
    const auto normal = static_cast<Index>(2 * j);
    const double along = c.status == Status::slip ? -c.side * friction : 0.0;
    Index row = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (!presses(contacts[i])) continue;
      for (Index r = 0; r < (sticks(contacts[i]) ? 2 : 1); ++r, ++row) {
        const Index at = static_cast<Index>(2 * i) + r;
        a(row, column) = w(at, normal) + along * w(at, normal + 1);
        if (sticks(c)) a(row, column + 1) = w(at, normal + 1);
      }
    }
    unknown_[at(column)] = -c.free_gap;
    if (sticks(c)) unknown_[at(column + 1)] = -c.free_slip;
    column += sticks(c) ? 2 : 1;
  }
  const auto size = static_cast<lapack_int>(n);
  if (LAPACKE_dgesv_work(LAPACK_COL_MAJOR, size, 1, matrix_.data(), size, pivots_.data(),
                         unknown_.data(), size) != 0)
    std::fill_n(unknown_.begin(), n, std::numeric_limits<double>::quiet_NaN());
  const double* x = unknown_.data();
  for (GapContact& c : contacts) {
    c.normal = presses(c) ? *x++ : 0.0;
    c.shear = sticks(c) ? *x++ : c.status == Status::slip ? -c.side * friction * c.normal : 0.0;
  }
}

/// Gaps and slips under the forces.
void GapLaw::move(std::span<GapContact> contacts) {
  const Eigen::Map<const Eigen::MatrixXd> w(compliance_.data(), size_, size_);
  Eigen::Map<Eigen::VectorXd> r(force_.data(), size_), moved(unknown_.data(), size_);
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    force_[2 * j] = contacts[j].normal;
    force_[2 * j + 1] = contacts[j].shear;
  }
  moved.noalias() = w * r;
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    contacts[j].gap = contacts[j].free_gap + unknown_[2 * j];
    contacts[j].slip = contacts[j].free_slip + unknown_[2 * j + 1];
  }
}

/// The statuses that the law gives the contacts as they are; where Newton's method goes round in
/// circles, of the first contact alone whose status is wrong. False: none is.
bool GapLaw::judge(std::span<GapContact> contacts, double friction, bool all) const {
  bool changed = false;
  for (GapContact& c : contacts) {
    const double pressed = c.normal - c.gap / mean_, pushed = c.shear - c.slip / mean_;
    Status status = Status::open;
    double side = 0.0;
    if (pressed > 0.0 && friction > 0.0 && std::abs(pushed) <= friction * pressed) {
      status = Status::stick;
    } else if (pressed > 0.0) {
      status = Status::slip;
      side = friction > 0.0 ? -std::copysign(1.0, pushed) : 0.0;
    }
    if (status == c.status && side == c.side) continue;
    c.status = status;
    c.side = side;
    changed = true;
    if (!all) return true;
  }
  return changed;
}

/// Distance of the forces from those that the law gives at their gaps and slips.
double GapLaw::residual(std::span<const GapContact> contacts, double friction) const {
  double worst = 0.0, largest = 0.0;
  for (const GapContact& c : contacts) {
    const double normal = std::max(0.0, c.normal - c.gap / mean_), most = friction * normal;
    const double shear = std::clamp(c.shear - c.slip / mean_, -most, most);
    const double missed = std::hypot(c.normal - normal, c.shear - shear);
    if (!(missed <= worst)) worst = missed;  // also not a number
    largest = std::max({largest, std::abs(c.normal), std::abs(c.free_gap) / mean_});
  }
  return largest > 0.0 ? worst / largest : worst;
}

/// The law as a linear complementarity problem.
void GapLaw::pivot(std::span<GapContact> contacts, double friction) {
  const Eigen::MatrixXd w = Eigen::Map<const Eigen::MatrixXd>(compliance_.data(), size_, size_);
  Eigen::VectorXd free(size_);
  for (std::size_t j = 0; j < contacts.size(); ++j)
    free.segment<2>(static_cast<Index>(2 * j)) << contacts[j].free_gap, contacts[j].free_slip;
  const statics::ComplementaryForm form = statics::make_complementary({w, free, friction});
  const auto m = static_cast<Index>(contacts.size());
  statics::LcpSolution solution;
  const auto most = static_cast<int>(30 * m + 100);
  if (solve_lemke(form.lcp, most, solution).end != statics::LemkeEnd::solved) return;
  for (Index j = 0; j < m; ++j) {
    GapContact& c = contacts[at(j)];
    c.normal = form.force * solution.z[j];
    c.shear = form.force * (solution.z[m + j] - friction * solution.z[j]);
  }
  move(contacts);
  // Its statuses, and their forces to round-off.
  static_cast<void>(judge(contacts, friction, true));
  settle(contacts, friction);
  move(contacts);
}

GapLaw::Report GapLaw::solve(std::span<GapContact> contacts, double friction) {
  RONDO_DEMAND(static_cast<Index>(2 * contacts.size()) == size_ && friction >= 0.0, contacts.size(),
               size_, friction);
  Report report;
  if (contacts.empty()) return report;
  mean_ = Eigen::Map<const Eigen::MatrixXd>(compliance_.data(), size_, size_).diagonal().mean();
  for (int i = 0; i < most_iterations; ++i) {
    ++report.iterations;
    settle(contacts, friction);
    move(contacts);
    if (!judge(contacts, friction, i < iterations_at_once)) break;
  }
  report.residual = residual(contacts, friction);
  if (report.residual <= solved) return report;
  report.pivoted = true;
  pivot(contacts, friction);
  report.residual = residual(contacts, friction);
  return report;
}

}  // namespace rondo::rom
