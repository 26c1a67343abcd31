// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/solid_wheel.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

/// Sectors for which the compliance is made beyond those that are needed.
constexpr int spare_sectors = 4;

}  // namespace

SolidWheel::Modes::Modes(const RingHarmonic& of, std::size_t n_branches)
    : strain(of.squares.size(), n_branches) {
  const Index r = of.squares.size(), c = of.contact.rows();
  for (Vector* v : {&state, &before, &work, &shift, &lift, &twist}) v->setZero(2 * r);
  for (Vector* v : {&force, &outside, &held, &pushed}) v->setZero(r);
  for (Vector* v : {&ground, &contact, &answered, &shift_contact, &lift_contact, &twist_contact,
                    &by_rate, &by_place, &by_axial})
    v->setZero(c);
  for (Matrix* m : {&stiff, &inverse, &step}) m->setZero(r, r);
  one.setIdentity(r, r);
  reply.setZero(r, c);
  answer.setZero(c, c);
}

SolidWheel::SolidWheel(const SolidRing& ring, const WheelModel& model,
                       const dynamics::ContactModel& ground, const SolidWheelSettings& settings)
    : ring_(ring),
      harmonics_(model.harmonics),
      model_(model),
      ground_(ground),
      settings_(settings),
      n_contact_(static_cast<int>(ring.contact.size())),
      flat_(!ground.space && ground.ground.bends().empty() && !ground.ground.has_concave_corners()),
      area_(tributaries_of(ring, ground)),
      law_(settings.law_residual) {
  const std::vector<RingResidual>& residuals = model.residuals;
  RONDO_DEMAND(
      residuals.size() == model.squares.size() && (residuals.size() == 1 || residuals.size() == 3),
      residuals.size(), model.squares.size());
  RONDO_DEMAND(settings.dt > 0.0 && model.radius > 0.0 && settings.theta >= 0.5, settings.dt,
               model.radius, settings.theta);
  const std::size_t n = ring.contact.size() * at(ring.n_sectors());
  memory_.resize(n);
  centrifugal_ = residuals.front().centrifugal;
  if (!model.creep.empty())
    creep_.emplace(model.creep, residuals, model.later, ring.stiffness.turn,
                   settings.stiffness_damping, settings.dt);
  if (residuals.size() > 1 || creep_) {
    tables_.resize(residuals.front().blocks.size());
    made_.assign(at(ring.n_sectors()), -1);
  }
  in_sector_.resize(at(ring.n_contact()));
  near_.reserve(n);
  seen_.reserve(n);
  moved_.reserve(3 * n);
  solved_.reserve(n);
  touch_.reserve(n);
  cones_.reserve(n);
  before_.reserve(n);
  place_before_.reserve(n);
  if (!ground.law.friction.is_constant())
    friction_ = [this](std::size_t candidate, double slip, double force) {
      return friction_at(candidate, slip, force);
    };
  contacts_.reserve(n);
  for (const RingHarmonic& h : harmonics_) modes_.emplace_back(h, model.branches.size());
}

/// The residual of a spin.
void SolidWheel::set_residual(double spin) {
  n_made_ = 0;
  ++version_;
  if (tables_.empty()) return;
  const double square = spin * spin;
  centrifugal_.setZero();
  for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
    double share = 1.0;
    for (std::size_t b = 0; b < model_.residuals.size(); ++b)
      if (b != a) share *= (square - model_.squares[b]) / (model_.squares[a] - model_.squares[b]);
    shares_[a] = share;
    centrifugal_ += share * model_.residuals[a].centrifugal;
  }
  if (creep_) creep_->use(shares_);
}

/// G of a lag; at a spin between those of the model made when it is asked for, as few lags are.
Eigen::Map<const Eigen::MatrixXd> SolidWheel::beyond(int lag) const {
  if (tables_.empty()) return model_.residuals.front().block(lag);
  const Index size = ring_.n_contact();
  const int d = wrapped(lag);
  double* const block = tables_.data() + d * size * size;
  if (made_[at(d)] == version_) return {block, size, size};
  made_[at(d)] = version_;
  Eigen::Map<Eigen::MatrixXd> sum(block, size, size);
  sum.setZero();
  for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
    const double share = shares_[a];
    sum += (creep_ ? share * creep_->memory().new_at_once() : share) * model_.residuals[a].block(d);
    if (creep_) sum += share * creep_->memory().new_later() * model_.later[a].block(d);
  }
  return {block, size, size};
}

