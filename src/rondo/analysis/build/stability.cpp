// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rondo/analysis/build/memory.hpp"
#include "rondo/case/case_keys.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/statics/stationary_spin.hpp"

namespace rondo::study {
namespace {

using dynamics::Table;

/// Largest |value| from 0 to `end`.
double largest_until(const Table& table, double end) {
  double largest = std::max(std::abs(table.at(0.0)), std::abs(table.at(end)));
  for (const auto& [time, value] : table.points())
    if (time > 0.0 && time < end) largest = std::max(largest, std::abs(value));
  return largest;
}

// Spin softening --------------------------------------------------------------------------------

/// Whether every ω² of the body is above `shift` [1/s²].
bool frequencies_above(const dynamics::Model& m, double shift) {
  if (m.solid) return statics::eigenvalues_above(m.solid->sector, m.mass, shift);
  return by_harmonics(m) ? statics::eigenvalues_above(*m.sector, m.mass, shift)
                         : statics::eigenvalues_above(m.stiffness, m.mass, held_nodes(m), shift);
}

struct Interval {
  double low = 0.0, high = 0.0;
};

/// ω₁, by halving [0, 2 spin], which holds it; the first half tells the softening limit [rad/s].
Interval lowest_frequency(const dynamics::Model& m, double spin) {
  RONDO_DEMAND(spin > 0.0, spin);
  constexpr int halvings = 8;
  Interval of{0.0, 2.0 * spin};
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (of.low + of.high);
    (frequencies_above(m, middle * middle) ? of.low : of.high) = middle;
  }
  return of;
}

/// ∫ √(s² - ω²) dt over the time that the spin is above ω: the power of e by which what is
/// deformed grows, at the most.
double softening_growth(const Case& c, double omega) {
  constexpr int parts = 10000;
  const double dt = c.time.end / parts;
  double growth = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double s = c.motion.angular_velocity.at((k + 0.5) * dt);
    growth += std::sqrt(std::max(0.0, s * s - omega * omega)) * dt;
  }
  return growth;
}

std::string beyond_softening(const Case& c, double spin, Interval omega) {
  return fmt::format(
      "motion.angular_velocity reaches {:.6g} rad/s, beyond the softening limit: the lowest "
      "frequency of the body at rest is {:.4g} to {:.4g} rad/s, and above it centrifugal softening "
      "exceeds the stiffness (K - s²M is not positive definite). There is no equilibrium: "
      "deformations in general grow, at up to {:.3g} 1/s, by e^{:.3g} in this run, which ends with "
      "exit code 3 once its strains are meaningless. {}",
      spin, omega.low, omega.high, std::sqrt(std::max(0.0, spin * spin - omega.low * omega.low)),
      softening_growth(c, omega.low),
      is_solid(c) ? "A lower rotation speed, or a stiffer material"
                  : "A lower rotation speed, a stiffer material, or "
                    "material.stress_stiffening = \"centrifugal\"");
}

/// Degrees of freedom of a sector, where the check goes by harmonics; else 0.
std::size_t harmonic_dofs(const dynamics::Model& m) {
  if (m.solid) return 3 * m.solid->sector.n_local();
  return by_harmonics(m) ? 2 * m.sector->n_local() : 0;
}

}  // namespace

void warn_of_softening(const Case& c, Setup& s) {
  const dynamics::Model& m = s.model;
  const double spin = largest_until(c.motion.angular_velocity, c.time.end);
  if (spin == 0.0 || c.stress_stiffening != StressStiffening::none || !is_held(c)) return;
  if (has_rubber(c)) return;                                     // stress stiffens it
  if (c.inflation && spin <= std::abs(spin_at_rest(c))) return;  // a stable equilibrium
  if (!softening_is_checked(count_dofs(m), harmonic_dofs(m))) {
    s.warnings.push_back(
        fmt::format("the check of spin softening is left out above {} degrees of freedom, unless "
                    "one of equal sectors of the disk has at most {}",
                    softening_check_dofs, softening_check_harmonic_dofs));
    return;
  }
  const double wanted = 4.0 * spin * spin;
  if (wanted <= s.frequencies_above) return;
  for (const double shift : {2.0 * wanted, wanted}) {  // the next run may turn somewhat faster
    if (!frequencies_above(m, shift)) continue;
    s.frequencies_above = shift;
    return;
  }
  const Interval omega = lowest_frequency(m, spin);
  if (omega.high <= spin)
    s.warnings.push_back(beyond_softening(c, spin, omega));
  else if (!c.inflation)
    s.warnings.push_back(
        fmt::format("at {:.6g} rad/s the centrifugal softening takes more than a quarter of the "
                    "lowest stiffness (s² > ω₁²/4, ω₁ = {:.4g} to {:.4g} rad/s): a small-strain "
                    "model without stress stiffening is too soft there",
                    spin, omega.low, omega.high));
}

