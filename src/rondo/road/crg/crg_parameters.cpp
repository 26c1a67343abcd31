// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_parameters.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace rondo::road {
namespace {

constexpr std::array<std::string_view, 28> road_keys{
    "REFERENCE_LINE_START_U",    "REFERENCE_LINE_END_U",     "REFERENCE_LINE_INCREMENT",
    "LONG_SECTION_V_RIGHT",      "LONG_SECTION_V_LEFT",      "LONG_SECTION_V_INCREMENT",
    "REFERENCE_LINE_START_S",    "REFERENCE_LINE_END_S",     "REFERENCE_LINE_START_B",
    "REFERENCE_LINE_END_B",      "REFERENCE_LINE_START_X",   "REFERENCE_LINE_START_Y",
    "REFERENCE_LINE_END_X",      "REFERENCE_LINE_END_Y",     "REFERENCE_LINE_OFFSET_X",
    "REFERENCE_LINE_OFFSET_Y",   "REFERENCE_LINE_START_PHI", "REFERENCE_LINE_END_PHI",
    "REFERENCE_LINE_OFFSET_PHI", "REFERENCE_LINE_START_Z",   "REFERENCE_LINE_END_Z",
    "REFERENCE_LINE_OFFSET_Z",   "REFERENCE_LINE_START_LON", "REFERENCE_LINE_START_LAT",
    "REFERENCE_LINE_END_LON",    "REFERENCE_LINE_END_LAT",   "REFERENCE_LINE_START_ALT",
    "REFERENCE_LINE_END_ALT"};

constexpr std::array<std::string_view, 24> modifier_keys{
    "SCALE_Z_GRID",        "SCALE_SLOPE",         "SCALE_BANKING",       "SCALE_LENGTH",
    "SCALE_WIDTH",         "SCALE_CURVATURE",     "GRID_NAN_MODE",       "GRID_NAN_OFFSET",
    "REFLINE_ROTCENTER_X", "REFLINE_ROTCENTER_Y", "REFLINE_OFFSET_PHI",  "REFLINE_OFFSET_X",
    "REFLINE_OFFSET_Y",    "REFLINE_OFFSET_Z",    "REFPOINT_U_FRACTION", "REFPOINT_U_OFFSET",
    "REFPOINT_U",          "REFPOINT_V_FRACTION", "REFPOINT_V_OFFSET",   "REFPOINT_V",
    "REFPOINT_X",          "REFPOINT_Y",          "REFPOINT_Z",          "REFPOINT_PHI"};

constexpr std::array<std::string_view, 26> option_keys{"BORDER_MODE_U",
                                                       "BORDER_MODE_V",
                                                       "BORDER_OFFSET_U",
                                                       "BORDER_OFFSET_V",
                                                       "BORDER_SMOOTH_UBEG",
                                                       "BORDER_SMOOTH_UEND",
                                                       "REFLINE_CONTINUATION",
                                                       "REFLINE_SEARCH_FAR",
                                                       "REFLINE_SEARCH_CLOSE",
                                                       "REFLINE_SEARCH_U",
                                                       "REFLINE_SEARCH_UFRAC",
                                                       "WARN_MSGS",
                                                       "WARN_CURV_LOCAL",
                                                       "WARN_CURV_GLOBAL",
                                                       "LOG_MSGS",
                                                       "LOG_EVAL",
                                                       "LOG_EVAL_FREQ",
                                                       "LOG_HIST",
                                                       "LOG_HIST_FREQ",
                                                       "LOG_STAT",
                                                       "LOG_STAT_FREQ",
                                                       "CHECK_EPS",
                                                       "CHECK_INC",
                                                       "CHECK_TOL",
                                                       "CHECK_PRO",
                                                       "CHECK_WGS"};

constexpr double shortest_increment = 1e-6;  // [m], as for the reference implementation
constexpr double longest_increment = 1e6;    // [m]
constexpr double farthest = 1e9;             // [m]: a step of 1e-6 m is still seen in u
constexpr double largest_scale = 1e6;
/// The end of the line may be so far from a whole number of increments, in increments.
constexpr double end_tolerance = 0.01;
/// Header and line at its end agree within this, in slope.
constexpr double constant_tolerance = 1e-6;

/// Keys of which one or more would change the heights in a way that is not done.
void refuse_undone_options(const CrgValues& options) {
  for (const char* const key : {"BORDER_SMOOTH_UBEG", "BORDER_SMOOTH_UEND"})
    if (options.real_or(key, 0.0) != 0.0)
      options.refuse(key, "heights that fade in and out at the ends are not done",
                     "0, or no line with it; a road whose heights in the file fade");
  if (options.choice("REFLINE_CONTINUATION", 1).value_or(0) == 1)
    options.refuse("REFLINE_CONTINUATION",
                   "a reference line that closes to a track is not followed",
                   "0, or no line with it; BORDER_MODE_U = 3 repeats the road");
}

void demand_scales(const CrgValues& modifiers) {
  for (const char* const key : {"SCALE_Z_GRID", "SCALE_SLOPE", "SCALE_BANKING"})
    if (modifiers.real_or(key, 1.0) == 0.0)
      modifiers.refuse(key, "the standard ignores the factor 0, and its tools make the road flat",
                       "another factor, or no line with it");
  for (const char* const key : {"SCALE_LENGTH", "SCALE_WIDTH"})
    if (!(modifiers.real_or(key, 1.0) > 0.0))
      modifiers.refuse(key, "a road has no such length or width", "a factor > 0");
  for (const char* const key :
       {"SCALE_Z_GRID", "SCALE_SLOPE", "SCALE_BANKING", "SCALE_LENGTH", "SCALE_WIDTH"})
    if (!(std::abs(modifiers.real_or(key, 1.0)) <= largest_scale))
      modifiers.refuse(key, "no road is scaled so much",
                       fmt::format("at most {:g}", largest_scale));
}

/// A reference point gives the height of the whole road, an offset shifts it.
void demand_one_shift(const CrgValues& modifiers) {
  const CrgValue* point = nullptr;
  for (const CrgValue& value : modifiers.values)
    if (value.key.starts_with("REFPOINT_")) point = &value;
  if (point != nullptr && modifiers.real_or("REFLINE_OFFSET_Z", 0.0) != 0.0)
    modifiers.refuse("REFLINE_OFFSET_Z",
                     fmt::format("{} in line {} gives the height of the road too, and the tools of "
                                 "OpenCRG differ in which of both counts",
                                 point->key, point->line),
                     "one of both");
  for (const char* const axis : {"U", "V"}) {
    const std::string absolute = fmt::format("REFPOINT_{}", axis);
    if (modifiers.find(absolute) != nullptr && modifiers.find(absolute + "_FRACTION") != nullptr)
      modifiers.refuse(absolute, fmt::format("{}_FRACTION gives the point too", absolute),
                       "one of both");
  }
}

}  // namespace

