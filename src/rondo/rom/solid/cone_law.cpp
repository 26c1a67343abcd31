// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/cone_law.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/contact/cone.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

using contact::Status;
using Eigen::Index, Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector2d, Eigen::Vector3d,
    Eigen::VectorXd;

constexpr int most_sweeps = 300;     ///< without Newton's method
constexpr int most_newton = 60;      ///< iterations
constexpr int most_secants = 40;     ///< of a coefficient that is not constant
constexpr int most_directions = 30;  ///< of sliding, in the solution of one contact

Vector3d vector(Vec3 a) noexcept {
  return {a.x, a.y, a.z};
}
Vec3 plain(const Vector3d& a) noexcept {
  return {a[0], a[1], a[2]};
}
/// Components along the axes of a contact.
Vector3d along(const ConeContact& c, const double* own) noexcept {
  const Vec3 a{own[0], own[1], own[2]};
  return {dot(c.axes[0], a), dot(c.axes[1], a), dot(c.axes[2], a)};
}
/// In the axes of the compliance.
Vec3 own(const ConeContact& c, const Vector3d& force) noexcept {
  return force[0] * c.axes[0] + force[1] * c.axes[1] + force[2] * c.axes[2];
}
/// Along the axes of a contact, by forces along those of another.
Matrix3d block(const ConeContact& to, const ConeContact& from, const WindowCompliance& w) {
  Matrix3d b;
  const double* columns[] = {w.column(3 * from.place), w.column(3 * from.place + 1),
                             w.column(3 * from.place + 2)};
  const Index row = Index{3} * to.place;
  for (Index c = 0; c < 3; ++c) {
    const Vec3 a = from.axes[at(c)];
    double moved[3];
    for (Index i = 0; i < 3; ++i)
      moved[i] = columns[0][row + i] * a.x + columns[1][row + i] * a.y + columns[2][row + i] * a.z;
    b.col(c) = along(to, moved);
  }
  for (std::size_t k = 0; k < 3; ++k) b += vector(to.lift[k]) * vector(from.reply[k]).transpose();
  return b;
}

/// out += three columns times three factors.
void add_columns(const float* a, const float* b, const float* c, const Vec3& by, Index n,
                 double* __restrict out) noexcept {
  for (Index i = 0; i < n; ++i)
    out[i] += by.x * static_cast<double>(a[i]) + by.y * static_cast<double>(b[i]) +
              by.z * static_cast<double>(c[i]);
}

}  // namespace

void WindowCompliance::resize(Index n) {
  exact_.resize(n, n);
  rounded_.resize(n, n);
}

void WindowCompliance::round() {
  rounded_ = exact_.cast<float>();
}

Vector3d ConeLaw::moved_of(const ConeContact& c) const noexcept {
  Vector3d u = vector(c.free) + along(c, moved_.data() + std::size_t{3} * at(c.place));
  for (Index k = 0; k < 3; ++k) u += rim_[k] * vector(c.lift[at(k)]);
  return u;
}

void ConeLaw::prepare(std::span<const ConeContact> contacts, const WindowCompliance& w) {
  const Index n = Index{3} * static_cast<Index>(contacts.size());
  local_.resize(contacts.size());
  moved_.resize(at(rows_));
  if (const Index all = n + rows_ + 3; before_.size() < all) {
    const Index room = all + all / 2;
    for (VectorXd* v : {&before_, &after_, &change_, &change_before_, &after_before_})
      v->resize(room);
    changes_.resize(room, depth);
    results_.resize(room, depth);
  }
  mean_ = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Local& l = local_[i];
    l.own = block(contacts[i], contacts[i], w);
    l.inverse = l.own.inverse();
    l.force = vector(contacts[i].force);
    l.friction = contacts[i].friction;
    mean_ += l.own.trace();
  }
  mean_ /= static_cast<double>(n);
}

/// W r, exactly, and the accelerations of the rim.
void ConeLaw::multiply(std::span<const ConeContact> contacts, const WindowCompliance& w) {
  std::ranges::fill(moved_, 0.0);
  rim_.setZero();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vector3d& force = local_[i].force;
    if (force.isZero(0.0)) continue;
    const ConeContact& c = contacts[i];
    const Vec3 r = own(c, force);
    const Index j = Index{3} * c.place;
    const double *a = w.column(j), *b = w.column(j + 1), *d = w.column(j + 2);
    double* __restrict out = moved_.data();
    for (Index k = 0; k < rows_; ++k) out[k] += r.x * a[k] + r.y * b[k] + r.z * d[k];
    for (Index k = 0; k < 3; ++k) rim_[k] += vector(c.reply[at(k)]).dot(force);
  }
}

void ConeLaw::push(const ConeContact& c, const WindowCompliance& w,
                   const Vector3d& change) noexcept {
  const Index j = Index{3} * c.place;
  add_columns(w.rounded(j), w.rounded(j + 1), w.rounded(j + 2), own(c, change), rows_,
              moved_.data());
  for (Index k = 0; k < 3; ++k) rim_[k] += vector(c.reply[at(k)]).dot(change);
}

