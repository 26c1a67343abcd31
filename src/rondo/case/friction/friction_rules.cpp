// SPDX-License-Identifier: BSD-3-Clause
/// Rules of friction that is no constant: its tables and patches, and which analyses cannot take
/// it. What a time step cannot do is in the table of steps (model/steps).
#include <fmt/format.h>

#include <string>
#include <string_view>

#include "rondo/case/case_rules.hpp"

namespace rondo::study {
namespace {

using contact::FrictionTable;

constexpr std::string_view table_key = "ground.friction", slip_key = "ground.friction.slip_speed";
constexpr double largest_factor = 100.0;  ///< that of the bounds of the other factors
constexpr double least_step = 1e-9;  ///< of the speeds: slopes between them are numbers   [m/s]

void check_slip_factors(CaseValues& in, const FrictionTable& friction) {
  for (std::size_t k = 0; k < friction.slip.size(); ++k) {
    const auto [speed, factor] = friction.slip[k];
    const auto fault = [&](std::string message) {
      in.fault_at_item(slip_key, static_cast<int>(k), std::move(message));
    };
    if (speed < 0.0) fault(fmt::format("the speed {} is below 0", speed));
    if (k > 0 && !(speed - friction.slip[k - 1][0] >= least_step))
      fault(fmt::format("the speeds must increase, by {:.0e} m/s at the least, but {} follows {}",
                        least_step, speed, friction.slip[k - 1][0]));
    if (factor < 0.0 || factor > largest_factor)
      fault(fmt::format("the factor {} is not from 0 to {}", factor, largest_factor));
  }
}

void check_patches(CaseValues& in, const Case& c) {
  const auto& patches = c.ground->friction.patches;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const std::string patch = item_of("ground.patch", k), to = patch + ".to";
    if (in.good({patch + ".from", to}) && in.has(patch + ".from") && in.has(to) &&
        !(patches[k].to > patches[k].from))
      in.fault(to, "must be more than from, or the patch has no length",
               fmt::format("> {:.6g}", patches[k].from));
    if (patches[k].side != contact::Side::both && !is_solid(c))
      in.fault(patch + ".side", "a plane body has no left and no right side",
               "\"both\"; or a wheel in three dimensions, with disk.width or a [section]");
  }
}

/// An analysis that cannot take some friction, and what to do instead.
struct FrictionRefusal {
  bool (*is_in)(const Case& c);
  bool (*cannot)(const FrictionTable& friction);
  std::string_view why, instead;
};

bool is_no_constant(const FrictionTable& friction) {
  return !friction.is_constant();
}

/// The factors of the slip speed are not all the same.
bool has_slip_factors(const FrictionTable& friction) {
  FrictionTable slip{.coefficient = friction.coefficient, .slip = friction.slip, .patches = {}};
  return !slip.is_constant();
}

bool is_of_latin(const Case& c) {
  return c.analysis.kind == AnalysisKind::crush && c.analysis.solver != CrushMethod::direct;
}

bool is_by_increments(const Case& c) {
  return c.analysis.kind == AnalysisKind::crush && c.analysis.solver == CrushMethod::direct;
}

bool has_patches(const FrictionTable& friction) {
  FrictionTable patches{
      .coefficient = friction.coefficient, .slip = {}, .patches = friction.patches};
  return !patches.is_constant();
}

constexpr FrictionRefusal friction_refusals[] = {
    {[](const Case& c) { return c.analysis.kind == AnalysisKind::steady_rolling; }, has_patches,
     "a wheel that passes from one stretch of the ground to another does not roll steadily",
     "no [[ground.patch]]; or a dynamic analysis"},
    {[](const Case& c) {
       return c.analysis.kind == AnalysisKind::dynamic &&
              c.initial.state == InitialState::steady_rolling;
     },
     has_patches, "a start in steady rolling has one friction everywhere on the ground",
     "no [[ground.patch]]; or initial.state = \"stationary\""},
    {is_of_latin, is_no_constant,
     "LATIN solves all increments at once with one coefficient of friction for all contacts",
     "a number, and no [[ground.patch]]; or analysis.solver = \"direct\""},
    {is_by_increments, has_slip_factors,
     "a crush is so slow that it has no slip speed, which the coefficient could depend on",
     "no slip_speed, and a coefficient times its factor at the slip speed that is meant; or a "
     "dynamic analysis"},
};

/// The key that is refused: patches, if without them it would not be; the slip speeds, if only they
/// are.
std::string_view key_of(const FrictionRefusal& refusal, FrictionTable friction) {
  friction.patches.clear();
  if (!refusal.cannot(friction)) return "ground.patch[0]";
  return refusal.cannot == has_slip_factors ? slip_key : table_key;
}

}  // namespace

void check_friction(CaseValues& in, const Case& c) {
  if (!c.ground) return;
  const FrictionTable& friction = c.ground->friction;
  if (in.has_table(table_key) && !in.has(table_key) && !has_friction_table(c) &&
      !in.has("ground.friction.coefficient") &&
      in.good({slip_key, "ground.friction.pressure_exponent"}))
    in.missing("ground.friction.coefficient");
  check_slip_factors(in, friction);
  check_patches(in, c);
  for (const FrictionRefusal& refusal : friction_refusals)
    if (refusal.is_in(c) && refusal.cannot(friction))
      in.refuse(key_of(refusal, friction), std::string(refusal.why), std::string(refusal.instead));
}

}  // namespace rondo::study
