// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "rondo/study/case.hpp"
#include "rondo/study/toml_text.hpp"

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

std::string disk_text(const mesh::Disk& d) {
  std::string text =
      fmt::format("\n[disk]\nouter_radius = {}\ninner_radius = {}\n\n[disk.mesh]\nradial = {}\n",
                  toml_number(d.outer_radius), toml_number(d.inner_radius), d.radial);
  if (!d.tread) text += fmt::format("circumferential = {}\n", d.circumferential);
  text += fmt::format("grading = {}\n", toml_number(d.grading));
  if (!d.tread) return text;
  return text + fmt::format(
                    "\n[disk.tread]\npitches = {}\ndepth = {}\nland_columns = {}\n"
                    "groove_columns = {}\nlayers = {}\n",
                    d.tread->pitches, toml_number(d.tread->depth), d.tread->land_columns,
                    d.tread->groove_columns, d.tread->layers);
}

std::string material_text(const Case& c) {
  return fmt::format(
      "\n[material]\nyoungs_modulus = {}\npoissons_ratio = {}\ndensity = {}\nplane = \"{}\"\n"
      "integration = \"full\"\nstress_stiffening = \"none\"\n",
      toml_number(c.material.youngs_modulus), toml_number(c.material.poissons_ratio),
      toml_number(c.material.density),
      c.material.plane == fem::Plane::strain ? "strain" : "stress");
}

std::string damping_text(const Damping& d) {
  return fmt::format("\n[damping]\nmass = {}\nstiffness = {}\n", toml_number(d.mass),
                     toml_number(d.stiffness));
}

std::string motion_text(const dynamics::Motion& m) {
  return fmt::format(
      "\n[motion]\nangular_velocity = {}\nspeed = {}\nheight = {}\nstart_x = {}\ngravity = {}\n",
      table_text(m.angular_velocity), table_text(m.speed), table_text(m.height),
      toml_number(m.start_x), toml_number(m.gravity));
}

std::string ground_text(const std::optional<GroundCase>& ground) {
  if (!ground) return "";
  return fmt::format("\n[ground]\nprofile = {}\nfillet = {}\nfriction = {}\nrestitution = {}\n",
                     profile_text(ground->shape.profile), toml_number(ground->shape.fillet),
                     toml_number(ground->friction), toml_number(ground->restitution));
}

std::string initial_text(const Initial& i) {
  const auto& g = i.displacement_gradient;
  return fmt::format(
      "\n[initial]\nstate = \"{}\"\nvelocity = {}\ndisplacement_gradient = [{}, {}]\n",
      i.state == InitialState::rest ? "rest" : "stationary", pair_text(i.velocity.x, i.velocity.y),
      pair_text(g[0][0], g[0][1]), pair_text(g[1][0], g[1][1]));
}

std::string time_text(const Case& c) {
  const Time& t = c.time;
  return fmt::format(
      "\n[analysis]\nkind = \"dynamic\"\n\n[time]\nend = {}\n{}\nscheme = \"{}\"\n"
      "\n[solver]\noperator = {}\n",
      toml_number(t.end),
      t.step ? "step = " + toml_number(*t.step) : "safety = " + toml_number(t.safety),
      t.scheme == Scheme::symplectic ? "symplectic" : "as-printed", toml_string(c.solver_operator));
}

std::string output_text(const Output& o) {
  return fmt::format(
      "\n[output]\nhistory_interval = {}\nsnapshots = {}\nsnapshots_from = {}\nstress = {}\n"
      "checkpoint_interval = {}\n",
      toml_number(o.history_interval), o.snapshots, toml_number(o.snapshots_from), o.stress,
      toml_number(o.checkpoint_interval));
}

/// What means nothing to a crush is left out, so that reading it again brings no warning.
std::string crush_text(const Case& c) {
  return fmt::format(
      "\n[ground]\nprofile = {}\nfriction = {}\n"
      "\n[analysis]\nkind = \"crush\"\ndepth = {}\nincrements = {}\n"
      "\n[output]\nstress = {}\ncheckpoint_interval = {}\n",
      profile_text(c.ground->shape.profile), toml_number(c.ground->friction),
      toml_number(c.analysis.depth), c.analysis.increments, c.output.stress,
      toml_number(c.output.checkpoint_interval));
}

}  // namespace

std::string write_case(const Case& c) {
  const std::string body = fmt::format("schema = 1\ntitle = {}\n", toml_string(c.title)) +
                           disk_text(c.disk) + material_text(c);
  if (c.analysis.kind == AnalysisKind::crush) return body + crush_text(c);
  return body + damping_text(c.damping) + motion_text(c.motion) + ground_text(c.ground) +
         initial_text(c.initial) + time_text(c) + output_text(c.output);
}

}  // namespace rondo::study
