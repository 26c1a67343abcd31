// SPDX-License-Identifier: BSD-3-Clause
/// The step on a rim that moves: its accelerations are unknown together with the forces. What
/// wheel/ring_wheel_rim.cpp has of a disk, with the plane of the wheel leaned by its camber.
#include <complex>

#include "rondo/core/index.hpp"
#include "rondo/rom/solid/solid_wheel.hpp"
#include "rondo/rom/wheel/rim_products.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;
using Complexes = std::complex<double>;

/// The unit vectors along t1 and n in the axes of the wheel.
Vec3 ahead(const SolidMotion& m) noexcept {
  return m.attitude_next.from_fixed({1.0, 0.0, 0.0});
}
Vec3 upwards(const SolidMotion& m) noexcept {
  return m.attitude_next.from_fixed({0.0, 1.0, 0.0});
}
Complexes in_plane_of(Vec3 a) noexcept {
  return {a.x, a.y};
}
Vec3 quarter_turn(Vec3 a) noexcept {
  return {-a.y, a.x, 0.0};
}

}  // namespace

/// Σ m R of the velocities, or of the displacements, in the axes of the wheel.
/// @param of (2r) which of them
Vec3 SolidWheel::momentum_of(const Vector Modes::*of, bool places) const {
  Vec3 sum;
  const auto n = static_cast<double>(ring_.n_sectors());
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const RingHarmonic& harmonic = harmonics_[h];
    const Index r = harmonic.squares.size();
    const Vector& x = modes_[h].*of;
    const auto half = places ? x.head(r) : x.tail(r);
    if (harmonic.k == 0) sum.z += n * product_of(harmonic.axial, half);
    if (harmonic.k != 1) continue;
    const Complexes plane = n * along_rim(harmonic, half);
    sum += Vec3(plane.real(), plane.imag(), 0.0);
  }
  return sum;
}

WheelSums SolidWheel::sums(const SolidMotion& m) const {
  WheelSums sum;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const auto y = modes_[h].state.head(r), p = modes_[h].state.tail(r);
    const double n = of.weight() * ring_.n_sectors();
    for (Index j = 0; j < r; ++j)
      for (Index l = 0; l < r; ++l)
        sum.square += n * (std::conj(y[j]) * of.planar(j, l) * y[l]).real();
    sum.swirl += n * twisted_by(of.coriolis, y, p);
    if (of.k != 0) continue;
    sum.swirl += n * product_of(of.turned, p);
    sum.stretch += n * product_of(of.reference, y);
  }
  const Complex turn = rotation(m.plane.angle_next - waves_at(m.plane));
  const Vec3 momentum = turn * momentum_of(&Modes::state, false),
             moment = turn * momentum_of(&Modes::state, true);
  sum.momentum = {dot(ahead(m), momentum), dot(upwards(m), momentum)};
  // A spin has the moment turned by a quarter, seen along t1 and n.
  const Vec3 turned = quarter_turn(moment);
  sum.moment = {dot(upwards(m), turned), -dot(ahead(m), turned)};
  return sum;
}

double SolidWheel::lateral_momentum(const SolidMotion& m, double spin) const {
  const Complex turn = rotation(m.plane.angle_next - waves_at(m.plane));
  const Vec3 all = turn * (momentum_of(&Modes::state, false) +
                           spin * quarter_turn(momentum_of(&Modes::state, true)));
  return m.attitude_next.to_fixed(all).z;
}

RimVector SolidWheel::force_on_rim(const SolidMotion& m) const {
  return {last_.force.x, last_.force.y, m.attitude_next.from_fixed(last_.moment).z};
}

/// Columns: momenta at the end of the step by unit accelerations along t1 and n and of the angle.
Eigen::Matrix3d SolidWheel::momenta_by_rate(const SolidMotion& m) const {
  Eigen::Matrix3d by = Eigen::Matrix3d::Zero();
  const double n = ring_.n_sectors(), spin = m.plane.spin_next;
  const std::array directions{ahead(m), upwards(m)};
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const Modes& s = modes_[h];
    const auto add = [&](Index column, Vec3 momentum) {
      for (std::size_t k = 0; k < 2; ++k)
        by(static_cast<Index>(k), column) += dot(directions[k], momentum);
    };
    const auto swirl = [&](const Vector& x) {
      return n *
             (product_of(of.turned, x.tail(r)) + 2.0 * spin * product_of(of.reference, x.head(r)));
    };
    if (of.k == 0) {
      by(2, 2) += swirl(s.twist);
      add(2, {0.0, 0.0, n * product_of(of.axial, s.twist.tail(r))});
      for (std::size_t k = 0; k < 2; ++k) {
        const auto column = static_cast<Index>(k);
        by(2, column) += directions[k].z * swirl(s.lift);
        add(column, {0.0, 0.0, directions[k].z * n * product_of(of.axial, s.lift.tail(r))});
      }
    }
    if (of.k != 1) continue;
    const auto momentum = [&](const Vector& x) {
      return n * (along_rim(of, x.tail(r)) + Complexes(0.0, spin) * along_rim(of, x.head(r)));
    };
    const auto vec = [](const Complexes& x) { return Vec3(x.real(), x.imag(), 0.0); };
    add(2, vec(momentum(s.twist)));
    for (std::size_t k = 0; k < 2; ++k)
      add(static_cast<Index>(k), vec(in_plane_of(directions[k]) * momentum(s.shift)));
  }
  return by;
}

