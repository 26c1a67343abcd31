// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/ring_wheel.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

}  // namespace

RingWheel::Modes::Modes(const RingHarmonic& of) {
  const Index r = of.squares.size(), c = of.contact.rows();
  for (Vector* v : {&state, &before, &work, &shift, &twist}) v->setZero(2 * r);
  for (Vector* v : {&force, &outside, &held, &left, &pushed}) v->setZero(r);
  for (Vector* v : {&ground, &contact, &shift_contact, &twist_contact, &by_rate, &by_place})
    v->setZero(c);
  stiff.setZero(r);
  inverse.setZero(r, r);
  one.setIdentity(r, r);
}

RingWheel::RingWheel(const Ring& ring, const WheelModel& model, const contact::Ground& ground,
                     const WheelSettings& settings)
    : ring_(ring),
      harmonics_(model.harmonics),
      model_(model),
      ground_(ground),
      settings_(settings),
      n_contact_(static_cast<int>(ring.contact.size())),
      flat_(ground.bends().empty() && !ground.has_concave_corners()),
      gap_law_(ring.contact.size() * at(ring.n_sectors())) {
  const std::vector<RingResidual>& residuals = model.residuals;
  RONDO_DEMAND(
      residuals.size() == model.squares.size() && (residuals.size() == 1 || residuals.size() == 3),
      residuals.size(), model.squares.size());
  RONDO_DEMAND(settings.dt > 0.0 && model.radius > 0.0 && settings.theta >= 0.5, settings.dt,
               model.radius, settings.theta);
  centrifugal_ = residuals.front().centrifugal;
  beyond_.resize(residuals.front().blocks.size() / 4);
  compliance_.resize(beyond_.size());
  const std::size_t n = ring.contact.size() * at(ring.n_sectors());
  memory_.resize(n);
  for (std::size_t node = 0; node < n; ++node) {
    sector_.push_back(static_cast<int>(node) / n_contact_);
    local_.push_back(static_cast<int>(node) % n_contact_);
    reference_.push_back(ring.stiffness.turn[at(sector_.back())] * arm(static_cast<int>(node)));
  }
  active_.reserve(n);
  near_.reserve(n);
  seen_.reserve(n);
  reply_.resize(4 * n * n);
  moved_.resize(2 * n);
  solved_.reserve(n);
  touch_.reserve(n);
  law_.reserve(n);
  contacts_.reserve(n);
  for (const RingHarmonic& h : harmonics_) modes_.emplace_back(h);
  if (!is_whole()) return;
  std::vector<Vec2> arms;
  for (int node = 0; node < n_contact_; ++node) arms.push_back(arm(node));
  left_.emplace(arms);
}

/// The residual of a spin.
void RingWheel::set_residual(double spin) {
  const double square = spin * spin;
  centrifugal_.setZero();
  for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
    double share = 1.0;
    for (std::size_t b = 0; b < model_.residuals.size(); ++b)
      if (b != a) share *= (square - model_.squares[b]) / (model_.squares[a] - model_.squares[b]);
    shares_[a] = share;
    centrifugal_ += share * model_.residuals[a].centrifugal;
  }
  const Index size = ring_.n_contact();
  Block* out = beyond_.data();
  for (Index column = 0; column < size * ring_.n_sectors(); column += 2)
    for (Index row = 0; row < size; row += 2, ++out) {
      *out = {};
      for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
        const double* g = model_.residuals[a].blocks.data() + column * size + row;
        const double share = shares_[a];
        *out =
            contact::sum(*out, {share * g[0], share * g[size], share * g[1], share * g[size + 1]});
      }
    }
}

/// Finds the matrices of a harmonic. With h = ½Δt the middle of the step solves
/// [c, -h; hL, c + hD] (y_m, p_m) = (y, p + hf).
void RingWheel::fill_step(const RingHarmonic& of, double spin, double rate, Modes& s) const {
  const double half = 0.5 * settings_.dt;
  s.turn = 1.0 + half * Complexes(0.0, of.k * spin);
  s.lever = half / s.turn;
  s.stiff = (of.squares.array() - spin * spin).matrix();
  s.twisted = rate;
  const auto damping = settings_.mass_damping + settings_.stiffness_damping * of.squares.array();
  s.step = (2.0 * half * spin + half * rate * s.lever) * of.coriolis;
  s.step.diagonal().array() += s.turn + half * damping + half * s.lever * s.stiff.array();
  s.factor.compute(s.step);
  s.inverse = s.factor.solve(s.one);
}

/// (2r) What a force on the modes does in a step.
void RingWheel::push_by(const Modes& s, const Vector& force, Vector& out) const {
  const Index r = s.stiff.size();
  out.tail(r).noalias() = s.inverse * force;
  out.tail(r) *= settings_.dt;
  out.head(r) = s.lever * out.tail(r);
}

/// The matrices of a step, and the answers of the contact nodes at its end.
void RingWheel::use_spin(const WheelMotion& m) {
  const double rate = m.kept_spin ? 0.0 : m.spin_rate, end = m.kept_spin.value_or(m.spin_next);
  const bool same = has_matrices_ && spin_rate_ == 0.0 && spin_ == end;
  new_table_ = rate != 0.0 || !same;
  if (new_table_) take_spin(m, rate, end);
  if (m.kept_spin && !has_shift_) shift_modes();
}

