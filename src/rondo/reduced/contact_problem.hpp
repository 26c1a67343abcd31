// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of a reduced step (docs/reduced.md, 5): which points touch, what the law sees at
/// them, and their impulses, all together as every mode moves all of them.
#pragma once
#include <vector>

#include "rondo/contact/coupled.hpp"
#include "rondo/contact/ground.hpp"
#include "rondo/dynamics/contact_node.hpp"
#include "rondo/reduced/spin_matrices.hpp"

namespace rondo::reduced {

/// Centre and spin of one step, and where it would lead without contact.
struct FreeStep {
  double dt = 0.0;                 ///< [s]
  double spin = 0.0;               ///< s̄ [rad/s]
  Vec2 center;                     ///< c at the end                       [m]
  Vec2 advance;                    ///< of the centre over the step        [m]
  Vec2 velocity_before, velocity;  ///< ċ at the beginning and just after the end [m/s]
  const VectorXd *q_before, *p_before, *q, *p;  ///< (r) at the beginning; free, at the end
};

/// A point of the rim, at an angle fixed in space, against a facet.
struct PointContact {
  int point = 0;
  Vec2 normal;       ///< out of the ground, fixed frame
  double gap = 0.0;  ///< at the end of the step, without contact           [m]
  Vec2 impulse;      ///< r: normal, tangential                             [N·s/m]
  contact::Status status = contact::Status::open;
};

struct ContactOutcome {
  int iterations = 0;
  double residual = 0.0;       ///< of the law, over the largest free impulse [-]
  double free_velocity = 0.0;  ///< largest |w| that the law sees without impulses [m/s]
  bool converged = true;
};

class ContactSolver {
 public:
  /// All must outlive it.
  ContactSolver(const reduction::ReducedModel& model, const contact::Ground& ground,
                contact::CoupledLimits limits);
  /// Finds the contacts of the step and their impulses.
  [[nodiscard]] ContactOutcome solve(const FreeStep& step, const contact::Law& law,
                                     SpinMatrices& matrices);
  /// Of the last step, by point.
  [[nodiscard]] const std::vector<PointContact>& contacts() const noexcept { return contacts_; }

 private:
  void find(const FreeStep& step);
  void make_problem(const FreeStep& step, const contact::Law& law, SpinMatrices& matrices);
  [[nodiscard]] Vec2 at(int point, const VectorXd& coefficients) const;
  [[nodiscard]] Vec2 place_velocity(int point, const FreeStep& step, bool end) const;

  const reduction::ReducedModel& model_;
  const contact::Ground& ground_;
  contact::CoupledLimits limits_;
  MatrixXd derived_rows_;      ///< (2m, r) H D
  std::vector<double> reach_;  ///< (m) norm of the rows: |u| <= reach |q|
  std::vector<PointContact> contacts_;
  std::vector<Vec2> warm_;  ///< (m) impulses of the step before              [N·s/m]
  std::vector<int> points_;
  contact::CoupledProblem problem_;
  contact::CoupledWorkspace work_;
  std::vector<Vec2> impulse_;
  std::vector<contact::Status> status_;
};

}  // namespace rondo::reduced
