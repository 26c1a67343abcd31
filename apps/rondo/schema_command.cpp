// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "answer.hpp"
#include "commands.hpp"
#include "documents/documents.hpp"
#include "rondo/case/schema/case_schema.hpp"
#include "rondo/core/error.hpp"
#include "rondo/study/run_json/run_json.hpp"
#include "rondo/study/sweep/keys/study_keys.hpp"

namespace rondo::app {
namespace {

struct Schema {
  std::string_view name;
  Json (*make)();
};

constexpr Schema schemas[] = {
    {"case", study::case_schema},
    {"study", study::study_schema},
    {"check", [] { return answer_schema("check", check_schema()); }},
    {"run", [] { return answer_schema("run", run_schema()); }},
    {"run.json",
     [] {
       Json schema = study::schema_head("run.json of rondo",
                                        "Units are those of a plane body, per metre of its width");
       schema.update(study::run_json_schema());
       return schema;
     }},
    {"sweep", [] { return answer_schema("sweep", sweep_schema()); }},
    {"pod", [] { return answer_schema("pod", pod_schema()); }},
    {"reduce", [] { return answer_schema("reduce", reduce_schema()); }},
    {"fmu", [] { return answer_schema("fmu", fmu_schema()); }},
    {"modes", [] { return answer_schema("modes", modes_schema()); }},
    {"matrices", [] { return answer_schema("matrices", matrices_schema()); }},
};

}  // namespace

int schema(const std::string& of) {
  const auto found = std::ranges::find(schemas, of, &Schema::name);
  if (found == std::end(schemas)) {
    std::string names;
    for (const Schema& one : schemas) names += (names.empty() ? "" : ", ") + std::string(one.name);
    throw request_error("rondo schema", of, "there is no such schema", names);
  }
  fmt::print("{}\n", found->make().dump(2));
  return exit_done;
}

}  // namespace rondo::app
