// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/base/reduced_wheel.hpp"

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/rim_products.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;

std::array<double, 2> components(Vec2 x) noexcept {
  return {x.x, x.y};
}
std::array<double, 3> components(Vec3 x) noexcept {
  return {x.x, x.y, x.z};
}

}  // namespace

HarmonicModes::HarmonicModes(const RingHarmonic& of, std::size_t n_branches, bool has_reply)
    : strain(of.squares.size(), n_branches) {
  const Index r = of.squares.size(), c = of.contact.rows();
  for (Vector* v : {&state, &before, &work, &shift, &twist}) v->setZero(2 * r);
  for (Vector* v : {&force, &outside, &held, &pushed}) v->setZero(r);
  for (Vector* v : {&ground, &contact, &shift_contact, &twist_contact, &by_rate, &by_place})
    v->setZero(c);
  for (Matrix* m : {&inverse, &step}) m->setZero(r, r);
  one.setIdentity(r, r);
  if (!has_reply) return;
  reply.setZero(r, c);
  answer.setZero(c, c);
}

template <int D>
ReducedWheel<D>::ReducedWheel(const SectorRing<D>& ring, const WheelModel& model,
                              const StepSettings& settings, bool flat)
    : ring_(ring),
      harmonics_(model.harmonics),
      model_(model),
      settings_(settings),
      n_contact_(static_cast<int>(ring.contact.size())),
      flat_(flat) {
  const std::size_t tables = model.residuals.size();
  RONDO_DEMAND(tables == model.squares.size() && (tables == 1 || tables == 3), tables,
               model.squares.size());
  RONDO_DEMAND(settings.dt > 0.0 && model.radius > 0.0 && settings.theta >= 0.5, settings.dt,
               model.radius, settings.theta);
  centrifugal_ = model.residuals.front().centrifugal;
  for (int node = 0; node < n_contact_ * ring.n_sectors(); ++node) {
    sector_.push_back(node / n_contact_);
    local_.push_back(node % n_contact_);
  }
  seen_.reserve(sector_.size());
  solved_.reserve(sector_.size());
  for (const RingHarmonic& h : harmonics_)
    modes_.emplace_back(h, model.branches.size(), is_whole());
}

/// The residual of a spin.
template <int D>
void ReducedWheel<D>::take_tables(double spin) {
  const double square = spin * spin;
  centrifugal_.setZero();
  for (std::size_t a = 0; a < model_.residuals.size(); ++a) {
    double share = 1.0;
    for (std::size_t b = 0; b < model_.residuals.size(); ++b)
      if (b != a) share *= (square - model_.squares[b]) / (model_.squares[a] - model_.squares[b]);
    shares_[a] = share;
    centrifugal_ += share * model_.residuals[a].centrifugal;
  }
  ++version_;
}

template <int D>
void ReducedWheel<D>::use_spin(const WheelMotion& m) {
  const double rate = m.kept_spin ? 0.0 : m.spin_rate, end = m.kept_spin.value_or(m.spin_next);
  const bool same = has_matrices_ && spin_rate_ == 0.0 && spin_ == end;
  new_table_ = rate != 0.0 || !same;
  if (new_table_) take_spin(m, rate, end);
  if (m.kept_spin && !has_shift_) shift_modes();
}

template <int D>
void ReducedWheel<D>::take_spin(const WheelMotion& m, double rate, double end) {
  residual_before_ = residual_stored();
  spin_ = end;
  spin_rate_ = rate;
  has_matrices_ = true;
  const double spin = rate == 0.0 ? end : (m.angle_next - m.angle) / settings_.dt;
  take_tables(end);
  for (std::size_t h = 0; h < harmonics_.size(); ++h) fill_step(h, spin, rate);
  has_shift_ = false;
}

template <int D>
WheelMotion ReducedWheel<D>::still(const WheelMotion& m) const noexcept {
  WheelMotion still = m;
  still.angle = m.angle_next - m.spin_next * settings_.dt;
  still.spin_rate = 0.0;
  return still;
}

template <int D>
void ReducedWheel<D>::rest_modes() {
  for (Modes& s : modes_) {
    s.strain.end.setZero();
    s.state.setZero();
    s.force.setZero();
  }
}

template <int D>
void ReducedWheel<D>::fill_lever(std::size_t harmonic, double spin) {
  const double half = 0.5 * settings_.dt;
  Modes& s = modes_[harmonic];
  s.turn = 1.0 + half * Complexes(0.0, harmonics_[harmonic].k * spin);
  s.lever = half / s.turn;
}

