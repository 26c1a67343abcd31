// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/contact_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

/// Memory for the tables of all phases [bytes], with blocks for 1/16 of the points in each.
constexpr double table_room = 256e6;

/// Closer phases are the same, because sums of rotations differ by round-off.

/// a · B b
double form(Vec2 a, const Eigen::Matrix2d& matrix, Vec2 b) noexcept {
  return a.x * (matrix(0, 0) * b.x + matrix(0, 1) * b.y) +
         a.y * (matrix(1, 0) * b.x + matrix(1, 1) * b.y);
}

}  // namespace

ContactSolver::ContactSolver(const mesh::Mesh& mesh, const rom::ReducedModel& model,
                             const contact::Ground& ground, contact::CoupledLimits limits)
    : mesh_(mesh),
      ground_(ground),
      nodes_(model.form == rom::ContactForm::nodes),
      turning_(model.frame == rom::ModelFrame::turning),
      coupled_(limits) {
  const std::size_t m = nodes_ ? mesh.boundary.size() : model.contact.points.size();
  warm_.resize(m);
  const double each = ContactTable::bytes(m, model.size(), m / 16);
  most_phases_ = static_cast<std::size_t>(std::clamp(table_room / each, 4.0, 1024.0));
  if (nodes_) {
    node_rows_ = std::make_unique<rom::NodeRows>(mesh, model);
    return;
  }
  phases_.push_back(
      {0.0, 0,
       std::make_unique<ContactTable>(model.contact, model.contact.rows * model.generator)});
}

Complex ContactSolver::frame_rotation(double angle) const noexcept {
  return turning_ ? rotation(angle) : Complex{1.0, 0.0};
}

ContactTable* ContactSolver::table_of(double share) {
  for (Phase& phase : phases_)
    if (std::abs(phase.share - share) < same_phase) {
      phase.used = steps_;
      return phase.table.get();
    }
  if (phases_.size() >= most_phases_)
    phases_.erase(std::ranges::min_element(phases_, {}, &Phase::used));
  const double turned = 2.0 * std::numbers::pi / mesh_.n_sectors * share;
  ++made_;
  phases_.push_back(
      {share, steps_, std::make_unique<ContactTable>(node_rows_->at(turned), MatrixXd())});
  return phases_.back().table.get();
}

ContactSolver::Points ContactSolver::points_at(double angle) {
  if (!nodes_) return {phases_.front().table.get(), 0};
  if (turning_) return {table_of(0.0), 0};
  const double sectors = angle / (2.0 * std::numbers::pi) * mesh_.n_sectors;
  // Nyquist's harmonic does not move on the material: it is the same again after two sectors.
  const double n = mesh_.n_sectors, period = mesh_.n_sectors % 2 == 0 ? 2.0 : 1.0;
  double whole = period * std::floor(sectors / period), share = sectors - whole;
  if (share > period - same_phase) {
    whole += period;
    share = 0.0;
  }
  return {table_of(share), static_cast<int>(whole - n * std::floor(whole / n))};
}

/// Points follow one another sector by sector within a ring.
int ContactSolver::material_of(int point, int sectors) const noexcept {
  const int n = mesh_.n_sectors, within = point % n;
  return nodes_ ? point - within + (within - sectors + n) % n : point;
}

int ContactSolver::point_of(int material, int sectors) const noexcept {
  const int n = mesh_.n_sectors, within = material % n;
  return nodes_ ? material - within + (within + sectors) % n : material;
}

void ContactSolver::forget_matrices() noexcept {
  // A new spin leads to other phases: keep only those of the previous step.
  if (nodes_) std::erase_if(phases_, [&](const Phase& phase) { return phase.used < steps_; });
  for (Phase& phase : phases_) phase.table->forget();
}

/// The result is in the model's frame, like all velocities here.
Vec2 ContactSolver::material_velocity(const BodyState& body, const Points& points,
                                      int point) const {
  const ContactTable& t = *points.table;
  const Vec2 arm = t.point(point) + t.at(point, *body.q);
  return conj(frame_rotation(body.angle)) * body.velocity + body.turn_rate * arm +
         body.turn * t.at(point, *body.p);
}

/// Velocity of what approaches the ground: of a point fixed in space, or of the material.
Vec2 ContactSolver::opening(const BodyState& body, const Points& points, int point,
                            double spin) const {
  const ContactTable& t = *points.table;
  if (!t.stands_still()) return material_velocity(body, points, point);
  return conj(frame_rotation(body.angle)) * body.velocity + t.at(point, *body.p) +
         spin * t.carried(point, *body.q);
}

