// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "rondo/case/case.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/case/toml_text.hpp"

namespace rondo::study {
namespace {

std::string pair_text(double a, double b) {
  return fmt::format("[{}, {}]", toml_number(a), toml_number(b));
}

/// One pair a line, with room for long tables.
template <class Pairs, class Text>
std::string pairs_text(const Pairs& pairs, Text&& text) {
  std::string said = "[";
  for (const auto& pair : pairs) said += (said.size() > 1 ? ",\n  " : "\n  ") + text(pair);
  return said + "\n]";
}

std::string table_text(const dynamics::Table& table) {
  const auto& points = table.points();
  if (points.size() == 1 && points[0][0] == 0.0 && !std::signbit(points[0][0]))
    return toml_number(points[0][1]);
  return pairs_text(points, [](const auto& p) { return pair_text(p[0], p[1]); });
}

std::string profile_text(const std::vector<Vec2>& profile) {
  if (profile == contact::GroundShape{}.profile) return "\"flat\"";
  return pairs_text(profile, [](Vec2 p) { return pair_text(p.x, p.y); });
}

std::string disk_text(const Case& c) {
  const mesh::Disk& d = c.disk;
  std::string text = fmt::format(
      "\n[disk]\nouter_radius = {}\ninner_radius = {}\nrim = \"{}\"\n\n[disk.mesh]\nradial = {}\n",
      toml_number(d.outer_radius), toml_number(d.inner_radius), c.free_rim ? "free" : "bonded",
      d.radial);
  if (!d.tread) text += fmt::format("circumferential = {}\n", d.circumferential);
  text += fmt::format("grading = {}\n", toml_number(d.grading));
  if (!d.tread) return text;
  return text + fmt::format(
                    "\n[disk.tread]\npitches = {}\ndepth = {}\nland_columns = {}\n"
                    "groove_columns = {}\nlayers = {}\n",
                    d.tread->pitches, toml_number(d.tread->depth), d.tread->land_columns,
                    d.tread->groove_columns, d.tread->layers);
}

std::string mesh_text(const MeshCase& m) {
  return fmt::format("\n[mesh]\nfile = {}\nscale = {}\nclamped = {}\ncontact = {}\n",
                     toml_string(as_utf8(m.file.string())), toml_number(m.scale),
                     toml_string(m.clamped), toml_string(m.contact));
}

std::string constants_text(const fem::Material& m) {
  return fmt::format("youngs_modulus = {}\npoissons_ratio = {}\ndensity = {}\n",
                     toml_number(m.youngs_modulus), toml_number(m.poissons_ratio),
                     toml_number(m.density));
}

std::string material_text(const Case& c) {
  std::string text = fmt::format(
      "\n[material]\n{}plane = \"{}\"\nintegration = \"{}\"\nstress_stiffening = \"{}\"\n",
      constants_text(c.material), c.material.plane == fem::Plane::strain ? "strain" : "stress",
      c.material.integration == fem::Integration::full ? "full" : "b-bar",
      c.stress_stiffening == StressStiffening::none ? "none" : "centrifugal");
  for (const MaterialRegion& region : c.regions)
    text += fmt::format("\n[[material.region]]\nsurface = {}\n{}", toml_string(region.surface),
                        constants_text(region.material));
  return text;
}

std::string damping_text(const Damping& d) {
  return fmt::format("\n[damping]\nmass = {}\nstiffness = {}\n", toml_number(d.mass),
                     toml_number(d.stiffness));
}

/// Nothing but gravity moves a free body, and the reader says so.
std::string motion_text(const Case& c) {
  const dynamics::Motion& m = c.motion;
  const std::string gravity = fmt::format("gravity = {}\n", table_text(m.gravity));
  if (!is_held(c)) return "\n[motion]\n" + gravity;
  return fmt::format("\n[motion]\nangular_velocity = {}\nspeed = {}\nheight = {}\nstart_x = {}\n{}",
                     table_text(m.angular_velocity), table_text(m.speed), table_text(m.height),
                     toml_number(m.start_x), gravity);
}

std::string ground_text(const std::optional<GroundCase>& ground) {
  if (!ground) return "";
  return fmt::format("\n[ground]\nprofile = {}\nfillet = {}\nfriction = {}\nrestitution = {}\n",
                     profile_text(ground->shape.profile), toml_number(ground->shape.fillet),
                     toml_number(ground->friction), toml_number(ground->restitution));
}

std::string contact_text(const BodyContactCase& contact) {
  constexpr std::array between{"none", "bodies", "all"};
  return fmt::format("\n[contact]\nbetween = \"{}\"\nfriction = {}\nrestitution = {}\n",
                     between[static_cast<std::size_t>(contact.between)],
                     toml_number(contact.friction), toml_number(contact.restitution));
}

std::string pressures_text(const std::vector<PressureCase>& pressures) {
  std::string text;
  for (const PressureCase& p : pressures)
    text += fmt::format("\n[[load.pressure]]\ncurve = {}\nvalue = {}\n", toml_string(p.curve),
                        table_text(p.pressure));
  return text;
}

std::string vector_text(Vec2 a) {
  return pair_text(a.x, a.y);
}

std::string initial_text(const Case& c) {
  const Initial& i = c.initial;
  const auto& g = i.displacement_gradient;
  std::string text =
      fmt::format("\n[initial]\nstate = \"{}\"\nvelocity = {}\ndisplacement_gradient = [{}, {}]\n",
                  i.state == InitialState::rest ? "rest" : "stationary", vector_text(i.velocity),
                  pair_text(g[0][0], g[0][1]), pair_text(g[1][0], g[1][1]));
  if (!may_be_free(c)) return text;
  text += fmt::format("position = {}\nangle = {}\nangular_velocity = {}\n", vector_text(i.position),
                      toml_number(i.angle), toml_number(i.angular_velocity));
  for (const InitialRegion& r : i.regions)
    text += fmt::format(
        "\n[[initial.region]]\nsurface = {}\nvelocity = {}\nangular_velocity = {}\n",
        toml_string(r.surface), vector_text(r.velocity), toml_number(r.angular_velocity));
  return text;
}

std::string time_text(const Case& c) {
  const Time& t = c.time;
  return fmt::format(
      "\n[analysis]\nkind = \"dynamic\"\n\n[time]\nend = {}\n{}\nscheme = \"{}\"\n"
      "\n[solver]\noperator = {}\ncontact_iterations = {}\ndump_contacts = {}\n",
      toml_number(t.end),
      t.step ? "step = " + toml_number(*t.step) : "safety = " + toml_number(t.safety),
      t.scheme == Scheme::symplectic ? "symplectic" : "as-printed", toml_string(c.solver_operator),
      c.contact_iterations, c.dump_contacts);
}

std::string output_text(const Output& o) {
  std::string text = fmt::format(
      "\n[output]\nhistory_interval = {}\nsnapshots = {}\nsnapshots_from = {}\nstress = {}\n"
      "checkpoint_interval = {}\n",
      toml_number(o.history_interval), o.snapshots, toml_number(o.snapshots_from), o.stress,
      toml_number(o.checkpoint_interval));
  for (const Probe& p : o.probes)
    text += fmt::format("\n[[output.probe]]\nname = {}\nposition = {}\n", toml_string(p.name),
                        vector_text(p.position));
  return text;
}

/// What means nothing to a crush is left out, so that reading it again brings no warning.
std::string crush_text(const Case& c) {
  const AnalysisCase& a = c.analysis;
  const std::string slide = a.slide_increments == 0
                                ? ""
                                : fmt::format("slide = {}\nslide_increments = {}\n",
                                              toml_number(a.slide), a.slide_increments);
  return fmt::format(
      "\n[ground]\nprofile = {}\nfriction = {}\n"
      "\n[analysis]\nkind = \"crush\"\ndepth = {}\nincrements = {}\n{}"
      "\n[output]\nstress = {}\ncheckpoint_interval = {}\n",
      profile_text(c.ground->shape.profile), toml_number(c.ground->friction), toml_number(a.depth),
      a.increments, slide, c.output.stress, toml_number(c.output.checkpoint_interval));
}

}  // namespace

std::string write_case(const Case& c) {
  const std::string body = fmt::format("schema = 1\ntitle = {}\n", toml_string(c.title)) +
                           (c.mesh ? mesh_text(*c.mesh) : disk_text(c)) + material_text(c);
  if (c.analysis.kind == AnalysisKind::crush) return body + crush_text(c);
  return body + damping_text(c.damping) + motion_text(c) + ground_text(c.ground) +
         contact_text(c.body_contact) + pressures_text(c.pressures) + initial_text(c) +
         time_text(c) + output_text(c.output);
}

}  // namespace rondo::study