/// The force of one contact, the others being as they are. @param free moved without it
Vector3d ConeLaw::solve_one(const Local& l, double mu, const Vector3d& free) const noexcept {
  if (free[0] >= 0.0) return Vector3d::Zero();
  const Matrix3d& a = l.own;
  if (mu == 0.0) return {-free[0] / a(0, 0), 0.0, 0.0};
  const Vector3d stuck = -(l.inverse * free);
  if (stuck[0] > 0.0 && stuck.tail<2>().squaredNorm() <= mu * mu * stuck[0] * stuck[0])
    return stuck;
  // It slides: r = r_n (1, μ e) with e against the slip.
  Vector2d e = l.force.tail<2>();
  if (e.isZero(0.0)) e = -free.tail<2>();
  const double length = e.norm();
  if (length > 0.0)
    e /= length;
  else
    e = {1.0, 0.0};
  double normal = 0.0;
  for (int turn = 0; turn < most_directions; ++turn) {
    const double stiff = a(0, 0) + mu * (a(0, 1) * e[0] + a(0, 2) * e[1]);
    normal = -free[0] / stiff;
    const Vector2d reached = a.block<2, 1>(1, 0) + mu * (a.block<2, 2>(1, 1) * e);
    const Vector2d slip = free.tail<2>() + normal * reached;
    const Vector2d across(-e[1], e[0]);
    const double off = e[0] * slip[1] - e[1] * slip[0];  // 0: along e
    const double by_normal =
        free[0] * mu * (a(0, 1) * across[0] + a(0, 2) * across[1]) / (stiff * stiff);
    const Vector2d slip_by = by_normal * reached + normal * mu * (a.block<2, 2>(1, 1) * across);
    const double slope =
        across[0] * slip[1] - across[1] * slip[0] + e[0] * slip_by[1] - e[1] * slip_by[0];
    if (e.dot(slip) > 0.0 && slope <= 0.0) {
      e = -slip.normalized();
      continue;
    }
    if (slope == 0.0) break;
    const double step = std::clamp(-off / slope, -1.0, 1.0);
    e = (e + step * across).normalized();
    if (std::abs(step) <= 1e-7) break;
  }
  normal = -free[0] / (a(0, 0) + mu * (a(0, 1) * e[0] + a(0, 2) * e[1]));
  return {normal, mu * normal * e[0], mu * normal * e[1]};
}

/// μ of a contact at a force and at what it has moved.
double ConeLaw::friction_of(std::size_t i, const Vector3d& force, const Vector3d& moved) const {
  return friction_ ? (*friction_)(i, moved.tail<2>().norm(), force[0]) : local_[i].friction;
}

/// The same where the coefficient follows the slip and the force: μ less that of its own force and
/// slip is below 0 at 0 and above 0 far out, and regula falsi finds where it vanishes.
Vector3d ConeLaw::solve_sliding(std::size_t i, const Vector3d& free) {
  Local& l = local_[i];
  if (free[0] >= 0.0) return Vector3d::Zero();
  Vector3d force;
  const auto beyond = [&](double mu) {
    force = solve_one(l, mu, free);
    return mu - friction_of(i, force, free + l.own * force);
  };
  double low = l.friction, at_low = beyond(low);
  const auto settled = [](double missed) { return std::abs(missed) <= 1e-10; };
  double high = low, at_high = at_low;
  for (int turn = 0; turn < most_secants && at_high < 0.0; ++turn) {
    low = high, at_low = at_high;
    high += -2.0 * at_high;
    at_high = beyond(high);
  }
  if (at_low > 0.0) low = 0.0, at_low = beyond(0.0);
  double mu = high;
  double missed = at_high;
  for (int turn = 0; turn < most_secants && !settled(missed) && high > low; ++turn) {
    mu = (low * at_high - high * at_low) / (at_high - at_low);
    missed = beyond(mu);
    if (missed < 0.0) {
      low = mu, at_low = missed, at_high *= 0.5;
    } else {
      high = mu, at_high = missed, at_low *= 0.5;
    }
  }
  l.friction = mu;
  return force;
}

/// Solves the contacts one after the other. @return the largest change of a force
double ConeLaw::sweep(std::span<const ConeContact> contacts, const WindowCompliance& w) {
  double largest = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Local& l = local_[i];
    const Vector3d free = moved_of(contacts[i]) - l.own * l.force;
    const Vector3d force = friction_ ? solve_sliding(i, free) : solve_one(l, l.friction, free);
    const Vector3d change = force - l.force;
    const double square = change.squaredNorm();
    if (square == 0.0) continue;
    largest = std::max(largest, square);
    push(contacts[i], w, change);
    l.force = force;
  }
  return std::sqrt(largest);
}

/// Forces, what they do in the window, and the accelerations of the rim, one after the other.
void ConeLaw::pack(VectorXd& to) const noexcept {
  const Index n = n_forces();
  for (std::size_t i = 0; i < local_.size(); ++i)
    to.segment<3>(Index{3} * static_cast<Index>(i)) = local_[i].force;
  std::ranges::copy(moved_, to.data() + n);
  to.segment<3>(n + rows_) = rim_;
}

