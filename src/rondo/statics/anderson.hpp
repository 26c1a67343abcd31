// SPDX-License-Identifier: BSD-3-Clause
/// @file  Anderson's acceleration of a fixed-point iteration x = g(x) (D. G. Anderson, J. ACM 12
/// (1965) 547; Walker and Ni, SIAM J. Numer. Anal. 49 (2011) 1715).
#pragma once
#include <Eigen/Core>
#include <deque>

namespace rondo::statics {

class Anderson {
 public:
  /// @param depth number of earlier points that are combined
  explicit Anderson(std::size_t depth) noexcept : depth_(depth) {}

  /// The next point, from the last one and what the iteration makes of it: the combination of the
  /// points so far whose changes cancel best.
  /// @param x, g (n). Every call has the same n.
  [[nodiscard]] Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& g);
  /// Forgets all earlier points.
  void restart() noexcept { steps_.clear(), has_last_ = false; }

 private:
  struct Step {
    Eigen::VectorXd g, change;  ///< differences of two points one after the other
  };
  std::size_t depth_;
  std::deque<Step> steps_;
  Eigen::VectorXd last_g_, last_change_;
  bool has_last_ = false;
};

}  // namespace rondo::statics
