// SPDX-License-Identifier: BSD-3-Clause
/// One step of BodiesIntegrator.
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/core/sum.hpp"
#include "rondo/integrators/bodies/bodies_integrator.hpp"
#include "rondo/integrators/fused/step_context.hpp"
#include "rondo/integrators/general/step_traps.hpp"
#include "rondo/model/friction_work.hpp"

namespace rondo::dynamics {
namespace {

using kernels::lanes;

template <std::size_t n>
void add_lanes(const double* x, std::array<double, n>& sums) noexcept {
  for (double& sum : sums) {
    sum = sum_of_lanes(x);
    x += lanes;
  }
}

using MoveSums = std::array<double, kernels::n_move_sums>;

void add_lanes_of_move(const double* x, MoveSums& sums) noexcept {
  add_lanes(x, sums);
  const double* speeds = x + kernels::move_fastest * lanes;
  sums[kernels::move_fastest] = *std::max_element(speeds, speeds + lanes);
}

Complex turn_of(const kernels::GroupPose& pose) noexcept {
  return {pose.turn_x, pose.turn_y};
}

}  // namespace

void BodiesIntegrator::advance_batch(std::span<StepReport> reports) noexcept {
  if (threads_ > 1) {
#pragma omp parallel num_threads(threads_)
    make_steps(reports, {static_cast<std::size_t>(omp_get_thread_num()),
                         static_cast<std::size_t>(omp_get_num_threads())});
  } else {
    make_steps(reports, {});
  }
  if (model_.friction_work) model_.friction_work->settle();
}

void BodiesIntegrator::make_steps(std::span<StepReport> reports, Share share) noexcept {
  RONDO_ASSERT(share.n_threads <= static_cast<std::size_t>(threads_), share.n_threads, threads_);
  const StepTraps traps;
  const std::size_t first = share.first(plan_.blocks.size());
  const std::size_t last = share.last(plan_.blocks.size());
  const auto wait = [&] {
    if (share.n_threads > 1) barrier_.wait(static_cast<unsigned>(share.n_threads));
  };
  for (StepReport& report : reports) {
    if (share.thread == 0) begin_step();
    wait();
    for (std::size_t b = first; b < last; ++b) find_elastic(b);
    wait();
    for (std::size_t b = first; b < last; ++b) find_forces(b);
    wait();
    if (share.thread == 0) between(report);
    wait();
    for (std::size_t b = first; b < last; ++b) find_velocities(b);
    wait();
    if (share.thread == 0) end_step(report);
  }
}

kernels::BodyBlock BodiesIntegrator::block_of(std::size_t block, double* sums) noexcept {
  const RowBlock& b = plan_.blocks[block];
  const GroupStep& group = groups_[b.group];
  return {.fields = &fields_,
          .first_pack = static_cast<std::ptrdiff_t>(b.first_pack),
          .last_pack = static_cast<std::ptrdiff_t>(b.last_pack),
          .pose = &group.pose,
          .turning = &group.turning,
          .step = &group.factors,
          .sums = sums};
}

/// Sum over the blocks of a group.
template <class Sums, class Sum>
double BodiesIntegrator::sum_of(const BodyGroup& group, Sums BlockSums::*sums,
                                Sum sum) const noexcept {
  CompensatedSum total;
  for (std::size_t b = group.first_block; b < group.last_block; ++b)
    total.add((sums_[b].*sums)[static_cast<std::size_t>(sum)]);
  return total.value();
}

/// Forces and energies at u_0, and the way to u_1.
void BodiesIntegrator::begin(const State& start) noexcept {
  load(start.u, start.v_next);
  for (std::size_t g = 0; g < groups_.size(); ++g) set_pose(plan_.groups[g], groups_[g]);
  for (std::size_t b = 0; b < plan_.blocks.size(); ++b) find_elastic(b);
  for (std::size_t b = 0; b < plan_.blocks.size(); ++b) find_forces(b);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const BodyGroup& group = plan_.groups[g];
    if (group.held()) continue;
    // τ and |Z| of the elastic displacements at hand.
    double inertia = group.inertia, power = 0.0;
    for (std::size_t i = group.first_pack * lanes; i < group.last_pack * lanes; ++i) {
      const double* c = plan_.constants.data() + BodyPlan::at(static_cast<int>(i));
      inertia +=
          c[2 * lanes] * (c[0] * elastic_.data()[2 * i] + c[lanes] * elastic_.data()[2 * i + 1]);
    }
    groups_[g].inertia = inertia;
    groups_[g].turning.elastic = sum_of(group, &BlockSums::force, kernels::force_moment) / inertia;
    for (std::size_t i = group.first_pack * lanes; i < group.last_pack * lanes; ++i) {
      if (plan_.node[i] < 0) continue;
      const Correction on = forces_on(static_cast<int>(i));
      power += dot(on.before, on.gradient);
    }
    energy_[static_cast<std::size_t>(group.body)] =
        0.25 * sum_of(group, &BlockSums::force, kernels::force_energy) + 0.25 * model_.dt * power;
  }
  kernels::StepFactors factors{};
  factors.dt = model_.dt;
  for (std::size_t b = 0; b < plan_.blocks.size(); ++b) move(b, &factors);
}

