// SPDX-License-Identifier: BSD-3-Clause
/// @file  The linear system of steady rolling for given statuses: gaps of closed pairs and ways of
/// sticking ones are 0; forces of sliding ones lie on the edge of the cone. In the plane their
/// shear follows from the normal force (docs/theory.md, 11.3); in space the direction of sliding is
/// an unknown, and is linearised (docs/wheel3d.md). Where the coefficient of a pair is linearised
/// too (PairFriction), its shear is an unknown in the plane as well. Height and speed are unknowns
/// where load, traction or torque are given instead.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rondo/contact/law.hpp"
#include "rondo/statics/steady/near_factors.hpp"
#include "rondo/statics/steady/rolling_problem.hpp"

namespace rondo::statics {

/// What the law says of a pair at a point, by q = r - ρ w: open where q_n <= 0; else it sticks
/// where q is in the cone, and slides where it is beyond it.
struct RollingStatus {
  contact::Status status = contact::Status::open;
  Vec2 direction{};    ///< of q along t1 and t2 where it slides; (1, 0) without friction
  double share = 0.0;  ///< μ q_n/|q_t| <= 1 where it slides

  bool operator==(const RollingStatus& b) const noexcept {
    return status == b.status && direction == b.direction;
  }
};
using RollingStatuses = std::vector<RollingStatus>;

/// One over the mean compliances of pairs along n and, times 0.4, across it [N/m]. In the plane
/// both are one over the mean of all.
struct RollingStiffness {
  double normal = 1.0, across = 1.0;
};
template <int D>
[[nodiscard]] RollingStiffness stiffness_of(const RollingProblem<D>& problem);

/// @param moved gaps and ways of the point
template <int D>
[[nodiscard]] RollingStatuses statuses_of(const RollingProblem<D>& problem,
                                          const RollingPoint& point, const Eigen::VectorXd& moved,
                                          const PairCoefficients& friction);

/// Derivatives of forces, height and speed by one of what is given.
struct RollingSlope {
  RollingForces forces;
  double height = 0.0, speed = 0.0;
};

/// By friction; by height, or load where that is given; by speed, or traction or torque; by the
/// slip angle and the turn slip, in space.
struct RollingSlopes {
  RollingSlope by_friction, by_height, by_speed, by_slip_angle, by_turn_slip;
};

template <int D>
class RollingSystem {
 public:
  /// @param around what is not linear is taken at: the torque, with a turn slip the ways, by speed
  /// times places, and coefficients that depend on slip and pressure. All must outlive it.
  /// @param near factors of a system that is like this one, or none yet, to solve with; null: by
  /// its own in double precision, as where those do not serve
  RollingSystem(const RollingProblem<D>& problem, const RollingDrive& drive,
                const RollingStatuses& statuses, const RollingPoint& around,
                NearFactors* near = nullptr);

  /// What factors of its own take, roughly, in floating-point operations.
  [[nodiscard]] double work() const noexcept;
  /// Not finite where there is no solution.
  [[nodiscard]] RollingPoint solve();
  /// Whether what was solved is as exact as by factors of its own.
  [[nodiscard]] bool is_exact() const noexcept { return is_factorised_ || near_->is_exact(); }
  /// @param around the solution
  [[nodiscard]] RollingSlopes slopes(const RollingPoint& around);

 private:
  struct Pair {
    Eigen::Index pair, at;  ///< number of the pair; of its first unknown
    Eigen::Index unknowns;  ///< 1: its shear follows from the normal force
    bool sticks;
    double edge;  ///< that shear over the normal force, along t1: 0 in space, where it is 0
    PairFriction friction;
    NodeMatrix<D - 1> by_way;  ///< of the row of what slides: how it depends on the way
  };
  [[nodiscard]] bool has_height() const noexcept { return drive_.load.has_value(); }
  [[nodiscard]] bool has_speed() const noexcept { return drive_.traction || drive_.torque; }
  [[nodiscard]] Eigen::Index of_height() const noexcept { return n_forces_; }
  [[nodiscard]] Eigen::Index of_speed() const noexcept {
    return n_forces_ + (has_height() ? 1 : 0);
  }
  [[nodiscard]] NodeVector<D - 1> direction(Eigen::Index pair) const noexcept;
  [[nodiscard]] NodeMatrix<D - 1> turning(Eigen::Index pair) const noexcept;
  [[nodiscard]] NodeMatrix<D - 1> by_way(Eigen::Index pair,
                                         const PairFriction& friction) const noexcept;
  void number();
  void fill(const RollingPoint& around);
  void add_edges();
  void add_linearised(const RollingPoint& around);
  void add_border(const RollingPoint& around);
  void add_sum(Eigen::Index row, const Eigen::VectorXd& by_force);
  void factorise();
  void name_rows();
  [[nodiscard]] Eigen::VectorXd unknowns_of(const RollingPoint& point) const;
  /// Rows of the system by what changes gaps and ways, (D pairs).
  template <class Moved>
  void reduce(const Moved& moved, Eigen::Ref<Eigen::VectorXd> rows) const;
  [[nodiscard]] Eigen::VectorXd rigid(double height, double ahead, double aside) const;
  [[nodiscard]] Eigen::VectorXd yawing(const RollingPoint& around) const;
  [[nodiscard]] Eigen::VectorXd by_speed(const RollingPoint& around) const;
  [[nodiscard]] Eigen::VectorXd expand(const Eigen::VectorXd& part) const;
  [[nodiscard]] Eigen::VectorXd solved(Eigen::VectorXd right, const Eigen::VectorXd& from);
  [[nodiscard]] Eigen::VectorXd solved(const Eigen::VectorXd& right);
  [[nodiscard]] RollingPoint point_of(const Eigen::VectorXd& unknowns, double height,
                                      double speed) const;
  [[nodiscard]] RollingPoint by_friction(const RollingPoint& around, const TorqueChange& torque);

  const RollingProblem<D>& problem_;
  const RollingDrive& drive_;
  const RollingStatuses& statuses_;
  double scale_;  ///< of sliding pairs' rows in space: forces to ways                         [m/N]
  std::vector<Pair> closed_;
  Eigen::Index n_forces_ = 0;
  const RollingPoint& around_;
  NearFactors* near_;                ///< null: it has, or will have, factors of its own
  std::vector<Eigen::Index> names_;  ///< of unknowns, for factors that are near
  Eigen::VectorXd weights_;          ///< of rows, for these
  Eigen::MatrixXd matrix_;           ///< its own factors, once it is factorised
  bool is_factorised_ = false;
  Eigen::VectorXd right_;
  std::vector<int> pivots_;
  bool singular_ = false;
};

}  // namespace rondo::statics
