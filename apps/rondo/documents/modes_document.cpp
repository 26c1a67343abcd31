// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "documents/documents.hpp"

namespace rondo::app {
namespace {

using study::ModeLine;
using study::ModesReport;
using study::SpinSummary;

constexpr JsonMember<ModeLine> mode_members[] = {
    {"spin", "number", "rad/s", "angular velocity of the body",
     [](const ModeLine& m) -> Json { return m.angular_velocity; }},
    {"omega", "number", "rad/s", "of the mode, in the turning frame",
     [](const ModeLine& m) -> Json { return m.omega; }},
    {"frequency", "number", "Hz", "likewise",
     [](const ModeLine& m) -> Json { return m.omega / (2.0 * std::numbers::pi); }},
    {"diameters", "integer or null", "", "nodal diameters; null: unknown",
     [](const ModeLine& m) -> Json { return m.diameters < 0 ? Json() : Json(m.diameters); }},
    {"wave", "string", "", "\"standing\", \"forward\", \"backward\"...; \"\": unknown",
     [](const ModeLine& m) -> Json { return study::name_of(m.wave); }},
    {"residual", "number", "", "of the mode", [](const ModeLine& m) -> Json { return m.residual; }},
    {"damping_ratio", "number or null", "",
     "rate of decay by [damping] over omega; null: of a rigid-body motion",
     [](const ModeLine& m) -> Json {
       return std::isnan(m.damping_ratio) ? Json() : Json(m.damping_ratio);
     }},
};

constexpr JsonMember<SpinSummary> spin_members[] = {
    {"spin", "number", "rad/s", "angular velocity of the body",
     [](const SpinSummary& s) -> Json { return s.angular_velocity; }},
    {"modes", "integer", "", "found", [](const SpinSummary& s) -> Json { return s.modes; }},
    {"rigid", "integer", "", "rigid-body motions",
     [](const SpinSummary& s) -> Json { return s.rigid; }},
    {"unstable", "integer", "", "that grow",
     [](const SpinSummary& s) -> Json { return s.unstable; }},
    {"growth", "number", "1/s", "of the rotation of a free disk",
     [](const SpinSummary& s) -> Json { return s.growth; }},
};

struct Critical {
  int diameters;
  double spin, rim_speed;
};

constexpr JsonMember<Critical> critical_members[] = {
    {"diameters", "integer", "", "of the wave that stands still",
     [](const Critical& s) -> Json { return s.diameters; }},
    {"spin", "number", "rad/s", "at which it does",
     [](const Critical& s) -> Json { return s.spin; }},
    {"rim_speed", "number", "m/s", "of the outer radius then",
     [](const Critical& s) -> Json { return s.rim_speed; }},
};

Json critical_of(const ModesReport& r) {
  std::vector<Critical> list;
  for (const auto& c : r.critical) list.push_back({c.diameters, c.spin, c.spin * r.outer_radius});
  return objects_of(critical_members, list);
}

constexpr JsonMember<study::Standing> standing_members[] = {
    {"height", "number", "m", "of the center above the ground",
     [](const study::Standing& s) -> Json { return s.height; }},
    {"load", "number", "N", "of the ground, without friction",
     [](const study::Standing& s) -> Json { return s.load; }},
    {"nodes", "integer", "", "that touch",
     [](const study::Standing& s) -> Json { return s.nodes; }},
};

constexpr JsonMember<ModesReport> modes_members[] = {
    {"directory", "string", "", "where the files are",
     [](const ModesReport& r) -> Json { return r.directory.string(); }},
    {"nodes", "integer", "", "of the mesh", [](const ModesReport& r) -> Json { return r.nodes; }},
    {"dofs", "integer", "", "degrees of freedom",
     [](const ModesReport& r) -> Json { return r.dofs; }},
    {"modes", "array", "", "a line of modes.csv each",
     [](const ModesReport& r) -> Json { return objects_of(mode_members, r.modes); },
     [] { return texts_of(mode_members); }},
    {"spins", "array", "", "what was found at each spin",
     [](const ModesReport& r) -> Json { return objects_of(spin_members, r.spins); },
     [] { return texts_of(spin_members); }},
    {"sweep", "array", "", "likewise of --spins",
     [](const ModesReport& r) -> Json { return objects_of(spin_members, r.sweep); },
     [] { return texts_of(spin_members); }},
    {"critical_speeds", "array", "", "at which a wave stands still in space", critical_of,
     [] { return texts_of(critical_members); }},
    {"standing", "object or null", "", "how the wheel stands; null: without --standing",
     [](const ModesReport& r) {
       return r.on_ground ? object_of(standing_members, *r.on_ground) : Json();
     },
     [] { return texts_of(standing_members); }},
    {"residual_max", "number", "", "of all modes",
     [](const ModesReport& r) -> Json { return r.residual_max; }},
    {"wall_s", "number", "s", "all of it", [](const ModesReport& r) -> Json { return r.wall_s; }},
};

}  // namespace

Json modes_document(const ModesReport& report) {
  return object_of(modes_members, report);
}

Json modes_schema() {
  return schema_of(texts_of(modes_members));
}

}  // namespace rondo::app