void RingWheel::take_spin(const WheelMotion& m, double rate, double end) {
  residual_before_ = 0.5 * products().end;
  spin_ = end;
  spin_rate_ = rate;
  has_matrices_ = true;
  const double dt = settings_.dt;
  const double spin = rate == 0.0 ? end : (m.angle_next - m.angle) / dt;
  set_residual(end);
  for (std::size_t h = 0; h < harmonics_.size(); ++h)
    fill_step(harmonics_[h], spin, rate, modes_[h]);
  has_shift_ = false;
  near_compliance_ = is_whole() && rate != 0.0;
  if (!near_compliance_) fill_compliance();
}

/// The angle at which the modes are at the end of the step.
double RingWheel::waves_at(const WheelMotion& m) const noexcept {
  return m.kept_spin ? m.angle + settings_.dt * *m.kept_spin : m.angle_next;
}

/// W[lag] = G[lag]/(1 + β/Δt) + the modes' answer.
void RingWheel::fill_compliance() {
  const double lag = settings_.stiffness_damping / settings_.dt;
  const Index size = ring_.n_contact();
  const int n = ring_.n_sectors();
  std::vector<Matrix> of_modes;
  for (std::size_t h = 0; h < harmonics_.size(); ++h)
    of_modes.push_back(settings_.theta * settings_.dt * harmonics_[h].weight() / n *
                       (modes_[h].lever * (harmonics_[h].contact * modes_[h].inverse *
                                           harmonics_[h].contact.adjoint())));
  Eigen::MatrixXd w(size, size);
  const Block* g = beyond_.data();
  contact::ComplexBlock* out = compliance_.data();
  for (int d = 0; d < n; ++d) {
    w.setZero();
    for (std::size_t h = 0; h < harmonics_.size(); ++h) {
      const Complex turn = ring_.stiffness.turn[at(harmonics_[h].k * d % n)];
      w += turn.re * of_modes[h].real() - turn.im * of_modes[h].imag();
    }
    for (Index from = 0; from < size; from += 2)
      for (Index to = 0; to < size; to += 2, ++g, ++out) {
        *out = contact::complex_block(
            {(*g)[0] / (1.0 + lag) + w(to, from), (*g)[1] / (1.0 + lag) + w(to, from + 1),
             (*g)[2] / (1.0 + lag) + w(to + 1, from), (*g)[3] / (1.0 + lag) + w(to + 1, from + 1)});
        out->same = ring_.stiffness.turn[at(d)] * out->same;
      }
  }
}

/// Fills W of a ring of one sector, for the pairs of near nodes alone.
void RingWheel::fill_near_compliance() {
  const double lag = settings_.stiffness_damping / settings_.dt;
  const Index n = static_cast<Index>(near_.size());
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (std::size_t h = 0; h < harmonics_.size(); ++h) {
    const Index r = harmonics_[h].squares.size();
    Eigen::MatrixXd shapes(2 * n, r);
    for (Index i = 0; i < n; ++i)
      shapes.middleRows<2>(2 * i) =
          harmonics_[h].contact.middleRows<2>(Index{2} * near_[at(i)].node).real();
    const Eigen::MatrixXd reply = settings_.theta * settings_.dt *
                                  (modes_[h].lever * modes_[h].inverse).real() * shapes.transpose();
    w.noalias() += shapes * reply;
  }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const std::size_t p = pair(near_[at(i)].node, near_[at(j)].node);
      Block g = beyond_[p];
      for (Index e = 0; e < 4; ++e)
        g[at(e)] = g[at(e)] / (1.0 + lag) + w(2 * i + e / 2, 2 * j + e % 2);
      compliance_[p] = contact::complex_block(g);
    }
}

/// Finds what the forces of the step before would do to the modes if they stayed in space. Without
/// it a mean over the step that is not in its middle moves these forces on with the nodes.
void RingWheel::leave_forces(const WheelMotion& m) {
  left_->clear();
  for (const int node : active_)
    if (const Vec2 force = memory_of(node).force; force != Vec2{})
      left_->add(node, force, m.angle_next - m.angle);
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Vector& left = modes_[h].left;
    left.setZero();
    for (const LeftBehind::Share& share : left_->shares()) {
      const Index row = Index{2} * share.node;
      left += share.force.x * harmonics_[h].contact.row(row).transpose() +
              share.force.y * harmonics_[h].contact.row(row + 1).transpose();
    }
  }
}

Eigen::MatrixXd RingWheel::compliance(int lag) const {
  RONDO_DEMAND(!near_compliance_);
  const int n = ring_.n_sectors(), d = (lag % n + n) % n;
  Eigen::MatrixXd w(ring_.n_contact(), ring_.n_contact());
  for (int from = 0; from < n_contact_; ++from)
    for (int to = 0; to < n_contact_; ++to) {
      contact::ComplexBlock block = compliance_[pair(d * n_contact_ + to, from)];
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
    if (s.twisted != 0.0) s.pushed.noalias() -= s.lever * s.twisted * (of.coriolis * y);
    s.state.tail(r).noalias() = s.inverse * s.pushed;  // the middle
    s.state.head(r) = 2.0 * (y / s.turn + s.lever * s.state.tail(r)) - y;
    s.state.tail(r) = 2.0 * s.state.tail(r) - p;
    s.contact.noalias() = of.contact * s.state.head(r);
  }
}

WheelReport RingWheel::step(const WheelMotion& m) {
  const double lag = settings_.stiffness_damping / settings_.dt;
  WheelReport report;
  use_spin(m);
  move_modes(m);
  find_near(m, lag / (1.0 + lag));
  if (near_compliance_) fill_near_compliance();
  solve(m, settings_.friction, report);
  take_forces(m, report);
  account(m, report);
  remember(m);
  return report;
}

}  // namespace rondo::rom
