// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {

using Eigen::Index;

RingWheel::Real::Real(const Eigen::MatrixXd& shapes) : contact(shapes.transpose()) {
  const Index r = contact.rows(), c = contact.cols();
  for (Eigen::MatrixXd* m : {&step, &inverse}) m->setZero(r, r);
  one.setIdentity(r, r);
  for (Eigen::VectorXd* v : {&place, &push}) v->setZero(r);
  reply.setZero(r, c);
  made.resize(at(c / 2));
}

RingWheel::RingWheel(const Ring& ring, const WheelModel& model, const contact::Ground& ground,
                     const WheelSettings& settings)
    : ReducedWheel(ring, model, settings, ground.bends().empty() && !ground.has_concave_corners()),
      ground_(ground),
      friction_(settings.friction),
      slip_(settings.slip),
      gap_law_(ring.contact.size() * at(ring.n_sectors())) {
  const std::vector<RingResidual>& residuals = model.residuals;
  beyond_.resize(residuals.front().blocks.size() / 4);
  compliance_.resize(beyond_.size());
  made_.resize(beyond_.size());
  beyond_made_.resize(beyond_.size());
  const std::size_t n = ring.contact.size() * at(ring.n_sectors());
  memory_.resize(n);
  for (int node = 0; node < n_nodes(); ++node)
    reference_.push_back(ring.stiffness.turn[at(sector(node))] * arm(node));
  active_.reserve(n);
  near_.reserve(n);
  reply_.resize(4 * n * n);
  moved_.resize(2 * n);
  touch_.reserve(n);
  law_.reserve(n);
  law_before_.reserve(n);
  contacts_.reserve(n);
  if (!model.creep.empty()) {
    creep_.emplace(model.creep, residuals, model.later, n, settings.stiffness_damping, settings.dt);
    forces_.reserve(n);
  }
  if (!settings.friction.is_constant())
    sliding_.emplace(settings.friction, settings.lengths, n, settings.dt);
  if (!is_whole()) return;
  std::vector<Vec2> arms;
  for (int node = 0; node < n_contact_; ++node) arms.push_back(arm(node));
  left_.emplace(arms);
  real_ = Real(harmonics_.empty() ? Eigen::MatrixXd(ring.n_contact(), 0)
                                  : Eigen::MatrixXd(harmonics_[0].contact.real()));
}

/// The tables of a viscous wheel at the spin, by their shares.
RingWheel::Block RingWheel::of_tables(int to, int from, double at_once, double later) const {
  const Index size = ring_.n_contact();
  const Index first = (lag(to, from) * size + Index{2} * local(from)) * size + Index{2} * local(to);
  Block sum{};
  for (std::size_t a = 0; a < model_.residuals.size(); ++a)
    for (const auto& [g, share] :
         {std::pair{model_.residuals[a].blocks.data() + first, shares_[a] * at_once},
          std::pair{model_.later[a].blocks.data() + first, shares_[a] * later}})
      sum = contact::sum(sum, {share * g[0], share * g[size], share * g[1], share * g[size + 1]});
  return sum;
}

/// What a force that has always been there does.
RingWheel::Block RingWheel::held(int to, int from) const {
  if (!creep_) return beyond(to, from);
  const CreepMemory& creep = creep_->memory();
  return of_tables(to, from, creep.held_at_once(), creep.held_later());
}

/// G of a pair at the spin, made when it is asked for; of a viscous wheel what a new force does at
/// the end of its step.
void RingWheel::make_beyond(int to, int from) const {
  const std::size_t p = pair(to, from);
  if (creep_) {
    const CreepMemory& creep = creep_->memory();
    beyond_[p] = of_tables(to, from, creep.new_at_once(), creep.new_later());
    beyond_made_[p] = version_;
    return;
  }
  const Index size = ring_.n_contact();
  const Index first = (lag(to, from) * size + Index{2} * local(from)) * size + Index{2} * local(to);
  Block& sum = beyond_[p];
  sum = {};
  for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
    const double* g = model_.residuals[a].blocks.data() + first;
    const double share = shares_[a];
    sum = contact::sum(sum, {share * g[0], share * g[size], share * g[1], share * g[size + 1]});
  }
  beyond_made_[p] = version_;
}

void RingWheel::fill_step(std::size_t harmonic, double spin, double rate) {
  const RingHarmonic& of = harmonics_[harmonic];
  Modes& s = modes_[harmonic];
  const double half = 0.5 * settings_.dt;
  fill_lever(harmonic, spin);
  s.stiff = (of.squares.array() - spin * spin).matrix();
  s.twisted = rate;
  const auto damping = settings_.mass_damping + settings_.stiffness_damping * of.squares.array();
  if (is_whole()) {
    real_.step = (2.0 * half * spin + half * rate * half) * of.coriolis.real();
    real_.step.diagonal().array() += 1.0 + half * damping + half * half * s.stiff.array();
    for (std::size_t b = 0; b < model_.branches.size(); ++b)
      real_.step.diagonal() +=
          (half * half * model_.branches[b].relative_modulus * branches(harmonic).share(b).real()) *
          of.squares;
    real_.factor.compute(real_.step);
    real_.inverse = real_.factor.solve(real_.one);
    s.inverse = real_.inverse.cast<Complexes>();
    return;
  }
  s.step = (2.0 * half * spin + half * rate * s.lever) * of.coriolis;
  s.step.diagonal().array() += s.turn + half * damping + half * s.lever * s.stiff.array();
  factorise(harmonic);
}

