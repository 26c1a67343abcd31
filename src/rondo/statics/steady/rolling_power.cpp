// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_power.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::statics {
namespace {

using Eigen::Index;

/// A scheme below this share of load times speed is round-off.
constexpr double round_off_of_sums = 1e-12;

}  // namespace

void find_scheme_shares(double carried, RollingPower& p) noexcept {
  const double scheme = std::abs(p.scheme);
  if (!(scheme > round_off_of_sums * carried)) return;
  const double largest = std::max({std::abs(p.drive), p.damping(), std::abs(p.friction)});
  p.scheme_share = scheme / largest;
  p.scheme_over_load = scheme / carried;
}

template <int D>
Eigen::MatrixXcd spectrum_of(const RollingWindow<D>& w, const RollingSolution& s) {
  const RollingHarmonics<D>& h = w.harmonics();
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(static_cast<Index>(D * h.n_candidates()), h.turn());
  for (std::size_t j = 0; j < w.pairs().size(); ++j) {
    const RollingPair& p = w.pairs()[j];
    force.block<D, 1>(static_cast<Index>(D * p.candidate),
                      static_cast<Index>(h.wrapped(p.sample))) =
        w.to_ground(p.sample).transpose() * s.force.segment<D>(static_cast<Index>(D * j));
  }
  Eigen::MatrixXcd spectrum = h.spectrum(force, w.gravity());
  if (w.response().size() > 0) spectrum += w.response();
  return spectrum;
}

template <int D>
RollingPower rolling_power(const RollingWindow<D>& w, const RollingSolution& s,
                           const Eigen::MatrixXcd& spectrum, const Eigen::MatrixXd& remainder) {
  const RollingHarmonics<D>& h = w.harmonics();
  const double spin = h.body().spin, pass = h.body().samples;
  const Eigen::MatrixXcd surface = h.on_candidates(spectrum);
  const Eigen::MatrixXd u = h.fields(surface, 0.0, false), rate = h.fields(surface, 0.0, true);
  const auto damped = h.damped(spectrum);
  const double ahead = s.speed * std::cos(s.path.slip_angle),
               aside = s.speed * std::sin(s.path.slip_angle), yaw = s.path.turn_slip * s.speed;
  const NodeVector<D> speed = NodeVector<3>{0.0, ahead, aside}.head<D>();
  RollingPower power;
  power.mass = damped.by_mass;
  power.stiffness = damped.by_stiffness;
  power.by_part = damped.by_viscosity;
  for (const double part : power.by_part) power.viscosity += part;
  power.weight = h.weight(spectrum, w.gravity());
  // The torque of the ground alone: the weight's part is an entry of its own.
  const double torque = s.forces.torque + power.weight / spin;
  power.drive = ahead * s.forces.heading + aside * s.forces.lateral + spin * torque;
  if (yaw != 0.0) power.drive += yaw * s.forces.aligning;
  double of_field = 0.0;  // Σ r·w by the field's own velocity
  for (std::size_t j = 0; j < w.pairs().size(); ++j) {
    const RollingPair& p = w.pairs()[j];
    const auto row = static_cast<Index>(D * j), at = static_cast<Index>(D * p.candidate);
    const NodeVector<D> force = s.force.segment<D>(row);
    if (force.isZero(0.0)) continue;
    const auto m = static_cast<Index>(h.wrapped(p.sample));
    const NodeVector<D> arm = h.reference(p.candidate) + u.block<D, 1>(at, m);
    const NodeVector<D> way = quarter_turned<D>(arm) + rate.block<D, 1>(at, m);
    const NodeMatrix<D>& to_ground = w.to_ground(p.sample);
    of_field += force.dot(spin * (to_ground * way) + speed) / pass;
    if (yaw != 0.0) {
      const NodeVector<D - 1> place = (to_ground * arm).template tail<D - 1>();
      of_field += yaw * force.dot(yawed<D>(place).reshaped()) / pass;
    }
    power.friction -=
        force.template tail<D - 1>().dot(s.gap_and_slip.segment<D - 1>(row + 1)) / pass;
  }
  double inner = 0.0;
  if (remainder.size() > 0)
    inner = spin / pass * h.fields(spectrum, 0.0, true).cwiseProduct(remainder).sum();
  power.scheme = of_field + power.friction - inner;
  const double left = power.drive + power.damping() - power.weight - of_field + inner;
  const double carried = s.forces.normal * std::max(std::abs(s.speed), std::abs(spin) * s.height);
  const double largest = std::max(
      {std::abs(ahead * s.forces.heading) + std::abs(aside * s.forces.lateral),
       std::abs(spin * torque), std::abs(yaw * s.forces.aligning), power.mass, power.stiffness,
       power.viscosity, std::abs(power.friction), least_power_share * carried});
  power.residual = largest > 0.0 ? std::abs(left) / largest : 0.0;
  find_scheme_shares(carried, power);
  return power;
}

template Eigen::MatrixXcd spectrum_of(const RollingWindow<2>&, const RollingSolution&);
template Eigen::MatrixXcd spectrum_of(const RollingWindow<3>&, const RollingSolution&);
template RollingPower rolling_power(const RollingWindow<2>&, const RollingSolution&,
                                    const Eigen::MatrixXcd&, const Eigen::MatrixXd&);
template RollingPower rolling_power(const RollingWindow<3>&, const RollingSolution&,
                                    const Eigen::MatrixXcd&, const Eigen::MatrixXd&);

}  // namespace rondo::statics
