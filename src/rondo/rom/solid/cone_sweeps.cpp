// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/cone_sweeps.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "rondo/core/index.hpp"

namespace rondo::rom {

using Eigen::Index, Eigen::Vector3d, Eigen::VectorXd;

void ConeSweeps::begin(std::span<const ConeContact> contacts, std::span<const ConeLocal> all,
                       const WindowCompliance& w, double gap, const ConeFriction* friction) {
  friction_ = friction;
  members_.clear();
  has_rim_ = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ConeLocal& l = all[i];
    if (l.force.isZero(0.0) && l.moved[0] >= gap) continue;
    members_.push_back({i, l.force, l.moved - l.own * l.force});
    for (const Vec3& lift : contacts[i].lift) has_rim_ |= lift != Vec3{};
  }
  gather(contacts, w);
  rim_.setZero();
  forget();
  size_before_ = 0.0;
  const Index n = n_forces();
  if (n <= before_.size()) return;
  const Index room = n + n / 2;
  for (VectorXd* v : {&before_, &after_, &change_, &change_before_, &after_before_})
    v->resize(room);
  changes_.resize(room, depth);
  results_.resize(room, depth);
}

/// Rows and columns of the members, one after the other. Members at places one after the other
/// are copied at once.
void ConeSweeps::gather(std::span<const ConeContact> contacts, const WindowCompliance& w) {
  runs_.clear();
  for (const Member& m : members_) {
    const int place = contacts[m.contact].place;
    if (runs_.empty() || runs_.back().place + runs_.back().count != place)
      runs_.push_back({place, 0});
    ++runs_.back().count;
  }
  const Index n = n_forces();
  stride_ = (n + kernels::cone_lanes - 1) / kernels::cone_lanes * kernels::cone_lanes;
  shift_.assign(at(stride_), 0.0F);
  if (const std::size_t size = at(n * stride_); rows_.size() < size) rows_.resize(size + size / 2);
  float* row = rows_.data();
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const Index place = contacts[members_[m].contact].place;
    for (Index r = 0; r < 3; ++r, row += stride_) {
      const float* from = w.rounded(3 * place + r);
      float* to = row;
      for (const Run& run : runs_)
        to = std::copy_n(from + std::ptrdiff_t{3} * run.place, 3 * run.count, to);
      std::fill(to, row + stride_, 0.0F);
      std::fill_n(row + 3 * m, 3, 0.0F);
    }
  }
}

/// Tells the products how far a force is from that of the beginning.
void ConeSweeps::shift(std::size_t m, const ConeContact& c, const ConeLocal& l) noexcept {
  const Vec3 changed = turned_back(c, l.force - members_[m].start);
  shift_[3 * m] = static_cast<float>(changed.x);
  shift_[3 * m + 1] = static_cast<float>(changed.y);
  shift_[3 * m + 2] = static_cast<float>(changed.z);
}

/// Solves the contacts one after the other. @return the largest change of a force
double ConeSweeps::sweep(std::span<const ConeContact> contacts, std::span<ConeLocal> all) {
  double largest = 0.0;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const Member& member = members_[m];
    const ConeContact& c = contacts[member.contact];
    ConeLocal& l = all[member.contact];
    float sums[3];
    table_.sums(rows_.data() + 3 * m * at(stride_), stride_, shift_.data(), stride_, sums);
    Vector3d free = member.base + along(c, sums);
    if (has_rim_)
      for (Index k = 0; k < 3; ++k)
        free += (rim_[k] - vector_of(c.reply[at(k)]).dot(l.force - member.start)) *
                vector_of(c.lift[at(k)]);
    const Vector3d force = friction_ ? solve_following(*friction_, member.contact, l, free)
                                     : solve_alone(l, l.friction, free);
    const Vector3d change = force - l.force;
    const double square = change.squaredNorm();
    if (square == 0.0) continue;
    largest = std::max(largest, square);
    l.force = force;
    shift(m, c, l);
    if (has_rim_)
      for (Index k = 0; k < 3; ++k) rim_[k] += vector_of(c.reply[at(k)]).dot(change);
  }
  return std::sqrt(largest);
}

void ConeSweeps::pack(std::span<const ConeLocal> all, VectorXd& to) const noexcept {
  for (std::size_t m = 0; m < members_.size(); ++m)
    to.segment<3>(static_cast<Index>(3 * m)) = all[members_[m].contact].force;
}

/// The forces that the mixing found.
void ConeSweeps::take_mixed(std::span<const ConeContact> contacts,
                            std::span<ConeLocal> all) noexcept {
  rim_.setZero();
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const ConeContact& c = contacts[members_[m].contact];
    ConeLocal& l = all[members_[m].contact];
    l.force = after_.segment<3>(static_cast<Index>(3 * m));
    shift(m, c, l);
    if (has_rim_)
      for (Index k = 0; k < 3; ++k)
        rim_[k] += vector_of(c.reply[at(k)]).dot(l.force - members_[m].start);
  }
}

/// Forces that would change least in a sweep, were it linear, from the sweeps so far.
void ConeSweeps::mix() {
  const Index n = n_forces();
  const auto change = change_.head(n), after = after_.head(n);
  const double size = change.norm();
  if (size > 1.5 * size_before_) {
    forget();
  } else {
    const Index column = kept_ < depth ? kept_ : oldest_;
    if (kept_ < depth)
      ++kept_;
    else
      oldest_ = (oldest_ + 1) % depth;
    changes_.col(column).head(n) = change - change_before_.head(n);
    results_.col(column).head(n) = after - after_before_.head(n);
    for (Index j = 0; j < kept_; ++j)
      products_(column, j) = products_(j, column) =
          changes_.col(column).head(n).dot(changes_.col(j).head(n));
  }
  change_before_.head(n) = change;
  after_before_.head(n) = after;
  size_before_ = size;
  if (kept_ == 0) return;
  Eigen::Matrix<double, depth, depth> normal = decltype(normal)::Identity();
  Eigen::Matrix<double, depth, 1> right = decltype(right)::Zero();
  normal.topLeftCorner(kept_, kept_) = products_.topLeftCorner(kept_, kept_);
  for (Index i = 0; i < kept_; ++i) {
    normal(i, i) = normal(i, i) > 0.0 ? normal(i, i) * (1.0 + 1e-10) : 1.0;
    right[i] = changes_.col(i).head(n).dot(change);
  }
  const Eigen::Matrix<double, depth, 1> share = normal.ldlt().solve(right);
  if (!share.allFinite() || share.cwiseAbs().sum() >= 20.0) {
    forget();
    return;
  }
  for (Index j = 0; j < kept_; ++j) after_.head(n) -= share[j] * results_.col(j).head(n);
}

int ConeSweeps::iterate(std::span<const ConeContact> contacts, std::span<ConeLocal> all,
                        double share, int most) {
  const Index n = n_forces();
  for (int sweeps = 1;; ++sweeps) {
    pack(all, before_);
    const double largest = sweep(contacts, all);
    double force = 0.0;
    for (const Member& m : members_) force = std::max(force, all[m.contact].force[0]);
    if (largest <= share * force || sweeps >= most) return sweeps;
    pack(all, after_);
    change_.head(n) = after_.head(n) - before_.head(n);
    mix();
    take_mixed(contacts, all);
  }
}

}  // namespace rondo::rom
