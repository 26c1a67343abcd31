// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/case/features/case_features.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/physical_group.hpp"

namespace rondo::study {
namespace {

constexpr double most_steps = 1e12;  ///< would take years

void check_tread(CaseValues& in, const mesh::Disk& disk) {
  constexpr std::string_view columns = "disk.mesh.circumferential";
  if (in.has(columns) && in.good({columns}))
    in.fault(columns, "is given together with [disk.tread], whose pitches determine the columns",
             "one of disk.mesh.circumferential and [disk.tread]");
  const double thickness = disk.outer_radius - disk.inner_radius;
  if (in.good({"disk.outer_radius", "disk.inner_radius", "disk.tread.depth"}) &&
      !(disk.tread->depth < thickness))
    in.fault("disk.tread.depth", "the grooves would reach the rim",
             fmt::format("> 0 and < outer_radius - inner_radius = {:.6g}", thickness));
}

/// The nodes of the mesh must be counted by int.
void check_size(CaseValues& in, const Case& c) {
  if (!in.good({"disk.mesh.radial", "disk.mesh.circumferential", "disk.tread.pitches",
                "disk.tread.land_columns", "disk.tread.groove_columns", "disk.tread.layers"}))
    return;
  const std::size_t n_nodes = mesh::n_disk_nodes(c.disk);
  constexpr std::size_t most_nodes = std::size_t{1} << 31;
  if (n_nodes >= most_nodes)
    in.fault(largest_count(c.disk), fmt::format("the mesh would have {} nodes", n_nodes),
             fmt::format("fewer than {} nodes", most_nodes));
}

void check_disk(CaseValues& in, const Case& c) {
  if (!is_generated(c)) return;
  if (in.has_table("mesh"))
    in.fault("mesh", "is given together with [disk]: the body is one or the other",
             "[disk] or [mesh]");
  if (in.good({"disk.outer_radius", "disk.inner_radius"}) &&
      !(c.disk.inner_radius < c.disk.outer_radius))
    in.fault("disk.inner_radius", "must be smaller than outer_radius",
             fmt::format("> 0 and < outer_radius = {:.6g}", c.disk.outer_radius));
  if (c.disk.tread) check_tread(in, c.disk);
  check_size(in, c);
}

void warn_of_locking(const std::string& key, const fem::Material& material, Case& c) {
  if (material.plane != fem::Plane::strain || material.poissons_ratio <= 0.49 ||
      material.integration == fem::Integration::b_bar)
    return;
  c.warnings.push_back(
      fmt::format("{} = {}: {}full integration is far too stiff so near to 0.5; use "
                  "material.integration = \"b-bar\"",
                  key, material.poissons_ratio, is_solid(c) ? "" : "in plane strain, "));
}

/// Each table chooses elements by exactly one key.
void check_implicit(CaseValues& in, const Case& c) {
  for (std::size_t k = 0; k < c.implicit.size(); ++k) {
    const std::string table = item_of("solver.implicit", k);
    check_part(in, c, table);
    int given = 0;
    for (const char* key : {"slower_than", "layers", "region"})
      given += in.has(fmt::format("{}.{}", table, key)) ? 1 : 0;
    if (given != 1)
      in.fault(table, given == 0 ? "chooses no elements" : "chooses elements by more than one key",
               "one of slower_than, layers and region; several tables add up");
  }
}

void check_material(CaseValues& in, Case& c) {
  if (c.stress_stiffening == StressStiffening::centrifugal && !is_held(c))
    in.fault("material.stress_stiffening",
             "a free body is not turned by a rim: there is no spin whose stress could stiffen it",
             "\"none\"");
  for (std::size_t k = 0; k < c.regions.size(); ++k) {
    const std::string table = item_of("material.region", k);
    check_part(in, c, table);
    if (is_generated(c) && !in.has(table + ".layers") && !in.has(table + ".surface"))
      in.missing(table + ".layers");
  }
  if (!is_generated(c)) check_names(in, "material.region[].surface", c);
  check_materials(in, c);
  warn_of_locking("material.poissons_ratio", c.material, c);
  for (std::size_t k = 0; k < c.regions.size(); ++k)
    if (c.regions[k].material.poissons_ratio != c.material.poissons_ratio ||
        c.regions[k].material.integration != c.material.integration)
      warn_of_locking(item_of("material.region", k) + ".poissons_ratio", c.regions[k].material, c);
}

/// A free body moves only by its initial velocity: nothing carries or turns it.
void check_motion(CaseValues& in, Case& c) {
  if (c.motion.slope != 0.0 && c.motion.gravity.largest() == 0.0)
    c.warnings.emplace_back(
        "motion.slope has no effect: it tilts gravity, and motion.gravity is 0");
  if (is_held(c)) return;
  for (const std::string_view path :
       {"motion.angular_velocity", "motion.speed", "motion.height", "motion.start_x"})
    if (in.has(path) && means_to(*find_case_key(path), c.analysis.kind))
      in.fault(path, "has no effect on an unconstrained body",
               "initial.position, initial.velocity, initial.angular_velocity instead");
}

void check_ground(CaseValues& in, const Case& c) {
  if (!c.ground) return;
  const MeshCase* const file = mesh_file_of(c);
  if (file && file->contact.empty())
    in.fault(base_ground_key(c), "no part of the mesh may touch the ground",
             fmt::format("{}.contact = \"tread\" beside it, a physical curve; {}",
                         c.mesh ? "mesh" : "section", mesh::physical_group_line("Curve", "tread")));
  if (!in.good({"ground", "ground.profile", "ground.road", "ground.fillet"})) return;
  const contact::GroundShape base{c.ground->profile, c.ground->fillet};
  for (const contact::ShapeFault& fault : contact::shape_faults(base)) {
    if (fault.about_fillet && in.has("ground.fillet"))
      in.fault("ground.fillet", fault.message);
    else if (c.ground->road.read && fault.point >= 0)
      in.fault("ground.road", fmt::format("{}, at x = {:.6g} m", fault.message,
                                          c.ground->profile[at(fault.point)].x));
    else
      in.fault_at_item(base_ground_key(c), fault.point, fault.message);
  }
}

void check_body_contact(CaseValues& in, Case& c) {
  if (c.body_contact.between == BodyContact::none) return;
  if (is_generated(c))
    c.warnings.emplace_back(
        "contact.between has no effect on a [disk]: it is one body, and the walls of its grooves "
        "have no contact nodes; for grooves that close, use a [mesh]");
  if (c.mesh && c.mesh->contact.empty())
    in.fault("contact.between", "no part of the mesh may touch anything",
             "mesh.contact = \"tread\" beside it, a physical curve; " +
                 mesh::physical_group_line("Curve", "tread"));
}

/// Refuses keys of free bodies in a case that can have none.
void check_placing(CaseValues& in) {
  const auto refuse = [&](std::string_view key) {
    in.fault(key,
             "is for unconstrained bodies: a bonded disk is placed and moved by its rim ([motion])",
             "disk.rim = \"free\" beside it");
  };
  for (const std::string_view key :
       {"initial.position", "initial.turn", "initial.angle", "initial.angular_velocity"})
    if (in.has(key)) refuse(key);
  if (in.n_items("initial.region") > 0) refuse("initial.region[0]");
}

/// Warns of the change of sign between versions: a case made for the other sign is valid too.
void warn_of_sign(Case& c) {
  bool turns = c.initial.angular_velocity != 0.0;
  for (const InitialRegion& region : c.initial.regions) turns |= region.angular_velocity != 0.0;
  if (turns)
    c.warnings.emplace_back(
        "initial.angular_velocity: > 0 turns clockwise now, as motion.angular_velocity does; until "
        "this version it was counter-clockwise");
}

/// The key of earlier versions has the opposite sign.
void take_angle(CaseValues& in, Case& c) {
  if (!in.has("initial.angle") || !may_be_free(c)) return;
  if (in.has("initial.turn"))
    in.fault("initial.angle", "is minus initial.turn, which is there as well", "one of both");
  if (c.initial.angle == 0.0) return;
  c.initial.turn = -c.initial.angle;
  c.warnings.push_back(fmt::format(
      "initial.angle = {} is counter-clockwise, unlike all other angles of turns: it is taken as "
      "initial.turn = {}, which takes its place",
      c.initial.angle, c.initial.turn));
  c.initial.angle = 0.0;
}

void check_initial(CaseValues& in, Case& c) {
  take_angle(in, c);
  warn_of_sign(c);
  if (c.initial.state == InitialState::stationary && !is_held(c))
    in.fault("initial.state", "a free body is not turned by a rim: it has no stationary spin",
             "\"rest\"");
  if (c.initial.state == InitialState::steady_rolling) check_steady_start(in, c);
  check_names(in, "initial.region[].surface", c);
  if (!may_be_free(c) && in.good({"disk.rim"})) check_placing(in);
  if (!c.mesh && c.free_rim && !c.initial.regions.empty())
    in.fault("initial.region[0]", "a [disk] is one body",
             "initial.velocity and initial.angular_velocity");
}

void check_time(CaseValues& in, const Case& c) {
  const Time& time = c.time;
  if (in.has("time.step") && in.has("time.safety"))
    in.fault("time.step", "is given together with time.safety: give one of them",
             "time.step or time.safety");
  if (time.step && in.good({"time.end", "time.step"}) && time.end / *time.step > most_steps)
    in.fault("time.step", fmt::format("the run would take {:.3g} steps", time.end / *time.step),
             fmt::format("at most {:.0e} steps", most_steps));
}

void check_operator(CaseValues& in, const Case& c) {
  if (c.solver_operator != "cyclic" || is_solid(c)) return;
  const std::string_view why = why_not_cyclic(c);
  if (!why.empty())
    in.fault("solver.operator", fmt::format("\"cyclic\" needs the step \"fused cyclic\": {}", why),
             "\"auto\" or \"sparse\"");
}

/// Refuses combinations that no time step supports (model/steps/step_table.hpp).
void check_combinations(CaseValues& in, const Case& c) {
  dynamics::Features all = features_of(c);
  if (!in.good({"material.model"})) all &= ~dynamics::Features{dynamics::has::viscosity};
  std::vector<const dynamics::Limit*> refusals;  // collected first: refusing one key affects others
  for (const dynamics::Limit& limit : dynamics::step_limits())
    if (limit.is_refusal() && limit.holds_for(all) &&
        in.good({row_of(c, limit.at).key, row_of(c, limit.with).key}))
      refusals.push_back(&limit);
  for (const dynamics::Limit* limit : refusals)
    in.refuse(row_of(c, limit->at).key, std::string(limit->why), instead_of(c, *limit));
  if (c.contact_mass != ContactMass::lumped && !c.ground)
    in.fault("solver.contact_mass",
             "there is no [ground] that contact nodes without mass could touch",
             "\"lumped\", or a [ground]");
}

bool is_word(std::string_view name) {
  return std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

/// What is asked for must come into a file, and must not be zero for want of contact.
void check_friction_work(CaseValues& in, const Case& c) {
  constexpr std::string_view key = "output.friction_work";
  if (!c.output.friction_work || !in.good({key})) return;
  if (!c.ground && c.body_contact.between == BodyContact::none)
    in.fault(key, "nothing can be touched, so that there is no friction",
             "output.friction_work = false, or a [ground]");
  if (in.good({"output.snapshots"}) && c.output.snapshots == 0)
    in.fault(key, "the run has no snapshots, in which it would be written",
             "output.snapshots = 2, for the start and the end, or more");
}

void check_output(CaseValues& in, Case& c) {
  const Output& output = c.output;
  if (in.good({"output.snapshots_from", "time.end"}) && output.snapshots_from > c.time.end)
    in.fault("output.snapshots_from", "must not be after the end of the run",
             fmt::format("0 to time.end = {:.6g}", c.time.end));
  check_friction_work(in, c);
  check_names(in, "output.probe[].name", c);
  for (std::size_t k = 0; k < output.probes.size(); ++k) {
    const std::string name = item_of("output.probe", k) + ".name";
    if (in.good({name}) && !is_word(output.probes[k].name))
      in.fault(name, "has a character that may not be in the name of a column",
               "letters, digits, _ and -");
  }
}

}  // namespace

void check_names(CaseValues& in, std::string_view path, Case& c) {
  const CaseKey& key = *find_case_key(path);
  const auto name = [&](std::size_t k) { return *std::get<std::string*>(key.field(c, k)); };
  for (std::size_t k = 1; k < table_with(key).count(c); ++k) {
    const std::string at = path_of(key, k);
    if (!in.has(at) || !in.good({at})) continue;
    for (std::size_t before = 0; before < k; ++before)
      if (name(before) == name(k)) {
        in.fault(at, "is the name of another one before it");
        break;
      }
  }
}

void check_part(CaseValues& in, const Case& c, const std::string& table) {
  for (const char* key : {"surface", "region"})
    if (is_generated(c) && in.has(fmt::format("{}.{}", table, key)))
      in.fault(fmt::format("{}.{}", table, key), "a [disk] has no physical surfaces",
               fmt::format("{}.layers, or a [mesh]", table));
  const std::string layers = table + ".layers";
  if (!is_generated(c) && in.has(layers))
    in.fault(layers, c.mesh ? "a [mesh] has no layers" : "a [section] has no layers",
             "its surface by name; " + mesh::physical_group_line("Surface", "tread"));
}

void require(CaseValues& in, std::string_view key) {
  if (in.good({"analysis.kind"}) && !in.has(key)) in.missing(key);
}

void check_flat_ground(CaseValues& in, const Case& c, std::string_view who) {
  if (!in.has_table("ground")) return in.missing("ground.profile");
  if (!in.good({"ground", "ground.profile", "ground.road", "ground.fillet"})) return;
  if (is_on_road_surface(c))
    return in.fault("ground.road", fmt::format("{} needs flat ground, and a road is not", who),
                    "ground.profile = \"flat\" in its place");
  const std::vector<Vec2>& profile = c.ground->shape.profile;
  if (has_obstacles_of_own_axes(c) ||
      !std::all_of(profile.begin(), profile.end(), [&](Vec2 p) { return p.y == profile[0].y; }))
    in.fault(ground_key(c), fmt::format("{} needs flat ground: all points at one height", who),
             c.ground->obstacles.empty() ? "ground.profile = \"flat\"" : "no [[ground.obstacle]]");
}

void check_analysis(CaseValues& in, Case& c) {
  if (const auto check = rules_of(c.analysis.kind).check) check(in, c);
}

void check_case(CaseValues& in, Case& c) {
  check_disk(in, c);
  check_material(in, c);
  check_motion(in, c);
  check_rim(in, c);
  check_ground(in, c);
  check_friction(in, c);
  check_body_contact(in, c);
  check_initial(in, c);
  check_time(in, c);
  check_operator(in, c);
  check_combinations(in, c);
  check_implicit(in, c);
  check_hati(in, c);
  check_rubber(in, c);
  check_viscosity(in, c);
  check_output(in, c);
  check_solid(in, c);
  check_inflation(in, c);
}

std::string_view largest_count(const mesh::Disk& disk) noexcept {
  const int columns = disk.tread ? disk.tread->pitches : disk.circumferential;
  if (disk.radial > columns) return "disk.mesh.radial";
  return disk.tread ? "disk.tread.pitches" : "disk.mesh.circumferential";
}

}  // namespace rondo::study