/// R, Rᵀ - 1 and the shift of a group's pose.
void BodiesIntegrator::set_pose(const BodyGroup& group, GroupStep& step) noexcept {
  if (group.held()) return;
  const Pose& pose = poses_[static_cast<std::size_t>(group.body)];
  const double c = pose.rotation.re, s = pose.rotation.im;
  const Vec2 shift = pose.center - group.center;
  step.pose = {.turn_x = c,
               .turn_y = s,
               .back_x = c > 0.0 ? -s * s / (1.0 + c) : c - 1.0,
               .back_y = -s,
               .shift_x = shift.x,
               .shift_y = shift.y};
}

/// Mean place and rotation at t_{n+1} (9.1), (9.2), from the sums of the way there.
void BodiesIntegrator::find_pose(const BodyGroup& group, GroupStep& step) noexcept {
  const auto sum = [&](kernels::MoveSum which) { return sum_of(group, &BlockSums::move, which); };
  const Vec2 moved = Vec2{sum(kernels::move_x), sum(kernels::move_y)} / group.mass;
  // Z: x - x_c = arm + d - moved
  const Complex turned =
      Complex{group.inertia + sum(kernels::move_along), sum(kernels::move_across)} -
      rotation_between(group.offset, moved);
  step.inertia = norm(turned);
  Pose& pose = poses_[static_cast<std::size_t>(group.body)];
  const Pose before = pose;
  pose.center = group.center + (Vec2{step.pose.shift_x, step.pose.shift_y} + moved);
  pose.rotation = turned / step.inertia;
  const Complex turn = pose.rotation * conj(before.rotation);
  pose.angle = before.angle + std::atan2(turn.im, turn.re);
  set_pose(group, step);
}

void BodiesIntegrator::begin_step() noexcept {
  ++step_;
  frame_ = frame_step(model_.motion, step_, model_.dt);
  const kernels::StepFactors held = step_context(model_, frame_).factors;
  const kernels::StepFactors free = step_context(model_, fixed_frame_step(model_, step_)).factors;
  CompensatedSum kinetic;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const BodyGroup& group = plan_.groups[g];
    groups_[g].factors = group.held() ? held : free;
    kinetic.add(sum_of(group, &BlockSums::move, kernels::move_kinetic));
    if (!group.held()) find_pose(group, groups_[g]);
  }
  kinetic_ = kinetic.value();
}

void BodiesIntegrator::find_elastic(std::size_t block) noexcept {
  table_.elastic(block_of(block, nullptr));
}

void BodiesIntegrator::find_forces(std::size_t block) noexcept {
  alignas(64) std::array<double, kernels::n_force_sums * lanes> sums;
  table_.force[beta_](block_of(block, sums.data()));
  add_lanes(sums.data(), sums_[block].force);
}

/// Finds the part of the forces that turning with a body takes away (9.5), (9.6).
void BodiesIntegrator::find_turning() noexcept {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const BodyGroup& group = plan_.groups[g];
    if (group.held()) continue;
    GroupStep& step = groups_[g];
    step.turning.elastic = sum_of(group, &BlockSums::force, kernels::force_moment) / step.inertia;
    if (beta_)
      step.turning.damping = step.factors.beta_over_dt / step.inertia *
                             sum_of(group, &BlockSums::force, kernels::force_change_moment);
  }
}

/// By one thread: sums over bodies, loads and contacts, once the forces are there.
void BodiesIntegrator::between(StepReport& report) noexcept {
  report = {};
  report.step = step_;
  report_frame(report);
  find_turning();
  loads_.find(motion_.data(), frame_.time);
  corrections_.clear();
  if (contact_) solve_contacts(report);
}

