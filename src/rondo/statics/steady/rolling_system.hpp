// SPDX-License-Identifier: BSD-3-Clause
/// @file  The linear system of steady rolling for given statuses, with height and speed as unknowns
/// where load, traction or torque are given instead; its derivatives.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "rondo/contact/law.hpp"
#include "rondo/statics/steady/rolling_problem.hpp"

namespace rondo::statics {

/// Of each of two pairs one is given: height or load, speed or traction or torque.
struct RollingDrive {
  double height = 0.0;             ///< h, of the center above the ground; without a load    [m]
  double speed = 0.0;              ///< V; without traction and torque; else where to start [m/s]
  double friction = 0.0;           ///< μ >= 0
  std::optional<double> load;      ///< F_y of the ground on the body, > 0                 [N/m]
  std::optional<double> traction;  ///< F_x of the ground on the body                      [N/m]
  std::optional<double> torque;    ///< of ground and weight, counter-clockwise              [N]
};

/// What a pair does; `side`: of a slipping one the sign of r_x.
struct RollingStatus {
  contact::Status status = contact::Status::open;
  int side = 0;
  bool operator==(const RollingStatus&) const = default;
};

/// Derivatives of forces, height and speed by one of what is given.
struct RollingSlope {
  RollingForces forces;
  double height = 0.0, speed = 0.0;
};

/// By friction; by height, or load where that is given; by speed, or traction or torque.
struct RollingSlopes {
  RollingSlope by_friction, by_height, by_speed;
};

class RollingSystem {
 public:
  /// @param found of each pair. @param around what the torque, which is not linear, is taken at.
  /// All must outlive it.
  RollingSystem(const RollingProblem& problem, const RollingDrive& drive,
                const std::vector<RollingStatus>& found, const RollingPoint& around);

  /// Of unknowns.
  [[nodiscard]] Eigen::Index size() const noexcept { return right_.size(); }
  /// Not finite where there is no solution.
  [[nodiscard]] RollingPoint solve() const;
  /// @param around the solution
  [[nodiscard]] RollingSlopes slopes(const RollingPoint& around) const;

 private:
  [[nodiscard]] double edge(std::size_t pair) const noexcept;
  void add_border(const RollingPoint& around);
  void factorise();
  [[nodiscard]] Eigen::VectorXd solved(Eigen::VectorXd right) const;
  /// The torque at a point: P dT = row·dr + shear dh.
  struct Torque {
    Eigen::VectorXd row;
    double shear;
  };
  [[nodiscard]] Torque torque_at(const RollingPoint& around) const;
  [[nodiscard]] RollingSlope slope(const Torque& torque, const Eigen::VectorXd& right,
                                   const Eigen::VectorXd& by_itself, double height,
                                   double speed) const;
  [[nodiscard]] Eigen::VectorXd expand(const Eigen::VectorXd& part) const;

  const RollingProblem& problem_;
  const RollingDrive& drive_;
  const std::vector<RollingStatus>& found_;
  bool has_height_, has_speed_;     ///< as unknowns
  std::vector<Eigen::Index> rows_;  ///< of the problem, each an unknown force
  Eigen::MatrixXd matrix_;          ///< its factors, once it is factorised
  Eigen::VectorXd right_;
  std::vector<int> pivots_;
  bool singular_ = false;
};

}  // namespace rondo::statics
