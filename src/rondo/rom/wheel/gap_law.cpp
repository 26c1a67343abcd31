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

bool is_bent(const GapContact& c) noexcept {
  return c.by_slip != 0.0 || c.by_normal != 0.0;
}

/// Whether the shear is an unknown of its own beside the normal force.
bool has_own_shear(const GapContact& c) noexcept {
  return c.status == Status::stick || (c.status == Status::slip && is_bent(c));
}

/// The most that friction holds, along the tangent of μ times the force.
double most_shear(const GapContact& c, double normal, double slip) noexcept {
  if (!is_bent(c)) return c.friction * normal;
  const double change = c.by_slip * (slip - c.slip_at) + c.by_normal * (normal - c.normal_at);
  return std::max(0.0, c.friction * normal + c.normal_at * change);
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

/// Contacts that slip and whose μ changes have their shear on the tangent of most_shear().
void GapLaw::follow_tangents(std::span<const GapContact> contacts, Eigen::Map<Eigen::MatrixXd>& a) {
  for (Index i = 0; i < a.rows(); ++i) {
    const GapContact& c = contacts[at(rows_[at(i)] / 2)];
    if (rows_[at(i)] % 2 == 0 || c.status != Status::slip) continue;
    const double steep = mean_ * c.normal_at * c.by_slip, rise = c.normal_at * c.by_normal;
    a.row(i) *= steep;
    a(i, i) += mean_;
    a(i, i - 1) += mean_ * c.side * (c.friction + rise);
    unknown_[at(i)] =
        steep * unknown_[at(i)] + c.side * (steep * c.slip_at + mean_ * rise * c.normal_at);
  }
}

/// Forces of the statuses at hand: gaps of those that press are closed, those that stick stay.
void GapLaw::settle(std::span<GapContact> contacts) {
  rows_.clear();
  bool bent = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].status == Status::open) continue;
    rows_.push_back(static_cast<Index>(2 * i));
    unknown_[rows_.size() - 1] = -contacts[i].free_gap;
    if (!has_own_shear(contacts[i])) continue;
    bent |= contacts[i].status == Status::slip;
    rows_.push_back(static_cast<Index>(2 * i + 1));
    unknown_[rows_.size() - 1] = -contacts[i].free_slip;
  }
  const auto n = static_cast<Index>(rows_.size());
  Eigen::Map<Eigen::MatrixXd> a(matrix_.data(), n, n);
  for (Index j = 0; j < n; ++j) {
    const GapContact& c = contacts[at(rows_[at(j)] / 2)];
    const double* by = compliance_.data() + size_ * rows_[at(j)];
    if (!has_own_shear(c)) {
      const double along = -c.side * c.friction;
      for (Index i = 0; i < n; ++i) a(i, j) = by[rows_[at(i)]] + along * by[size_ + rows_[at(i)]];
    } else {
      for (Index i = 0; i < n; ++i) a(i, j) = by[rows_[at(i)]];
    }
  }
  if (bent) follow_tangents(contacts, a);
  eliminate(a, unknown_.data());
  const double* x = unknown_.data();
  for (GapContact& c : contacts) {
    c.normal = c.status == Status::open ? 0.0 : *x++;
    c.shear = has_own_shear(c)           ? *x++
              : c.status == Status::slip ? -c.side * c.friction * c.normal
                                         : 0.0;
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
bool GapLaw::judge(std::span<GapContact> contacts, bool all) const {
  bool changed = false;
  for (GapContact& c : contacts) {
    const double pressed = c.normal - c.gap / mean_, pushed = c.shear - c.slip / mean_;
    const double most = most_shear(c, std::max(0.0, pressed), 0.0);
    Status status = Status::open;
    double side = 0.0;
    if (pressed > 0.0 && most > 0.0 && std::abs(pushed) <= most) {
      status = Status::stick;
    } else if (pressed > 0.0) {
      status = Status::slip;
      side = c.friction > 0.0 || is_bent(c) ? -std::copysign(1.0, pushed) : 0.0;
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
double GapLaw::residual(std::span<const GapContact> contacts) const {
  double worst = 0.0, largest = 0.0;
  for (const GapContact& c : contacts) {
    const double normal = std::max(0.0, c.normal - c.gap / mean_),
                 most = most_shear(c, normal, std::abs(c.slip));
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
void GapLaw::pivot(std::span<GapContact> contacts) {
  const Eigen::MatrixXd w = Eigen::Map<const Eigen::MatrixXd>(compliance_.data(), size_, size_);
  Eigen::VectorXd free(size_);
  std::vector<double> friction;
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    free.segment<2>(static_cast<Index>(2 * j)) << contacts[j].free_gap, contacts[j].free_slip;
    friction.push_back(contacts[j].friction);
  }
  const statics::ComplementaryForm form =
      statics::make_complementary({w, free, statics::CandidateFriction(std::move(friction))});
  const auto m = static_cast<Index>(contacts.size());
  statics::LcpSolution solution;
  const auto most = static_cast<int>(30 * m + 100);
  if (solve_lemke(form.lcp, most, solution).end != statics::LemkeEnd::solved) return;
  for (Index j = 0; j < m; ++j) {
    GapContact& c = contacts[at(j)];
    c.normal = form.force * solution.z[j];
    c.shear = form.force * (solution.z[m + j] - c.friction * solution.z[j]);
  }
  move(contacts);
  // Its statuses, and their forces to round-off.
  static_cast<void>(judge(contacts, true));
  settle(contacts);
  move(contacts);
}

GapLaw::Report GapLaw::solve(std::span<GapContact> contacts) {
  RONDO_DEMAND(static_cast<Index>(2 * contacts.size()) == size_, contacts.size(), size_);
  Report report;
  if (contacts.empty()) return report;
  mean_ = Eigen::Map<const Eigen::MatrixXd>(compliance_.data(), size_, size_).diagonal().mean();
  for (int i = 0; i < most_iterations; ++i) {
    ++report.iterations;
    settle(contacts);
    move(contacts);
    if (!judge(contacts, i < iterations_at_once)) break;
  }
  report.residual = residual(contacts);
  if (report.residual <= solved || std::ranges::any_of(contacts, is_bent)) return report;
  report.pivoted = true;
  pivot(contacts);
  report.residual = residual(contacts);
  return report;
}

}  // namespace rondo::rom
