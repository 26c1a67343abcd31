// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include "documents/documents.hpp"
#include "rondo/study/run_json/run_json.hpp"

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

constexpr JsonMember<Ran> ran_members[] = {
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
    {"notes", "array of string", "", "of this kind of analysis, in words",
     [](const Ran& k) -> Json { return k.r.notes; }},
    {"run", "object or null", "", "run.json as it is in the directory (docs/results.md)",
     [](const Ran& k) -> Json { return read_json(k.directory / "run.json"); }},
};

}  // namespace

Json run_document(const study::RunReport& report, const std::filesystem::path& directory) {
  return object_of(ran_members, {report, directory});
}

Json run_schema() {
  Json schema = schema_of(texts_of(ran_members));
  Json run = study::run_json_schema();
  run["type"] = {"object", "null"};
  schema["properties"]["run"].update(run);
  return schema;
}

}  // namespace rondo::app
