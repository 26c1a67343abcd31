// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "rondo/case/case.hpp"
#include "rondo/case/case_bodies.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

constexpr int schema_read = 1;
constexpr double most_steps = 1e12;  ///< years of computing

/// A later schema may mean other things by the same keys, so nothing else is said of such a file.
void read_schema(CaseSource& source) {
  const auto found = source.values.find("schema");
  if (found == source.values.end() || found->second.type != ValueType::integer) return;
  const CaseValue& value = found->second;
  if (value.integer <= schema_read) return;
  const bool in_file = value.place.source == 0;
  throw InputError(
      Fault{source.sources[static_cast<std::size_t>(value.place.source)].name,
            in_file ? value.place.line : 0, in_file ? value.place.column : 0, "schema",
            source.written(value.place),
            fmt::format("schema {} is from a later version of rondo; this one reads {}",
                        value.integer, schema_read),
            fmt::format("{}", schema_read)});
}

bool is_crush(const Case& c) {
  return c.analysis.kind == AnalysisKind::crush;
}

/// For keys that only one kind of analysis requires; says nothing where the kind is at fault.
void require(CaseValues& in, std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys)
    if (in.good({"analysis.kind"}) && !in.has(key)) in.missing(key);
}

void read_analysis(CaseValues& in, Case& c) {
  constexpr std::string_view depth = "analysis.depth", increments = "analysis.increments",
                             slide = "analysis.slide",
                             slide_increments = "analysis.slide_increments";
  c.analysis.kind = static_cast<AnalysisKind>(in.choice("analysis.kind"));
  in.read(depth, c.analysis.depth);
  in.read(increments, c.analysis.increments);
  in.read(slide, c.analysis.slide);
  in.read(slide_increments, c.analysis.slide_increments);
  if (is_crush(c)) {
    require(in, {depth, increments});
    if (in.has(slide)) require(in, {slide_increments});
    if (in.has(slide_increments)) require(in, {slide});
    if (c.analysis.slide == 0.0) c.analysis.slide_increments = 0;
    return;
  }
  for (const std::string_view key : {depth, increments, slide, slide_increments})
    if (in.good({"analysis.kind"}) && in.has(key))
      in.fault(key, "means nothing to a dynamic analysis", "analysis.kind = \"crush\" beside it");
}

/// @pre analysis and disk are read
void check_depth(CaseValues& in, const Case& c) {
  if (c.mesh) return;  // how thick it is, only the file tells
  const double thickness = c.disk.outer_radius - c.disk.inner_radius;
  if (is_crush(c) && in.good({"disk.outer_radius", "disk.inner_radius", "analysis.depth"}) &&
      !(c.analysis.depth < thickness))
    in.fault("analysis.depth", "the rim would reach the ground",
             fmt::format("> 0 and < outer_radius - inner_radius = {:.6g}", thickness));
}

void read_tread(CaseValues& in, mesh::Disk& disk) {
  mesh::Tread& tread = disk.tread.emplace();
  in.read("disk.tread.pitches", tread.pitches);
  in.read("disk.tread.depth", tread.depth);
  in.read("disk.tread.land_columns", tread.land_columns);
  in.read("disk.tread.groove_columns", tread.groove_columns);
  in.read("disk.tread.layers", tread.layers);
  const double thickness = disk.outer_radius - disk.inner_radius;
  if (in.good({"disk.outer_radius", "disk.inner_radius", "disk.tread.depth"}) &&
      !(tread.depth < thickness))
    in.fault("disk.tread.depth", "the grooves would reach the rim",
             fmt::format("> 0 and < outer_radius - inner_radius = {:.6g}", thickness));
}

void read_columns(CaseValues& in, mesh::Disk& disk) {
  constexpr std::string_view columns = "disk.mesh.circumferential";
  if (!in.has_table("disk.tread")) {
    if (!in.has(columns)) in.missing(columns);
    return in.read(columns, disk.circumferential);
  }
  if (in.has(columns))
    in.fault(columns, "stands beside a [disk.tread], whose pitches give the columns",
             "one of disk.mesh.circumferential and [disk.tread]");
  read_tread(in, disk);
}

/// The mesh must be numbered by int.
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

