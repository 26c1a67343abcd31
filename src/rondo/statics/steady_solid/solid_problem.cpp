// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady_solid/solid_problem.hpp"

namespace rondo::statics {
namespace {

using Eigen::Index;

/// Columns of the matrix where there is a force: many pairs touch nothing.
void add_product(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& force,
                 Eigen::VectorXd& sum) {
  for (Index c = 0; c < force.size(); ++c)
    if (force[c] != 0.0) sum += force[c] * matrix.col(c);
}

/// (3 pairs) from the center along n, t1, t2.
Eigen::VectorXd arms(const SolidRollingProblem& problem, const Eigen::VectorXd& force) {
  Eigen::VectorXd gap = problem.base, all(gap.size());
  add_product(problem.matrix, force, gap);
  const Eigen::VectorXd place = places(problem, force);
  for (Index j = 0; 3 * j < all.size(); ++j)
    all.segment<3>(3 * j) << gap[3 * j], place[2 * j], place[2 * j + 1];
  return all;
}

Vec3 vec3_of_pair(const Eigen::VectorXd& all, Index pair) noexcept {
  return {all[3 * pair], all[3 * pair + 1], all[3 * pair + 2]};
}

}  // namespace

Eigen::VectorXd gaps_and_ways(const SolidRollingProblem& problem, double slip_angle,
                              const SolidRollingPoint& p) {
  Eigen::VectorXd all = problem.base;
  add_product(problem.matrix, p.force, all);
  const double way = p.speed * problem.time;
  const Eigen::Vector3d rigid{p.height, way * std::cos(slip_angle), way * std::sin(slip_angle)};
  for (Index j = 0; j < all.size(); j += 3) all.segment<3>(j) += rigid;
  return all;
}

Eigen::VectorXd places(const SolidRollingProblem& problem, const Eigen::VectorXd& force) {
  Eigen::VectorXd all = problem.base_place;
  add_product(problem.matrix_place, force, all);
  return all;
}

SolidRollingForces forces_of(const SolidRollingProblem& problem, const SolidRollingPoint& p) {
  const Eigen::VectorXd arm = arms(problem, p.force);
  Vec3 force, moment;  // about the center
  for (Index j = 0; 3 * j < arm.size(); ++j) {
    const Vec3 r = vec3_of_pair(p.force, j);
    if (r == Vec3{}) continue;
    force += r;
    moment += cross(problem.ground.to_wheel(vec3_of_pair(arm, j)), problem.ground.to_wheel(r));
  }
  force = force / problem.pass;
  moment = moment / problem.pass;
  const Vec3 at_ground =
      moment + cross(p.height * problem.ground.normal, problem.ground.to_wheel(force));
  return {.normal = force.x,
          .heading = force.y,
          .lateral = force.z,
          .torque = moment.z + problem.base_weight + problem.weight.dot(p.force),
          .aligning = dot(at_ground, problem.ground.normal),
          .overturning = dot(at_ground, problem.ground.heading)};
}

/// With a and f in the axes of the wheel, T = Σ a_x f_y - a_y f_x; both hang on the forces.
Eigen::VectorXd torque_row(const SolidRollingProblem& problem, const SolidRollingPoint& p) {
  const Eigen::VectorXd arm = arms(problem, p.force);
  const GroundFrame& g = problem.ground;
  Eigen::VectorXd row = problem.pass * problem.weight;
  for (Index j = 0; 3 * j < arm.size(); ++j) {
    const Vec3 a = g.to_wheel(vec3_of_pair(arm, j)), f = g.to_wheel(vec3_of_pair(p.force, j));
    const auto of_force = [&](Vec3 axis) { return a.x * axis.y - a.y * axis.x; };
    row.segment<3>(3 * j) +=
        Eigen::Vector3d{of_force(g.normal), of_force(g.heading), of_force(g.lateral)};
    if (f == Vec3{}) continue;
    const auto of_arm = [&](Vec3 axis) { return axis.x * f.y - axis.y * f.x; };
    row += of_arm(g.normal) * problem.matrix.row(3 * j).transpose() +
           of_arm(g.heading) * problem.matrix_place.row(2 * j).transpose() +
           of_arm(g.lateral) * problem.matrix_place.row(2 * j + 1).transpose();
  }
  return row;
}

}  // namespace rondo::statics
