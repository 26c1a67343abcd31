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
  for (Vector* v : {&force, &outside, &left, &pushed}) v->setZero(r);
  for (Vector* v : {&contact, &middle, &shift_contact, &twist_contact, &by_rate, &by_place})
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
  compliance_.resize(residuals.front().blocks.size());
  const std::size_t n = ring.contact.size() * at(ring.n_sectors());
  memory_.resize(n);
  for (std::size_t node = 0; node < n; ++node) {
    sector_.push_back(static_cast<int>(node) / n_contact_);
    local_.push_back(static_cast<int>(node) % n_contact_);
  }
  active_.reserve(n);
  near_.reserve(n);
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
  shares_before_ = shares_;
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
  for (std::size_t e = 0; e < compliance_.size(); ++e) {
    double g = 0.0;
    for (std::size_t a = 0; a < model_.residuals.size(); ++a)
      g += shares_[a] * model_.residuals[a].blocks[e];
    compliance_[e] = g / (1.0 + lag);
  }
  const int n = ring_.n_sectors();
  for (std::size_t h = 0; h < harmonics_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Matrix g = settings_.theta * settings_.dt * of.weight() / n *
                     (modes_[h].lever * (of.contact * modes_[h].inverse * of.contact.adjoint()));
    for (int d = 0; d < n; ++d) {
      const Complex turn = ring_.stiffness.turn[at(of.k * d % n)];
      Eigen::Map<Eigen::MatrixXd>(compliance_.data() + d * size * size, size, size) +=
          turn.re * g.real() - turn.im * g.imag();
    }
  }
}

/// Fills W of a ring of one sector, for the pairs of near nodes alone.
void RingWheel::fill_near_compliance() {
  const double lag = settings_.stiffness_damping / settings_.dt;
  const Index size = ring_.n_contact(), n = static_cast<Index>(near_.size());
  const auto entry = [&](Index i, int c) { return Index{2} * near_[at(i)].node + c; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Block g = beyond_modes(shares_, near_[at(i)].node, near_[at(j)].node);
      for (int e = 0; e < 4; ++e)
        compliance_[at(entry(j, e % 2) * size + entry(i, e / 2))] = g[at(e)] / (1.0 + lag);
    }
  for (std::size_t h = 0; h < harmonics_.size(); ++h) {
    const Index r = harmonics_[h].squares.size();
    Eigen::MatrixXd shapes(2 * n, r);
    for (Index i = 0; i < 2 * n; ++i)
      shapes.row(i) = harmonics_[h].contact.row(entry(i / 2, static_cast<int>(i % 2))).real();
    const Eigen::MatrixXd reply = settings_.theta * settings_.dt *
                                  (modes_[h].lever * modes_[h].inverse).real() * shapes.transpose();
    const Eigen::MatrixXd answer = shapes * reply;
    for (Index i = 0; i < 2 * n; ++i)
      for (Index j = 0; j < 2 * n; ++j)
        compliance_[at(entry(j / 2, static_cast<int>(j % 2)) * size +
                       entry(i / 2, static_cast<int>(i % 2)))] += answer(i, j);
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

Eigen::Map<const Eigen::MatrixXd> RingWheel::compliance(int lag) const {
  RONDO_DEMAND(!near_compliance_);
  const int d = (lag % ring_.n_sectors() + ring_.n_sectors()) % ring_.n_sectors();
  const Index size = ring_.n_contact();
  return {compliance_.data() + d * size * size, size, size};
}

/// 2 × 2 block of G between two nodes, of a spin.
RingWheel::Block RingWheel::beyond_modes(const Shares& shares, int to, int from) const noexcept {
  if (model_.residuals.size() == 1) return answer(model_.residuals[0].blocks.data(), to, from);
  Block sum{};
  for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
    const Block g = answer(model_.residuals[a].blocks.data(), to, from);
    for (std::size_t e = 0; e < sum.size(); ++e) sum[e] += shares[a] * g[e];
  }
  return sum;
}

/// 2 × 2 block of a table between two nodes.
RingWheel::Block RingWheel::answer(const double* table, int to, int from) const noexcept {
  const int lag = sector(to) - sector(from);
  const Index size = ring_.n_contact(), d = lag < 0 ? lag + ring_.n_sectors() : lag;
  const double* block = table + d * size * size + 2 * local(from) * size + 2 * local(to);
  return {block[0], block[size], block[1], block[size + 1]};
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
    s.pushed = s.outside;
    if (is_whole())
      s.pushed += 0.5 * s.force - (settings_.theta - 0.5) * s.left;
    else
      s.pushed += (1.0 - settings_.theta) * s.force;
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
