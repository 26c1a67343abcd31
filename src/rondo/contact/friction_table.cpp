// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/friction_table.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace rondo::contact {
namespace {

/// Pressures count between p_ref over this and p_ref times this.
constexpr double pressure_range = 10.0;

/// A factor with its derivative.
struct Factor {
  double value = 1.0, slope = 0.0;
};

Factor slip_factor(const std::vector<std::array<double, 2>>& table, double speed) noexcept {
  if (table.empty()) return {};
  const auto after =
      std::ranges::upper_bound(table, speed, {}, [](const auto& point) { return point[0]; });
  if (after == table.begin()) return {.value = table.front()[1]};
  if (after == table.end()) return {.value = table.back()[1]};
  const auto [low_speed, low] = *std::prev(after);
  const auto [high_speed, high] = *after;
  const double slope = (high - low) / (high_speed - low_speed);
  return {low + slope * (speed - low_speed), slope};
}

Factor pressure_factor(const FrictionTable& table, double pressure) noexcept {
  if (table.pressure_exponent == 0.0) return {};
  const double ratio = pressure / table.pressure_reference;
  const double within = std::clamp(ratio, 1.0 / pressure_range, pressure_range);
  const double value = std::pow(within, table.pressure_exponent);
  const bool moves = ratio >= 1.0 / pressure_range && ratio < pressure_range;
  return {value, moves ? table.pressure_exponent * value / pressure : 0.0};
}

/// Half the width over which one side passes into the other, so that round-off does not decide on
/// which one a node in the middle plane is                                                     [m]
constexpr double border = 1e-3;

/// How much of a node at `lateral` lies on a side: from 0 to 1.
double share_on(Side side, double lateral) noexcept {
  if (side == Side::both) return 1.0;
  const double right = std::clamp(0.5 * (1.0 + lateral / border), 0.0, 1.0);
  return side == Side::right ? right : 1.0 - right;
}

}  // namespace

bool FrictionTable::is_constant() const noexcept {
  const auto is_as_first = [&](const auto& point) { return point[1] == slip[0][1]; };
  const auto changes_nothing = [](const FrictionPatch& patch) { return patch.factor == 1.0; };
  return coefficient == 0.0 ||
         (pressure_exponent == 0.0 && std::ranges::all_of(slip, is_as_first) &&
          std::ranges::all_of(patches, changes_nothing));
}

double patch_factor(const FrictionTable& table, const Vec3& place) noexcept {
  double factor = 1.0;
  for (const FrictionPatch& patch : table.patches)
    if (place.x >= patch.from && place.x < patch.to)
      factor *= 1.0 + share_on(patch.side, place.z) * (patch.factor - 1.0);
  return factor;
}

bool falls_with_slip(const FrictionTable& table) noexcept {
  return !std::ranges::is_sorted(table.slip, {}, [](const auto& point) { return point[1]; });
}

double steepest_rise(const FrictionTable& table, double pressure) noexcept {
  double rise = 0.0;
  for (const auto& point : table.slip)
    rise = std::max(rise, slip_factor(table.slip, point[0]).slope);
  return table.coefficient * pressure_factor(table, pressure).value * rise;
}

double largest_friction(const FrictionTable& table) noexcept {
  double slip = table.slip.empty() ? 1.0 : 0.0, patches = 1.0;
  for (const auto& point : table.slip) slip = std::max(slip, point[1]);
  for (const FrictionPatch& patch : table.patches) patches *= std::max(1.0, patch.factor);
  const double pressure = std::pow(pressure_range, std::abs(table.pressure_exponent));
  return table.coefficient * patches * slip * pressure;
}

FrictionValue friction_at(const FrictionTable& table, const SlidingState& of) noexcept {
  const Factor slip = slip_factor(table.slip, of.slip);
  const Factor pressure = pressure_factor(table, of.pressure);
  const double scale = table.coefficient * patch_factor(table, of.place);
  return {scale * slip.value * pressure.value, scale * slip.slope * pressure.value,
          scale * slip.value * pressure.slope};
}

Friction friction_of(FrictionTable table) {
  if (table.is_constant()) return friction_at(table, {}).coefficient;
  const auto shared = std::make_shared<const FrictionTable>(std::move(table));
  return Friction(
      [shared](const SlidingState& of) { return friction_at(*shared, of).coefficient; });
}

}  // namespace rondo::contact
