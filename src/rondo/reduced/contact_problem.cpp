// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/reduced/contact_problem.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::reduced {
namespace {

/// a · B b
double form(Vec2 a, const Eigen::Matrix2d& matrix, Vec2 b) noexcept {
  return a.x * (matrix(0, 0) * b.x + matrix(0, 1) * b.y) +
         a.y * (matrix(1, 0) * b.x + matrix(1, 1) * b.y);
}

}  // namespace

ContactSolver::ContactSolver(const reduction::ReducedModel& model, const contact::Ground& ground,
                             contact::CoupledLimits limits)
    : model_(model),
      ground_(ground),
      limits_(limits),
      derived_rows_(model.rows * model.generator),
      warm_(model.contact_points.size()) {
  for (Index k = 0; k < model.rows.rows(); k += 2)
    reach_.push_back(model.rows.middleRows(k, 2).norm());
}

Vec2 ContactSolver::at(int point, const VectorXd& coefficients) const {
  const Index row = 2 * point;
  return {model_.rows.row(row).dot(coefficients), model_.rows.row(row + 1).dot(coefficients)};
}

/// Of the point that keeps its angle in space.
Vec2 ContactSolver::place_velocity(int point, const FreeStep& step, bool end) const {
  const VectorXd& q = end ? *step.q : *step.q_before;
  const VectorXd& p = end ? *step.p : *step.p_before;
  const Index row = 2 * point;
  const Vec2 carried = {derived_rows_.row(row).dot(q), derived_rows_.row(row + 1).dot(q)};
  return (end ? step.velocity : step.velocity_before) + at(point, p) + step.spin * carried;
}

void ContactSolver::find(const FreeStep& step) {
  contacts_.clear();
  points_.clear();
  const double norm = step.q->norm(), top = ground_.top();
  for (std::size_t k = 0; k < model_.contact_points.size(); ++k) {
    const Vec2 x = step.center + model_.contact_points[k];
    if (x.y - reach_[k] * norm > top) continue;
    const int point = static_cast<int>(k);
    const contact::Touches touches = ground_.touches(x + at(point, *step.q));
    if (touches.count > 0) points_.push_back(point);
    for (int i = 0; i < touches.count; ++i) {
      const contact::Touch& touch = touches.at[static_cast<std::size_t>(i)];
      contacts_.push_back({point, touch.normal, touch.gap, i == 0 ? warm_[k] : Vec2{}});
    }
  }
}

void ContactSolver::make_problem(const FreeStep& step, const contact::Law& law,
                                 SpinMatrices& matrices) {
  const std::size_t n = contacts_.size();
  contact::CoupledProblem& p = problem_;
  p.free.resize(n);
  p.bounce.resize(n);
  p.mass.resize(n);
  p.friction.assign(n, law.friction);
  p.row_start.resize(n + 1);
  p.column.resize(n * n);
  p.blocks.resize(n * n);
  impulse_.resize(n);
  status_.resize(n);
  p.row_start[0] = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const PointContact& c = contacts_[i];
    const Vec2 normal = c.normal, tangent = turn90(normal);
    const Vec2 moved = step.advance + at(c.point, *step.q) - at(c.point, *step.q_before);
    const double gap_before = c.gap - dot(normal, moved);
    const Vec2 arm =
        model_.contact_points[static_cast<std::size_t>(c.point)] + at(c.point, *step.q);
    const Vec2 material = step.velocity + step.spin * turn90(arm) + at(c.point, *step.p);
    p.free[i] = {dot(normal, place_velocity(c.point, step, true)) + gap_before / step.dt,
                 dot(tangent, material)};
    p.bounce[i] =
        law.restitution == 0.0
            ? 0.0
            : law.restitution * std::min(dot(normal, place_velocity(c.point, step, false)), 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      const DelassusPair w = matrices.pair(c.point, contacts_[j].point);
      const Vec2 from = contacts_[j].normal, side = turn90(from);
      p.column[i * n + j] = static_cast<int>(j);
      p.blocks[i * n + j] = {form(normal, w.normal, from), form(normal, w.normal, side),
                             form(tangent, w.tangential, from), form(tangent, w.tangential, side)};
    }
    const contact::Block& own = p.blocks[i * n + i];
    p.mass[i] = 1.0 / std::max(own[0], own[3]);
    p.row_start[i + 1] = static_cast<int>((i + 1) * n);
    impulse_[i] = c.impulse;
  }
}

ContactOutcome ContactSolver::solve(const FreeStep& step, const contact::Law& law,
                                    SpinMatrices& matrices) {
  find(step);
  std::fill(warm_.begin(), warm_.end(), Vec2{});
  ContactOutcome outcome;
  if (contacts_.empty()) return outcome;
  matrices.prepare(points_);
  make_problem(step, law, matrices);
  const contact::CoupledResult result =
      contact::solve_coupled(problem_, limits_, impulse_, status_, work_);
  outcome.iterations = result.iterations;
  outcome.residual = result.residual;
  outcome.converged = result.converged;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    PointContact& c = contacts_[i];
    c.impulse = impulse_[i];
    c.status = status_[i];
    outcome.free_velocity = std::max(outcome.free_velocity, norm(problem_.free[i]));
    Vec2& warm = warm_[static_cast<std::size_t>(c.point)];
    if (warm == Vec2{}) warm = c.impulse;
  }
  return outcome;
}

}  // namespace rondo::reduced
