// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/gap_law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Solves A x = b in place, with row pivots. Systems are so small that calls of LAPACK would take
/// longer than the arithmetic.
void eliminate(Eigen::Map<Eigen::MatrixXd> a, double* b) {
  const Index n = a.rows();
  for (Index k = 0; k < n; ++k) {
    double* pivots = &a(0, k);
    Index best = k;
    for (Index i = k + 1; i < n; ++i)
      if (std::abs(pivots[i]) > std::abs(pivots[best])) best = i;
    if (best != k) {
      for (Index j = k; j < n; ++j) std::swap(a(k, j), a(best, j));
      std::swap(b[k], b[best]);
    }
    const double over = 1.0 / pivots[k];
    for (Index i = k + 1; i < n; ++i) {
      pivots[i] *= over;
      b[i] -= pivots[i] * b[k];
    }
    const double* __restrict by = pivots;
    for (Index j = k + 1; j < n; ++j) {
      double* __restrict column = &a(0, j);
      const double top = column[k];
      for (Index i = k + 1; i < n; ++i) column[i] -= by[i] * top;
    }
  }
  for (Index k = n; k-- > 0;) {
    const double* column = &a(0, k);
    b[k] /= column[k];
    for (Index i = 0; i < k; ++i) b[i] -= column[i] * b[k];
  }
}

}  // namespace

GapLaw::GapLaw(std::size_t most_contacts)
    : most_(most_contacts),
      compliance_(4 * most_ * most_),
      matrix_(4 * most_ * most_),
      unknown_(2 * most_),
      force_(2 * most_) {
  rows_.reserve(2 * most_);
}

Eigen::Map<Eigen::MatrixXd> GapLaw::compliance(std::size_t n) {
  RONDO_DEMAND(n <= most_, n, most_);
  size_ = static_cast<Index>(2 * n);
  return {compliance_.data(), size_, size_};
}

/// Forces of the statuses at hand: gaps of those that press are closed, those that stick stay.
void GapLaw::settle(std::span<GapContact> contacts, double friction) {
  const auto sticks = [](const GapContact& c) { return c.status == Status::stick; };
  rows_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].status == Status::open) continue;
    rows_.push_back(static_cast<Index>(2 * i));
    unknown_[rows_.size() - 1] = -contacts[i].free_gap;
    if (!sticks(contacts[i])) continue;
    rows_.push_back(static_cast<Index>(2 * i + 1));
    unknown_[rows_.size() - 1] = -contacts[i].free_slip;
  }
  const auto n = static_cast<Index>(rows_.size());
  Eigen::Map<Eigen::MatrixXd> a(matrix_.data(), n, n);
  for (Index j = 0; j < n; ++j) {
    const GapContact& c = contacts[at(rows_[at(j)] / 2)];
    const double* by = compliance_.data() + size_ * rows_[at(j)];
    if (c.status == Status::slip) {
      const double along = -c.side * friction;
      for (Index i = 0; i < n; ++i) a(i, j) = by[rows_[at(i)]] + along * by[size_ + rows_[at(i)]];
    } else {
      for (Index i = 0; i < n; ++i) a(i, j) = by[rows_[at(i)]];
    }
  }
  eliminate(a, unknown_.data());
  const double* x = unknown_.data();
  for (GapContact& c : contacts) {
    c.normal = c.status == Status::open ? 0.0 : *x++;
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
    const double missed =
        (c.normal - normal) * (c.normal - normal) + (c.shear - shear) * (c.shear - shear);
    if (!(missed <= worst)) worst = missed;  // also not a number
    largest = std::max({largest, std::abs(c.normal), std::abs(c.free_gap) / mean_});
  }
  worst = std::sqrt(worst);
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