/// What the residual of a node does by a force on another that has always been there.
Eigen::Matrix3d SolidWheel::held(int to, int from) const {
  const int lag = sector(to) - sector(from);
  const Index row = Index{3} * local(to), column = Index{3} * local(from);
  if (!creep_) return beyond(lag).block<3, 3>(row, column);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t a = 0; a < model_.residuals.size(); ++a)
    sum +=
        shares_[a] *
        (creep_->memory().held_at_once() * model_.residuals[a].block(lag).block<3, 3>(row, column) +
         creep_->memory().held_later() * model_.later[a].block(lag).block<3, 3>(row, column));
  return sum;
}

/// What the residual of a node does by a force on another.
Vec3 SolidWheel::product(int to, int from, Vec3 force) const noexcept {
  const auto g = beyond(sector(to) - sector(from));
  const Index row = Index{3} * local(to), column = Index{3} * local(from);
  const auto line = [&](Index r) {
    return g(row + r, column) * force.x + g(row + r, column + 1) * force.y +
           g(row + r, column + 2) * force.z;
  };
  return {line(0), line(1), line(2)};
}

/// What the residual of all nodes that are remembered does, by the tables of the spin.
void SolidWheel::renew_residuals() {
  if (creep_) return;
  for (const int to : seen_) {
    Vec3 u;
    for (const int from : seen_)
      if (const Vec3 force = memory_of(from).filtered; force != Vec3{})
        u += product(to, from, force);
    memory_of(to).residual = u;
  }
}

/// Finds the matrices of a harmonic. With h = ½Δt the middle of the step solves
/// [c, -h; hL, c + hD] (y_m, p_m) = (y, p + hf).
void SolidWheel::fill_step(std::size_t harmonic, double spin, double rate) {
  const RingHarmonic& of = harmonics_[harmonic];
  Modes& s = modes_[harmonic];
  const double half = 0.5 * settings_.dt;
  s.turn = 1.0 + half * Complexes(0.0, of.k * spin);
  s.lever = half / s.turn;
  s.stiff = rate * of.coriolis - spin * spin * of.planar;
  s.stiff.diagonal().array() += of.squares.array();
  const auto damping = settings_.mass_damping + settings_.stiffness_damping * of.squares.array();
  s.step = 2.0 * half * spin * of.coriolis + half * s.lever * s.stiff;
  s.step.diagonal().array() += s.turn + half * damping;
  branches(harmonic).add_to(s.step);
  s.factor.compute(s.step);
  s.inverse = s.factor.solve(s.one);
  const double share = settings_.theta * settings_.dt * of.weight() / ring_.n_sectors();
  s.reply.noalias() = s.inverse * of.contact.adjoint();
  s.answer.noalias() = share * s.lever * of.contact * s.reply;
}

/// The strains of the branches at the end of the step.
void SolidWheel::relax_modes() {
  for (std::size_t h = 0; h < modes_.size(); ++h)
    modes_[h].strain.relax(branches(h), modes_[h].before, modes_[h].state);
}

/// (2r) What a force on the modes does in a step.
void SolidWheel::push_by(const Modes& s, const Vector& force, Vector& out) const {
  const Index r = s.force.size();
  out.tail(r).noalias() = s.inverse * force;
  out.tail(r) *= settings_.dt;
  out.head(r) = s.lever * out.tail(r);
}

/// The matrices of a step, and the answers of the contact nodes at its end.
void SolidWheel::use_spin(const SolidMotion& motion) {
  const WheelMotion& m = motion.plane;
  const double rate = m.kept_spin ? 0.0 : m.spin_rate, end = m.kept_spin.value_or(m.spin_next);
  new_table_ = rate != 0.0 || !has_matrices_ || spin_rate_ != 0.0 || spin_ != end;
  if (new_table_) take_spin(m, rate, end);
  if (m.kept_spin && !has_shift_) shift_modes();
}

