// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_study.hpp"

#include <algorithm>
#include <utility>

#include "rondo/study/sweep/keys/study_keys.hpp"
#include "rondo/study/sweep/keys/vary_reader.hpp"

namespace rondo::study {
namespace {

void read_top(StudyReader& in, SweepStudy& study) {
  int schema = 1;
  std::filesystem::path base;
  study.title = study.file.stem().string();
  in.read("schema", &schema);
  in.read("base", &base);
  in.read("title", &study.title);
  in.read("snapshots", &study.snapshots);
  if (!in.has("schema")) in.fault("schema", "is missing", "schema = 1");
  if (!in.has("base"))
    in.fault("base", "is missing", "base = \"case.toml\", relative to the study");
  if (schema != 1) in.fault("schema", "is from another version of rondo; this one reads 1");
  if (!base.empty()) study.base = study.file.parent_path() / base;
  study.columns = in.texts("columns");
  const CaseValue* set = in.typed("set", ValueType::array);
  if (!set) return;
  for (const CaseValue& item : set->items) {
    if (item.type == ValueType::text && item.text.find('=') != std::string::npos)
      study.settings.push_back(item.text);
    else
      in.fault("set", "an item is not a setting");
  }
}

/// The key of a setting.
std::string key_of(const std::string& setting) {
  std::string key = setting.substr(0, setting.find('='));
  std::erase(key, ' ');
  return key;
}

void read_sample(StudyReader& in, SweepStudy& study) {
  const bool uniform = std::ranges::any_of(
      study.parameters, [](const Vary& vary) { return vary.uniform.has_value(); });
  if (!in.good({"sample"})) return;  // it is not a table
  if (!in.has_table("sample")) {
    if (uniform)
      in.fault("sample", "is missing: a parameter is uniform",
               "[sample] with kind = \"latin-hypercube\", count, seed");
    return;
  }
  if (!uniform)
    in.fault("sample", "samples nothing", "uniform = [from, to] in a [[vary]], or no [sample]");
  std::string kind(sample_kind);
  in.read("sample.kind", &kind);
  if (kind != sample_kind) in.fault("sample.kind", "is no kind of sample");
  if (!in.has("sample.count")) in.fault("sample.count", "is missing", "count = 200");
  const auto count = in.integer("sample.count", sample_counts);
  const auto seed = in.integer("sample.seed", sample_seeds);
  if (count)
    study.sample = Sample{static_cast<int>(*count), static_cast<std::uint64_t>(seed.value_or(1))};
}

void read_window(StudyReader& in, SweepStudy& study) {
  in.read("window.from", &study.window.from);
  in.read("window.to", &study.window.to);
  if (study.window.from && study.window.to && !(*study.window.from < *study.window.to))
    in.fault("window.to", "is not after window.from", "from < to");
}

SweepStudy read(const std::filesystem::path& file, CaseSource source) {
  StudyReader in(std::move(source));
  SweepStudy study;
  study.file = file;
  read_top(in, study);
  study.parameters = read_parameters(in);
  read_sample(in, study);
  read_window(in, study);
  in.finish();
  check_settings(study);
  return study;
}

}  // namespace

void check_settings(const SweepStudy& study) {
  std::vector<Fault> faults;
  const std::string file = study.file.string();
  const auto is_hidden = [&](const std::string& key) {
    return std::ranges::find(study.parameters, key, &Vary::key) != study.parameters.end();
  };
  for (const std::string& setting : study.settings)
    if (is_hidden(key_of(setting)))
      faults.push_back({file, 0, 0, "", setting, "sets a key that is varied", "another key"});
  const auto is_snapshots = [](const std::string& key) { return key == "output.snapshots"; };
  if (!study.snapshots && (std::ranges::any_of(study.parameters, is_snapshots, &Vary::key) ||
                           std::ranges::any_of(study.settings, is_snapshots, key_of)))
    faults.push_back({file, 0, 0, "output.snapshots", "", "the runs write no snapshots",
                      "snapshots = true at the top of the study"});
  if (!faults.empty()) throw InputError(std::move(faults));
}

SweepStudy read_study(const std::filesystem::path& file) {
  return read(file, load_study(file));
}

SweepStudy read_study_text(const std::filesystem::path& file, std::string text) {
  return read(file, load_study_text(file, std::move(text)));
}

}  // namespace rondo::study
