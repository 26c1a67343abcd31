// SPDX-License-Identifier: BSD-3-Clause
/// The step on a rim that moves: its accelerations are unknown together with the forces.
#include <complex>

#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/rim_products.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"
#include "rondo/rom/wheel/ring_wheel.hpp"

namespace rondo::rom {
namespace {

using Eigen::Index;
using Complexes = std::complex<double>;

Vec2 vec(const Complexes& x) noexcept {
  return {x.real(), x.imag()};
}

}  // namespace

WheelSums RingWheel::sums() const {
  WheelSums sum;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const auto y = modes_[h].state.head(r), p = modes_[h].state.tail(r);
    const double n = of.weight() * ring_.n_sectors();
    sum.square += n * y.squaredNorm();
    sum.swirl += n * twisted_by(of.coriolis, y, p);
    if (of.k == 0) {
      sum.swirl += n * product_of(of.turned, p);
      sum.stretch += n * product_of(of.reference, y);
    }
    if (of.k != 1) continue;
    sum.momentum += static_cast<double>(ring_.n_sectors()) * vec(along_rim(of, p));
    sum.moment += static_cast<double>(ring_.n_sectors()) * vec(along_rim(of, y));
  }
  return sum;
}

/// Columns: momenta at the end of the step by unit accelerations of x, y and the angle.
Eigen::Matrix3d RingWheel::momenta_by_rate(double spin) const {
  Eigen::Matrix3d by = Eigen::Matrix3d::Zero();
  const double n = ring_.n_sectors();
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Index r = of.squares.size();
    const Modes& s = modes_[h];
    if (of.k == 0)
      by(2, 2) += n * (product_of(of.turned, s.twist.tail(r)) +
                       2.0 * spin * product_of(of.reference, s.twist.head(r)));
    if (of.k != 1) continue;
    const auto momentum = [&](const Vector& x) {
      return n * (along_rim(of, x.tail(r)) + Complexes(0.0, spin) * along_rim(of, x.head(r)));
    };
    const Complexes ahead = momentum(s.shift), turned = momentum(s.twist);
    by.topRows<2>() << ahead.real(), -ahead.imag(), turned.real(), ahead.imag(), ahead.real(),
        turned.imag();
  }
  return by;
}

/// What unit accelerations do to the places of near nodes, and forces there to the momenta.
void RingWheel::find_columns(const WheelMotion& m) {
  const double dt = settings_.dt, half = 0.5 * dt * dt, share = dt * settings_.theta;
  for (Near& near : near_) {
    const Index c = Index{2} * local(near.node);
    near.still = near.free;
    near.moved = {Vec2{half, 0.0}, Vec2{0.0, half}, half * turn90(near.free)};
    near.push = {Vec2{share, 0.0}, Vec2{0.0, share}, share * turn90(near.free)};
    for_waves(harmonics_, near.wave, [&](std::size_t h, Complex wave) {
      const RingHarmonic& of = harmonics_[h];
      const Modes& s = modes_[h];
      const Complexes e(wave.re, wave.im);
      const auto place = [&](const Complexes* x, Complexes by) {
        const Vec2 u{(by * x[0]).real(), (by * x[1]).real()};
        return near.turn * (of.weight() * u);
      };
      near.moved[2] += place(s.twist_contact.data() + c, e);
      const auto momentum = [&](Index row, Complexes spin) {
        return s.by_rate[row] + spin * s.by_place[row];
      };
      if (of.k == 0)
        near.push[2] -= near.turn * Vec2{momentum(c, 2.0 * m.spin_next).real(),
                                         momentum(c + 1, 2.0 * m.spin_next).real()};
      if (of.k != 1) return;
      near.moved[0] += place(s.shift_contact.data() + c, e);
      near.moved[1] += place(s.shift_contact.data() + c, Complexes(0.0, -1.0) * e);
      const Complexes spin(0.0, m.spin_next);
      const Complexes by[] = {e * momentum(c, spin), e * momentum(c + 1, spin)};
      near.push[0] -= near.turn * Vec2{by[0].real(), by[1].real()};
      near.push[1] -= near.turn * Vec2{by[0].imag(), by[1].imag()};
    });
  }
}

/// Places without new forces under accelerations, and what new forces do to these.
void RingWheel::accelerate_near(const RimVector& z, const Eigen::Matrix3d& answer) {
  for (Near& near : near_) {
    near.accelerate(z, answer);
    near.column = -1;
  }
  n_columns_ = 0;
}

RimVector RingWheel::push_on_rim() const {
  RimVector sum = RimVector::Zero();
  for (std::size_t i = 0; i < solved_.size(); ++i) {
    const Near& near = near_[solved_[i]];
    const Vec2 normal = touch_[i].normal;
    const Vec2 force = law_[i].normal * normal + law_[i].shear * tangent_of(normal);
    sum += RimVector(dot(near.push[0], force), dot(near.push[1], force), dot(near.push[2], force));
  }
  return sum;
}

/// Places are then those from the center as it is.
void RingWheel::accelerate_modes(const RimVector& z) {
  const double half = 0.5 * settings_.dt * settings_.dt;
  for (Near& near : near_) near.place -= half * Vec2{z[0], z[1]};
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    if (harmonics_[h].k == 1) modes_[h].state += Complexes(z[0], -z[1]) * modes_[h].shift;
    modes_[h].state += z[2] * modes_[h].twist;
  }
}

/// @param ahead angle by which the rim is ahead of the modes
WheelRim::End RingWheel::end_of(const WheelReport& report, double ahead) const {
  WheelRim::End end;
  end.force = {report.force.x, report.force.y, report.torque};
  end.rim_work = report.energy.rim;
  end.sums = sums();
  end.sums.momentum = rotation(ahead) * end.sums.momentum;
  end.sums.moment = rotation(ahead) * end.sums.moment;
  for (std::size_t h = 0; h < modes_.size(); ++h) {
    const RingHarmonic& of = harmonics_[h];
    const Modes& s = modes_[h];
    const Index r = of.squares.size();
    const double n = of.weight() * ring_.n_sectors();
    const auto rate = 0.5 * (s.before.tail(r) + s.state.tail(r));
    end.swirl += n * twisted_by(of.coriolis, s.before.head(r), rate);
    if (of.k == 0) end.swirl += n * product_of(of.turned, rate);
    if (of.k == 1) end.middle += static_cast<double>(ring_.n_sectors()) * vec(along_rim(of, rate));
  }
  return end;
}

WheelReport RingWheel::step(long long n, WheelRim& rim, dynamics::Works& works) {
  WheelMotion m = rim.begin(n);
  use_spin(m);
  move_modes(m);
  find_near(m);
  twist_modes();
  WheelAnswer answer{sums(), momenta_by_rate(m.spin_next)};
  const Complex ahead = rotation(m.angle_next - waves_at(m));
  answer.free.momentum = ahead * answer.free.momentum;
  answer.free.moment = ahead * answer.free.moment;
  rim.set_lines(answer);
  find_columns(m);
  WheelReport report;
  on_moving_rim_ = true;
  do {
    const RimVector z = rim.hold();
    accelerate_near(z, rim.answer());
    report = {};
    solve(m, report);
  } while (!rim.settled(push_on_rim()));
  on_moving_rim_ = false;
  accelerate_modes(rim.change());
  m = rim.moved();
  take_forces(m, report);
  account(m, report);
  const double turn = m.angle_next - waves_at(m);
  rim.finish(end_of(report, turn), works);
  turn_modes(turn);
  remember(m);
  return report;
}

}  // namespace rondo::rom