namespace {

// Steps and speeds ------------------------------------------------------------------------------

bool is_energy_safe(const dynamics::Model& m) {
  const auto is_safe = [](const auto& contact) {
    return !contact || contact->law.impact == contact::Impact::energy_safe;
  };
  return is_safe(m.contact) && is_safe(m.surfaces);
}

void warn_of_contact_step(Setup& s) {
  RONDO_DEMAND(s.critical.step > 0.0, s.critical.step);
  const double share = explicit_step(s.model) / s.critical.step;
  const double ratio = 0.5 * s.model.stiffness_damping * s.critical.omega;
  if (!has_candidates(s.model) || share <= contact_step_share || ratio >= contact_damping_ratio ||
      is_energy_safe(s.model) || has_massless_contact(s.model))
    return;
  s.warnings.push_back(fmt::format(
      "the step is {:.5g} of the critical one: with contact and next to no damping.stiffness, "
      "above {} of it repeated impacts feed the shortest waves of the mesh, where these reach the "
      "contact (they grow, and the ledger shows a negative loss_impact); time.safety of at most "
      "0.95, a damping.stiffness of {:.2g} s, or {}.impact = \"energy-safe\", with which they "
      "cannot",
      share, contact_step_share, 2.0 * contact_damping_ratio / s.critical.omega,
      s.model.contact ? "ground" : "contact"));
}

/// The scheme as printed lets a wave of frequency ω grow at s ω Δt / 2, and damping takes
/// (α + β ω²) / 2 of it.
void warn_of_printed_scheme(const Case& c, Setup& s) {
  if (c.time.scheme != Scheme::as_printed) return;
  const double spin = largest_until(c.motion.angular_velocity, c.time.end);
  const double beta = c.damping.stiffness, feed = 0.5 * spin * s.model.dt;
  const double omega =
      beta > 0.0 ? std::min(s.critical.omega, feed / beta) : s.critical.omega;  // fastest
  const double rate = omega * feed - 0.5 * (c.damping.mass + beta * omega * omega);
  if (rate * c.time.end <= growth_spoken_of) return;
  s.warnings.push_back(fmt::format(
      "time.scheme = \"as-printed\" creates energy: at {:.6g} rad/s waves of {:.4g} rad/s grow at "
      "up to {:.3g} 1/s, by e^{:.3g} in this run, which ends with exit code 3 once they outweigh "
      "all else; \"symplectic\", more damping, a smaller step or an earlier time.end",
      spin, omega, rate, rate * c.time.end));
}

/// Impulses of one half step act on velocities of the next, whose frame has turned by half of φ,
/// the turn in a step: with friction μ the law has one solution where μ tan(φ/2) < 1 (4.3).
void refuse_wide_turns(const Case& c, double dt) {
  if (!c.ground || !is_held(c) || c.rim) return;
  const double turn = largest_until(c.motion.angular_velocity, c.time.end) * dt;
  const double most = 2.0 * std::atan2(1.0, contact::largest_friction(c.ground->friction));
  if (turn < most) return;
  throw case_error(c, c.time.step ? "time.step" : "motion.angular_velocity",
                   fmt::format("the rim turns by {:.3g} rad in a step of {:.3g} s: too far for the "
                               "contact law, whose friction allows less than {:.3g} rad",
                               turn, dt, most),
                   fmt::format("time.step below {:.6g}", most / turn * dt));
}

/// The spin of t = 0 is in the factors of implicit elements; another one is found by a fixed point.
void refuse_wide_change_of_spin(const Case& c, const Setup& s) {
  if (!s.model.implicit) return;
  const double start = c.motion.angular_velocity.at(0.0);
  double change = 0.0;
  for (const auto& point : c.motion.angular_velocity.points())
    change = std::max(change, std::abs(point[1] - start));
  constexpr double most = 0.1;
  if (change * s.model.dt <= most) return;
  throw case_error(
      c, c.time.step ? "time.step" : "motion.angular_velocity",
      fmt::format("the spin changes by {:.4g} rad/s, {:.3g} rad in a step: too far for "
                  "implicit elements, whose factors are those of t = 0",
                  change, change * s.model.dt),
      fmt::format("time.step of at most {:.3g}", most / change));
}

/// A rim of its own; of one that is free the start tells, and the run looks on.
void refuse_wide_rim_turns(const Case& c, double dt) {
  if (!c.rim) return;
  const double fastest = largest_until(c.motion.angular_velocity, c.time.end);
  if (fastest * dt <= largest_turn) return;
  throw case_error(c, c.time.step ? "time.step" : "motion.angular_velocity",
                   fmt::format("the rim turns by {:.3g} rad in a step of {:.3g} s: with a [rim] at "
                               "most {} rad are resolved",
                               fastest * dt, dt, largest_turn),
                   fmt::format("time.step of at most {:.6g}", largest_turn / fastest));
}

void refuse_large_turns(const Case& c, const Setup& s) {
  if (s.model.free_bodies.empty()) return;
  double fastest = std::abs(c.initial.angular_velocity);
  std::string key = "initial.angular_velocity";
  for (std::size_t k = 0; k < c.initial.regions.size(); ++k)
    if (std::abs(c.initial.regions[k].angular_velocity) > fastest) {
      fastest = std::abs(c.initial.regions[k].angular_velocity);
      key = item_of("initial.region", k) + ".angular_velocity";
    }
  if (fastest * s.model.dt <= largest_turn) return;
  throw case_error(c, key,
                   fmt::format("the body would turn by {:.3g} rad in a step of {:.4g} s: its "
                               "rotation is not resolved above {} rad",
                               fastest * s.model.dt, s.model.dt, largest_turn),
                   fmt::format("at most {:.4g} rad/s with this step", largest_turn / s.model.dt));
}

/// Largest speed of what may touch, at the start and by the motion of the rim [m/s].
double largest_speed(const Case& c, const Setup& s) {
  double initial = 0.0, radius = 0.0;
  for (const int node : s.mesh.boundary) {
    const auto k = static_cast<std::size_t>(node);
    initial = std::max(initial, initial_speed(s, k));
    if (!in_fixed_frame(s.model, k)) radius = std::max(radius, norm(s.model.reference[k]));
  }
  const dynamics::Motion& motion = c.motion;
  double lowering = std::abs(motion.height.slope(0.0));
  for (const auto& [time, height] : motion.height.points())
    if (time < c.time.end) lowering = std::max(lowering, std::abs(motion.height.slope(time)));
  const double rim = is_held(c)
                         ? std::max(largest_until(motion.speed, c.time.end),
                                    radius * largest_until(motion.angular_velocity, c.time.end))
                         : 0.0;
  return initial + rim + lowering;
}

void warn_of_fast_contact(const Case& c, Setup& s) {
  if (!has_candidates(s.model)) return;
  double shortest = std::numeric_limits<double>::infinity();
  if (s.mesh.is_solid()) {
    const std::vector<double> sizes = element_sizes(s.mesh);
    for (const int node : s.mesh.boundary) shortest = std::min(shortest, sizes[at(node)]);
  }
  for (const mesh::Edge& edge : s.mesh.contact_edges) {
    const auto& x = s.mesh.coordinates;
    shortest = std::min(shortest, norm(x[at(edge[1])] - x[at(edge[0])]));
  }
  const double dt = explicit_step(s.model), way = largest_speed(c, s) * dt;
  if (!(way > 0.5 * shortest)) return;
  s.warnings.push_back(fmt::format(
      "at {:.4g} m/s contact nodes move by {:.3g} m in a step, more than half the shortest edge "
      "({:.3g} m): contacts may be missed or met too late. Such speeds are near or above that of "
      "waves ({:.4g} m/s){}; a smaller time.step helps the contact only",
      way / dt, way, shortest, fem::wave_speeds(c.material).pressure,
      has_rubber(c) ? "" : ", where small strains are not valid"));
}

}  // namespace