CrgValues read_road_block(const CrgHeader& header) {
  if (header.block("ROAD_CRG") == nullptr)
    refuse_header({header.file, header.last_line, "$ROAD_CRG"}, "",
                  "the file has no such block, which gives the increment of the rows",
                  "$ROAD_CRG with REFERENCE_LINE_INCREMENT");
  return read_crg_values(header, "ROAD_CRG", road_keys);
}

CrgValues read_modifier_block(const CrgHeader& header) {
  CrgValues modifiers = read_crg_values(header, "ROAD_CRG_MODS", modifier_keys);
  demand_scales(modifiers);
  demand_one_shift(modifiers);
  static_cast<void>(modifiers.choice("GRID_NAN_MODE", 2));
  return modifiers;
}

CrgValues read_option_block(const CrgHeader& header) {
  CrgValues options = read_crg_values(header, "ROAD_CRG_OPTS", option_keys);
  refuse_undone_options(options);
  return options;
}

double crg_increment(const CrgValues& road) {
  constexpr const char* key = "REFERENCE_LINE_INCREMENT";
  const std::optional<double> step = road.real(key);
  if (!step) road.refuse(key, "the distance of the rows is missing", "a length in m");
  if (!(*step >= shortest_increment && *step <= longest_increment))
    road.refuse(key, "this is no distance of rows", "1e-6 to 1e6 m");
  if (!(std::abs(road.real_or("REFERENCE_LINE_START_U", 0.0)) <= farthest))
    road.refuse("REFERENCE_LINE_START_U", "the rows cannot be told apart so far from u = 0",
                "-1e9 to 1e9 m");
  return *step;
}

std::optional<double> crg_promised_rows(const CrgValues& road) {
  constexpr const char* key = "REFERENCE_LINE_END_U";
  const std::optional<double> end = road.real(key);
  if (!end) return std::nullopt;
  const double steps = (*end - road.real_or("REFERENCE_LINE_START_U", 0.0)) / crg_increment(road);
  if (!(steps >= 1.0 - end_tolerance))
    road.refuse(key, "the road has no length", "REFERENCE_LINE_START_U and an increment, or more");
  const double whole = std::round(steps);
  if (std::abs(steps - whole) > end_tolerance)
    road.refuse(key, fmt::format("the road is {:.6g} increments long", steps),
                "REFERENCE_LINE_START_U and a whole number of REFERENCE_LINE_INCREMENT");
  return whole + 1.0;
}

double crg_constant(const CrgValues& road, const char* start_key, const char* end_key) {
  const double start = road.real_or(start_key, 0.0);
  if (!(std::abs(start) <= 1.0))
    road.refuse(start_key, "slope and banking are at most 1", "-1 to 1");
  const std::optional<double> end = road.real(end_key);
  if (end && std::abs(*end - start) > constant_tolerance)
    road.refuse(end_key,
                fmt::format("{} is {}, and the file has no channel that says how it changes",
                            start_key, start),
                "the same value, or a channel D:reference line slope,m/m or banking,m/m");
  return start;
}

Edges crg_edges(const CrgValues& options) {
  Edges edges;
  if (const auto mode = options.choice("BORDER_MODE_U", 4)) edges.u = static_cast<Border>(*mode);
  if (const auto mode = options.choice("BORDER_MODE_V", 4)) edges.v = static_cast<Border>(*mode);
  edges.offset_u = options.real_or("BORDER_OFFSET_U", 0.0);
  edges.offset_v = options.real_or("BORDER_OFFSET_V", 0.0);
  return edges;
}

}  // namespace rondo::road
