// SPDX-License-Identifier: BSD-3-Clause
#include "documents/documents.hpp"

namespace rondo::app {
namespace {

struct Swept {
  const study::SweepReport& r;
  const std::filesystem::path& directory;
  const std::vector<std::size_t>& unfinished;
};

constexpr JsonMember<Swept> sweep_members[] = {
    {"directory", "string", "", "of results.csv, sweep.h5 and sweep.json",
     [](const Swept& k) -> Json { return k.directory.string(); }},
    {"runs", "integer", "", "of the study, or of the shard",
     [](const Swept& k) -> Json { return k.r.members; }},
    {"done", "integer", "", "of these", [](const Swept& k) -> Json { return k.r.done; }},
    {"failed", "integer", "", "of these", [](const Swept& k) -> Json { return k.r.failed; }},
    {"interrupted", "integer", "", "or not begun",
     [](const Swept& k) -> Json { return k.r.interrupted; }},
    {"kept", "integer", "", "that were there already",
     [](const Swept& k) -> Json { return k.r.kept; }},
    {"failures", "array of string", "", "some of them, in words; all are in sweep.json",
     [](const Swept& k) -> Json { return k.r.failures; }},
    {"strained", "integer", "", "runs whose largest strain is above what the law is for",
     [](const Swept& k) -> Json { return k.r.strained; }},
    {"strain_max", "number", "", "the largest of all",
     [](const Swept& k) -> Json { return k.r.strain_max; }},
    {"strain_run", "integer", "", "the run that has it, from 1; 0: none",
     [](const Swept& k) -> Json { return k.r.strain_run; }},
    {"unfinished", "array of integer", "",
     "numbers of the shards that --collect found so; else empty",
     [](const Swept& k) -> Json { return k.unfinished; }},
    {"wall_s", "number", "s", "all of it", [](const Swept& k) -> Json { return k.r.wall_s; }},
};

struct Planned {
  std::size_t number;
  const study::SweepStudy& study;
  const study::PlannedMember& member;
};

constexpr JsonMember<Planned> planned_members[] = {
    {"run", "integer", "", "from 1", [](const Planned& p) -> Json { return p.number; }},
    {"settings", "array of string", "", "KEY=VALUE over the base case",
     [](const Planned& p) -> Json { return study::settings_of(p.study, p.member.member); }},
    {"lent", "boolean", "", "of another shard, made here for its fields",
     [](const Planned& p) -> Json { return p.member.part == study::Part::lent; }},
    {"nodes", "integer", "", "of its mesh",
     [](const Planned& p) -> Json { return p.member.nodes; }},
    {"dofs", "integer", "", "degrees of freedom",
     [](const Planned& p) -> Json { return p.member.dofs; }},
    {"steps", "integer", "", "or increments",
     [](const Planned& p) -> Json { return p.member.steps; }},
    {"memory_bytes", "integer", "B", "estimated",
     [](const Planned& p) -> Json { return p.member.memory_bytes; }},
    {"disk_bytes", "integer", "B", "estimated",
     [](const Planned& p) -> Json { return p.member.disk_bytes; }},
    {"seconds", "number", "s", "estimated; null: not",
     [](const Planned& p) -> Json {
       return p.member.seconds > 0.0 ? Json(p.member.seconds) : Json();
     }},
};

struct Plan {
  const study::DrySweep& dry;
  int workers;
};

Json planned_runs(const Plan& plan) {
  Json array = Json::array();
  std::size_t number = 0;
  for (const study::PlannedMember& member : plan.dry.plan.members) {
    ++number;
    if (member.part != study::Part::other)
      array.push_back(object_of(planned_members, {number, plan.dry.study, member}));
  }
  return array;
}

constexpr JsonMember<Plan> plan_members[] = {
    {"workers", "integer", "", "runs at once", [](const Plan& p) -> Json { return p.workers; }},
    {"planned", "array", "", "the runs, of which none was run", planned_runs,
     [] { return texts_of(planned_members); }},
};

}  // namespace

Json sweep_document(const study::SweepReport& report, const std::filesystem::path& directory,
                    const std::vector<std::size_t>& unfinished) {
  return object_of(sweep_members, {report, directory, unfinished});
}

Json plan_document(const study::DrySweep& dry, int workers) {
  return object_of(plan_members, {dry, workers});
}

Json sweep_schema() {
  Json swept = schema_of(texts_of(sweep_members)), planned = schema_of(texts_of(plan_members));
  swept["title"] = "what was run";
  planned["title"] = "with --dry-run";
  return Json{{"oneOf", {swept, planned}}};
}

}  // namespace rondo::app
