// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"
#include "documents/documents.hpp"

namespace rondo::app {
namespace {

constexpr JsonMember<FmuReport> fmu_members[] = {
    {"fmu", "string", "", "file of the FMU",
     [](const FmuReport& r) -> Json { return r.file.string(); }},
    {"fmu_bytes", "integer", "B", "its size", [](const FmuReport& r) -> Json { return r.bytes; }},
    {"identifier", "string", "", "modelIdentifier: name of the binary within",
     [](const FmuReport& r) -> Json { return r.identifier; }},
    {"guid", "string", "", "of case, modes and step",
     [](const FmuReport& r) -> Json { return r.guid; }},
    {"modes", "integer", "", "number of modes of the wheel",
     [](const FmuReport& r) -> Json { return r.modes; }},
    {"step", "number", "s", "internal step at the most",
     [](const FmuReport& r) -> Json { return r.step; }},
    {"tyre_mass", "number", "kg", "to be added to the hub's; of a plane wheel for a width of 1 m",
     [](const FmuReport& r) -> Json { return r.tyre_mass; }},
    {"tyre_inertia", "number", "kg m2", "likewise",
     [](const FmuReport& r) -> Json { return r.tyre_inertia; }},
};

}  // namespace

Json fmu_document(const FmuReport& report) {
  return object_of(fmu_members, report);
}

Json fmu_schema() {
  return schema_of(texts_of(fmu_members));
}

}  // namespace rondo::app
