// SPDX-License-Identifier: BSD-3-Clause
#include "documents/documents.hpp"

namespace rondo::app {
namespace {

struct Checked {
  const study::Case& c;
  const study::CheckReport& r;
};

using Line = std::pair<std::string, std::string>;

constexpr JsonMember<Line> line_members[] = {
    {"name", "string", "", "what is told", [](const Line& l) -> Json { return l.first; }},
    {"text", "string", "", "its value, in words", [](const Line& l) -> Json { return l.second; }},
};

constexpr JsonMember<Checked> check_members[] = {
    {"title", "string", "", "of the case", [](const Checked& k) -> Json { return k.c.title; }},
    {"analysis", "string", "", "analysis.kind",
     [](const Checked& k) -> Json { return study::rules_of(k.c.analysis.kind).name; }},
    {"nodes", "integer", "", "nodes of the mesh",
     [](const Checked& k) -> Json { return k.r.nodes; }},
    {"elements", "integer", "", "elements of the mesh",
     [](const Checked& k) -> Json { return k.r.elements; }},
    {"dofs", "integer", "", "degrees of freedom that are free",
     [](const Checked& k) -> Json { return k.r.dofs; }},
    {"contact_nodes", "integer", "", "nodes that may touch something",
     [](const Checked& k) -> Json { return k.r.candidates; }},
    {"bodies", "integer", "", "parts that no element joins",
     [](const Checked& k) -> Json { return k.r.bodies; }},
    {"free_bodies", "integer", "", "of these, held by nothing",
     [](const Checked& k) -> Json { return k.r.free_bodies; }},
    {"wave_speed_pressure", "number", "m/s", "of pressure waves",
     [](const Checked& k) -> Json { return k.r.wave_speeds.pressure; }},
    {"wave_speed_shear", "number", "m/s", "of shear waves",
     [](const Checked& k) -> Json { return k.r.wave_speeds.shear; }},
    {"steps", "integer", "", "steps or increments of the run",
     [](const Checked& k) -> Json { return k.r.steps; }},
    {"snapshots", "integer", "", "fields that the run would keep",
     [](const Checked& k) -> Json { return k.r.snapshots; }},
    {"memory_bytes", "integer", "B", "estimated",
     [](const Checked& k) -> Json { return k.r.memory_bytes; }},
    {"disk_bytes", "integer", "B", "estimated",
     [](const Checked& k) -> Json { return k.r.disk_bytes; }},
    {"seconds", "number", "s", "of all steps, estimated; null: not estimated",
     [](const Checked& k) -> Json { return k.r.seconds > 0.0 ? Json(k.r.seconds) : Json(); }},
    {"threads", "integer", "", "of the run", [](const Checked& k) -> Json { return k.r.threads; }},
    {"lines", "array", "", "what else is printed for people, in the words of the analysis",
     [](const Checked& k) -> Json { return objects_of(line_members, k.r.lines); },
     [] { return texts_of(line_members); }},
};

}  // namespace

Json check_document(const study::Case& c, const study::CheckReport& report) {
  return object_of(check_members, {c, report});
}

Json check_schema() {
  return schema_of(texts_of(check_members));
}

}  // namespace rondo::app
