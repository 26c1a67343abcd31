// SPDX-License-Identifier: BSD-3-Clause
#include "documents/documents.hpp"

namespace rondo::app {
namespace {

constexpr JsonMember<study::MatricesReport> matrices_members[] = {
    {"matrices", "string", "", "file of the matrices",
     [](const study::MatricesReport& r) -> Json { return r.file.string(); }},
    {"matrices_bytes", "integer", "B", "its size",
     [](const study::MatricesReport& r) -> Json { return r.bytes; }},
    {"nodes", "integer", "", "nodes that are not clamped",
     [](const study::MatricesReport& r) -> Json { return r.nodes; }},
    {"unknowns", "integer", "", "rows of the matrices: 2 of each node, in three dimensions 3",
     [](const study::MatricesReport& r) -> Json { return r.unknowns; }},
    {"stiffness_entries", "integer", "", "numbers stored of K",
     [](const study::MatricesReport& r) -> Json { return r.entries; }},
    {"contact_nodes", "integer", "", "nodes with contact rows; 0: there is no ground",
     [](const study::MatricesReport& r) -> Json { return r.contact_nodes; }},
    {"time", "number", "s", "time of the contact rows",
     [](const study::MatricesReport& r) -> Json { return r.time; }},
};

}  // namespace

Json matrices_document(const study::MatricesReport& report) {
  return object_of(matrices_members, report);
}

Json matrices_schema() {
  return schema_of(texts_of(matrices_members));
}

}  // namespace rondo::app
