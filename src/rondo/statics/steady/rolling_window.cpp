// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rondo::statics {
namespace {

using Eigen::Index;

int wrapped(int sample, int turn) noexcept {
  return (sample % turn + turn) % turn;
}

/// A column-major 2×2 matrix times a vector.
Vec2 times(const std::array<double, 4>& m, const Vec2& v) noexcept {
  return {m[0] * v.x + m[2] * v.y, m[1] * v.x + m[3] * v.y};
}

}  // namespace

RollingWindow::RollingWindow(const RollingHarmonics& harmonics, SlipDifference slip)
    : harmonics_(harmonics),
      weights_(slip == SlipDifference::upwind ? std::vector{1.0, -1.0}
                                              : std::vector{1.5, -2.0, 0.5}),
      back_(harmonics.body().spin < 0.0 ? 1 : -1),
      included_(harmonics.n_candidates(),
                std::vector<char>(static_cast<std::size_t>(harmonics.turn()))) {
  problem_.time = 2.0 * std::numbers::pi / (harmonics.turn() * std::abs(harmonics.body().spin));
  problem_.pass = harmonics.body().samples;
  problem_.base_weight = harmonics.weight_torque();
  for (int m = 0; m < harmonics.turn(); ++m)
    frames_.push_back(rotation(2.0 * std::numbers::pi * m / harmonics.turn()));
  find_kernels();
}

Complex RollingWindow::frame(int sample) const noexcept {
  return frames_[static_cast<std::size_t>(wrapped(sample, harmonics_.turn()))];
}

/// Of the way: Σ w_j R(j of a sample) C(ahead + j), in the frame of the later sample.
void RollingWindow::find_kernels() {
  const std::size_t n = harmonics_.n_candidates();
  const auto turned = [&](int j) {
    const Complex r = frame(j);
    Eigen::Matrix2d matrix;
    matrix << r.re, -r.im, r.im, r.re;
    return matrix;
  };
  auto kernels = std::make_shared<std::vector<Kernel>>();
  kernels->reserve(n * n * frames_.size());
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b)
      for (int ahead = 0; ahead < harmonics_.turn(); ++ahead) {
        Eigen::Matrix2d way = Eigen::Matrix2d::Zero();
        for (std::size_t j = 0; j < weights_.size(); ++j) {
          const int by = back_ * static_cast<int>(j);
          way += weights_[j] * turned(by) * harmonics_.compliance(a, b, ahead + by);
        }
        Kernel& k = kernels->emplace_back();
        Eigen::Matrix2d::Map(k.moved.data()) = harmonics_.compliance(a, b, ahead);
        Eigen::Matrix2d::Map(k.slipped.data()) = way;
      }
  kernels_ = std::move(kernels);
}

RollingWindow::Place RollingWindow::place(const RollingPair& p) const noexcept {
  const auto x = [&](int m) { return frame(m) * harmonics_.place(p.candidate, m); };
  const Vec2 here = x(p.sample);
  double way = 0.0;
  for (std::size_t j = 0; j < weights_.size(); ++j)
    way += weights_[j] * x(p.sample + back_ * static_cast<int>(j)).x;
  return {here.y, way, here.x};
}

const RollingWindow::Kernel& RollingWindow::kernel(const RollingPair& p,
                                                   const RollingPair& of) const noexcept {
  const std::size_t n = harmonics_.n_candidates(), turn = frames_.size();
  const auto ahead = static_cast<std::size_t>(wrapped(p.sample - of.sample, harmonics_.turn()));
  return (*kernels_)[(p.candidate * n + of.candidate) * turn + ahead];
}

