// SPDX-License-Identifier: BSD-3-Clause
#include "documents/documents.hpp"

namespace rondo::app {
namespace {

using study::PodCount;
using study::PodReport;
using study::PodRun;

constexpr JsonMember<PodCount> count_members[] = {
    {"discarded", "number", "", "share of the energy",
     [](const PodCount& n) -> Json { return n.discarded; }},
    {"modes", "integer or null", "", "that leave at most that much; null: more than were found",
     [](const PodCount& n) -> Json { return n.modes < 0 ? Json() : Json(n.modes); }},
};

Json errors_of(const PodRun& run) {
  Json errors = Json::array();
  for (const auto& error : run.count_errors) errors.push_back(error ? Json(*error) : Json());
  return errors;
}

constexpr JsonMember<PodRun> run_members[] = {
    {"directory", "string", "", "results of the run",
     [](const PodRun& r) -> Json { return r.directory.string(); }},
    {"title", "string", "", "of its case", [](const PodRun& r) -> Json { return r.title; }},
    {"status", "string", "", "of the run", [](const PodRun& r) -> Json { return r.status; }},
    {"snapshots", "integer", "", "taken of it",
     [](const PodRun& r) -> Json { return r.snapshots; }},
    {"from", "number", "time_unit", "of the first", [](const PodRun& r) -> Json { return r.from; }},
    {"to", "number", "time_unit", "of the last", [](const PodRun& r) -> Json { return r.to; }},
    {"energy_share", "number", "", "of all runs' energy",
     [](const PodRun& r) -> Json { return r.energy_share; }},
    {"error", "number", "", "with all modes kept, over the norm of the run",
     [](const PodRun& r) -> Json { return r.error; }},
    {"error_with_modes_for", "array of number", "",
     "with those of each of modes_for; null: more than are kept", errors_of},
};

struct Decomposed {
  const study::PodRequest& q;
  const PodReport& r;
};

constexpr JsonMember<Decomposed> pod_members[] = {
    {"directory", "string", "", "where the files are",
     [](const Decomposed& k) -> Json { return k.r.directory.string(); }},
    {"field", "string", "", "as asked for", [](const Decomposed& k) -> Json { return k.q.field; }},
    {"frame", "string", "", "as asked for", [](const Decomposed& k) -> Json { return k.q.frame; }},
    {"weight", "string", "", "of the norm", [](const Decomposed& k) -> Json { return k.r.weight; }},
    {"unit", "string", "", "of the field", [](const Decomposed& k) -> Json { return k.r.unit; }},
    {"time_unit", "string", "", "\"s\"; \"1\": times are shares of the load of a crush",
     [](const Decomposed& k) -> Json { return k.r.time_unit; }},
    {"method", "string", "", "\"direct\", \"tsqr\" or \"incremental\"",
     [](const Decomposed& k) -> Json { return k.r.method; }},
    {"snapshots", "integer", "", "of all runs",
     [](const Decomposed& k) -> Json { return k.r.snapshots; }},
    {"rows", "integer", "", "numbers of a snapshot",
     [](const Decomposed& k) -> Json { return k.r.rows; }},
    {"energy", "number", "", "sum of the squared singular values",
     [](const Decomposed& k) -> Json { return k.r.energy; }},
    {"sigma_1", "number", "", "first singular value",
     [](const Decomposed& k) -> Json { return k.r.sigma_1; }},
    {"sigma_bound_relative", "number", "", "of the error of the singular values, over the first",
     [](const Decomposed& k) -> Json { return k.r.sigma_bound; }},
    {"rank", "integer", "", "singular values above round-off",
     [](const Decomposed& k) -> Json { return k.r.rank; }},
    {"rank_is_known", "boolean", "", "false: it is at least `rank`",
     [](const Decomposed& k) -> Json { return k.r.rank_is_known; }},
    {"modes_kept", "integer", "", "in pod.h5",
     [](const Decomposed& k) -> Json { return k.r.modes; }},
    {"modes_for", "array", "", "least modes for shares of the energy left out",
     [](const Decomposed& k) -> Json { return objects_of(count_members, k.r.counts); },
     [] { return texts_of(count_members); }},
    {"worst_error", "number", "", "largest error of a snapshot over its own norm",
     [](const Decomposed& k) -> Json { return k.r.worst_error; }},
    {"worst_time", "number", "time_unit", "of that snapshot",
     [](const Decomposed& k) -> Json { return k.r.worst_time; }},
    {"worst_run", "string", "", "whose snapshot it is",
     [](const Decomposed& k) -> Json { return k.r.worst_run.string(); }},
    {"error_residual", "number", "", "of the modes kept, share of the energy",
     [](const Decomposed& k) -> Json { return k.r.residual; }},
    {"error_tail", "number", "", "of the spectrum, share of the energy: as large",
     [](const Decomposed& k) -> Json { return k.r.tail; }},
    {"error_difference", "number", "", "of these two",
     [](const Decomposed& k) -> Json { return k.r.difference; }},
    {"error_lost", "number", "", "share that was truncated, in the tail",
     [](const Decomposed& k) -> Json { return k.r.lost; }},
    {"orthonormality", "number", "", "largest entry of the modes' Gram matrix less identity",
     [](const Decomposed& k) -> Json { return k.r.orthonormality; }},
    {"runs", "array", "", "how well the basis serves each",
     [](const Decomposed& k) -> Json { return objects_of(run_members, k.r.runs); },
     [] { return texts_of(run_members); }},
    {"peak_memory_bytes", "integer", "B", "of the process",
     [](const Decomposed& k) -> Json { return k.r.peak_memory; }},
    {"wall_s", "number", "s", "all of it", [](const Decomposed& k) -> Json { return k.r.wall_s; }},
};

}  // namespace

Json pod_document(const study::PodRequest& request, const PodReport& report) {
  return object_of(pod_members, {request, report});
}

Json pod_schema() {
  return schema_of(texts_of(pod_members));
}

}  // namespace rondo::app