/// Inverts the matrix of a step, to which it adds the branches.
template <int D>
void ReducedWheel<D>::factorise(std::size_t harmonic) {
  const RingHarmonic& of = harmonics_[harmonic];
  Modes& s = modes_[harmonic];
  branches(harmonic).add_to(s.step);
  s.factor.compute(s.step);
  s.inverse = s.factor.solve(s.one);
  const double share = settings_.theta * settings_.dt * of.weight() / ring_.n_sectors();
  s.reply.noalias() = s.inverse * of.contact.adjoint();
  s.answer.noalias() = share * s.lever * of.contact * s.reply;
}

template <int D>
void ReducedWheel<D>::finish_middle(std::size_t harmonic) {
  Modes& s = modes_[harmonic];
  const Index r = s.force.size();
  const auto y = s.before.head(r), p = s.before.tail(r);
  s.state.tail(r).noalias() = s.inverse * s.pushed;  // the middle
  s.state.head(r) = 2.0 * (y / s.turn + s.lever * s.state.tail(r)) - y;
  s.state.tail(r) = 2.0 * s.state.tail(r) - p;
}

/// The strains of the branches at the end of the step.
template <int D>
void ReducedWheel<D>::relax_modes() {
  for (std::size_t h = 0; h < modes_.size(); ++h)
    modes_[h].strain.relax(branches(h), modes_[h].before, modes_[h].state);
}

/// (2r) What a force on the modes does in a step.
template <int D>
void ReducedWheel<D>::push_by(const HarmonicModes& s, const Vector& force, Vector& out) const {
  const Index r = s.force.size();
  out.tail(r).noalias() = s.inverse * force;
  out.tail(r) *= settings_.dt;
  out.head(r) = s.lever * out.tail(r);
}

/// What the modes do to the contact nodes.
template <int D>
void ReducedWheel<D>::move_contact() {
  for (std::size_t h = 0; h < modes_.size(); ++h)
    modes_[h].contact.noalias() =
        harmonics_[h].contact * modes_[h].state.head(harmonics_[h].squares.size());
}

template <int D>
void ReducedWheel<D>::push_modes(int node, Complex wave, Vec force) {
  const Index row = Index{D} * local(node);
  const auto part = components(force / static_cast<double>(ring_.n_sectors()));
  for_waves(waves_of_sectors(), wave, [&](std::size_t h, Complex turned) {
    const Complexes back(turned.re, -turned.im);
    for (Index c = 0; c < D; ++c) modes_[h].ground[row + c] += part[at(c)] * back;
  });
}

/// (r, D C) Δt inverse φ_cᴴ. Both ways round differently, and results are those of before to the
/// bit.
template <int D>
typename ReducedWheel<D>::Matrix ReducedWheel<D>::reply_times_step(const Modes& s,
                                                                   const RingHarmonic& of) const {
  if constexpr (D == 2)
    return settings_.dt * (s.inverse * of.contact.adjoint());
  else
    return settings_.dt * s.reply;
}

/// What a unit acceleration along x, in space also along the axle, does to the modes, and how
/// momenta see new forces through them.
template <int D>
void ReducedWheel<D>::shift_modes() {
  has_shift_ = true;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    if (of.k > 1) return;
    const Index r = of.squares.size();
    const Matrix rate = reply_times_step(s, of), place = s.lever * rate;
    if (of.k == 0) {
      s.by_rate = settings_.theta * (of.turned.adjoint() * rate).transpose();
      s.by_place = settings_.theta * (of.reference.adjoint() * place).transpose();
      if constexpr (D == 3) {
        push_by(s, -of.axial, s.lift);
        s.lift_contact = of.contact * s.lift.head(r);
        s.by_axial = settings_.theta * (of.axial.adjoint() * rate).transpose();
      }
      continue;
    }
    push_by(s, -0.5 * of.translation.conjugate(), s.shift);
    s.shift_contact = of.contact * s.shift.head(r);
    s.by_rate = settings_.theta * (of.translation.transpose() * rate).adjoint();
    s.by_place = settings_.theta * (of.translation.transpose() * place).adjoint();
  }
}

/// What a unit acceleration of the angle does to the modes.
template <int D>
void ReducedWheel<D>::twist_modes() {
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    s.pushed.noalias() = -of.coriolis * s.before.head(r);
    if (of.k == 0) s.pushed -= of.turned;
    push_by(s, s.pushed, s.twist);
    s.twist_contact.noalias() = of.contact * s.twist.head(r);
  }
}

/// Turns what the modes refer to by an angle; nodes stay where they are.
template <int D>
void ReducedWheel<D>::turn_modes(double angle) {
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const Complex back = rotation(-harmonics_[h].k * angle);
    modes_[h].state *= Complexes(back.re, back.im);
    modes_[h].force *= Complexes(back.re, back.im);
    modes_[h].strain.end *= Complexes(back.re, back.im);
  }
}

