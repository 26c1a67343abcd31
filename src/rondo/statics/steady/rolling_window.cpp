// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/statics/steady/rolling_transient.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;

template <int D>
NodeMatrix<D> rotation_matrix(Complex r) noexcept {
  NodeMatrix<D> m = NodeMatrix<D>::Identity();
  m.template topLeftCorner<2, 2>() << r.re, -r.im, r.im, r.re;
  return m;
}

std::vector<double> weights_of(SlipDifference slip) {
  if (slip == SlipDifference::standing) return {1.0};
  if (slip == SlipDifference::upwind || slip == SlipDifference::transient) return {1.0, -1.0};
  return {1.5, -2.0, 0.5};
}

}  // namespace

template <int D>
RollingWindow<D>::RollingWindow(const RollingHarmonics<D>& harmonics, SlipDifference slip,
                                double camber, double gravity)
    : harmonics_(harmonics),
      gravity_{gravity * std::cos(camber), gravity * std::sin(camber)},
      weights_(weights_of(slip)),
      n_now_(slip == SlipDifference::transient ? 1 : weights_.size()),
      included_(harmonics.n_candidates(),
                std::vector<char>(static_cast<std::size_t>(harmonics.turn()))) {
  const bool stands = slip == SlipDifference::standing;
  RONDO_DEMAND(stands == (harmonics.body().spin == 0.0) &&
                   (D == 3 || (!stands && slip != SlipDifference::transient)),
               harmonics.body().spin);
  const double spin = harmonics.body().spin, sample = 2.0 * std::numbers::pi / harmonics.turn();
  problem_.lean = rotation(camber);
  problem_.time = stands ? 1.0 : 2.0 * std::numbers::pi / (harmonics.turn() * std::abs(spin));
  problem_.pass = harmonics.body().samples;
  problem_.back = spin < 0.0 ? 1 : -1;
  problem_.base_weight = gravity_.down * gravity_.down * harmonics.weight_torque();
  turn_ = stands ? 0.0 : -problem_.back * sample;
  if (stands) origin_.setZero(static_cast<Index>(D * harmonics.n_candidates()), harmonics.turn());
  const NodeMatrix<D> ground = ground_axes<D>(problem_.lean).transpose();
  for (int m = 0; m < harmonics.turn(); ++m) {
    frames_.push_back(rotation(2.0 * std::numbers::pi * m / harmonics.turn()));
    to_ground_.push_back(ground * rotation_matrix<D>(frames_.back()));
  }
  if constexpr (D == 2) find_kernels();
}

template <int D>
void RollingWindow<D>::find_kernels() {
  const std::size_t n = harmonics_.n_candidates();
  auto kernels = std::make_shared<std::vector<Kernel>>();
  kernels->reserve(n * n * frames_.size());
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b)
      for (int ahead = 0; ahead < harmonics_.turn(); ++ahead)
        kernels->push_back(kernel(a, b, ahead));
  kernels_ = std::move(kernels);
}

template <int D>
typename RollingWindow<D>::Kernel RollingWindow<D>::kernel(std::size_t a, std::size_t b,
                                                           int ahead) const noexcept {
  Kernel k{harmonics_.compliance(a, b, ahead), NodeMatrix<D>::Zero()};
  for (std::size_t j = 0; j < n_now_; ++j) {
    const int by = problem_.back * static_cast<int>(j);
    const NodeMatrix<D> moved = harmonics_.compliance(a, b, ahead + by);
    if constexpr (D == 2)
      k.slipped += weights_[j] * rotation_matrix<D>(frame(by)) * moved;
    else
      k.slipped += weights_[j] * moved;
  }
  if constexpr (D == 3) {
    k.slipped.row(0) -= turn_ * k.moved.row(1);
    k.slipped.row(1) += turn_ * k.moved.row(0);
  }
  return k;
}

template <int D>
typename RollingWindow<D>::Kernel RollingWindow<D>::kernel(const RollingPair& of,
                                                           const RollingPair& by) const noexcept {
  const int ahead = of.sample - by.sample;
  if constexpr (D == 3) return kernel(of.candidate, by.candidate, ahead);
  const std::size_t n = harmonics_.n_candidates();
  return (
      *kernels_)[(of.candidate * n + by.candidate) * frames_.size() + harmonics_.wrapped(ahead)];
}