/// Velocities and forces of a row.
BodiesIntegrator::Correction BodiesIntegrator::forces_on(int row) const noexcept {
  const std::size_t g = plan_.group_of(row);
  const GroupStep& step = groups_[g];
  const auto i = static_cast<std::size_t>(row);
  const double *motion = motion_.data() + BodyPlan::at(row),
               *constants = plan_.constants.data() + BodyPlan::at(row),
               *force = force_.data() + i / lanes * (beta_ ? 4 : 2) * lanes + i % lanes;
  const Complex turn = turn_of(step.pose);
  Correction on;
  on.row = row;
  on.before = {motion[2 * lanes], motion[3 * lanes]};
  on.load = loads_.on(row);
  on.gradient = turn * Vec2{force[0], force[lanes]};
  if (beta_)
    on.damping = step.factors.beta_over_dt * (turn * Vec2{force[2 * lanes], force[3 * lanes]});
  if (plan_.groups[g].held()) return on;
  const Vec2 across =
      constants[2 * lanes] * turn90(turn * Vec2{constants[0], constants[lanes]});  // m J R arm
  on.gradient -= step.turning.elastic * across;
  on.damping -= step.turning.damping * across;
  return on;
}

/// Δt times the acceleration of the frame at a row.
Vec2 BodiesIntegrator::frame_at(int row) const noexcept {
  const kernels::StepFactors& f = groups_[plan_.group_of(row)].factors;
  const double* constants = plan_.constants.data() + BodyPlan::at(row);
  const Vec2 arm = Vec2{constants[0], constants[lanes]} + displacement_of(row);
  return Complex{f.rate_x, f.rate_y} * arm + Vec2{f.pull_x, f.pull_y};
}

/// v⁺ without impulses (3.4).
Vec2 BodiesIntegrator::free_velocity(const Correction& on) const noexcept {
  const kernels::StepFactors& f = groups_[plan_.group_of(on.row)].factors;
  const double dt_over_mass = plan_.constants.data()[BodyPlan::at(on.row) + 3 * lanes];
  const Vec2 t = dt_over_mass * (on.gradient + on.damping - on.load) + frame_at(on.row) +
                 Complex{f.drag_x, f.drag_y} * on.before;
  return on.before - Complex{f.inverse_x, f.inverse_y} * t;
}

Vec2 BodiesIntegrator::displacement_of(int row) const noexcept {
  const double* motion = motion_.data() + BodyPlan::at(row);
  return {motion[0], motion[lanes]};
}

/// How far a node has come in the last step at most; what is held moves with its frame besides [m]
double BodiesIntegrator::farthest_travel() const noexcept {
  if (plan_.groups.front().held()) return std::numeric_limits<double>::infinity();
  double fastest = 0.0;
  for (const BlockSums& block : sums_)
    fastest = std::max(fastest, block.move[kernels::move_fastest]);
  return model_.dt * std::sqrt(fastest);
}

void BodiesIntegrator::solve_contacts(StepReport& report) noexcept {
  for (const int node : contact_->boundary_after(farthest_travel()))
    if (const int row = plan_.row[static_cast<std::size_t>(node)]; row >= 0)
      contact_->displacement()[static_cast<std::size_t>(node)] = displacement_of(row);
  const std::span<TouchingNode> touching = contact_->find(frame_);
  for (TouchingNode& t : touching) {
    RONDO_ASSERT(plan_.row[static_cast<std::size_t>(t.node)] >= 0, t.node);  // see ContactModel
    corrections_.push_back(forces_on(plan_.row[static_cast<std::size_t>(t.node)]));
    t.before = corrections_.back().before;
    t.free = free_velocity(corrections_.back());
  }
  report.contact = contact_->solve(BodyFrames(model_, frame_), report.frame.center.plane());
  for (std::size_t i = 0; i < touching.size(); ++i) corrections_[i].after = touching[i].after;
  std::ranges::sort(corrections_, {}, &Correction::row);
}

void BodiesIntegrator::move(std::size_t block, const kernels::StepFactors* factors) noexcept {
  alignas(64) std::array<double, kernels::n_move_sums * lanes> sums;
  kernels::BodyBlock b = block_of(block, sums.data());
  b.step = factors;
  table_.move(b);
  add_lanes_of_move(sums.data(), sums_[block].move);
}

