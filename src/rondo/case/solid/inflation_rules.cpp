// SPDX-License-Identifier: BSD-3-Clause
/// Rules of [inflation] and [[cords]] (docs/tyre.md).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/case/case_rules.hpp"
#include "rondo/case/case_source.hpp"

namespace rondo::study {
namespace {

constexpr double far_from_rest = 0.1;  ///< of s²: the growth by the spin counts

/// Exactly one way to give a number.
void check_cord_stiffness(CaseValues& in, const CordsCase& cords, const std::string& table) {
  const std::string key = table + ".stiffness", modulus = table + ".youngs_modulus";
  if (!in.good({key, modulus, table + ".area"})) return;
  if (cords.stiffness && cords.youngs_modulus)
    in.fault(key, "is given together with youngs_modulus: the stiffness of a cord is E times area",
             "one of both");
  if (!cords.stiffness && !cords.youngs_modulus)
    in.fault(key, "is missing, and so is youngs_modulus", "stiffness, or youngs_modulus and area");
  if (cords.youngs_modulus && !cords.area)
    in.fault(modulus, "needs the area of a cord", "area beside it; or stiffness");
}

void check_cord_mass(CaseValues& in, const CordsCase& cords, const std::string& table) {
  if (cords.density && cords.excess_mass)
    in.refuse(table + ".density", "is given together with excess_mass, which follows from it",
              "one of both");
  if (cords.density && !cords.area && in.good({table + ".area"}))
    in.refuse(table + ".density", "needs the area of a cord", "area beside it; or excess_mass");
  if (!cords.area || !in.good({table + ".area", table + ".spacing"})) return;
  const double diameter = std::sqrt(4.0 * *cords.area / std::numbers::pi);
  if (diameter > cords.spacing)
    in.fault(
        table + ".spacing",
        fmt::format("cords of this area have a diameter of {:.4g} m and would overlap", diameter),
        fmt::format(">= {:.4g}, or a smaller area", diameter));
}

void check_lift(CaseValues& in, const CordsCase& cords, const std::string& table) {
  if (!cords.green_radius && in.has(table + ".green_extension") &&
      in.good({table + ".green_radius"}))
    in.refuse(table + ".green_extension", "has no effect without green_radius",
              "green_radius beside it");
  if (!cords.green_radius) return;
  if (cords.spacing_radius)
    in.refuse(table + ".spacing_radius",
              "is given together with green_radius, which says how the spacing changes",
              "one of both");
  if (cords.angle == 0.0 && in.good({table + ".angle"}))
    in.refuse(table + ".green_radius",
              "has no meaning for cords around the wheel: they cannot turn",
              "an angle that is not 0, or no green_radius");
}

void check_cords(CaseValues& in, const Case& c) {
  for (std::size_t k = 0; k < c.cords.size(); ++k) {
    const std::string table = item_of("cords", k);
    if (!c.inflation)
      return in.fault(table,
                      "cords belong to a wheel that is brought into equilibrium at finite strain, "
                      "by the table [inflation]",
                      "[inflation] beside them, with pressure = 0.0 if there is no air");
    check_cord_stiffness(in, c.cords[k], table);
    check_cord_mass(in, c.cords[k], table);
    check_lift(in, c.cords[k], table);
  }
}

void check_air(CaseValues& in, const Case& c) {
  const InflationCase& air = *c.inflation;
  if (air.pressure > 0.0 && air.curve.empty())
    in.refuse("inflation.curve", "is missing: there is no wall for the pressure",
              "the physical curve of the liner");
  for (std::size_t k = 0; k < c.pressures.size(); ++k)
    if (!air.curve.empty() && c.pressures[k].curve == air.curve)
      in.refuse(item_of("load.pressure", k) + ".curve",
                "is the curve of [inflation], whose pressure is in the equilibrium: the wheel is "
                "linear about one pressure",
                "inflation.pressure for the whole of it");
}

void demand_rubber(CaseValues& in, const fem::Material& m, const MaterialLaw& law,
                   const std::string& table) {
  if (!law.is_rubber() && in.good({table + ".youngs_modulus", table + ".poissons_ratio"}))
    in.refuse(table + ".model",
              "\"linear\" is for small strains, and [inflation] needs a law for finite ones",
              fmt::format("\"neo-hooke\" with shear_modulus = E / (2 (1 + ν)) = {:.6g}",
                          0.5 * m.youngs_modulus / (1.0 + m.poissons_ratio)));
  if (law.integration == Quadrature::one_point)
    in.refuse(table + ".integration", "[inflation] integrates rubber at 2×2×2 points",
              "no such key");
}

void check_rubbers(CaseValues& in, const Case& c) {
  demand_rubber(in, c.material, c.law, "material");
  for (std::size_t k = 0; k < c.regions.size(); ++k)
    demand_rubber(in, c.regions[k].material, c.regions[k].law, item_of("material.region", k));
}

/// The stress of finite strain is not that of the small ones about it.
void check_stress(CaseValues& in, Case& c) {
  constexpr std::string_view key = "output.stress";
  if (in.has(key) && c.output.stress && means_to(*find_case_key(key), c.analysis.kind))
    in.refuse(key, "the stress of an inflated wheel is not computed",
              "false, which is the default beside [inflation]; cord forces are in cords.csv");
  c.output.stress = false;
}

/// Where the motion is linear about the state, for the end of a sentence.
std::string_view linear_part(const InflationCase& c) {
  switch (c.nonlinear) {
    case TyreMotion::linear:
      return "";
    case TyreMotion::cords:
      return " in the rubber";
    default:
      return " in the rubber away from the ground";
  }
}

/// The crown grows with the spin by more than the linear motion should carry.
void warn_of_spin(CaseValues& in, Case& c) {
  if (c.inflation->nonlinear == TyreMotion::all ||
      !in.good({"motion.angular_velocity", "inflation.spin"}) ||
      !means_to(*find_case_key("motion.speed"), c.analysis.kind))
    return;
  const double rest = spin_at_rest(c) * spin_at_rest(c);
  for (const auto& point : c.motion.angular_velocity.points()) {
    const double spin = point[1] * point[1];
    if (std::abs(spin - rest) <= far_from_rest * std::max(spin, rest)) continue;
    c.warnings.push_back(fmt::format(
        "motion.angular_velocity = {} rad/s is far from the {} rad/s at which the wheel is in "
        "equilibrium (inflation.spin): what the spin changes there is linear{}",
        point[1], spin_at_rest(c), linear_part(*c.inflation)));
    return;
  }
}

/// A stationary start at another spin than that of the state is linear about the state.
void check_nonlinear(CaseValues& in, const Case& c) {
  if (c.inflation->nonlinear == TyreMotion::linear) return;
  if (c.initial.state == InitialState::stationary &&
      std::abs(c.motion.angular_velocity.at(0.0)) != std::abs(spin_at_rest(c)))
    in.refuse(
        "initial.state",
        fmt::format("\"stationary\" is linear about the state at {} rad/s "
                    "(inflation.spin), and with inflation.nonlinear no "
                    "equilibrium at the spin of t = 0",
                    spin_at_rest(c)),
        "\"rest\"; or inflation.spin = motion.angular_velocity at t = 0, which is its default");
}

}  // namespace

void check_inflation_alone(CaseValues& in, Case& c) {
  if (!c.inflation)
    in.refuse("analysis.kind", "\"inflation\" needs the table [inflation]",
              "[inflation] beside it, with the curve and the pressure of the air");
  if (c.ground)
    c.warnings.emplace_back(
        "an inflation is an equilibrium off the ground; without effect: [ground]");
}

void check_inflation(CaseValues& in, Case& c) {
  check_cords(in, c);
  if (!c.inflation) return;
  if (!is_solid(c))
    return in.fault("inflation", "is for wheels in three dimensions, and the body is plane",
                    "a [section], or a [disk] with a disk.width");
  check_air(in, c);
  check_names(in, "inflation.mounting[].curve", c);
  check_rubbers(in, c);
  if (is_generated(c) && c.disk.tread)
    in.fault("disk.tread", "with [inflation] all columns of the wheel are alike",
             "no [disk.tread]; grooves around the wheel in a [section]");
  check_stress(in, c);
  if (in.good({"inflation", "analysis.kind", "motion.angular_velocity", "initial.state"}))
    check_nonlinear(in, c);
  if (in.good({"inflation"})) warn_of_spin(in, c);
}

}  // namespace rondo::study