template <int D>
void RollingWindow<D>::add_softness(const RollingPair& of, const RollingPair& by, Kernel& k) const {
  const NodeMatrix<D> moved = softness_(of, by);
  k.moved += moved;
  for (std::size_t j = 0; j < weights_.size(); ++j)
    k.slipped += weights_[j] *
                 softness_({of.candidate, of.sample + problem_.back * static_cast<int>(j)}, by);
  k.slipped.row(0) -= turn_ * moved.row(1);
  k.slipped.row(1) += turn_ * moved.row(0);
}

/// Without contact, in the frame of the pair's sector.
template <int D>
NodeVector<D> RollingWindow<D>::free_displacement(const RollingPair& p) const noexcept {
  NodeVector<D> u = harmonics_.displacement(p.candidate, p.sample, gravity_);
  if (more_.size() > 0)
    u += more_.block<D, 1>(static_cast<Index>(D * p.candidate),
                           static_cast<Index>(harmonics_.wrapped(p.sample)));
  return u;
}

/// From the center, along n, t1 and t2.
template <int D>
NodeVector<D> RollingWindow<D>::free_place(const RollingPair& p) const noexcept {
  return to_ground(p.sample) * (harmonics_.reference(p.candidate) + free_displacement(p));
}

template <int D>
NodeVector<D> RollingWindow<D>::way_from_origin(const RollingPair& p) const noexcept {
  return to_ground(p.sample) *
         (free_displacement(p) -
          origin_.block<D, 1>(static_cast<Index>(D * p.candidate),
                              static_cast<Index>(harmonics_.wrapped(p.sample))));
}

/// What of it is along n has no meaning.
template <int D>
NodeVector<D> RollingWindow<D>::free_way(const RollingPair& p) const noexcept {
  if (origin_.size() > 0) return way_from_origin(p);
  NodeVector<D> way = NodeVector<D>::Zero();
  for (std::size_t j = 0; j < weights_.size(); ++j) {
    const int sample = p.sample + problem_.back * static_cast<int>(j);
    if constexpr (D == 2)
      way += weights_[j] * free_place({p.candidate, sample});
    else
      way += weights_[j] * free_displacement({p.candidate, sample});
  }
  if constexpr (D == 2) return way;
  const NodeVector<D> x = harmonics_.reference(p.candidate) + free_displacement(p);
  return to_ground(p.sample) * (way + turn_ * quarter_turned<D>(x));
}

template <int D>
void RollingWindow<D>::roll_on_from(Eigen::VectorXd force) {
  RONDO_DEMAND(is_transient() && force.size() <= problem_.size(), force.size());
  force.conservativeResizeLike(Eigen::VectorXd::Zero(problem_.size()));
  statics::roll_on_from(problem_, force);
}

template <int D>
double RollingWindow<D>::lowest() const noexcept {
  double least = 0.0;
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a) {
    const NodeVector<D> place =
        to_ground(0) * (harmonics_.reference(a) + harmonics_.displacement(a, 0, gravity_));
    least = std::max(least, D == 2 ? norm(Vec2{place[0], place[1]}) : -place[0]);
  }
  return least;
}

template <int D>
void RollingWindow<D>::count_from(Eigen::MatrixXd displacement) {
  RONDO_DEMAND(origin_.size() > 0 && displacement.size() == origin_.size(), displacement.size());
  origin_ = std::move(displacement);
  fill_bases();
}

/// The torque of the weight is minus its power over s; that of a standing body is not found.
template <int D>
void RollingWindow<D>::take_response(Eigen::MatrixXcd spectrum) {
  response_ = std::move(spectrum);
  problem_.base_weight = gravity_.down * gravity_.down * harmonics_.weight_torque();
  if (const double spin = harmonics_.body().spin; spin != 0.0)
    problem_.base_weight -= harmonics_.weight(response_, gravity_) / spin;
  foresee_nothing();
}