void BodiesIntegrator::find_velocities(std::size_t block) noexcept {
  constexpr std::size_t n = kernels::n_velocity_sums, way = kernels::n_move_sums;
  alignas(64) std::array<double, (n + way) * lanes> sums;
  const RowBlock& b = plan_.blocks[block];
  const bool held = plan_.groups[b.group].held();
  const auto first = std::ranges::lower_bound(corrections_, static_cast<int>(b.first_pack * lanes),
                                              {}, &Correction::row);
  const auto last =
      std::lower_bound(first, corrections_.end(), static_cast<int>(b.last_pack * lanes),
                       [](const Correction& c, int row) { return c.row < row; });
  const kernels::BodyBlock work = block_of(block, sums.data());
  if (first == last) {
    table_.velocity_and_move[held][beta_](work);
    add_lanes(sums.data(), sums_[block].velocity);
    add_lanes_of_move(sums.data() + n * lanes, sums_[block].move);
  } else {
    table_.velocity[held][beta_](work);
    add_lanes(sums.data(), sums_[block].velocity);
    for (auto c = first; c != last; ++c) correct(*c, sums_[block]);
    move(block, work.step);
  }
  rest_padding(b);
}

/// Puts in what contact makes of a velocity, and adds to the sums what that changes.
void BodiesIntegrator::correct(const Correction& on, BlockSums& sums) noexcept {
  double* velocity = motion_.data() + BodyPlan::at(on.row) + 2 * lanes;
  const double mass = plan_.constants.data()[BodyPlan::at(on.row) + 2 * lanes];
  const Vec2 free{velocity[0], velocity[lanes]};
  const Vec2 change = on.after - free, other = on.after + free + 2.0 * on.before;
  std::array<double, kernels::n_velocity_sums>& s = sums.velocity;
  s[kernels::velocity_frame] += mass * dot(change, frame_at(on.row));
  s[kernels::velocity_mass] += mass * dot(change, other);  // a² - b² = (a - b)(a + b)
  s[kernels::velocity_stiffness] += dot(change, on.damping);
  s[kernels::velocity_load] += dot(change, on.load);
  s[kernels::velocity_power_after] += dot(change, on.gradient);
  velocity[0] = on.after.x;
  velocity[lanes] = on.after.y;
}

/// Keeps the rows that fill up the last pack of a group where they are.
void BodiesIntegrator::rest_padding(const RowBlock& block) noexcept {
  for (std::size_t i = block.last_pack * lanes; plan_.node[--i] < 0;) {
    double* motion = motion_.data() + BodyPlan::at(static_cast<int>(i));
    for (std::size_t k = 0; k < 4; ++k) motion[k * lanes] = 0.0;
  }
}

/// Strain energy of (5.1) and (9.7), half a step before t_{n+1}.
double BodiesIntegrator::find_strain() noexcept {
  CompensatedSum strain;
  for (const BodyGroup& group : plan_.groups) {
    const auto sum = [&](kernels::VelocitySum which) {
      return sum_of(group, &BlockSums::velocity, which);
    };
    if (group.held()) {
      strain.add(0.5 * sum(kernels::velocity_strain));
      continue;
    }
    const double quarter = 0.25 * model_.dt;
    const double half = 0.25 * sum_of(group, &BlockSums::force, kernels::force_energy);
    double& energy = energy_[static_cast<std::size_t>(group.body)];
    strain.add(energy);
    strain.add(half);
    strain.add(-quarter * sum(kernels::velocity_power_before));
    energy = half + quarter * sum(kernels::velocity_power_after);
  }
  return strain.value();
}

/// By one thread: the ledger.
void BodiesIntegrator::end_step(StepReport& report) noexcept {
  std::array<CompensatedSum, kernels::n_velocity_sums> sums;
  for (const BlockSums& block : sums_)
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k].add(block.velocity[k]);
  const double dt = model_.dt;
  StepEnergy e;
  e.kinetic = 0.5 * kinetic_;
  e.strain = find_strain();
  e.works.frame = -0.5 * sums[kernels::velocity_frame].value();
  e.works.dissipation_mass = 0.25 * dt * model_.mass_damping * sums[kernels::velocity_mass].value();
  e.works.dissipation_stiffness = 0.5 * dt * sums[kernels::velocity_stiffness].value();
  e.works.load = 0.5 * dt * sums[kernels::velocity_load].value();
  set_contact_works(report.contact, e.works);
  ledger_.add(e);
  report.balance = ledger_.last();
}

/// Reports the first body's place and rotation where nothing is held.
void BodiesIntegrator::report_frame(StepReport& report) const noexcept {
  report.frame = frame_;
  if (plan_.groups.front().held() || poses_.empty()) return;
  report.frame.center = poses_.front().center;
  report.frame.angle = poses_.front().angle;
}

}  // namespace rondo::dynamics
