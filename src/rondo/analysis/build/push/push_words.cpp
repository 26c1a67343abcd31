// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/push/push_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "rondo/analysis/build/push/free_rolling.hpp"
#include "rondo/contact/friction_table.hpp"

namespace rondo::study {
namespace {

using dynamics::Table;

constexpr int none = 0, positive = 1, negative = 2, both = 3;

int sense_of(double value) noexcept {
  return value > 0.0 ? positive : value < 0.0 ? negative : none;
}

/// Which signs a table has at some time.
int sense_of(const Table& table) noexcept {
  int sense = none;
  for (const auto& point : table.points()) sense |= sense_of(point[1]);
  return sense;
}

int reversed(int sense) noexcept {
  return sense == positive ? negative : sense == negative ? positive : sense;
}

bool is_steady(const Case& c) noexcept {
  return c.analysis.kind == AnalysisKind::steady_rolling;
}

/// Whether the speed is a result, of which the case says at most how it begins.
bool has_free_speed(const Case& c) noexcept {
  const bool found = is_steady(c) && (c.analysis.traction || c.analysis.torque);
  return found || (c.rim && c.rim->free_x);
}

/// The sense of travel; with a speed that is a result, that of the spin.
int travel_of(const Case& c) noexcept {
  return sense_of(has_free_speed(c) ? c.motion.angular_velocity : c.motion.speed);
}

/// The sense of rolling; none: the wheel does not turn at first, and forces decide.
int spin_of(const Case& c) noexcept {
  return sense_of(c.motion.angular_velocity);
}

std::string degrees(double angle) {
  return fmt::format("{:.4g}°", 180.0 / std::numbers::pi * std::abs(angle));
}

/// "by 1°", of a table "by up to 1°".
std::string by_angle(const Table& table) {
  return (table.points().size() > 1 ? "by up to " : "by ") + degrees(table.largest());
}

/// A force towards +x, +z or the other way in the columns of rondo, and in ISO axes where these
/// are defined alike: of wheels that roll ahead.
std::string signs(const char* column, const char* iso, int sense, bool iso_is_opposite,
                  bool ahead) {
  const char* const sign = sense == positive ? ">" : "<";
  const char* const other = sense == positive ? "<" : ">";
  std::string text = fmt::format("{} {} 0", column, sign);
  if (ahead) text += fmt::format(", ISO {} {} 0", iso, iso_is_opposite ? other : sign);
  return text;
}

std::string lateral_signs(int sense, bool ahead) {
  return signs("force_lateral", "F_y", sense, true, ahead);
}

const char* side(int sense) noexcept {  // of +z, to the right
  return sense == positive ? "right" : "left";
}

/// Says to which side the slip angle pushes a wheel that travels ahead, backwards, or both in turn.
std::string slip_angle_words(const Case& c, int travel) {
  if (travel == none) return "the wheel does not travel, so that a slip angle does not push it";
  const Table& angle = c.motion.slip_angle;
  const int moves = travel == negative ? reversed(sense_of(angle)) : sense_of(angle);
  if (moves == both || travel == both)
    return fmt::format(
        "turned {} to the left and to the right of its velocity: the ground pushes it against its "
        "motion to the side, {}",
        by_angle(angle),
        travel == positive ? "force_lateral < 0 and ISO F_y > 0 while motion.slip_angle > 0"
                           : "force_lateral < 0 while it moves to the right");
  const int push = reversed(moves);
  if (travel == negative)
    return fmt::format("rolls backwards and moves to the {} {}: the ground pushes it to the {}, {}",
                       side(moves), by_angle(angle), side(push), lateral_signs(push, false));
  return fmt::format("turned to the {} of its velocity {}: the ground pushes it to the {}, {}",
                     side(push), by_angle(angle), side(push), lateral_signs(push, true));
}

std::string camber_words(const Case& c, int travel) {
  const int lean = reversed(sense_of(c.motion.camber));  // > 0 leans to the left
  const std::string leans =
      fmt::format("leans its top to the {} by {}", side(lean), degrees(c.motion.camber));
  if (travel == none) return leans + "; it does not roll, and the run tells how it is pushed";
  return fmt::format(
      "{}: to which side the ground pushes it depends on the crown of the tread. A crowned tread "
      "on a short footprint is pushed to the {} ({}), a flat one to the {}; the run tells",
      leans, side(lean), lateral_signs(lean, travel == positive), side(reversed(lean)));
}

/// Not for certain: narrow wheels, which are soft sideways, may be pushed inwards.
std::string turn_slip_words(const Case& c, int travel) {
  const int outwards = sense_of(c.analysis.turn_slip);  // > 0 turns to the left
  std::string text = fmt::format(
      "the path bends to the {}, with a radius of {:.4g} m: most wheels are pushed outwards, to "
      "the {}, {}",
      side(reversed(outwards)), 1.0 / std::abs(c.analysis.turn_slip), side(outwards),
      lateral_signs(outwards, travel == positive));
  if (travel == positive)
    text += ", and turned against the path, " +
            signs("moment_aligning", "M_z", reversed(outwards), false, true);
  return text + "; narrow ones may be pushed inwards, and the run tells";
}

/// "ahead, force_x > 0, ISO F_x > 0"
std::string along(int sense, int travel, bool solid) {
  const char* way = sense == positive ? "towards +x" : "towards -x";
  if (travel == positive) way = sense == positive ? "ahead" : "back";
  return fmt::format("{}, {}", way,
                     signs("force_x", "F_x", sense, false, solid && travel == positive));
}

/// When the words on a free spin hold.
constexpr const char* settled = ", once its spin has settled";

/// A torque or a brake has a sign for certain if it is above that of a wheel that rolls freely,
/// which may be of either sign at a slip angle.
const char* condition(const Case& c, bool drives) {
  const bool is_at_angles = sense_of(c.motion.slip_angle) != none || c.motion.camber != 0.0 ||
                            c.analysis.turn_slip != 0.0;
  if (is_at_angles)
    return ", if the torque is well above that of rolling with this slip angle, camber or turn "
           "slip";
  return drives ? ", if the torque is above that of the rolling resistance" : "";
}

/// The torque on the rim of steady rolling, or of a free spin. @param when  the words hold
std::string torque_words(const Case& c, int sense, int travel, const char* key, const char* when) {
  if (sense == both)
    return fmt::format("{} changes its sign: > 0 pushes the wheel towards +x, force_x > 0{}", key,
                       when);
  const bool drives = travel == sense, brakes = travel == reversed(sense);
  return fmt::format("{} by {}: the ground pushes it {}{}{}",
                     drives   ? "driven"
                     : brakes ? "braked"
                              : "turned",
                     key, along(sense, travel, is_solid(c)), when, condition(c, drives));
}

/// What spin and speed are to a wheel at some time: above or below those of free rolling at any
/// radius with which it may roll freely, or within.
struct Slip {
  bool above = false, below = false, within = false;
  double radius = 0.0;  ///< V/w, at the last time                                           [m]
};

Slip slip_of(const Case& c, const FreeRadii& free) {
  Slip slip;
  for (const Table* table : {&c.motion.angular_velocity, &c.motion.speed, &c.motion.slip_angle})
    for (const auto& point : table->points()) {
      const double spin = c.motion.angular_velocity.at(point[0]), speed = c.motion.ahead(point[0]);
      if (spin == 0.0 && speed == 0.0) continue;
      const int sense = sense_of(spin * free.least - speed) | sense_of(spin * free.largest - speed);
      slip.above |= sense == positive;
      slip.below |= sense == negative;
      slip.within |= sense == both || sense == none;
      if (spin != 0.0) slip.radius = speed / spin;
    }
  return slip;
}

std::string slip_words(const Case& c, const FreeRadii& free, int travel) {
  const Slip slip = slip_of(c, free);
  if (!slip.above && !slip.below && !slip.within)
    return "neither turns nor travels: the ground does not push it along";
  if (!slip.above && !slip.below)
    return fmt::format(
        "near free rolling: V/w = {:.4g} m, and the effective radius is a result, between {:.4g} "
        "and {:.4g} m by estimate; the run tells the sign of force_x",
        slip.radius, free.least, free.largest);
  if (slip.within || (slip.above && slip.below))
    return "its spin changes against that of free rolling: force_x > 0 while it is above, < 0 "
           "while it is below";
  const int sense = slip.above ? positive : negative;
  const bool drives = travel == none || sense == travel;
  return fmt::format("{}: the ground pushes it {}",
                     drives ? "driven, its spin is above that of free rolling at its speed"
                            : "braked, its spin is below that of free rolling at its speed",
                     along(sense, travel, is_solid(c)));
}

std::string brake_words(const Case& c, int travel) {
  if (travel == positive || travel == negative)
    return fmt::format("braked by rim.brake: the ground pushes it {}{}{}",
                       along(reversed(travel), travel, is_solid(c)), settled, condition(c, false));
  return "rim.brake acts against the spin: the ground pushes the wheel against its travel";
}

/// Whether more than torque and brake changes the spin of a rim that turns freely.
bool is_pulled(const Case& c) noexcept {
  const dynamics::RimBody& rim = *c.rim;
  if (!rim.free_x) return c.motion.speed.points().size() > 1;
  const bool is_held_back = rim.support_x.stiffness > 0.0 || rim.support_x.damping > 0.0;
  const bool is_on_slope = c.motion.slope != 0.0 && sense_of(c.motion.gravity) != none;
  return sense_of(rim.force_x) != none || is_held_back || is_on_slope;
}

/// @param add  takes a name and words
template <class Add>
void tell_rim(const Case& c, int travel, Add add) {
  const int torque = sense_of(c.rim->torque), brake = sense_of(c.rim->brake);
  if (torque == none && brake == none) return;
  if (is_pulled(c))
    return add("pushes along",
               "a changing motion.speed, rim.force_x, rim.support.x or gravity on a slope acts on "
               "the spin besides torque and brake: the run tells the sign of force_x");
  if (torque != none) add("push of torque", torque_words(c, torque, travel, "rim.torque", settled));
  if (brake != none) add("push of the brake", brake_words(c, travel));
  if (torque != none && brake != none)
    add("pushes along", "each as if alone; the run tells the sum");
}

/// @param add  takes a name and words
template <class Add>
void tell_drive(const Case& c, const std::optional<FreeRadii>& free, int travel, Add add) {
  if (is_steady(c) && c.analysis.torque) {
    const int sense = sense_of(*c.analysis.torque);
    add("push of torque", sense == none
                              ? std::string("rolls freely: the run tells its rolling resistance")
                              : torque_words(c, sense, travel, "analysis.torque", ""));
  } else if (is_steady(c) && c.analysis.traction) {
    const int sense = sense_of(*c.analysis.traction);
    if (sense != none)
      add("push of traction",
          "analysis.traction: the ground pushes it " + along(sense, travel, is_solid(c)));
  } else if (c.rim && c.rim->free_spin) {
    tell_rim(c, travel, add);
  } else if (free && !(c.rim && c.rim->free_x)) {
    add("push of the spin", slip_words(c, *free, travel));
  }
}

bool rolls_on_ground(const Case& c) {
  return c.ground && is_held(c) && (is_steady(c) || c.analysis.kind == AnalysisKind::dynamic);
}

}  // namespace

std::vector<Told> push_lines(const Case& c, const mesh::Mesh& mesh) {
  std::vector<Told> lines;
  const std::optional<Wall> wall = wall_of(mesh);
  if (!rolls_on_ground(c) || !(wall || is_solid(c))) return lines;
  if (contact::largest_friction(c.ground->friction) == 0.0)
    return {{"push",
             "the ground has no friction: it pushes along its normal, and not along the "
             "way or to a side"}};
  const auto add = [&](const char* name, std::string words) {
    lines.emplace_back(name, std::move(words));
  };
  const int travel = travel_of(c);
  if (is_solid(c)) {
    if (sense_of(c.motion.slip_angle) != none)
      add("push of slip angle", slip_angle_words(c, travel));
    if (c.motion.camber != 0.0)
      add("push of camber", camber_words(c, spin_of(c) == none ? none : travel));
    if (c.analysis.turn_slip != 0.0) add("push of turn slip", turn_slip_words(c, travel));
    const std::size_t sideways = lines.size();
    if (sideways > 1 || (sideways == 1 && c.section))
      add("pushes to a side",
          c.section
              ? "each as if alone; a section or cords that are not symmetric push as well, also "
                "straight ahead"
              : "each as if alone; the run tells the sum");
  }
  std::optional<FreeRadii> free;
  if (wall) free = free_radii(c, mesh, *wall);
  tell_drive(c, free, travel, add);
  return lines;
}

}  // namespace rondo::study