template <int D>
void RollingWindow<D>::foresee_nothing() {
  more_ = harmonics_.fields(harmonics_.on_candidates(response_), 0.0, false);
  fill_bases();
}

template <int D>
void RollingWindow<D>::fill_bases() {
  for (Index p = 0; p < std::ssize(problem_.pairs); ++p) fill_base(p);
}

template <int D>
void RollingWindow<D>::soften(Softness softness) {
  RONDO_DEMAND(D == 3 && !is_transient());
  softness_ = std::move(softness);
  if (response_.size() > 0) foresee_nothing();
  fill_columns(0);
}

template <int D>
void RollingWindow<D>::foresee(const Eigen::VectorXd& force, const Eigen::MatrixXd& more) {
  RONDO_DEMAND(force.size() == problem_.size() && more_.size() > 0, force.size());
  std::vector<std::pair<RollingPair, NodeVector<D>>> forces;  // in the frames of their sectors
  int low = harmonics_.turn(), high = -low;
  for (std::size_t q = 0; q < problem_.pairs.size(); ++q) {
    const RollingPair& p = problem_.pairs[q];
    low = std::min(low, p.sample), high = std::max(high, p.sample);
    const NodeVector<D> f = force.segment<D>(static_cast<Index>(D * q));
    if (!f.isZero(0.0)) forces.emplace_back(p, to_ground(p.sample).transpose() * f);
  }
  const int before = static_cast<int>(weights_.size());  // samples that the ways of a pair take in
  const int first = low - before, last = std::min(high + before, first + harmonics_.turn() - 1);
  more_ += harmonics_.on_candidates(more);
#pragma omp parallel for num_threads(harmonics_.body().threads) schedule(static)
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a) {
    const auto row = static_cast<Index>(D * a);
    for (int m = first; m <= last; ++m)
      for (const auto& [pair, f] : forces)
        more_.block<D, 1>(row, static_cast<Index>(harmonics_.wrapped(m))) -=
            softness_({a, m}, pair) * f;
  }
  fill_bases();
}

template <int D>
void RollingWindow<D>::fill_base(Index at) {
  const RollingPair& p = problem_.pairs[static_cast<std::size_t>(at)];
  const NodeVector<D> place = free_place(p), way = free_way(p);
  problem_.base.template segment<D>(D * at) << place[0], way.template tail<D - 1>();
  problem_.base_place.template segment<D - 1>((D - 1) * at) = place.template tail<D - 1>();
  problem_.weight.template segment<D>(D * at) =
      to_ground(p.sample) * (gravity_.down * harmonics_.weight_torque(p.candidate, p.sample));
  if (is_transient())
    problem_.base.template segment<D>(D * at) -=
        problem_.upstream.template middleRows<D>(D * at) * problem_.before;
}

/// All columns of a pair's forces, from a row on.
template <int D>
void RollingWindow<D>::fill_column(Index of, Index from) {
  const RollingPair& pair = problem_.pairs[static_cast<std::size_t>(of)];
  const NodeMatrix<D> forces = to_ground(pair.sample).transpose();
  for (Index p = from; p < std::ssize(problem_.pairs); ++p) {
    const RollingPair& row = problem_.pairs[static_cast<std::size_t>(p)];
    Kernel k = kernel(row, pair);
    if (softness_) add_softness(row, pair, k);
    const NodeMatrix<D>& to = to_ground(row.sample);
    const NodeMatrix<D> u = to * (k.moved * forces).eval(), way = to * (k.slipped * forces).eval();
    auto here = problem_.matrix.template block<D, D>(D * p, D * of);
    here.row(0) = u.row(0);
    here.template bottomRows<D - 1>() = way.template bottomRows<D - 1>();
    problem_.matrix_place.template block<D - 1, D>((D - 1) * p, D * of) =
        u.template bottomRows<D - 1>();
  }
  if (is_transient()) fill_upstream(of, from);
}

