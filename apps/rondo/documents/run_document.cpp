// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include "documents/documents.hpp"
#include "documents/members.hpp"

namespace rondo::app {
namespace {

struct Ran {
  const study::RunReport& r;
  const std::filesystem::path& directory;
};

/// Null where it is not there or is no JSON.
Json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  Json json = Json::parse(in, nullptr, false);
  return json.is_discarded() ? Json() : json;
}

/// Further keys depend on the analysis: docs/results.md has them all.
Json run_json_schema() {
  const auto of_type = [](const char* type) { return Json{{"type", type}}; };
  Json schema{{"type", {"object", "null"}}};
  for (const char* name : {"status", "title", "version", "build", "build_id", "host", "analysis"}) {
    schema["properties"][name] = of_type("string");
    schema["required"].push_back(name);
  }
  Json column = study::closed_object();
  for (const char* name : {"name", "unit"}) {
    column["properties"][name] = of_type("string");
    column["required"].push_back(name);
  }
  schema["properties"]["columns"] = study::array_of(std::move(column));
  schema["properties"]["warnings"] = schema_of_texts();
  return schema;
}

constexpr Member<Ran> ran_members[] = {
    {"directory", "string", "", "where the results are",
     [](const Ran& k) -> Json { return k.directory.string(); }},
    {"reached", "string", "", "how far the run came, in words",
     [](const Ran& k) -> Json { return k.r.reached; }},
    {"steps", "integer", "", "steps or increments done",
     [](const Ran& k) -> Json { return k.r.steps; }},
    {"end_time", "number", "s", "reached; 0: no motion",
     [](const Ran& k) -> Json { return k.r.end_time; }},
    {"snapshots", "integer", "", "fields written",
     [](const Ran& k) -> Json { return k.r.snapshots; }},
    {"resumable", "boolean", "", "the run keeps checkpoints",
     [](const Ran& k) -> Json { return k.r.resumable; }},
    {"resumed_at", "integer", "", "step of the checkpoint that it went on from; 0: begun anew",
     [](const Ran& k) -> Json { return k.r.resumed_at; }},
    {"was_complete", "boolean", "", "to be resumed, but already at its end: nothing was done",
     [](const Ran& k) -> Json { return k.r.was_complete; }},
    {"loop_wall_s", "number", "s", "of all steps",
     [](const Ran& k) -> Json { return k.r.loop_wall_s; }},
    {"simulated_s", "number", "s", "of motion, in this call; 0: there is none",
     [](const Ran& k) -> Json { return k.r.simulated_s; }},
    {"step_wall_s", "number", "s", "that simulated_s took; their ratio is the real-time factor",
     [](const Ran& k) -> Json { return k.r.step_wall_s; }},
    {"energy_residual_relative", "number", "", "of the energy balance, over the energy exchanged",
     [](const Ran& k) -> Json { return k.r.energy_residual_relative; }},
    {"energy_residual_bound", "number", "", "above it the run would have failed",
     [](const Ran& k) -> Json { return k.r.energy_residual_bound; }},
    {"contact_residual_max", "number", "", "largest residual of the contact law",
     [](const Ran& k) -> Json { return k.r.contact_residual_max; }},
    {"penetration_max_m", "number", "m", "largest penetration",
     [](const Ran& k) -> Json { return k.r.penetration_max_m; }},
    {"strain_max", "number", "", "largest magnitude of a principal strain",
     [](const Ran& k) -> Json { return k.r.strain_max; }},
    {"jacobian_min", "number", "", "smallest J at a corner of an element",
     [](const Ran& k) -> Json { return k.r.jacobian_min; }},
    {"notes", "array", "", "of this kind of analysis, in words",
     [](const Ran& k) -> Json { return k.r.notes; }, schema_of_texts},
    {"run", "object", "", "run.json as it is in the directory (docs/results.md)",
     [](const Ran& k) -> Json { return read_json(k.directory / "run.json"); }, run_json_schema},
};

}  // namespace

Json run_document(const study::RunReport& report, const std::filesystem::path& directory) {
  return object_of<Ran>(ran_members, {report, directory});
}

Json run_schema() {
  return schema_of<Ran>(ran_members);
}

}  // namespace rondo::app
