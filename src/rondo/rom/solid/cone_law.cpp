// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/cone_law.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "rondo/contact/cone.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/integrators/fused/dispatch.hpp"

namespace rondo::rom {
namespace {

using contact::Status;
using Eigen::Index, Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector2d, Eigen::Vector3d,
    Eigen::VectorXd;

/// Sweeps of the first round end when no force changes by more than so many tolerances; a residual
/// is then below a third of it, as a rule.
constexpr double first_share = 1.5;
/// Least share of the residual that a round can leave: below it, sweeps end nowhere, because sums
/// in single precision err by as much.
constexpr double least_of_round = 1e-5;
constexpr int most_newton = 60;  ///< iterations
/// Gap, over the distance that the largest force presses a contact by itself, below which a contact
/// is swept though it has no force. One that is left out wrongly costs one more round.
constexpr double near_gap = 0.03;

Vec3 plain(const Vector3d& a) noexcept {
  return {a[0], a[1], a[2]};
}
/// Along the axes of a contact, by forces along those of another.
Matrix3d block(const ConeContact& to, const ConeContact& from, const WindowCompliance& w) {
  Matrix3d b;
  const Index j = Index{3} * from.place, row = Index{3} * to.place;
  const double* columns[] = {w.column(j), w.column(j + 1), w.column(j + 2)};
  for (Index c = 0; c < 3; ++c) {
    const Vec3 a = from.axes[at(c)];
    double moved[3];
    for (Index i = 0; i < 3; ++i)
      moved[i] = columns[0][row + i] * a.x + columns[1][row + i] * a.y + columns[2][row + i] * a.z;
    b.col(c) = along(to, moved);
  }
  for (std::size_t k = 0; k < 3; ++k)
    b += vector_of(to.lift[k]) * vector_of(from.reply[k]).transpose();
  return b;
}

const kernels::ConeTable& table_of(std::string_view level) noexcept {
#ifdef RONDO_X86_KERNELS
  for (const kernels::ConeTable* table : {&kernels::avx512_cone, &kernels::avx2_cone})
    if (table->name == level) return *table;
#endif
  (void)level;
  return kernels::baseline_cone;
}

}  // namespace

const kernels::ConeTable& cone_table() {
  return table_of(dynamics::kernel_table().name);
}

std::vector<const kernels::ConeTable*> cone_tables() {
  std::vector<const kernels::ConeTable*> tables;
  for (const dynamics::kernels::Table* level : dynamics::kernel_tables())
    tables.push_back(&table_of(level->name));
  return tables;
}

void ConeLaw::prepare(std::span<const ConeContact> contacts, const WindowCompliance& w) {
  local_.resize(contacts.size());
  mean_ = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ConeLocal& l = local_[i];
    l.own = block(contacts[i], contacts[i], w);
    l.inverse = l.own.inverse();
    l.force = vector_of(contacts[i].force);
    l.friction = contacts[i].friction;
    mean_ += l.own.trace();
  }
  mean_ /= 3.0 * static_cast<double>(contacts.size());
}

/// W r, exactly, and what each contact does.
void ConeLaw::multiply(std::span<const ConeContact> contacts, const WindowCompliance& w) {
  std::ranges::fill(moved_, 0.0);
  Vector3d rim = Vector3d::Zero();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vector3d& force = local_[i].force;
    if (force.isZero(0.0)) continue;
    const ConeContact& c = contacts[i];
    const Vec3 r = turned_back(c, force);
    const Index j = Index{3} * c.place;
    const double* columns[] = {w.column(j), w.column(j + 1), w.column(j + 2)};
    const double by[] = {r.x, r.y, r.z};
    table_.add(columns, by, static_cast<Index>(moved_.size()), moved_.data());
    for (Index k = 0; k < 3; ++k) rim[k] += vector_of(c.reply[at(k)]).dot(force);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ConeContact& c = contacts[i];
    Vector3d& u = local_[i].moved;
    u = vector_of(c.free) + along(c, moved_.data() + std::size_t{3} * at(c.place));
    for (Index k = 0; k < 3; ++k) u += rim[k] * vector_of(c.lift[at(k)]);
  }
}

double ConeLaw::largest_force() const noexcept {
  double largest = 0.0;
  for (const ConeLocal& l : local_) largest = std::max(largest, std::abs(l.force[0]));
  return largest;
}

/// μ of a contact at its force and at what it has moved.
double ConeLaw::friction_of(std::size_t i) const {
  const ConeLocal& l = local_[i];
  return friction_ ? (*friction_)(i, l.moved.tail<2>().norm(), l.force[0]) : l.friction;
}

