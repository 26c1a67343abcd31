// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/general_integrator.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {

// Kept impulses of implicit elements and of other contacts are saved in one list.
static_assert(ImplicitContact::key_bits >> 62U > static_cast<std::uint64_t>(ContactKind::segment));

GeneralIntegrator::GeneralIntegrator(const Model& model, const State& start)
    : ReadableStep(model, start), forces_(model, start), contact_(model) {
  RONDO_DEMAND(!model.rim && (model.free_bodies.empty() || model.scheme == Scheme::symplectic));
  RONDO_DEMAND(start.poses.size() == model.free_bodies.size(), start.poses.size(),
               model.free_bodies.size());
  take_poses();
  if (model.implicit) set_implicit();
  if (!has_massless_contact(model)) return;
  RONDO_DEMAND(model.scheme == Scheme::symplectic && model.free_bodies.empty() &&
               !model.internal_force);
  ring_.emplace(model);
  move_ring(BodyFrame(model, state_.frame).contact);
}

void GeneralIntegrator::set_implicit() {
  NodeSet nodes = node_set(model_, model_.implicit->nodes);
  RONDO_DEMAND(nodes.size() > 0, model_.n_nodes());
  const double spin = factored_spin(model_);
  implicit_velocity_ = PlaneField(nodes.size());
  auto implicit = assembled_operator(model_, nodes, spin);
  implicit_ =
      std::make_unique<ImplicitElements>(model_, std::move(nodes), std::move(implicit), spin);
  if (implicit_->contact()) contact_.leave_out(implicit_->contact()->is_held());
}

void GeneralIntegrator::take_poses() noexcept {
  const std::span<const Pose> poses = forces_.poses();
  RONDO_ASSERT(poses.size() == state_.poses.size(), poses.size(), state_.poses.size());
  std::ranges::copy(poses, state_.poses.begin());
}

/// u_{n+1}, and ½ vᵀ M v before it.
void GeneralIntegrator::move(double& kinetic) noexcept {
  const std::span u = state_.u.plane(), v = state_.v.plane();
  for_free_nodes(model_, [&](std::size_t k) {
    u[k] += model_.dt * v[k];
    kinetic += 0.5 * model_.mass[k] * dot(v[k], v[k]);
  });
}

/// Forces at u_{n+1} and the frame of this step; the strain energy of the half step before.
void GeneralIntegrator::find_forces(double& strain) noexcept {
  state_.frame = frame_step(model_.motion, state_.step, model_.dt);
  strain = forces_.evaluate(state_.u, state_.v, state_.frame);
  take_poses();
}

/// In the order of the candidates; the two of a node one after the other.
void GeneralIntegrator::add_active(std::span<const ActiveContact> more) {
  state_.active.insert(state_.active.end(), more.begin(), more.end());
  std::ranges::stable_sort(state_.active, {}, [](const ActiveContact& a) { return a.candidate; });
}

/// v⁺ of the nodes without mass, by where they are at its end.
void GeneralIntegrator::move_ring(const ContactStep& step) noexcept {
  RingMotion& motion = ring_->motion();
  const std::span<const int> nodes = ring_->nodes(), around = ring_->neighbours();
  RONDO_ASSERT(
      motion.place.size() == nodes.size() + around.size() && motion.rate.size() == around.size(),
      motion.place.size(), motion.rate.size(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    motion.place[i] = state_.u.plane()[at(nodes[i])];
    motion.before[i] = state_.v.plane()[at(nodes[i])];
  }
  for (std::size_t i = 0; i < around.size(); ++i) {
    motion.rate[i] = state_.v_next.plane()[at(around[i])];
    motion.place[nodes.size() + i] = state_.u.plane()[at(around[i])] + model_.dt * motion.rate[i];
  }
  ring_->solve(step);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    state_.v_next.plane()[at(nodes[i])] = ring_->velocity()[i];
}

ContactReport GeneralIntegrator::solve_contacts(const BodyFrames& frames,
                                                const StepReport& report) noexcept {
  if (!ring_) {
    const ContactReport found = contact_.solve(frames, report.frame.center.plane(), state_);
    if (implicit_ && implicit_->contact()) add_active(implicit_->contact()->active());
    return found;
  }
  const ContactStep step = BodyFrame(model_, state_.frame).contact;
  move_ring(step);
  return ring_->report(step, report.frame.center.plane(), state_.active);
}

/// v⁺ = v⁻ + [Δt f/m - drag v⁻]/a, without contact (3.4).
void GeneralIntegrator::free_velocities(const BodyFrames& frames) noexcept {
  const double dt = model_.dt;
  const std::span u = state_.u.plane(), v = state_.v.plane(), v_next = state_.v_next.plane();
  for_free_nodes(model_, [&](std::size_t k) {
    if (model_.mass[k] == 0.0) return;  // of the ring
    const BodyFrame& f = frames.of(model_, k);
    const Vec2 force = -forces_.gradient(k) - forces_.damping(k) + forces_.load(k);
    const Vec2 acceleration =
        force / model_.mass[k] - frame_acceleration(f.frame, model_.reference[k] + u[k]);
    v_next[k] = v[k] + (dt * acceleration - f.update.drag * v[k]) / f.update.a;
  });
}

/// v⁺ of the nodes of implicit elements, and their contacts (3.9).
void GeneralIntegrator::correct_implicit(const BodyFrames& frames, StepEnergy& energy,
                                         ContactReport& report) {
  ImplicitElements& implicit = *implicit_;
  const std::vector<int>& nodes = implicit.nodes().node;
  PlaneField& v = implicit_velocity_;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto k = static_cast<std::size_t>(nodes[i]);
    implicit.u().put(i, state_.u.plane()[k]);
    implicit.before().put(i, state_.v.plane()[k]);
    v.put(i, state_.v_next.plane()[k]);
  }
  const BodyFrame& frame = frames.of(model_, static_cast<std::size_t>(nodes.front()));
  const ImplicitEnergy more =
      implicit.solve(frame.frame.spin, model_.contact ? &frame.contact : nullptr, v, report);
  for (std::size_t i = 0; i < nodes.size(); ++i) state_.v_next.plane()[at(nodes[i])] = v.at(i);
  energy.strain += more.strain;
  energy.works.dissipation_stiffness += more.dissipation_stiffness;
}