/// What of the ways is by forces of the step before.
template <int D>
void RollingWindow<D>::fill_upstream(Index of, Index from) {
  const RollingPair& pair = problem_.pairs[static_cast<std::size_t>(of)];
  const NodeMatrix<D> forces = to_ground(pair.sample).transpose();
  for (Index p = from; p < std::ssize(problem_.pairs); ++p) {
    const RollingPair& row = problem_.pairs[static_cast<std::size_t>(p)];
    const int ahead = row.sample - pair.sample + problem_.back;
    const NodeMatrix<D> u = harmonics_.compliance(row.candidate, pair.candidate, ahead);
    auto here = problem_.upstream.template block<D, D>(D * p, D * of);
    here = -weights_[1] * (to_ground(row.sample) * u * forces);
    here.row(0).setZero();
  }
}

template <int D>
void RollingWindow<D>::include(const std::vector<RollingPair>& pairs) {
  const Index before = std::ssize(problem_.pairs);
  for (const RollingPair& p : pairs) {
    char& in = included_[p.candidate][harmonics_.wrapped(p.sample)];
    if (!in) problem_.pairs.push_back(p);
    in = 1;
  }
  const Index n = std::ssize(problem_.pairs);
  problem_.base.conservativeResize(D * n);
  problem_.base_place.conservativeResize((D - 1) * n);
  problem_.weight.conservativeResize(D * n);
  problem_.matrix.conservativeResize(D * n, D * n);
  problem_.matrix_place.conservativeResize((D - 1) * n, D * n);
  if (is_transient()) {
    problem_.upstream.conservativeResize(D * n, D * n);
    problem_.before.conservativeResizeLike(Eigen::VectorXd::Zero(D * n));
  }
  fill_columns(before);
  for (Index p = before; p < n; ++p) fill_base(p);
}

/// Those of pairs so far and what pairs from one on add.
template <int D>
void RollingWindow<D>::fill_columns(Index from) {
#pragma omp parallel for num_threads(harmonics_.body().threads) schedule(static)
  for (Index q = 0; q < std::ssize(problem_.pairs); ++q) fill_column(q, q < from ? from : 0);
}

template <int D>
void RollingWindow<D>::include_below(double height) {
  const int quarter = harmonics_.turn() / 4;
  std::vector<RollingPair> pairs;
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a) {
    int low = quarter + 1, high = -low;
    for (int m = -quarter; m <= quarter; ++m)
      if (height + free_place({a, m})[0] <= 0.0) low = std::min(low, m), high = std::max(high, m);
    for (int m = low - 1; low <= high && m <= high + 1; ++m) pairs.push_back({a, m});
  }
  include(pairs);
}

template <int D>
bool RollingWindow<D>::include_touching(double height, const Eigen::VectorXd& force) {
  const double smallest = 1e-12 * harmonics_.reference(0).norm();
  std::vector<RollingPair> touching, missing;
  std::vector<NodeVector<D>> forces;  // in the frames of their sectors
  int low = harmonics_.turn(), high = -low;
  for (std::size_t q = 0; q < problem_.pairs.size(); ++q) {
    const RollingPair& p = problem_.pairs[q];
    low = std::min(low, p.sample), high = std::max(high, p.sample);
    const NodeVector<D> f = force.segment<D>(static_cast<Index>(D * q));
    if (f.isZero(0.0)) continue;
    touching.push_back(p);
    forces.push_back(to_ground(p.sample).transpose() * f);
  }
  const auto gap = [&](const RollingPair& p) {
    NodeVector<D> u = NodeVector<D>::Zero();
    for (std::size_t q = 0; q < touching.size(); ++q) {
      NodeMatrix<D> moved =
          harmonics_.compliance(p.candidate, touching[q].candidate, p.sample - touching[q].sample);
      if (softness_) moved += softness_(p, touching[q]);
      u += moved * forces[q];
    }
    return height + free_place(p)[0] + to_ground(p.sample).row(0).dot(u);
  };
  const int beyond = std::max(2, (high - low) / (D == 2 ? 2 : 4));
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a)
    for (int m = low - beyond; m <= high + beyond; ++m)
      if (!included_[a][harmonics_.wrapped(m)] && gap({a, m}) < -smallest)
        missing.push_back({a, m});
  include(missing);
  return !missing.empty();
}

template class RollingWindow<2>;
template class RollingWindow<3>;

}  // namespace rondo::statics