void ContactSolver::find(const FreeStep& step, bool next) {
  contacts_.clear();
  points_.clear();
  const ContactTable& t = *end_.table;
  const Complex turned = frame_rotation(step.end.angle);
  const double norm = step.end.q->norm(), top = ground_.top();
  for (int k = 0; k < static_cast<int>(t.size()); ++k) {
    const Vec2 x = step.end.center + turned * t.point(k);
    if (x.y - t.reach(k) * norm > top) continue;
    Vec2 place = x + turned * t.at(k, *step.end.q);
    // A fixed point may remain in contact, and its gap must not drift: use the next gap.
    if (next) place += step.dt * opening(step.end, end_, k, step.spin);
    const contact::Touches touches = ground_.touches(place);
    if (touches.count > 0) points_.push_back(k);
    const int material = material_of(k, end_.sectors);
    for (int i = 0; i < touches.count; ++i) {
      const contact::Touch& touch = touches.at[at(i)];
      const Vec2 warm = i == 0 ? warm_[at(material)] : Vec2{};
      contacts_.push_back({k, material, conj(turned) * touch.normal, touch.gap, warm});
    }
  }
}

/// A law is asked with the place and the slip before the step, and the impulse of the step before.
double ContactSolver::friction_of(const FreeStep& step, const contact::Friction& friction,
                                  const PointContact& c) const {
  if (friction.is_constant()) return friction.constant();
  const ContactTable& table = *before_.table;
  const int k = point_of(c.material, before_.sectors);
  const Complex turned = frame_rotation(step.before.angle);
  const Vec2 arm = table.point(k) + table.at(k, *step.before.q);
  const Vec2 tangent = frame_rotation(step.end.angle) * turn90(c.normal);
  const Vec2 velocity = turned * material_velocity(step.before, before_, k);
  return friction.coefficient({step.before.center + turned * arm, std::abs(dot(tangent, velocity)),
                               c.impulse.x / (step.dt * table.share(k))});
}

void ContactSolver::make_problem(const FreeStep& step, const contact::Law& law,
                                 const StepMatrices& matrices) {
  coupled_.clear();
  const bool implicit = matrices.key().scheme == StepScheme::midpoint;
  const ContactTable& now = *end_.table;
  const Complex back = conj(frame_rotation(step.end.angle));
  const Complex from_before = back * frame_rotation(step.before.angle);
  const Complex back_turn = conj(step.end.turn);
  const Vec2 advance = back * (step.end.center - step.before.center);
  for (const PointContact& c : contacts_) {
    const Vec2 normal = c.normal, tangent = turn90(normal);
    const int earlier = point_of(c.material, before_.sectors);
    const Vec2 arm = now.point(c.point) + now.at(c.point, *step.end.q);
    const Vec2 arm_before =
        before_.table->point(earlier) + before_.table->at(earlier, *step.before.q);
    const double gap_before = c.gap - dot(normal, advance + arm - from_before * arm_before);
    Vec2 free{dot(normal, opening(step.end, end_, c.point, step.spin)),
              dot(tangent, material_velocity(step.end, end_, c.point))};
    if (implicit) free.x += gap_before / step.dt;
    if (!implicit && now.stands_still()) free.x = c.gap / step.dt;
    double bounce = 0.0;
    if (law.restitution != 0.0 || law.impact != contact::Impact::moreau) {
      const Vec2 before = from_before * opening(step.before, before_, earlier, step.spin);
      const double w = dot(normal, before);
      bounce = contact::restitution_shift(law, w, w);
    }
    coupled_.add(free, bounce, friction_of(step, law.friction, c), c.impulse);
  }
  coupled_.couple_all([&](std::size_t i, std::size_t j) -> contact::Block {
    const DelassusPair w = now.pair(contacts_[i].point, contacts_[j].point);
    const Vec2 normal = contacts_[i].normal, from = contacts_[j].normal, side = turn90(from);
    const Vec2 n_back = now.stands_still() ? normal : back_turn * normal;
    const Vec2 t_back = back_turn * turn90(normal);
    return {form(n_back, w.normal, from), form(n_back, w.normal, side),
            form(t_back, w.tangential, from), form(t_back, w.tangential, side)};
  });
}

ContactOutcome ContactSolver::solve(const FreeStep& step, const contact::Law& law,
                                    const StepMatrices& matrices) {
  ++steps_;
  before_ = points_at(step.before.angle);
  end_ = points_at(step.end.angle);
  const bool central = matrices.key().scheme == StepScheme::central;
  find(step, central && end_.table->stands_still());
  std::fill(warm_.begin(), warm_.end(), Vec2{});
  ContactOutcome outcome;
  if (contacts_.empty()) return outcome;
  end_.table->prepare(points_, matrices);
  make_problem(step, law, matrices);
  const contact::CoupledResult& result = coupled_.solve();
  outcome.iterations = result.iterations;
  outcome.residual = result.residual;
  outcome.converged = result.converged;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    PointContact& c = contacts_[i];
    c.impulse = coupled_.impulse[i];
    c.status = coupled_.status[i];
    outcome.free_velocity = std::max(outcome.free_velocity, norm(coupled_.problem.free[i]));
    Vec2& warm = warm_[at(c.material)];
    if (warm == Vec2{}) warm = c.impulse;
  }
  return outcome;
}

}  // namespace rondo::rom
