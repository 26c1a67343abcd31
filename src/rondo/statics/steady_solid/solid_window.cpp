// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady_solid/solid_window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rondo::statics {
namespace {

using Eigen::Index;

Vec3 times(const Eigen::Matrix3d& m, const Vec3& v) noexcept {
  const Eigen::Vector3d p = m * Eigen::Vector3d{v.x, v.y, v.z};
  return {p[0], p[1], p[2]};
}

/// J₃ a.
Vec3 across(Vec3 a) noexcept {
  return {-a.y, a.x, 0.0};
}

}  // namespace

SolidWindow::SolidWindow(const SolidHarmonics& harmonics, SlipDifference slip, double camber,
                         double gravity)
    : harmonics_(harmonics),
      gravity_{gravity * std::cos(camber), gravity * std::sin(camber)},
      weights_(slip == SlipDifference::upwind ? std::vector{1.0, -1.0}
                                              : std::vector{1.5, -2.0, 0.5}),
      back_(harmonics.body().spin < 0.0 ? 1 : -1),
      turn_(-back_ * 2.0 * std::numbers::pi / harmonics.turn()),
      included_(harmonics.n_candidates(),
                std::vector<char>(static_cast<std::size_t>(harmonics.turn()))) {
  problem_.ground = GroundFrame(camber);
  problem_.time = turn_ / harmonics.body().spin;
  problem_.pass = harmonics.body().samples;
  problem_.base_weight = gravity_.down * gravity_.down * harmonics.weight_torque();
  for (int m = 0; m < harmonics.turn(); ++m)
    frames_.push_back(rotation(2.0 * std::numbers::pi * m / harmonics.turn()));
}

std::size_t SolidWindow::wrapped(int sample) const noexcept {
  const int turn = harmonics_.turn();
  return static_cast<std::size_t>((sample % turn + turn) % turn);
}

Complex SolidWindow::frame(int sample) const noexcept {
  return frames_[wrapped(sample)];
}

Vec3 SolidWindow::free_place(const RollingPair& p) const noexcept {
  const Vec3 x =
      harmonics_.reference(p.candidate) + harmonics_.displacement(p.candidate, p.sample, gravity_);
  return problem_.ground.to_ground(frame(p.sample) * x);
}

double SolidWindow::lowest() const noexcept {
  double least = 0.0;
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a)
    least = std::max(least, -free_place({a, 0}).x);
  return least;
}

/// The way is that of the turn, exactly, and of the displacement by its difference.
void SolidWindow::fill_base(Index at) {
  const RollingPair& p = problem_.pairs[static_cast<std::size_t>(at)];
  Vec3 u, way;
  for (std::size_t j = weights_.size(); j-- > 0;) {
    u = harmonics_.displacement(p.candidate, p.sample + back_ * static_cast<int>(j), gravity_);
    way += weights_[j] * u;
  }
  const Vec3 x = harmonics_.reference(p.candidate) + u;
  const Complex turn = frame(p.sample);
  const Vec3 place = problem_.ground.to_ground(turn * x);
  way = problem_.ground.to_ground(turn * (way + turn_ * across(x)));
  problem_.base.segment<3>(3 * at) << place.x, way.y, way.z;
  problem_.base_place.segment<2>(2 * at) << place.y, place.z;
  const Vec3 by = problem_.ground.to_ground(
      turn * (gravity_.down * harmonics_.weight_torque(p.candidate, p.sample)));
  problem_.weight.segment<3>(3 * at) << by.x, by.y, by.z;
}

