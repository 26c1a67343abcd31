// SPDX-License-Identifier: BSD-3-Clause
/// @file  A cylinder that rolls on rigid ground, as a half plane: an independent solution of the
/// problem of Bentall and Johnson (Int. J. Mech. Sci. 9 (1967) 389; K. L. Johnson, Contact
/// Mechanics, 1985, 8.2 and 8.3) by strips of constant traction. Lengths are over R, tractions over
/// E*; the surface flows towards -x.
///
///     g = x²/2 - δ + u_z >= 0  ⊥  p >= 0,  w/V = -ξ - u_x' of the surface against q,  |q| <= μp
///     u_z' = -(2/π) ∫ p/(x - s) ds + 2β q,     u_x' = -(2/π) ∫ q/(x - s) ds - 2β p
#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

namespace rondo::test {

struct HalfPlane {
  double dundurs = 0.0;      ///< β, of an elastic cylinder on rigid ground (1 - 2ν)/(2 (1 - ν))
  double friction = 0.0;     ///< μ > 0
  double half_width = 0.01;  ///< Hertz's a, which determines the load
  double share = 0.0;        ///< Q/(μP)
  int strips = 200;          ///< over 1.2 times the width of Hertz
};

struct HalfPlaneRolling {
  bool solved = false;
  double creep = 0.0;  ///< ξ = 1 - V/(ωR)
};

/// Newton's method on statuses: 0 open, 1 sticking, 2 and -2 slipping with q of that sign.
class HalfPlaneProblem {
 public:
  explicit HalfPlaneProblem(const HalfPlane& of)
      : of_(of), n_(of.strips), width_(2.4 * of.half_width / of.strips) {
    place_ = (Eigen::VectorXd::LinSpaced(n_, 0.5, n_ - 0.5).array() - 0.5 * n_) * width_;
    const auto primitive = [](double y) { return y * std::log(std::abs(y)) - y; };
    normal_.resize(n_ + 1, n_);
    across_.resize(n_ + 1, n_);
    for (int i = 0; i <= n_; ++i)  // one more ahead, for the slip of the foremost strip
      for (int j = 0; j < n_; ++j) {
        const double y = (i - j) * width_, half = 0.5 * width_;
        normal_(i, j) = -2.0 / std::numbers::pi * (primitive(y + half) - primitive(y - half));
        across_(i, j) = of.dundurs * width_ * (i > j ? 1.0 : i < j ? -1.0 : 0.0);
      }
  }

  HalfPlaneRolling solve() {
    std::vector<int> status(static_cast<std::size_t>(n_), 0);
    for (int i = 0; i < n_; ++i)
      if (std::abs(place_[i]) < of_.half_width) status[static_cast<std::size_t>(i)] = 1;
    for (int round = 0; round < 200; ++round) {
      find(status);
      std::vector<int> next = after();
      if (next == status) return {p_.maxCoeff() > 0.0 && std::isfinite(creep_), creep_};
      status = std::move(next);
    }
    return {};
  }

 private:
  /// p, q, δ and ξ for given statuses, under the load of Hertz, π a²/4, and its share of friction.
  void find(const std::vector<int>& status) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(2 * n_ + 2, 2 * n_ + 2);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * n_ + 2);
    for (int i = 0; i < n_; ++i) {
      const int s = status[static_cast<std::size_t>(i)];
      if (s == 0) {
        m(i, i) = m(n_ + i, n_ + i) = 1.0;
        continue;
      }
      m.block(i, 0, 1, n_) = normal_.row(i);
      m.block(i, n_, 1, n_) = across_.row(i);
      m(i, 2 * n_) = -1.0;
      right[i] = -0.5 * place_[i] * place_[i];
      if (s == 1) {
        m.block(n_ + i, 0, 1, n_) = -(across_.row(i) - across_.row(i + 1));
        m.block(n_ + i, n_, 1, n_) = normal_.row(i) - normal_.row(i + 1);
        m(n_ + i, 2 * n_ + 1) = -width_;
      } else {
        m(n_ + i, n_ + i) = 1.0;
        m(n_ + i, i) = -std::copysign(of_.friction, s);
      }
    }
    const double load = 0.25 * std::numbers::pi * of_.half_width * of_.half_width / width_;
    m.block(2 * n_, 0, 1, n_).setOnes();
    m.block(2 * n_ + 1, n_, 1, n_).setOnes();
    right[2 * n_] = load;
    right[2 * n_ + 1] = of_.share * of_.friction * load;
    const Eigen::VectorXd z = m.partialPivLu().solve(right);
    p_ = z.head(n_);
    q_ = z.segment(n_, n_);
    depth_ = z[2 * n_];
    creep_ = z[2 * n_ + 1];
  }

  [[nodiscard]] std::vector<int> after() const {
    const Eigen::VectorXd uz = normal_ * p_ + across_ * q_, ux = normal_ * q_ - across_ * p_;
    const double compliance = normal_.diagonal().mean() - normal_.row(n_ / 2).minCoeff();
    std::vector<int> next(static_cast<std::size_t>(n_), 0);
    for (int i = 0; i < n_; ++i) {
      const double gap = 0.5 * place_[i] * place_[i] - depth_ + uz[i];
      const double way = ux[i] - ux[i + 1] - creep_ * width_;
      const double normal = p_[i] - gap / compliance, shear = q_[i] - way / compliance;
      if (!(normal > 0.0)) continue;
      const bool sticks = std::abs(shear) <= of_.friction * normal;
      next[static_cast<std::size_t>(i)] = sticks ? 1 : shear > 0.0 ? 2 : -2;
    }
    return next;
  }

  HalfPlane of_;
  int n_;
  double width_, depth_ = 0.0, creep_ = 0.0;
  Eigen::VectorXd place_, p_, q_;
  Eigen::MatrixXd normal_, across_;  ///< displacement along a traction, and normal to it, due to β
};

inline HalfPlaneRolling roll(const HalfPlane& of) {
  return HalfPlaneProblem(of).solve();
}

/// Creep / (a/R), a of Hertz, if all points stick: 2η/√(1 + 4η²), η = ln((1 + β)/(1 - β))/(2π).
inline double creep_of_adhesion(double dundurs) {
  const double eta = std::log((1.0 + dundurs) / (1.0 - dundurs)) / (2.0 * std::numbers::pi);
  return 2.0 * eta / std::sqrt(1.0 + 4.0 * eta * eta);
}

}  // namespace rondo::test
