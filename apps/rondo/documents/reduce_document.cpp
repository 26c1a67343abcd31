// SPDX-License-Identifier: BSD-3-Clause
#include "documents/documents.hpp"

namespace rondo::app {
namespace {

struct Reduced {
  const study::ReduceRequest& q;
  const study::ReduceReport& r;
};

constexpr JsonMember<Reduced> reduce_members[] = {
    {"wheel", "string", "", "file of the reduced wheel",
     [](const Reduced& k) -> Json { return k.q.output.string(); }},
    {"wheel_bytes", "integer", "B", "its size",
     [](const Reduced& k) -> Json { return k.r.file_bytes; }},
    {"basis", "string", "", "\"eigenmodes\" or \"pod\"",
     [](const Reduced& k) -> Json { return k.r.basis; }},
    {"dofs", "integer", "", "of the mesh", [](const Reduced& k) -> Json { return k.r.dofs; }},
    {"modes", "integer", "", "of the wheel", [](const Reduced& k) -> Json { return k.r.modes; }},
    {"highest_mode", "number", "rad/s", "angular frequency of the highest",
     [](const Reduced& k) -> Json { return k.r.highest; }},
    {"contact_nodes", "integer", "", "of the wheel",
     [](const Reduced& k) -> Json { return k.r.contact_nodes; }},
    {"spins", "array", "rad/s", "at which there are tables of compliance",
     [](const Reduced& k) -> Json { return k.r.spins; }},
    {"snapshots", "integer", "", "that a POD is of; 0: eigenmodes",
     [](const Reduced& k) -> Json { return k.r.snapshots; }},
    {"energy_left", "number", "", "share of their energy outside the modes",
     [](const Reduced& k) -> Json { return k.r.left; }},
    {"wall_s", "number", "s", "all of it", [](const Reduced& k) -> Json { return k.r.wall_s; }},
};

}  // namespace

Json reduce_document(const study::ReduceRequest& request, const study::ReduceReport& report) {
  return object_of(reduce_members, {request, report});
}

Json reduce_schema() {
  return schema_of(texts_of(reduce_members));
}

}  // namespace rondo::app