void read_disk(CaseValues& in, Case& c) {
  mesh::Disk& disk = c.disk;
  c.free_rim = in.choice("disk.rim") == 1;
  if (c.free_rim && is_crush(c))
    in.fault("disk.rim", "a crush presses a disk down by its rim", "\"bonded\"");
  in.read("disk.outer_radius", disk.outer_radius);
  in.read("disk.inner_radius", disk.inner_radius);
  if (in.good({"disk.outer_radius", "disk.inner_radius"}) &&
      !(disk.inner_radius < disk.outer_radius))
    in.fault("disk.inner_radius", "must be smaller than outer_radius",
             fmt::format("> 0 and < outer_radius = {:.6g}", disk.outer_radius));
  in.read("disk.mesh.radial", disk.radial);
  in.read("disk.mesh.grading", disk.grading);
  read_columns(in, disk);
  check_size(in, c);
}

void read_body(CaseValues& in, Case& c) {
  if (!in.has_table("mesh")) return read_disk(in, c);
  if (in.has_table("disk")) {
    in.fault("mesh", "stands beside a [disk]: the body is one or the other", "[disk] or [mesh]");
    return read_disk(in, c);
  }
  read_mesh_file(in, c);
  if (is_crush(c) && !is_held(c) && in.good({"mesh.clamped"}))
    in.fault("mesh.clamped", "a crush presses a body down by what is held",
             "a physical curve of the mesh");
}

/// Nothing carries or turns a free body but what it starts with.
void refuse_motion(CaseValues& in) {
  for (const std::string_view key :
       {"motion.angular_velocity", "motion.speed", "motion.height", "motion.start_x"})
    if (in.has(key))
      in.fault(key, "means nothing to a body that nothing holds",
               "initial.position, initial.velocity, initial.angular_velocity in its place");
}

void read_motion(CaseValues& in, Case& c) {
  dynamics::Motion& motion = c.motion;
  const bool held = is_held(c);
  if (!is_crush(c) && held)
    require(in, {"motion.angular_velocity", "motion.speed", "motion.height"});
  if (!is_crush(c) && !held) refuse_motion(in);
  in.read("motion.angular_velocity", motion.angular_velocity);
  in.read("motion.speed", motion.speed);
  in.read("motion.height", motion.height);
  in.read("motion.start_x", motion.start_x);
  in.read("motion.gravity", motion.gravity);
}

/// A crush knows no ground but flat: true where it is.
bool check_flat(CaseValues& in, const std::vector<Vec2>& profile) {
  const bool flat =
      std::all_of(profile.begin(), profile.end(), [&](Vec2 p) { return p.y == profile.front().y; });
  if (!flat)
    in.fault("ground.profile", "a crush needs flat ground: all points at one height",
             "ground.profile = \"flat\"");
  return flat;
}

void read_ground(CaseValues& in, Case& c) {
  if (!in.has_table("ground") && is_crush(c)) in.missing("ground.profile");
  if (!in.has_table("ground")) return;
  GroundCase& ground = c.ground.emplace();
  in.read_profile("ground.profile", ground.shape.profile);
  in.read("ground.fillet", ground.shape.fillet);
  in.read("ground.friction", ground.friction);
  in.read("ground.restitution", ground.restitution);
  if (c.mesh && c.mesh->contact.empty())
    in.fault("ground.profile", "no part of the mesh may touch the ground",
             "mesh.contact, a physical curve, beside it");
  if (!in.good({"ground", "ground.profile", "ground.fillet"})) return;
  if (is_crush(c) && !check_flat(in, ground.shape.profile)) return;
  for (const contact::ShapeFault& fault : contact::shape_faults(ground.shape)) {
    if (fault.about_fillet && in.has("ground.fillet"))
      in.fault("ground.fillet", fault.message);
    else
      in.fault_at_item("ground.profile", fault.point, fault.message);
  }
}

void read_time(CaseValues& in, Case& c) {
  Time& time = c.time;
  if (!is_crush(c)) require(in, {"time.end"});
  in.read("time.end", time.end);
  in.read("time.safety", time.safety);
  if (in.has("time.step")) in.read("time.step", time.step.emplace());
  if (in.has("time.step") && in.has("time.safety"))
    in.fault("time.step", "stands beside time.safety: give one of them",
             "time.step or time.safety");
  if (time.step && in.good({"time.end", "time.step"}) && time.end / *time.step > most_steps)
    in.fault("time.step", fmt::format("the run would take {:.3g} steps", time.end / *time.step),
             fmt::format("at most {:.0e} steps", most_steps));
  time.scheme = static_cast<Scheme>(in.choice("time.scheme"));
  if (time.scheme == Scheme::as_printed && !is_held(c))
    in.fault("time.scheme", "shows what the spin of a rim does, and nothing turns a free body",
             "\"symplectic\"");
}