/// What unit accelerations do to the places of near nodes, and forces there to the momenta.
void SolidWheel::find_columns(const SolidMotion& m) {
  const double dt = settings_.dt, half = 0.5 * dt * dt, share = dt * settings_.theta;
  const std::array directions{ahead(m), upwards(m)};
  const double spin = m.plane.spin_next;
  // Momenta in the frame of the waves are those of the rim turned back by what it is ahead.
  const Complex lead = rotation(m.plane.angle_next - waves_at(m.plane));
  for (Near& near : near_) {
    const Index c = Index{3} * local(near.node);
    near.still = near.free;
    for (std::size_t k = 0; k < 2; ++k) {
      near.moved[k] = half * (conj(near.turn) * directions[k]);
      near.push[k] = share * (conj(near.turn) * directions[k]);
    }
    near.moved[2] = half * quarter_turn(near.free);
    near.push[2] = share * Vec3(-near.free.y, near.free.x, 0.0);
    for_waves(harmonics_, near.wave, [&](std::size_t h, Complex wave) {
      const RingHarmonic& of = harmonics_[h];
      const Modes& s = modes_[h];
      const Complexes e(wave.re, wave.im);
      const auto real = [&](Complexes by, const Vector& x) {
        return Vec3((by * x[c]).real(), (by * x[c + 1]).real(), (by * x[c + 2]).real());
      };
      near.moved[2] += of.weight() * real(e, s.twist_contact);
      if (of.k == 0) {
        near.push[2] -= real(1.0, s.by_rate) + 2.0 * spin * real(1.0, s.by_place);
        for (std::size_t k = 0; k < 2; ++k) {
          near.moved[k] += directions[k].z * real(1.0, s.lift_contact);
          near.push[k] -= directions[k].z * real(1.0, s.by_axial);
        }
      }
      if (of.k != 1) return;
      for (std::size_t k = 0; k < 2; ++k) {
        const Complexes direction = in_plane_of(directions[k]);
        near.moved[k] += of.weight() * real(std::conj(direction) * e, s.shift_contact);
        // Re(conj(d) e^{iψ} x): the momentum x e^{iψ} along d.
        const Complexes along = std::conj(direction) * Complexes(lead.re, lead.im) * e;
        near.push[k] -= real(along, s.by_rate) + real(Complexes(0.0, spin) * along, s.by_place);
      }
    });
  }
}

RimVector SolidWheel::push_on_rim() const {
  RimVector sum = RimVector::Zero();
  for (const std::size_t i : solved_) {
    const Near& near = near_[i];
    sum += RimVector(dot(near.push[0], near.force), dot(near.push[1], near.force),
                     dot(near.push[2], near.force));
  }
  return sum;
}

/// Places are then those from the center as it is.
void SolidWheel::accelerate_modes(const RimVector& z, const SolidMotion& m) {
  const double half = 0.5 * settings_.dt * settings_.dt;
  const Vec3 rate = z[0] * ahead(m) + z[1] * upwards(m);
  for (Near& near : near_) near.place -= half * (conj(near.turn) * rate);
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    if (harmonics_[h].k == 0) s.state += rate.z * s.lift;
    if (harmonics_[h].k == 1) s.state += std::conj(in_plane_of(rate)) * s.shift;
    s.state += z[2] * s.twist;
  }
}

WheelRim::End SolidWheel::end_of(const SolidWheelReport& report, const SolidMotion& m) {
  WheelRim::End end;
  end.force = force_on_rim(m);
  end.rim_work = report.energy.rim - report.lateral_work - report.turning_work;
  end.sums = sums(m);
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    Modes& s = modes_[h];
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const double n = of.weight() * ring_.n_sectors();
    s.work = 0.5 * (s.before + s.state);
    end.swirl += n * twisted_by(of.coriolis, s.before.head(r), s.work.tail(r));
    if (of.k == 0) end.swirl += n * product_of(of.turned, s.work.tail(r));
  }
  const Vec3 middle = momentum_of(&Modes::work, false);
  end.middle = {dot(ahead(m), middle), dot(upwards(m), middle)};
  return end;
}

SolidWheelReport SolidWheel::step(long long n, WheelRim& rim, SolidMotion& m,
                                  dynamics::Works& works) {
  m.plane = rim.begin(n);
  use_spin(m.plane);
  move_modes(m);
  find_near(m);
  twist_modes();
  rim.set_lines({sums(m), momenta_by_rate(m)});
  find_columns(m);
  SolidWheelReport report;
  on_moving_rim_ = true;
  do {
    const RimVector z = rim.hold();
    for (Near& near : near_) near.accelerate(z, rim.answer());
    report = {};
    solve(m, report);
  } while (!rim.settled(push_on_rim()));
  on_moving_rim_ = false;
  accelerate_modes(rim.change(), m);
  m.plane = rim.moved();
  take_forces(m, report);
  account(m, report);
  const double spin = (m.plane.angle_next - m.plane.angle) / settings_.dt;
  const Complex turned = rotation(m.plane.angle_next - waves_at(m.plane));
  const Vec3 moment =
      0.5 * (momentum_of(&Modes::before, true) + turned * momentum_of(&Modes::state, true));
  WheelRim::End end = end_of(report, m);
  end.aside = m.lateral_pull * m.attitude_next.to_fixed(quarter_turn(moment)).z;
  rim.finish(end, works);
  report.lateral_momentum = lateral_momentum(m, m.plane.spin_next);
  report.lateral_middle =
      m.attitude_next.to_fixed(momentum_of(&Modes::work, false) + spin * quarter_turn(moment)).z;
  turn_modes(m.plane.angle_next - waves_at(m.plane));
  remember(m);
  return report;
}

}  // namespace rondo::rom