/// Both columns of a pair's forces, from a row on.
void RollingWindow::fill_column(Index of, Index from) {
  const RollingPair& pair = problem_.pairs[static_cast<std::size_t>(of)];
  const Complex back = conj(frame(pair.sample));
  const std::array forces{back * Vec2{0.0, 1.0}, back * Vec2{1.0, 0.0}};
  for (Index p = from; p < std::ssize(problem_.pairs); ++p) {
    const RollingPair& row = problem_.pairs[static_cast<std::size_t>(p)];
    const Kernel& k = kernel(row, pair);
    const Complex to = frame(row.sample);
    for (std::size_t c = 0; c < 2; ++c) {
      const Index column = 2 * of + static_cast<Index>(c);
      const Vec2 u = to * times(k.moved, forces[c]), way = times(k.slipped, forces[c]);
      problem_.matrix(2 * p, column) = u.y;
      problem_.matrix(2 * p + 1, column) = to.re * way.x - to.im * way.y;
      problem_.matrix_x(p, column) = u.x;
    }
  }
}

void RollingWindow::include(const std::vector<RollingPair>& pairs) {
  const auto before = std::ssize(problem_.pairs);
  for (const RollingPair& p : pairs) {
    char& in =
        included_[p.candidate][static_cast<std::size_t>(wrapped(p.sample, harmonics_.turn()))];
    if (!in) problem_.pairs.push_back(p);
    in = 1;
  }
  const Index n = std::ssize(problem_.pairs);
  problem_.base.conservativeResize(2 * n);
  problem_.base_x.conservativeResize(n);
  problem_.weight.conservativeResize(2 * n);
  problem_.matrix.conservativeResize(2 * n, 2 * n);
  problem_.matrix_x.conservativeResize(n, 2 * n);
  for (Index p = before; p < n; ++p) {
    const Place at = place(problem_.pairs[static_cast<std::size_t>(p)]);
    problem_.base.segment<2>(2 * p) << at.gap, at.way;
    problem_.base_x[p] = at.x;
    const RollingPair& pair = problem_.pairs[static_cast<std::size_t>(p)];
    const Vec2 by = frame(pair.sample) * harmonics_.weight_torque(pair.candidate, pair.sample);
    problem_.weight.segment<2>(2 * p) << by.y, by.x;
  }
#pragma omp parallel for num_threads(harmonics_.body().threads) schedule(static)
  for (Index q = 0; q < n; ++q) fill_column(q, q < before ? before : 0);
}

void RollingWindow::include_below(double height) {
  const int quarter = harmonics_.turn() / 4;
  std::vector<RollingPair> pairs;
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a) {
    std::vector<int> inside;
    for (int m = -quarter; m <= quarter; ++m)
      if (height + place({a, m}).gap <= 0.0) inside.push_back(m);
    if (inside.empty()) continue;
    for (int m = inside.front() - 1; m <= inside.back() + 1; ++m) pairs.push_back({a, m});
  }
  include(pairs);
}

bool RollingWindow::include_touching(double height, const Eigen::VectorXd& force) {
  const double smallest = 1e-12 * norm(harmonics_.place(0, 0));
  std::vector<RollingPair> touching, missing;
  std::vector<Vec2> forces;  // in the frames of their sectors
  for (std::size_t q = 0; q < problem_.pairs.size(); ++q) {
    const auto row = static_cast<Index>(2 * q);
    if (force[row] == 0.0 && force[row + 1] == 0.0) continue;
    touching.push_back(problem_.pairs[q]);
    forces.push_back(conj(frame(problem_.pairs[q].sample)) * Vec2{force[row + 1], force[row]});
  }
  const auto gap = [&](const RollingPair& p) {
    Vec2 u;
    for (std::size_t q = 0; q < touching.size(); ++q)
      u += times(kernel(p, touching[q]).moved, forces[q]);
    return height + place(p).gap + (frame(p.sample) * u).y;
  };
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a) {
    int low = harmonics_.turn(), high = -low;
    for (const RollingPair& p : problem_.pairs)
      if (p.candidate == a) low = std::min(low, p.sample), high = std::max(high, p.sample);
    if (high < low) continue;
    const int beyond = std::max(2, (high - low) / 2);
    for (int m = low - beyond; m <= high + beyond; ++m) {
      const bool in = included_[a][static_cast<std::size_t>(wrapped(m, harmonics_.turn()))] != 0;
      if (!in && gap({a, m}) < -smallest) missing.push_back({a, m});
    }
  }
  include(missing);
  return !missing.empty();
}

}  // namespace rondo::statics