void ConeLaw::unpack(const VectorXd& from) noexcept {
  const Index n = n_forces();
  for (std::size_t i = 0; i < local_.size(); ++i)
    local_[i].force = from.segment<3>(Index{3} * static_cast<Index>(i));
  std::copy_n(from.data() + n, moved_.size(), moved_.data());
  rim_ = from.segment<3>(n + rows_);
}

/// Anderson's mixing of the sweeps so far: forces that would change least in a sweep, were it
/// linear.
void ConeLaw::mix() {
  const Index n = n_forces(), all = n + rows_ + 3;
  const auto change = change_.head(n);
  const double size = change.norm();
  if (size > 1.5 * size_before_) {
    kept_ = 0;
  } else {
    const Index column = kept_ < depth ? kept_ : oldest_;
    if (kept_ < depth)
      ++kept_;
    else
      oldest_ = (oldest_ + 1) % depth;
    changes_.col(column).head(n) = change - change_before_.head(n);
    results_.col(column).head(all) = after_.head(all) - after_before_.head(all);
  }
  change_before_.head(n) = change;
  after_before_.head(all) = after_.head(all);
  size_before_ = size;
  if (kept_ == 0) {
    oldest_ = 0;
    return;
  }
  using Small = Eigen::Matrix<double, depth, depth>;
  Small normal = Small::Identity();
  Eigen::Matrix<double, depth, 1> right = Eigen::Matrix<double, depth, 1>::Zero();
  for (Index i = 0; i < kept_; ++i) {
    const auto di = changes_.col(i).head(n);
    for (Index j = 0; j <= i; ++j) normal(i, j) = normal(j, i) = di.dot(changes_.col(j).head(n));
    normal(i, i) = normal(i, i) > 0.0 ? normal(i, i) * (1.0 + 1e-10) : 1.0;
    right[i] = di.dot(change);
  }
  const Eigen::Matrix<double, depth, 1> share = normal.ldlt().solve(right);
  if (!share.allFinite() || share.cwiseAbs().sum() >= 20.0) {
    kept_ = oldest_ = 0;
    return;
  }
  for (Index j = 0; j < kept_; ++j) after_.head(all) -= share[j] * results_.col(j).head(all);
  unpack(after_);
}

/// Sweeps until no force changes by more than a share of the largest.
void ConeLaw::iterate(std::span<const ConeContact> contacts, const WindowCompliance& w, double goal,
                      Report& report) {
  const Index n = n_forces();
  kept_ = oldest_ = 0;
  size_before_ = 0.0;
  while (report.sweeps < most_sweeps) {
    pack(before_);
    const double largest = sweep(contacts, w);
    ++report.sweeps;
    double force = 0.0;
    for (const Local& l : local_) force = std::max(force, l.force[0]);
    if (largest <= goal * force) return;
    pack(after_);
    change_.head(n) = after_.head(n) - before_.head(n);
    mix();
  }
}

double ConeLaw::residual(std::span<const ConeContact> contacts) const {
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ConeContact& c = contacts[i];
    const Vector3d& force = local_[i].force;
    const Vector3d moved = moved_of(c);
    const double missed = contact::law_residual(plain(force), plain(moved), 0.0,
                                                friction_of(i, force, moved), 1.0 / mean_);
    if (!(missed <= worst)) worst = missed;  // also not a number
    largest = std::max({largest, std::abs(force[0]), -c.free.x / mean_});
  }
  return largest > 0.0 ? worst / largest : worst;
}

/// Newton's method on the normal maps of all contacts, from the forces at hand. False: it does not
/// come to the tolerance.
bool ConeLaw::newton(std::span<const ConeContact> contacts, const WindowCompliance& w) {
  const Index n = n_forces();
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
      const Vector3d &r = local_[i].force, u = moved_of(contacts[i]), s = r - rho * u;
      const double mu = local_[i].friction = friction_of(i, r, u);
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
  rows_ = rows;
  prepare(contacts, w);
  multiply(contacts, w);
  if (contacts.empty()) return report;
  double goal = 0.5 * tolerance_;
  for (report.residual = residual(contacts);
       report.residual > tolerance_ && report.sweeps < most_sweeps; goal *= 0.25) {
    iterate(contacts, w, goal, report);
    multiply(contacts, w);
    report.residual = residual(contacts);
  }
  if (report.residual > tolerance_) {
    report.by_newton = true;
    newton(contacts, w);
    report.residual = residual(contacts);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) finish(i, contacts[i]);
  return report;
}

/// Tells a contact its force, what it does, and its status.
void ConeLaw::finish(std::size_t i, ConeContact& c) const {
  const Vector3d& force = local_[i].force;
  const Vector3d moved = moved_of(c);
  c.force = plain(force);
  c.moved = plain(moved);
  c.status = Status::open;
  if (force[0] <= 0.0) return;
  c.friction = friction_of(i, force, moved);
  const double most = c.friction * force[0];
  c.status = force.tail<2>().norm() < most * (1.0 - 1e-9) ? Status::stick : Status::slip;
}

}  // namespace rondo::rom