/// (5.3)
void GeneralIntegrator::add_works(const BodyFrames& frames, Works& w) const noexcept {
  const double dt = model_.dt;
  const std::span u = state_.u.plane(), v = state_.v.plane(), v_next = state_.v_next.plane();
  for_free_nodes(model_, [&](std::size_t k) {
    const double m = model_.mass[k];
    const FrameStep& frame = frames.of(model_, k).frame;
    const Vec2 mean = 0.5 * (v[k] + v_next[k]);
    const Vec2 taken = velocity_of_terms(model_.scheme, v[k], mean);
    w.frame -= dt * m * dot(mean, frame_acceleration(frame, model_.reference[k] + u[k]));
    w.dissipation_mass += dt * model_.mass_damping * m * dot(mean, taken);
    w.dissipation_stiffness += dt * dot(mean, forces_.damping(k));
    w.load += dt * dot(mean, forces_.load(k));
    w.scheme -= 2.0 * dt * frame.spin * m * dot(mean, turn90(taken));
  });
}

/// Reports the first body's place and rotation where nothing is held.
void GeneralIntegrator::report_frame(StepReport& report) const noexcept {
  report.frame = state_.frame;
  std::size_t n_free = 0;
  for (const FreeBody& body : model_.free_bodies) n_free += body.nodes.size();
  if (n_free != model_.free.size() || state_.poses.empty()) return;
  report.frame.center = state_.poses.front().center;
  report.frame.angle = state_.poses.front().angle;
}

void GeneralIntegrator::make_step(StepEnergy& energy, StepReport& report) noexcept {
  std::swap(state_.v, state_.v_next);
  move(energy.kinetic);
  find_forces(energy.strain);
  const BodyFrames frames(model_, state_.frame);
  free_velocities(frames);
  report_frame(report);
  ContactReport on_implicit;  // before the ring, which follows what is around it
  if (implicit_) correct_implicit(frames, energy, on_implicit);
  report.contact = solve_contacts(frames, report);
  report.contact.add(on_implicit);
  add_works(frames, energy.works);
  set_contact_works(report.contact, energy.works);
  report.material = forces_.material();
}

std::vector<contact::ProblemFile> GeneralIntegrator::take_difficult() {
  std::vector<contact::ProblemFile> problems =
      (ring_ ? ring_->coupled() : contact_.coupled()).difficult.take();
  if (implicit_ && implicit_->contact())
    for (contact::ProblemFile& problem : implicit_->contact()->coupled().difficult.take())
      problems.push_back(std::move(problem));
  return problems;
}

void GeneralIntegrator::save_fields(SavedState& saved) const {
  ReadableStep::save_fields(saved);
  forces_.save(saved);
  saved.impulses = contact_.coupled().kept;
  if (ring_) saved.ring = ring_->save();
  if (implicit_ && implicit_->contact())
    for (const auto& impulse : implicit_->contact()->coupled().kept)
      saved.impulses.push_back(impulse);
}

void GeneralIntegrator::restore_fields(const SavedState& saved) {
  ReadableStep::restore_fields(saved);
  forces_.restore(saved);
  take_poses();
  contact_.coupled().kept = saved.impulses;
  if (ring_) ring_->restore(saved.ring);
  if (implicit_ && implicit_->contact()) implicit_->contact()->coupled().kept = saved.impulses;
}

}  // namespace rondo::dynamics