void check_motion(const Case& c, const Setup& s) {
  RONDO_DEMAND(s.model.dt > 0.0, s.model.dt);
  refuse_wide_turns(c, explicit_step(s.model));
  refuse_wide_rim_turns(c, s.model.dt);
  refuse_wide_change_of_spin(c, s);
}

void check_stability(const Case& c, Setup& s) {
  RONDO_DEMAND(s.n_steps > 0 && s.velocity.size() == s.model.n_nodes(), s.n_steps,
               s.velocity.size(), s.model.n_nodes());
  check_motion(c, s);
  refuse_large_turns(c, s);
  warn_of_softening(c, s);
  warn_of_contact_step(s);
  warn_of_printed_scheme(c, s);
  warn_of_fast_contact(c, s);
}

void check_places(const Case& c, const mesh::Mesh& mesh) {
  const std::vector<double> sizes = element_sizes(mesh);
  RONDO_DEMAND(!sizes.empty(), c.file.string());
  const double shortest = *std::min_element(sizes.begin(), sizes.end());
  constexpr double resolution = 1e-4;  // of the shortest edge
  const double farthest = resolution * shortest / std::numeric_limits<double>::epsilon();
  const auto refuse_beyond = [&](double distance, const char* key) {
    if (std::abs(distance) <= farthest) return;
    throw case_error(c, key,
                     fmt::format("brings the body {:.3g} m away from the origin, where coordinates "
                                 "do not resolve its shortest edge of {:.3g} m",
                                 std::abs(distance), shortest),
                     fmt::format("a distance of at most {:.2g} m", farthest));
  };
  if (may_be_free(c)) {
    refuse_beyond(norm(c.initial.position), "initial.position");
    refuse_beyond(norm(c.initial.velocity) * c.time.end, "initial.velocity");
  }
  if (!is_held(c)) return;
  refuse_beyond(c.motion.start_x, "motion.start_x");
  if (!c.rim || !c.rim->free_x) refuse_beyond(c.motion.center(c.time.end).x, "motion.speed");
  refuse_beyond(largest_until(c.motion.height, c.time.end), "motion.height");
}

bool softening_is_checked(std::size_t dofs, std::size_t harmonic_dofs) noexcept {
  return dofs <= softening_check_dofs ||
         (harmonic_dofs > 0 && harmonic_dofs <= softening_check_harmonic_dofs);
}

}  // namespace rondo::study
