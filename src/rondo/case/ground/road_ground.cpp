// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/ground/road_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/case/case_source.hpp"
#include "rondo/case/ground/profile_file.hpp"
#include "rondo/road/crg/crg_reader.hpp"
#include "rondo/road/road_section.hpp"

namespace rondo::study {
namespace {

constexpr std::string_view road_key = "ground.road", start_key = "ground.road_start",
                           offset_key = "ground.road_offset", border_key = "ground.road_border",
                           fillet_key = "ground.fillet";
/// By default x = 0 is so far behind the first row of the road [m].
constexpr double default_start = 0.5;
/// The level stretches at both ends have at most so many points.
constexpr std::size_t points_of_ends = 4;

/// Whether there is one shape of the ground, and no key of a road without one.
bool asks_for_road(CaseValues& in) {
  if (!in.has_table("ground") || !in.good({"ground"})) return false;
  if (in.has(road_key)) {
    if (in.has("ground.profile"))
      in.fault(road_key, "is given together with ground.profile: the ground has one shape",
               "one of ground.road and ground.profile");
    return in.good({road_key});
  }
  if (!in.has("ground.profile")) in.missing("ground.profile");
  for (const std::string_view key : {start_key, offset_key, border_key})
    if (in.has(key))
      in.refuse(key, "has no effect without ground.road", "ground.road = \"NAME.crg\" beside it");
  return false;
}

/// Reads the file, whose name is relative to the case file even if --set gives it. The case of a
/// wheel in three dimensions is written with the file, which is then found from elsewhere too.
bool read_road(CaseValues& in, Case& c) {
  RoadCase& road = c.ground->road;
  if (road.file.empty()) {
    in.fault(road_key, "must not be empty", "the name of an OpenCRG file (.crg)");
    return false;
  }
  const std::filesystem::path file = c.file.parent_path() / std::filesystem::path(road.file);
  try {
    road.read = std::make_shared<const road::Road>(road::read_crg(file));
    if (is_solid(c)) road.file = as_utf8(file.string());
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) in.fault_in_file(road_key, fault);
  } catch (const FileError& error) {
    in.fault(road_key, error.what(), "a whole file of ASAM OpenCRG");
  }
  return road.read != nullptr;
}

std::string_view mode_text(road::Border border) {
  switch (border) {
    case road::Border::none:
      return "none";
    case road::Border::zero:
      return "zero";
    case road::Border::keep:
      return "keep";
    case road::Border::repeat:
      return "repeat";
    case road::Border::reflect:
      return "reflect";
  }
  return "";
}

/// A plane ground is level beyond the ends of a road, at one height or another. Under a wheel in
/// three dimensions there is ground beyond the ends, whatever it is.
bool check_border(CaseValues& in, const Case& c) {
  const RoadCase& road = c.ground->road;
  const road::Border border = edges_of(road).u;
  if (border == road::Border::keep || border == road::Border::zero) return true;
  const bool in_space = is_solid(c);
  if (in_space && border != road::Border::none) return true;
  const std::string asks = fmt::format(
      "(\"{}\") for what the ground of {} does not do beyond the "
      "ends of a road",
      mode_text(border), in_space ? "a wheel" : "a plane body");
  const std::string instead = fmt::format("\"keep\"{} \"zero\"{}", in_space ? "," : " or",
                                          in_space ? " or \"repeat\"" : "");
  if (!road.border.empty())
    in.fault(border_key, "asks " + asks, instead);
  else
    in.fault(road_key,
             fmt::format("{} asks by BORDER_MODE_U = {} {}", road.read->file,
                         static_cast<int>(border), asks),
             fmt::format("ground.road_border = {} beside it", instead));
  return false;
}

/// Where x = 0 is, and the plane of the wheel: both are on the road.
bool check_places(CaseValues& in, Case& c) {
  RoadCase& road = c.ground->road;
  const road::Road& read = *road.read;
  const double last = read.u_last();
  const bool given = road.start.has_value();
  const double start = road.start.value_or(read.u_first + default_start);
  if (!(start >= read.u_first && start <= last))
    in.fault(start_key,
             given ? "x = 0 would not be on the road"
                   : fmt::format("is missing: by default x = 0 is {} m behind the first row, which "
                                 "is not on this road",
                                 default_start),
             fmt::format("{:.6g} to {:.6g}, u of the road", read.u_first, last));
  if (!(road.offset >= read.v.front() && road.offset <= read.v.back()))
    in.fault(offset_key, "the plane of the wheel is beside the road",
             fmt::format("{:.6g} to {:.6g}, v of the road", read.v.front(), read.v.back()));
  if (!is_solid(c) && read.n_u() + points_of_ends > most_profile_points)
    in.fault(road_key,
             fmt::format("the road has {} rows, and the ground of a plane body has up to {}",
                         read.n_u(), most_profile_points - points_of_ends),
             "a file with the part that the wheel reaches");
  road.start = start;
  return in.good({road_key, start_key, offset_key});
}

/// The points of the ground, from the heights with everything in them.
void make_points(CaseValues& in, GroundCase& ground) {
  RoadCase& road = ground.road;
  const road::Surface surface(*road.read, edges_of(road));
  const std::vector<Vec2> rows = road::section_of(surface, road.offset);
  const auto hole = std::ranges::find_if(rows, [](Vec2 p) { return std::isnan(p.y); });
  if (hole != rows.end())
    return in.fault(in.has(offset_key) ? offset_key : road_key,
                    fmt::format("{} has no height at u = {:.6g} m, v = {:.6g} m", road.read->file,
                                hole->x, road.offset),
                    "another ground.road_offset; or GRID_NAN_MODE = 2 in the file, which fills "
                    "missing heights");
  road.height = road::height_in(rows, *road.start);
  ground.profile.clear();
  for (const Vec2 p : road::with_level_ends(rows, surface, road.offset))
    ground.profile.push_back({p.x - *road.start, p.y - road.height});
}

/// Refuses a place without height at x = 0, and what has no meaning on a smooth surface.
void take_surface(CaseValues& in, GroundCase& ground) {
  RoadCase& road = ground.road;
  road.height = road::Surface(*road.read, edges_of(road)).at(*road.start, road.offset).height;
  if (std::isnan(road.height))
    in.fault(in.has(start_key) ? start_key : road_key,
             fmt::format("{} has no height at u = {:.6g} m, v = {:.6g} m, where x = 0",
                         road.read->file, *road.start, road.offset),
             "another ground.road_start or ground.road_offset; or GRID_NAN_MODE = 2 in the file, "
             "which fills missing heights");
  if (in.good({fillet_key}) && ground.fillet > 0.0)
    in.fault(fillet_key,
             "rounds corners, and the surface of a road under a wheel with a width has none",
             "0, or leave it out");
}

}  // namespace

road::Edges edges_of(const RoadCase& road) {
  road::Edges edges = road.read->edges;
  if (road.border.empty()) return edges;
  edges.u = road.border == "zero"     ? road::Border::zero
            : road.border == "repeat" ? road::Border::repeat
                                      : road::Border::keep;
  edges.offset_u = 0.0;
  return edges;
}

void take_road(CaseValues& in, Case& c) {
  if (!asks_for_road(in) || !c.ground) return;
  if (!in.good({start_key, offset_key, border_key}) || !read_road(in, c)) return;
  const bool known = check_border(in, c);
  if (!check_places(in, c) || !known) return;
  if (is_solid(c))
    take_surface(in, *c.ground);
  else
    make_points(in, *c.ground);
}

}  // namespace rondo::study
