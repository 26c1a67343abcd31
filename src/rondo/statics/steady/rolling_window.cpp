// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rondo::statics {
namespace {

using Eigen::Index;

int wrapped(int sample, int turn) noexcept {
  return (sample % turn + turn) % turn;
}

}  // namespace

RollingWindow::RollingWindow(const RollingHarmonics& harmonics, SlipDifference slip)
    : harmonics_(harmonics),
      weights_(slip == SlipDifference::upwind ? std::vector{1.0, -1.0}
                                              : std::vector{1.5, -2.0, 0.5}),
      back_(harmonics.body().spin < 0.0 ? 1 : -1),
      time_(2.0 * std::numbers::pi / (harmonics.turn() * std::abs(harmonics.body().spin))),
      included_(harmonics.n_candidates(),
                std::vector<char>(static_cast<std::size_t>(harmonics.turn()))) {
  for (int m = 0; m < harmonics.turn(); ++m)
    frames_.push_back(rotation(2.0 * std::numbers::pi * m / harmonics.turn()));
  find_slip_kernels();
}

Complex RollingWindow::frame(int sample) const noexcept {
  return frames_[static_cast<std::size_t>(wrapped(sample, harmonics_.turn()))];
}

/// Of the way: Σ w_j R(j of a sample) C(ahead + j), in the frame of the later sample.
void RollingWindow::find_slip_kernels() {
  const std::size_t n = harmonics_.n_candidates();
  const auto turned = [&](int j) {
    const Complex r = frame(j);
    Eigen::Matrix2d matrix;
    matrix << r.re, -r.im, r.im, r.re;
    return matrix;
  };
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b)
      for (int ahead = 0; ahead < harmonics_.turn(); ++ahead) {
        Eigen::Matrix2d way = Eigen::Matrix2d::Zero();
        for (std::size_t j = 0; j < weights_.size(); ++j) {
          const int by = back_ * static_cast<int>(j);
          way += weights_[j] * turned(by) * harmonics_.compliance(a, b, ahead + by);
        }
        moved_.push_back(harmonics_.compliance(a, b, ahead));
        slipped_.push_back(way);
      }
}

RollingWindow::Place RollingWindow::place(const RollingPair& p) const noexcept {
  const auto x = [&](int m) { return frame(m) * harmonics_.place(p.candidate, m); };
  const Vec2 here = x(p.sample);
  double way = 0.0;
  for (std::size_t j = 0; j < weights_.size(); ++j)
    way += weights_[j] * x(p.sample + back_ * static_cast<int>(j)).x;
  return {here.y, way, here.x};
}

Eigen::Matrix<double, 3, 2> RollingWindow::response(const RollingPair& p,
                                                    const RollingPair& of) const noexcept {
  const std::size_t n = harmonics_.n_candidates();
  const int ahead = wrapped(p.sample - of.sample, harmonics_.turn());
  const std::size_t at =
      (p.candidate * n + of.candidate) * static_cast<std::size_t>(harmonics_.turn()) +
      static_cast<std::size_t>(ahead);
  const Complex to = frame(p.sample), from = conj(frame(of.sample));
  const Eigen::Matrix2d &moved = moved_[at], &slipped = slipped_[at];
  Eigen::Matrix<double, 3, 2> r;
  for (int c = 0; c < 2; ++c) {
    const Vec2 f = from * (c == 0 ? Vec2{0.0, 1.0} : Vec2{1.0, 0.0});
    const Vec2 u =
        to * Vec2{moved(0, 0) * f.x + moved(0, 1) * f.y, moved(1, 0) * f.x + moved(1, 1) * f.y};
    const Vec2 w = {slipped(0, 0) * f.x + slipped(0, 1) * f.y,
                    slipped(1, 0) * f.x + slipped(1, 1) * f.y};
    r.col(c) << u.y, to.re * w.x - to.im * w.y, u.x;
  }
  return r;
}

void RollingWindow::include(const std::vector<RollingPair>& pairs) {
  const auto before = static_cast<Index>(pairs_.size());
  for (const RollingPair& p : pairs) {
    char& in =
        included_[p.candidate][static_cast<std::size_t>(wrapped(p.sample, harmonics_.turn()))];
    if (!in) pairs_.push_back(p);
    in = 1;
  }
  const auto n = static_cast<Index>(pairs_.size());
  base_.conservativeResize(2 * n);
  base_x_.conservativeResize(n);
  matrix_.conservativeResize(2 * n, 2 * n);
  matrix_x_.conservativeResize(n, 2 * n);
  for (Index p = 0; p < n; ++p) {
    const RollingPair& pair = pairs_[static_cast<std::size_t>(p)];
    if (p >= before) {
      const Place at = place(pair);
      base_.segment<2>(2 * p) << at.gap, at.way;
      base_x_[p] = at.x;
    }
    for (Index q = p < before ? before : 0; q < n; ++q) {
      const auto r = response(pair, pairs_[static_cast<std::size_t>(q)]);
      matrix_.block<2, 2>(2 * p, 2 * q) = r.topRows<2>();
      matrix_x_.block<1, 2>(p, 2 * q) = r.row(2);
    }
  }
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
  std::vector<RollingPair> missing;
  const auto gap = [&](const RollingPair& p) {
    double g = height + place(p).gap;
    for (Index q = 0; q < force.size() / 2; ++q) {
      if (force[2 * q] == 0.0 && force[2 * q + 1] == 0.0) continue;
      g += response(p, pairs_[static_cast<std::size_t>(q)]).row(0).dot(force.segment<2>(2 * q));
    }
    return g;
  };
  for (std::size_t a = 0; a < harmonics_.n_candidates(); ++a) {
    std::vector<int> there;
    for (const RollingPair& p : pairs_)
      if (p.candidate == a) there.push_back(p.sample);
    if (there.empty()) continue;
    const auto [low, high] = std::minmax_element(there.begin(), there.end());
    const int beyond = std::max(2, (*high - *low) / 2);
    for (int m = *low - beyond; m <= *high + beyond; ++m) {
      const bool in = included_[a][static_cast<std::size_t>(wrapped(m, harmonics_.turn()))] != 0;
      if (!in && gap({a, m}) < -smallest) missing.push_back({a, m});
    }
  }
  include(missing);
  return !missing.empty();
}

}  // namespace rondo::statics
