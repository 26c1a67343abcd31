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
  table_.n_sectors = residuals.front().n_sectors;
  table_.size = residuals.front().size;
  table_.blocks = residuals.front().blocks;
  table_.centrifugal = residuals.front().centrifugal;
  table_before_ = table_;
  compliance_.resize(table_.blocks.size());
  const std::size_t n = ring.contact.size() * at(ring.n_sectors());
  memory_.resize(n);
  active_.reserve(n);
  near_.reserve(n);
  solved_.reserve(n);
  touch_.reserve(n);
  law_.reserve(n);
  contacts_.reserve(n);
  for (const RingHarmonic& h : harmonics_) {
    const Index r = h.squares.size(), c = h.contact.rows();
    const auto zero = [](Index size) { return Vector(Vector::Zero(size)); };
    modes_.push_back({zero(2 * r), zero(2 * r), zero(r), zero(r), Matrix::Zero(2 * r, 2 * r),
                      Matrix::Zero(2 * r, r), zero(c), zero(c), zero(2 * r), zero(2 * r),
                      zero(2 * r), zero(c), zero(c), zero(c), zero(c)});
  }
}

/// The residual of a spin.
void RingWheel::set_table(double spin) {
  const double square = spin * spin;
  std::fill(table_.blocks.begin(), table_.blocks.end(), 0.0);
  table_.centrifugal.setZero();
  for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
    double share = 1.0;
    for (std::size_t b = 0; b < model_.residuals.size(); ++b)
      if (b != a) share *= (square - model_.squares[b]) / (model_.squares[a] - model_.squares[b]);
    for (std::size_t e = 0; e < table_.blocks.size(); ++e)
      table_.blocks[e] += share * model_.residuals[a].blocks[e];
    shares_[a] = share;
    table_.centrifugal += share * model_.residuals[a].centrifugal;
  }
}

/// The matrices of a step, and the answers of the contact nodes at its end.
void RingWheel::use_spin(const WheelMotion& m) {
  const double rate = m.kept_spin ? 0.0 : m.spin_rate, end = m.kept_spin.value_or(m.spin_next);
  const bool same = has_matrices_ && spin_rate_ == 0.0 && spin_ == end;
  new_table_ = rate != 0.0 || !same;
  if (!new_table_) return;
  std::swap(table_before_, table_);
  spin_ = end;
  spin_rate_ = rate;
  has_matrices_ = true;
  const double dt = settings_.dt;
  const double spin = rate == 0.0 ? end : (m.angle_next - m.angle) / dt;
  set_table(end);
  for (std::size_t h = 0; h < harmonics_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const Complexes wander(0.0, -of.k * spin);
    Matrix a = Matrix::Zero(2 * r, 2 * r);
    a.topRightCorner(r, r).setIdentity();
    a.bottomLeftCorner(r, r) = -rate * of.coriolis;
    a.bottomRightCorner(r, r) = -2.0 * spin * of.coriolis;
    for (Index j = 0; j < r; ++j) {
      a(j, j) += wander;
      a(r + j, j) -= of.squares[j] - spin * spin;
      a(r + j, r + j) +=
          wander - settings_.mass_damping - settings_.stiffness_damping * of.squares[j];
    }
    const Matrix one = Matrix::Identity(2 * r, 2 * r);
    const Matrix inverse = (one - 0.5 * dt * a).partialPivLu().inverse();
    modes_[h].carry = inverse * (one + 0.5 * dt * a);
    modes_[h].push = dt * inverse.rightCols(r);
  }
  shift_modes();
  fill_compliance();
}

/// The angle at which the modes are at the end of the step.
double RingWheel::waves_at(const WheelMotion& m) const noexcept {
  return m.kept_spin ? m.angle + settings_.dt * *m.kept_spin : m.angle_next;
}

/// W[lag] = G[lag]/(1 + β/Δt) + the modes' answer.
void RingWheel::fill_compliance() {
  const double lag = settings_.stiffness_damping / settings_.dt;
  const Index size = table_.size;
  for (std::size_t e = 0; e < compliance_.size(); ++e)
    compliance_[e] = table_.blocks[e] / (1.0 + lag);
  const int n = ring_.n_sectors();
  for (std::size_t h = 0; h < harmonics_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const Matrix g = settings_.theta * of.weight() / n *
                     (of.contact * modes_[h].push.topRows(r) * of.contact.adjoint());
    for (int d = 0; d < n; ++d) {
      const Complex turn = ring_.stiffness.turn[at(of.k * d % n)];
      Eigen::Map<Eigen::MatrixXd>(compliance_.data() + d * size * size, size, size) +=
          turn.re * g.real() - turn.im * g.imag();
    }
  }
}

Eigen::Map<const Eigen::MatrixXd> RingWheel::compliance(int lag) const noexcept {
  const int d = (lag % ring_.n_sectors() + ring_.n_sectors()) % ring_.n_sectors();
  return {compliance_.data() + d * table_.size * table_.size, table_.size, table_.size};
}

/// 2 × 2 block of a table between two nodes.
RingWheel::Block RingWheel::answer(const double* table, int to, int from) const noexcept {
  const int lag = sector(to) - sector(from);
  const Index size = table_.size, d = lag < 0 ? lag + ring_.n_sectors() : lag;
  const double* block =
      table + d * size * size + 2 * (from % n_contact_) * size + 2 * (to % n_contact_);
  return {block[0], block[size], block[1], block[size + 1]};
}

/// The modes at the end of the step without new forces.
void RingWheel::move_modes(const WheelMotion& m) {
  const double spin = (m.angle_next - m.angle) / settings_.dt;
  const Complexes back(m.pull.x, -m.pull.y);  // conj
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    s.outside.setZero();
    if (of.k == 0) s.outside = spin * spin * of.reference - m.spin_rate * of.turned;
    if (of.k == 1) s.outside -= 0.5 * back * of.translation.conjugate();
    if (m.kept_spin) s.outside.noalias() -= m.spin_rate * (of.coriolis * s.state.head(r));
    s.before = s.state;
    s.work.head(r) = s.outside + (1.0 - settings_.theta) * s.force;
    s.state.noalias() = s.carry * s.before;
    s.state.noalias() += s.push * s.work.head(r);
    s.contact.noalias() = of.contact * s.state.head(r);
  }
}

WheelReport RingWheel::step(const WheelMotion& m) {
  const double lag = settings_.stiffness_damping / settings_.dt;
  WheelReport report;
  use_spin(m);
  move_modes(m);
  find_near(m, lag / (1.0 + lag));
  solve(m, settings_.friction, report);
  take_forces(report);
  account(m, report);
  remember(m);
  return report;
}

}  // namespace rondo::rom