double ConeLaw::residual(std::span<const ConeContact> contacts) const {
  double worst = 0.0, largest = largest_force();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ConeContact& c = contacts[i];
    const ConeLocal& l = local_[i];
    const double missed =
        contact::law_residual(plain(l.force), plain(l.moved), 0.0, friction_of(i), 1.0 / mean_);
    if (!(missed <= worst)) worst = missed;  // also not a number
    largest = std::max(largest, -c.free.x / mean_);
  }
  return largest > 0.0 ? worst / largest : worst;
}

/// Newton's method on the normal maps of all contacts, from the forces at hand. False: it does not
/// come to the tolerance.
bool ConeLaw::newton(std::span<const ConeContact> contacts, const WindowCompliance& w) {
  const Index n = Index{3} * static_cast<Index>(contacts.size());
  MatrixXd a(n, n), jacobian(n, n);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t j = 0; j < contacts.size(); ++j)
      a.block<3, 3>(Index{3} * static_cast<Index>(i), Index{3} * static_cast<Index>(j)) =
          block(contacts[i], contacts[j], w);
  const double rho = 1.0 / mean_;
  VectorXd missed(n);
  for (int turn = 0; turn < most_newton; ++turn) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Index at_row = Index{3} * static_cast<Index>(i);
      const Vector3d &r = local_[i].force, &u = local_[i].moved, s = r - rho * u;
      const double mu = local_[i].friction = friction_of(i);
      auto rows = jacobian.middleRows<3>(at_row);
      const auto lines = a.middleRows<3>(at_row);
      rows.setZero();
      if (s[0] <= 0.0) {
        rows.block<3, 3>(0, at_row).setIdentity();
        missed.segment<3>(at_row) = r;
        continue;
      }
      rows.row(0) = rho * lines.row(0);
      missed[at_row] = rho * u[0];
      const double length = s.tail<2>().norm(), most = mu * s[0];
      if (length <= most) {
        rows.bottomRows<2>() = rho * lines.bottomRows<2>();
        missed.segment<2>(at_row + 1) = rho * u.tail<2>();
        continue;
      }
      const Vector2d e = s.tail<2>() / length;
      const Eigen::Matrix2d turned =
          most / length * (Eigen::Matrix2d::Identity() - e * e.transpose());
      rows.bottomRows<2>() = rho * (mu * e * lines.row(0) + turned * lines.bottomRows<2>());
      rows.block<2, 1>(1, at_row) -= mu * e;
      rows.block<2, 2>(1, at_row + 1) += Eigen::Matrix2d::Identity() - turned;
      missed.segment<2>(at_row + 1) = r.tail<2>() - most * e;
    }
    const VectorXd change = jacobian.partialPivLu().solve(missed);
    if (!change.allFinite()) return false;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      local_[i].force -= change.segment<3>(Index{3} * static_cast<Index>(i));
    multiply(contacts, w);
    if (residual(contacts) <= tolerance_) return true;
  }
  return false;
}

ConeLaw::Report ConeLaw::solve(std::span<ConeContact> contacts, const WindowCompliance& w,
                               Index rows, const ConeFriction* friction) {
  friction_ = friction;
  RONDO_DEMAND(rows <= w.size() && rows % 3 == 0, rows, w.size());
  Report report;
  moved_.resize(at(rows));
  if (contacts.empty()) {
    std::ranges::fill(moved_, 0.0);
    return report;
  }
  prepare(contacts, w);
  multiply(contacts, w);
  double share = first_share * tolerance_;
  for (report.residual = residual(contacts);
       report.residual > tolerance_ && report.sweeps < most_sweeps_; share *= 0.25) {
    sweeps_.begin(contacts, local_, w, near_gap * mean_ * largest_force(), friction);
    report.sweeps +=
        sweeps_.iterate(contacts, local_, std::max(share, least_of_round * report.residual),
                        most_sweeps_ - report.sweeps);
    multiply(contacts, w);
    report.residual = residual(contacts);
  }
  if (report.residual > tolerance_) {
    report.by_newton = true;
    const std::vector<ConeLocal> swept = local_;
    newton(contacts, w);
    const double found = residual(contacts);
    if (!(found < report.residual)) {
      local_ = swept;
      multiply(contacts, w);
    }
    report.residual = residual(contacts);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) finish(i, contacts[i]);
  return report;
}

/// Tells a contact its force, what it does, and its status.
void ConeLaw::finish(std::size_t i, ConeContact& c) const {
  const ConeLocal& l = local_[i];
  c.force = plain(l.force);
  c.moved = plain(l.moved);
  c.status = Status::open;
  if (l.force[0] <= 0.0) return;
  c.friction = friction_of(i);
  const double most = c.friction * l.force[0];
  c.status = l.force.tail<2>().norm() < most * (1.0 - 1e-9) ? Status::stick : Status::slip;
}

}  // namespace rondo::rom
