// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "rondo/case/case.hpp"
#include "rondo/case/case_rules.hpp"
#include "rondo/case/ground/ground_shape.hpp"
#include "rondo/case/ground/road_ground.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

/// A later schema may give the same keys other meanings, so other faults are not reported.
void read_schema(CaseSource& source) {
  const int schema_read = Case{}.schema;
  const auto found = source.values.find("schema");
  if (found == source.values.end() || found->second.type != ValueType::integer) return;
  const CaseValue& value = found->second;
  if (value.integer <= schema_read) return;
  const bool in_file = value.place.source == 0;
  throw InputError(
      Fault{source.sources[at(value.place.source)].name, in_file ? value.place.line : 0,
            in_file ? value.place.column : 0, "schema", source.written(value.place),
            fmt::format("schema {} is from a later version of rondo; this one reads {}",
                        value.integer, schema_read),
            fmt::format("{}", schema_read)});
}

/// Whether the file has this part of the case; of several bodies only the first counts.
bool is_given(const CaseValues& in, const CaseTable& table) {
  if (!in.has_table(table.path)) return false;
  for (const std::string_view body : body_tables) {
    if (table.path == body) return true;
    if (in.has_table(body) && std::ranges::find(body_tables, table.path) != body_tables.end())
      return false;
  }
  return true;
}

/// Lists are created in their turn, because missing values in them come from an earlier table.
void read_keys(CaseValues& in, Case& c) {
  for (const CaseTable& table : case_tables())
    if (table.resize && !table.is_list() && is_given(in, table)) table.resize(c, 1);
  for (const CaseTable& table : case_tables()) {
    if (table.is_list()) table.resize(c, in.n_items(table.name()));
    for (std::size_t k = 0; k < table.count(c); ++k)
      for (const CaseKey& key : keys_of(table)) in.read(key, path_of(key, k), key.field(c, k));
  }
  if (MeshCase* mesh = mesh_file_of(c)) mesh->file = c.file.parent_path() / mesh->file;
}

/// If the kind of analysis is faulty, keys that only some kinds require are not checked. If the key
/// that decides about the parameters of a material is faulty, these are not checked.
void require_keys(CaseValues& in, const Case& c) {
  for (const CaseTable& table : case_tables())
    for (std::size_t k = 0; k < table.count(c); ++k)
      for (const CaseKey& key : keys_of(table)) {
        const bool of_all = key.use.analyses.all() && table.analyses.all();
        const bool asked = of_all || (in.good({"analysis.kind"}) &&  //
                                      means_to(key, c.analysis.kind));
        const std::string path = path_of(key, k);
        const bool required = key.use.required && key.use.required_in.contain(c.analysis.kind);
        const bool known =
            table.path != "material" || in.good({"material.model", "material.bulk_modulus"});
        if (required && known && counts(key, c, k) && asked && !in.has(path)) in.missing(path);
      }
}

/// Refuses keys of other analyses than a dynamic one, given for yet another analysis.
void refuse_keys_of_others(CaseValues& in, const Case& c) {
  const std::string_view name = rules_of(c.analysis.kind).name;
  for (const CaseKey& key : case_keys()) {
    if (means_to(key, AnalysisKind::dynamic) || means_to(key, c.analysis.kind)) continue;
    if (!in.has(key.path) || !in.good({"analysis.kind"})) continue;
    std::string others;
    for (std::size_t k = 0; k < std::size(analysis_kinds); ++k)
      if (means_to(key, static_cast<AnalysisKind>(k)))
        others += fmt::format("{}\"{}\"", others.empty() ? "" : " or ", analysis_kinds[k].name);
    in.fault(key.path, fmt::format("has no effect in a {} analysis", name),
             fmt::format("analysis.kind = {} beside it", others));
  }
}

/// Keys without a meaning for the analysis get their default in the case as run. Returns those that
/// were given: whole tables, else keys; a choice only if it is not the default.
std::string leave_out(const CaseValues& in, Case& c) {
  std::string given;
  const auto add = [&](const std::string& name) { given += (given.empty() ? "" : ", ") + name; };
  const AnalysisKind kind = c.analysis.kind;
  for (const CaseTable& table : case_tables()) {
    if (table.count(c) == 0) continue;
    const bool whole = !table.analyses.contain(kind);
    if (whole && table.analyses.told && (table.is_list() || in.has_table(table.path)))
      add(heading_of(table.path));
    for (const CaseKey& key : keys_of(table)) {
      if (means_to(key, kind)) continue;
      const bool told = !whole && key.use.analyses.told && in.has(key.path) &&
                        (type_of(key) != KeyType::choice ||
                         value_text(key, key.field(c, 0)) != default_text(key));
      if (told) add(std::string(key.path));
      reset(key, c);
    }
  }
  return given;
}

Case read_source(const std::filesystem::path& file, CaseSource source) {
  read_schema(source);
  CaseValues in(std::move(source));
  Case c;
  c.file = file;
  c.title = as_utf8(file.stem().string());
  read_keys(in, c);
  take_road(in, c);
  require_keys(in, c);
  refuse_keys_of_others(in, c);
  make_shape(in, c);
  check_analysis(in, c);
  const std::string left_out = leave_out(in, c);
  check_case(in, c);
  if (!left_out.empty() && !rules_of(c.analysis.kind).why_left_out.empty())
    c.warnings.push_back(
        fmt::format("{}; without effect: {}", rules_of(c.analysis.kind).why_left_out, left_out));
  in.finish();
  c.places = in.places();
  return c;
}

}  // namespace

Case::Case() = default;
Case::~Case() = default;
Case::Case(const Case&) = default;
Case::Case(Case&&) noexcept = default;
Case& Case::operator=(const Case&) = default;
Case& Case::operator=(Case&&) noexcept = default;

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  return read_source(file, load_case(file, settings));
}

Case read_case_text(const std::filesystem::path& file, std::string text,
                    const std::vector<std::string>& settings) {
  return read_source(file, load_case_text(file.string(), std::move(text), settings));
}

}  // namespace rondo::study