void SolidWheel::take_spin(const WheelMotion& m, double rate, double end) {
  residual_before_ = residual_stored();
  const bool other_spin = spin_ != end;
  spin_ = end;
  spin_rate_ = rate;
  const double spin = rate == 0.0 ? end : (m.angle_next - m.angle) / settings_.dt;
  set_residual(end);
  for (std::size_t h = 0; h < harmonics_.size(); ++h) fill_step(h, spin, rate);
  if (other_spin && !tables_.empty()) renew_residuals();
  has_matrices_ = true;
  has_shift_ = false;
}

/// W of the window: G/(1 + β/Δt) and the answer of the modes, block after block by the lag.
void SolidWheel::make_window() {
  if (n_window_ <= n_made_) return;
  n_made_ = std::min(n_window_ + spare_sectors, ring_.n_sectors());
  const Index size = ring_.n_contact();
  window_.resize(size, n_made_);
  const double share = 1.0 - filter();
  for (int lag = 1 - n_made_; lag < n_made_; ++lag) {
    block_ = share * beyond(lag);
    for (std::size_t h = 0; h < modes_.size(); ++h) {
      const Complex turn =
          ring_.stiffness
              .turn[at(static_cast<long long>(harmonics_[h].k) * wrapped(lag) % ring_.n_sectors())];
      block_ += turn.re * modes_[h].answer.real() - turn.im * modes_[h].answer.imag();
    }
    window_.set(lag, block_);
  }
}

/// The modes at the end of the step without new forces.
void SolidWheel::move_modes(const SolidMotion& motion) {
  const WheelMotion& m = motion.plane;
  const double spin = (m.angle_next - m.angle) / settings_.dt;
  const Vec3 pull = motion.attitude_next.from_fixed(Vec3(m.pull, motion.lateral_pull));
  const Complexes back(pull.x, -pull.y);  // conj
  const Complexes tilting = motion.tilting(spin);
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    s.outside.setZero();
    if (of.k == 0)
      s.outside =
          spin * spin * of.reference - m.spin_rate * of.turned - pull.z * of.axial + of.load;
    if (of.k == 1) {
      s.outside -= 0.5 * back * of.translation.conjugate();
      s.outside -= tilting * of.tilt;
    }
    if (m.kept_spin) s.outside.noalias() -= m.spin_rate * (of.coriolis * s.state.head(r));
    s.before = s.state;
    s.held = (1.0 - settings_.theta) * s.force;
    s.pushed = s.outside + s.held;
    const auto y = s.before.head(r), p = s.before.tail(r);
    s.pushed *= 0.5 * settings_.dt;
    s.pushed += p;
    s.pushed.noalias() -= s.lever * (s.stiff * y);
    if (creep_) s.strain.take_from(branches(h), s.pushed);
    s.state.tail(r).noalias() = s.inverse * s.pushed;  // the middle
    s.state.head(r) = 2.0 * (y / s.turn + s.lever * s.state.tail(r)) - y;
    s.state.tail(r) = 2.0 * s.state.tail(r) - p;
  }
  move_contact();
}

/// What the modes do to the contact nodes.
void SolidWheel::move_contact() {
  for (std::size_t h = 0; h < modes_.size(); ++h)
    modes_[h].contact.noalias() =
        harmonics_[h].contact * modes_[h].state.head(harmonics_[h].squares.size());
}

/// Displacement of a contact node by the modes. @param of (3C) amplitudes of each harmonic
Vec3 SolidWheel::modal(int node, Complex turn, const Vector Modes::*of) const noexcept {
  const Index c = Index{3} * local(node);
  Vec3 u;
  for_waves(harmonics_, turn, [&](std::size_t h, Complex wave) {
    const Complexes* amplitude = (modes_[h].*of).data() + c;
    const double weight = harmonics_[h].weight();
    u += weight * Vec3(real_product(wave, amplitude[0]), real_product(wave, amplitude[1]),
                       real_product(wave, amplitude[2]));
  });
  return u;
}

SolidWheelReport SolidWheel::step(const SolidMotion& m) {
  SolidWheelReport report;
  use_spin(m);
  move_modes(m);
  find_near(m);
  solve(m, report);
  take_forces(m, report);
  account(m, report);
  remember(m);
  return report;
}

}  // namespace rondo::rom
