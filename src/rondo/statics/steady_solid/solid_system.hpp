// SPDX-License-Identifier: BSD-3-Clause
/// @file  The linear system of a Newton step of steady rolling in three dimensions
/// (docs/wheel3d.md): gaps of closed pairs and ways of sticking ones are 0, forces of sliding ones
/// lie on the cone against the slip, whose direction is linearised; height and speed are unknowns
/// where load, traction or torque are given instead. Its derivatives.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rondo/contact/law.hpp"
#include "rondo/statics/steady_solid/solid_problem.hpp"

namespace rondo::statics {

/// What the law says of a point: of q = r - ρ w, which lies in the cone where a pair sticks and
/// beyond it where it slides.
struct SolidStatuses {
  std::vector<contact::Status> of;  ///< (pairs)
  Eigen::MatrixXd direction;        ///< (2, pairs) of q_t where it slides
  Eigen::VectorXd share;            ///< (pairs) μ q_n/|q_t| <= 1 where it slides
};

/// Mean compliances of pairs along n, and across it [m/N].
struct SolidScales {
  double normal = 1.0, across = 1.0;
};
[[nodiscard]] SolidScales scales_of(const SolidRollingProblem& problem);

/// @param moved gaps and ways of the point
[[nodiscard]] SolidStatuses statuses_of(const SolidRollingProblem& problem,
                                        const SolidRollingPoint& point,
                                        const Eigen::VectorXd& moved, double friction);

/// Derivatives of forces, height and speed by one of what is given.
struct SolidRollingSlope {
  SolidRollingForces forces;
  double height = 0.0, speed = 0.0;
};

/// By friction; by height, or load where that is given; by speed, or traction or torque; by the
/// slip angle.
struct SolidRollingSlopes {
  SolidRollingSlope by_friction, by_height, by_speed, by_slip_angle;
};

class SolidSystem {
 public:
  /// @param around what statuses and the torque, which is not linear, are taken at. All must
  /// outlive it.
  SolidSystem(const SolidRollingProblem& problem, const SolidRollingDrive& drive,
              const SolidStatuses& statuses, const SolidRollingPoint& around);

  /// Of its making, roughly, in floating-point operations.
  [[nodiscard]] double work() const noexcept;
  /// Not finite where there is no solution.
  [[nodiscard]] SolidRollingPoint solve() const;
  /// @pre `around` is the solution
  [[nodiscard]] SolidRollingSlopes slopes() const;

 private:
  struct Pair {
    Eigen::Index pair, at;  ///< number of the pair; of its first unknown
    bool sticks;
  };
  [[nodiscard]] bool has_height() const noexcept { return drive_.load.has_value(); }
  [[nodiscard]] bool has_speed() const noexcept { return drive_.traction || drive_.torque; }
  [[nodiscard]] Eigen::Index of_height() const noexcept { return n_forces_; }
  [[nodiscard]] Eigen::Index of_speed() const noexcept {
    return n_forces_ + (has_height() ? 1 : 0);
  }
  void number();
  void fill();
  void add_border();
  void add_sum(Eigen::Index row, const Eigen::VectorXd& by_force);
  void factorise();
  /// Rows of the system by what changes gaps and ways, (3 pairs).
  [[nodiscard]] Eigen::VectorXd reduced(const Eigen::VectorXd& moved) const;
  [[nodiscard]] Eigen::VectorXd rigid(double height, double ahead, double aside) const;
  [[nodiscard]] Eigen::Matrix2d turning(Eigen::Index pair) const;
  [[nodiscard]] Eigen::VectorXd expand(const Eigen::VectorXd& part) const;
  [[nodiscard]] Eigen::VectorXd solved(Eigen::VectorXd right) const;
  [[nodiscard]] SolidRollingSlope slope(const Eigen::VectorXd& right, double height,
                                        double speed) const;

  const SolidRollingProblem& problem_;
  const SolidRollingDrive& drive_;
  const SolidStatuses& statuses_;
  const SolidRollingPoint& around_;
  double scale_;  ///< of sliding pairs' rows: forces to ways                                 [m/N]
  std::vector<Pair> closed_;
  Eigen::Index n_forces_ = 0;
  Eigen::MatrixXd matrix_;  ///< its factors, once it is factorised
  Eigen::VectorXd right_;
  std::vector<int> pivots_;
  bool singular_ = false;
};

}  // namespace rondo::statics