/// Work of the ground's forces on the modes in the step.
template <int D>
double ReducedWheel<D>::work_on_modes() const {
  double power = 0.0;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const Modes& s = modes_[h];
    const Index r = s.force.size();
    Complexes sum = 0.0;
    for (Index j = 0; j < r; ++j)
      sum +=
          std::conj(s.before[r + j] + s.state[r + j]) * (s.held[j] + settings_.theta * s.force[j]);
    power += 0.5 * harmonics_[h].weight() * sum.real();
  }
  return settings_.dt * ring_.n_sectors() * power;
}

/// What viscous branches of the modes store and take, and the work against the forces of the modes.
template <int D>
void ReducedWheel<D>::account_branches(WheelEnergy& e) const {
  for (std::size_t h = 0; h < modes_.size(); ++h)
    modes_[h].strain.account(branches(h), modes_[h].before, modes_[h].state,
                             harmonics_[h].weight() * ring_.n_sectors(), e);
}

/// What the residual of a viscous wheel stores and takes.
template <int D>
ResidualProducts ReducedWheel<D>::account_creep(const CreepMemory& creep, WheelEnergy& e) const {
  const CreepEnergy of = creep.energy(shares_);
  e.by_residual = of.by_stiffness;
  e.viscous += of.lost - of.by_stiffness;
  e.internal += of.work - of.by_stiffness;
  return {2.0 * of.at_end, 0.0, 2.0 * of.at_start};
}

/// Energies of the residual, and those works of the scheme that are not of contact.
/// @return energy that the tables of a new spin add to the residual
template <int D>
double ReducedWheel<D>::account_residual(const WheelMotion& m, const ResidualProducts& of,
                                         WheelEnergy& e) const {
  e.residual = 0.5 * of.end;
  e.stored += e.residual;
  const double by_table =
      new_table_ && (m.kept_spin || m.spin_rate != 0.0) ? 0.5 * of.start - residual_before_ : 0.0;
  if (!m.kept_spin) e.frame += by_table;
  e.internal += by_table;
  e.scheme = work_on_modes() + 0.5 * (of.end - of.start) + e.by_residual;
  return m.kept_spin ? by_table : 0.0;
}

/// φᴴ M of a field, harmonic by harmonic.
template <int D>
void ReducedWheel<D>::project(double angle, std::span<const Vec> field, bool velocity) {
  const Complex frame = rotation(angle);
  for (int j = 0; j < ring_.n_sectors(); ++j) {
    const Complex turn = ring_.stiffness.turn[at(j)];
    for_waves(harmonics_, conj(frame * turn), [&](std::size_t h, Complex back) {
      const Matrix& shapes = harmonics_[h].shapes;
      const Index r = shapes.cols();
      const Complexes part = Complexes(back.re, back.im) / static_cast<double>(ring_.n_sectors());
      for (std::size_t a = 0; a < ring_.mass.size(); ++a) {
        const double mass = ring_.mass[a];
        if (mass == 0.0) continue;
        const auto x = components(conj(turn) * field[ring_.stiffness.node(a, at(j))]);
        const auto row = static_cast<Index>(D * a);
        for (Index c = 0; c < r; ++c) {
          Complexes product = std::conj(shapes(row, c)) * x[0];
          for (Index i = 1; i < D; ++i) product += std::conj(shapes(row + i, c)) * x[at(i)];
          modes_[h].state[(velocity ? r : 0) + c] += part * mass * product;
        }
      }
    });
  }
}

/// (r) In the last step.
template <int D>
typename ReducedWheel<D>::Vector ReducedWheel<D>::mean_velocity(std::size_t harmonic) const {
  const Index r = harmonics_[harmonic].squares.size();
  return 0.5 * (modes_[harmonic].before.tail(r) + modes_[harmonic].state.tail(r));
}

template <int D>
std::size_t ReducedWheel<D>::n_mode_numbers(const WheelModel& model) noexcept {
  std::size_t n = 0;
  for (const RingHarmonic& h : model.harmonics)
    n += (6 + 2 * model.branches.size()) * at(h.squares.size());
  return n;
}

template <int D>
void ReducedWheel<D>::save_modes(std::vector<double>& out) const {
  for (const Modes& s : modes_) {
    put(s.state, out);
    put(s.force, out);
    for (Index b = 0; b < s.strain.end.cols(); ++b) put(s.strain.end.col(b), out);
  }
}

template <int D>
void ReducedWheel<D>::restore_modes(SavedNumbers& from) {
  for (Modes& s : modes_) {
    from.fill(s.state);
    from.fill(s.force);
    for (Index b = 0; b < s.strain.end.cols(); ++b) from.fill(s.strain.end.col(b));
  }
}

template <int D>
void ReducedWheel<D>::restore_spin(double spin) {
  if (has_matrices_ && spin_rate_ == 0.0 && spin_ == spin) return;
  spin_ = spin;
  take_tables(spin);
  has_matrices_ = false;
}

template class ReducedWheel<2>;
template class ReducedWheel<3>;

}  // namespace rondo::rom
