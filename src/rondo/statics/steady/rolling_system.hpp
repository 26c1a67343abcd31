// SPDX-License-Identifier: BSD-3-Clause
/// @file  The linear system of steady rolling for given statuses, with height and speed as unknowns
/// where load, traction or torque are given instead; its derivatives.
#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "rondo/statics/steady/rolling_contact.hpp"

namespace rondo::statics {

/// Forces, height and speed around which the torque, which is not linear, is taken.
struct RollingPoint {
  Eigen::VectorXd force;  ///< (2 pairs)
  double height = 0.0, speed = 0.0;
};

class RollingSystem {
 public:
  /// @param found of each pair. All must outlive it.
  RollingSystem(const RollingWindow& window, const RollingDrive& drive,
                const std::vector<RollingStatus>& found, const RollingPoint& around);

  /// Not finite where there is no solution.
  [[nodiscard]] RollingPoint solve() const;
  /// @pre `around` is the solution
  void add_slopes(RollingSolution& solution) const;

 private:
  [[nodiscard]] double edge(std::size_t pair) const noexcept;
  [[nodiscard]] Eigen::VectorXd rows_of(const Eigen::VectorXd& window_rows) const;
  void add_border();
  [[nodiscard]] RollingSlope slope(const Eigen::VectorXd& right, const Eigen::VectorXd& by_itself,
                                   double height, double speed) const;
  [[nodiscard]] Eigen::VectorXd expand(const Eigen::VectorXd& part) const;
  [[nodiscard]] Eigen::VectorXd torque_row() const;

  const RollingWindow& window_;
  const RollingDrive& drive_;
  const std::vector<RollingStatus>& found_;
  const RollingPoint& around_;
  bool has_height_, has_speed_;     ///< as unknowns
  double pass_;                     ///< P
  std::vector<Eigen::Index> rows_;  ///< of the window, each an unknown force
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace rondo::statics