/// All columns of a pair's forces, from a row on.
void SolidWindow::fill_column(Index of, Index from) {
  const GroundFrame& g = problem_.ground;
  const RollingPair& pair = problem_.pairs[static_cast<std::size_t>(of)];
  const Complex back = conj(frame(pair.sample));
  const std::array forces{back * g.normal, back * g.heading, back * g.lateral};
  for (Index p = from; p < std::ssize(problem_.pairs); ++p) {
    const RollingPair& row = problem_.pairs[static_cast<std::size_t>(p)];
    const int ahead = row.sample - pair.sample;
    const Complex to = frame(row.sample);
    const Eigen::Matrix3d moved = harmonics_.compliance(row.candidate, pair.candidate, ahead);
    Eigen::Matrix3d differed = weights_[0] * moved;
    for (std::size_t j = 1; j < weights_.size(); ++j)
      differed += weights_[j] * harmonics_.compliance(row.candidate, pair.candidate,
                                                      ahead + back_ * static_cast<int>(j));
    for (std::size_t c = 0; c < 3; ++c) {
      const Index column = 3 * of + static_cast<Index>(c);
      const Vec3 u = times(moved, forces[c]);
      const Vec3 place = g.to_ground(to * u);
      const Vec3 way = g.to_ground(to * (times(differed, forces[c]) + turn_ * across(u)));
      problem_.matrix.col(column).segment<3>(3 * p) << place.x, way.y, way.z;
      problem_.matrix_place.col(column).segment<2>(2 * p) << place.y, place.z;
    }
  }
}

void SolidWindow::include(const std::vector<RollingPair>& pairs) {
  const Index before = std::ssize(problem_.pairs);
  for (const RollingPair& p : pairs) {
    char& in = included_[p.candidate][wrapped(p.sample)];
    if (!in) problem_.pairs.push_back(p);
    in = 1;
  }
  const Index n = std::ssize(problem_.pairs);
  problem_.base.conservativeResize(3 * n);
  problem_.base_place.conservativeResize(2 * n);
  problem_.weight.conservativeResize(3 * n);
  problem_.matrix.conservativeResize(3 * n, 3 * n);
  problem_.matrix_place.conservativeResize(2 * n, 3 * n);
  for (Index p = before; p < n; ++p) fill_base(p);
#pragma omp parallel for num_threads(harmonics_.body().threads) schedule(static)
  for (Index q = 0; q < n; ++q) fill_column(q, q < before ? before : 0);
}

void SolidWindow::include_below(double height) {
  const int quarter = harmonics_.turn() / 4;
  std::vector<RollingPair> pairs;
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a) {
    int low = quarter + 1, high = -low;
    for (int m = -quarter; m <= quarter; ++m)
      if (height + free_place({a, m}).x <= 0.0) low = std::min(low, m), high = std::max(high, m);
    for (int m = low - 1; low <= high && m <= high + 1; ++m) pairs.push_back({a, m});
  }
  include(pairs);
}

bool SolidWindow::include_touching(double height, const Eigen::VectorXd& force) {
  const double smallest = 1e-12 * norm(harmonics_.reference(0));
  std::vector<RollingPair> touching, missing;
  std::vector<Vec3> forces;  // in the frames of their sectors
  int low = harmonics_.turn(), high = -low;
  for (std::size_t q = 0; q < problem_.pairs.size(); ++q) {
    const RollingPair& p = problem_.pairs[q];
    low = std::min(low, p.sample), high = std::max(high, p.sample);
    const Eigen::Vector3d f = force.segment<3>(static_cast<Index>(3 * q));
    if (f.isZero(0.0)) continue;
    touching.push_back(p);
    forces.push_back(conj(frame(p.sample)) * problem_.ground.to_wheel({f[0], f[1], f[2]}));
  }
  const auto gap = [&](const RollingPair& p) {
    Vec3 u;
    for (std::size_t q = 0; q < touching.size(); ++q)
      u += times(
          harmonics_.compliance(p.candidate, touching[q].candidate, p.sample - touching[q].sample),
          forces[q]);
    return height + free_place(p).x + dot(frame(p.sample) * u, problem_.ground.normal);
  };
  const int beyond = std::max(2, (high - low) / 4);
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a)
    for (int m = low - beyond; m <= high + beyond; ++m)
      if (!included_[a][wrapped(m)] && gap({a, m}) < -smallest) missing.push_back({a, m});
  include(missing);
  return !missing.empty();
}

}  // namespace rondo::statics