/// W[lag] = G[lag]/(1 + β/Δt) + the modes' answer of a pair, made when it is asked for.
void RingWheel::make_answer(int to, int from) {
  const int d = lag(to, from), n = ring_.n_sectors();
  Block by_modes = is_whole() ? whole_answer(to, from) : Block{};
  for (std::size_t h = 0; h < modes_.size() && !is_whole(); ++h) {
    const Modes& s = modes_[h];
    const Complex turn = ring_.stiffness.turn[at(harmonics_[h].k * d % n)];
    const std::complex<double>* x = &s.answer(Index{2} * local(to), Index{2} * local(from));
    const Index below = s.answer.rows();
    by_modes = contact::sum(by_modes, {real_product(turn, x[0]), real_product(turn, x[below]),
                                       real_product(turn, x[1]), real_product(turn, x[below + 1])});
  }
  const double share = creep_ ? 1.0 : 1.0 / (1.0 + settings_.stiffness_damping / settings_.dt);
  const Block& g = beyond(to, from);
  const std::size_t p = pair(to, from);
  compliance_[p] = contact::complex_block(
      contact::sum({share * g[0], share * g[1], share * g[2], share * g[3]}, by_modes));
  compliance_[p].same = ring_.stiffness.turn[at(d)] * compliance_[p].same;
  made_[p] = version_;
}

/// What the modes answer, of a ring of one sector.
RingWheel::Block RingWheel::whole_answer(int to, int from) {
  if (modes_.empty()) return {};
  auto reply = real_.reply.middleCols<2>(Index{2} * from);
  if (real_.made[at(from)] != version_) {
    reply.noalias() = real_.inverse * real_.contact.middleCols<2>(Index{2} * from);
    reply *= settings_.theta * settings_.dt * modes_[0].lever.real();
    real_.made[at(from)] = version_;
  }
  const auto a = real_.contact.col(Index{2} * to), b = real_.contact.col(Index{2} * to + 1);
  return {a.dot(reply.col(0)), a.dot(reply.col(1)), b.dot(reply.col(0)), b.dot(reply.col(1))};
}

/// Finds what the forces of the step before would do to the modes if they stayed in space. Without
/// it a mean over the step that is not in its middle moves these forces on with the nodes.
void RingWheel::leave_forces(const WheelMotion& m) {
  left_->clear();
  for_remembered([&](int node) {
    if (const Vec2 force = memory_of(node).force; force != Vec2{})
      left_->add(node, force, m.angle_next - m.angle);
  });
  if (modes_.empty()) return;
  modes_[0].left.setZero();
  for (const LeftBehind::Share& share : left_->shares())
    modes_[0].left.real() += real_.on_modes(share.node, share.force);
}

Eigen::MatrixXd RingWheel::compliance(int lag) {
  RONDO_DEMAND(has_matrices_);
  const int n = ring_.n_sectors(), d = (lag % n + n) % n;
  Eigen::MatrixXd w(ring_.n_contact(), ring_.n_contact());
  for (int from = 0; from < n_contact_; ++from)
    for (int to = 0; to < n_contact_; ++to) {
      contact::ComplexBlock block = answer(d * n_contact_ + to, from);
      block.same = conj(ring_.stiffness.turn[at(d)]) * block.same;
      const Block b = contact::block_of(block);
      w.block<2, 2>(Index{2} * to, Index{2} * from) << b[0], b[1], b[2], b[3];
    }
  return w;
}

/// The modes at the end of the step without new forces.
void RingWheel::move_modes(const WheelMotion& m) {
  const double spin = (m.angle_next - m.angle) / settings_.dt;
  const Complexes back(m.pull.x, -m.pull.y);  // conj
  const Vec2 own_pull = rotation(-0.5 * (m.angle + m.angle_next)) * m.pull;
  if (is_whole()) leave_forces(m);
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    s.outside.setZero();
    if (of.k == 0) s.outside = spin * spin * of.reference - m.spin_rate * of.turned;
    if (is_whole())
      s.outside -= (Complexes(own_pull.x, own_pull.y) * of.translation).real().cast<Complexes>();
    else if (of.k == 1)
      s.outside -= 0.5 * back * of.translation.conjugate();
    if (m.kept_spin) s.outside.noalias() -= m.spin_rate * (of.coriolis * s.state.head(r));
    s.before = s.state;
    if (is_whole())
      s.held = 0.5 * s.force - (settings_.theta - 0.5) * s.left;
    else
      s.held = (1.0 - settings_.theta) * s.force;
    s.pushed = s.outside + s.held;
    const auto y = s.before.head(r), p = s.before.tail(r);
    s.pushed *= 0.5 * settings_.dt;
    s.pushed += p - s.lever * s.stiff.cwiseProduct(y);
    if (creep_) s.strain.take_from(branches(h), s.pushed);
    if (s.twisted != 0.0) s.pushed.noalias() -= s.lever * s.twisted * (of.coriolis * y);
    finish_middle(h);
  }
  move_contact();
}

WheelReport RingWheel::step(const WheelMotion& m) {
  WheelReport report;
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
