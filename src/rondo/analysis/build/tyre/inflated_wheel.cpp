// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/tyre/inflated_wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "rondo/analysis/build/tyre/curves.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

constexpr const char* instead =
    "more inflation.steps, other loads, or a finer section where it is thin; rondo run with "
    "analysis.kind = \"inflation\" keeps the equilibria up to there";

/// Largest distance from the axle of the nodes that may touch, else of all.
double radius_of(const InflatedWheel& wheel, std::span<const Vec3> u) {
  const std::vector<Vec2>& place = wheel.energy().section().place;
  const std::vector<int>& contact = wheel.section().boundary;
  double radius = 0.0;
  const auto take = [&](std::size_t a) {
    radius = std::max(radius, std::hypot(place[a].x + u[a].x, u[a].y));
  };
  for (const int node : contact) take(at(node));
  for (std::size_t a = 0; contact.empty() && a < place.size(); ++a) take(a);
  return radius;
}

std::string loads_text(double pressure, double spin) {
  return fmt::format("{:.6g} Pa and {:.6g} rad/s", pressure, spin);
}

CordFigures cord_figures(const InflatedWheel& wheel, std::size_t layer, std::span<const Vec3> u) {
  CordFigures f{wheel.energy().section().cords[layer].name, 1e300, -1e300, 1e300, 0.0};
  for (const auto& p : wheel.energy().cords(layer, u)) {
    f.force_min = std::min(f.force_min, p.state.force);
    f.force_max = std::max(f.force_max, p.state.force);
    f.stretch_min = std::min(f.stretch_min, p.state.stretch);
    f.stretch_max = std::max(f.stretch_max, p.state.stretch);
  }
  return f;
}

}  // namespace

InflatedWheel::InflatedWheel(const Case& c, mesh::Mesh section,
                             const std::vector<fem::Material>& materials)
    : section_(std::move(section)),
      energy_(tyre_section(c, section_, materials)),
      loads_(inflation_loads(c, section_)) {
  const auto least = std::ranges::min_element(energy_.mass());
  if (*least > 0.0) return;
  const auto node = static_cast<int>(least - energy_.mass().begin());
  throw case_error(c, "cords[0]",
                   fmt::format("with the excess mass of the cords the node at {} has a mass of "
                               "{:.4g} kg",
                               place_text(section_, node), *least),
                   "cords[].excess_mass of a metre of cord, in kg/m: a cord less the rubber in its "
                   "place");
}

InflationFigures figures_of(const InflatedWheel& wheel, const statics::Inflation& now) {
  const fem::finite::SectorEnergy& energy = wheel.energy();
  const std::vector<Vec2>& place = energy.section().place;
  RONDO_DEMAND(now.u.size() == place.size(), now.u.size(), place.size());
  InflationFigures f;
  f.share = now.share;
  f.pressure = now.share * wheel.loads().sector.pressure;
  f.spin = std::sqrt(now.share * wheel.loads().sector.spin_squared);
  for (const double m : energy.mass()) f.mass += energy.section().n_sectors * m;
  f.outer_radius = radius_of(wheel, now.u);
  f.growth = f.outer_radius - radius_of(wheel, std::vector<Vec3>(now.u.size()));
  double left = 1e300, right = -1e300;
  for (std::size_t a = 0; a < place.size(); ++a) {
    left = std::min(left, place[a].y + now.u[a].z);
    right = std::max(right, place[a].y + now.u[a].z);
    f.twist = std::max(f.twist, std::abs(now.u[a].y));
  }
  f.width = right - left;
  f.cavity = energy.cavity(now.u);
  f.det_f_min = now.turns.empty() ? 1.0 : now.state.least;
  f.stretch_max = energy.largest_stretch(now.u);
  f.newton_iterations = std::accumulate(now.turns.begin(), now.turns.end(), 0);
  f.residual = now.residual;
  for (std::size_t k = 0; k < energy.section().cords.size(); ++k)
    f.cords.push_back(cord_figures(wheel, k, now.u));
  return f;
}

std::string no_equilibrium(const InflatedWheel& wheel, const statics::Inflation& now) {
  const InflationFigures f = figures_of(wheel, now);
  std::string text = fmt::format("there is no equilibrium beyond {:.4g} of the loads, {}",
                                 now.share, loads_text(f.pressure, f.spin));
  if (now.inverted) {
    const auto& corner = wheel.energy().section().quads[*now.inverted].corner;
    const auto& names = wheel.section().region_names;
    const std::size_t region =
        wheel.section().region.empty() ? 0 : at(wheel.section().region[*now.inverted]);
    text += fmt::format(": the element at {}{} turns inside out",
                        place_text(wheel.section(), corner[0]),
                        region < names.size() ? fmt::format(", in \"{}\",", names[region]) : "");
  }
  std::string pressed;
  for (const CordFigures& cords : f.cords)
    if (cords.stretch_min < 1.0 - 1e-9)
      pressed += fmt::format("{}\"{}\" ({:.4g} N)", pressed.empty() ? "" : ", ", cords.curve,
                             cords.force_min);
  if (!pressed.empty()) text += "; cords in compression there: " + pressed;
  return text;
}

std::string instability(const InflatedWheel& wheel, const statics::Inflation& now) {
  const double spin_squared = now.share * wheel.loads().sector.spin_squared;
  const std::optional<int> waves =
      statics::unstable_harmonic(wheel.energy(), now.state, spin_squared, now.found ? -1 : 0);
  if (!waves) return {};
  const std::string shape =
      *waves == 0 ? "in all sectors alike" : fmt::format("in {} waves around the axle", *waves);
  return fmt::format("the equilibrium at {} is not stable: the wheel buckles {}",
                     loads_text(now.share * wheel.loads().sector.pressure, std::sqrt(spin_squared)),
                     shape);
}

statics::Inflation equilibrium_of(const Case& c, const InflatedWheel& wheel) {
  constexpr const char* key = "inflation";
  statics::InflationSteps steps(wheel.energy(), wheel.loads());
  std::string text;
  while (!steps.now().found && text.empty()) {
    if (!steps.advance()) throw case_error(c, key, no_equilibrium(wheel, steps.now()), instead);
    text = instability(wheel, steps.now());
  }
  if (!text.empty())
    throw case_error(c, key, text,
                     "loads that keep the cords in tension; rondo run with analysis.kind = "
                     "\"inflation\" tells their forces (cords.csv)");
  return steps.now();
}

std::vector<Vec3> in_all_sectors(const mesh::Mesh& wheel, std::span<const Vec3> u) {
  RONDO_DEMAND(wheel.n_nodes() == u.size() * at(wheel.n_sectors), wheel.n_nodes(), u.size(),
               wheel.n_sectors);
  std::vector<Vec3> all;
  for (std::size_t i = 0; i < wheel.n_nodes(); ++i) {
    const Vec2 out = direction_at(2.0 * std::numbers::pi * wheel.sector[i] / wheel.n_sectors -
                                  0.5 * std::numbers::pi);
    const Vec3 v = u[at(wheel.sector_node[i])];
    all.emplace_back(v.x * out + v.y * turn90(out), v.z);
  }
  return all;
}

}  // namespace rondo::study