void read_solver(CaseValues& in, Case& c) {
  const std::array<std::string, 3> operators{"auto", "cyclic", "sparse"};
  c.solver_operator = operators[in.choice("solver.operator")];
  check_operator(in, c);
  in.read("solver.contact_iterations", c.contact_iterations);
  in.read("solver.dump_contacts", c.dump_contacts);
}

void read_output(CaseValues& in, Case& c) {
  Output& output = c.output;
  in.read("output.history_interval", output.history_interval);
  in.read("output.snapshots", output.snapshots);
  in.read("output.snapshots_from", output.snapshots_from);
  if (!is_crush(c) && in.good({"output.snapshots_from", "time.end"}) &&
      output.snapshots_from > c.time.end)
    in.fault("output.snapshots_from", "must not be after the end of the run",
             fmt::format("0 to time.end = {:.6g}", c.time.end));
  in.read("output.stress", output.stress);
  read_probes(in, c);
  in.read("output.checkpoint_interval", output.checkpoint_interval);
}

/// What was given for nothing is named once, and has its default in the case as run.
void leave_out_dynamics(CaseValues& in, Case& c) {
  std::string given;
  const auto add = [&](const std::string& name) { given += (given.empty() ? "" : ", ") + name; };
  for (const std::string_view table : {"damping", "motion", "initial", "time"})
    if (in.has_table(table)) add(fmt::format("[{}]", table));
  for (const std::string_view key :
       {"ground.restitution", "output.history_interval", "output.snapshots",
        "output.snapshots_from", "solver.contact_iterations", "solver.dump_contacts"})
    if (in.has(key)) add(std::string(key));
  if (!c.output.probes.empty()) add("[[output.probe]]");
  if (c.stress_stiffening != Case{}.stress_stiffening) add("material.stress_stiffening");
  if (c.solver_operator != Case{}.solver_operator) add("solver.operator");
  if (!given.empty())
    c.warnings.push_back("a crush is quasi-static, its ground flat; without effect: " + given);
  c.damping = {};
  c.motion = {};
  c.initial = {};
  c.time = {};
  const Case defaults;
  c.stress_stiffening = defaults.stress_stiffening;
  c.solver_operator = defaults.solver_operator;
  c.contact_iterations = defaults.contact_iterations;
  c.dump_contacts = defaults.dump_contacts;
  if (c.ground) c.ground->restitution = c.ground->shape.fillet = 0.0;
  const Output standard;
  c.output.history_interval = standard.history_interval;
  c.output.snapshots = standard.snapshots;
  c.output.snapshots_from = standard.snapshots_from;
  c.output.probes.clear();
}

Case read_source(const std::filesystem::path& file, CaseSource source) {
  read_schema(source);
  CaseValues in(std::move(source));
  Case c;
  c.file = file;
  c.title = as_utf8(file.stem().string());
  int schema = schema_read;
  in.read("schema", schema);
  in.read("title", c.title);
  read_analysis(in, c);
  read_body(in, c);
  check_depth(in, c);
  read_material(in, c);
  read_motion(in, c);
  read_ground(in, c);
  read_body_contact(in, c);
  read_pressures(in, c);
  read_initial(in, c);
  read_time(in, c);
  read_solver(in, c);
  read_output(in, c);
  if (is_crush(c)) leave_out_dynamics(in, c);
  in.finish();
  c.places = in.places();
  return c;
}

}  // namespace

std::string_view largest_count(const mesh::Disk& disk) noexcept {
  const int columns = disk.tread ? disk.tread->pitches : disk.circumferential;
  if (disk.radial > columns) return "disk.mesh.radial";
  return disk.tread ? "disk.tread.pitches" : "disk.mesh.circumferential";
}

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  return read_source(file, load_case(file, settings));
}

Case read_case_text(const std::filesystem::path& file, std::string text,
                    const std::vector<std::string>& settings) {
  return read_source(file, load_case_text(file.string(), std::move(text), settings));
}

}  // namespace rondo::study
