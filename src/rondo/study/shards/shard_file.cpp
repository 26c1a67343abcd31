// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/shards/shard_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <system_error>
#include <tuple>

#include "rondo/case/case_source.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/hash.hpp"
#include "rondo/study/sweep/sweep_directory.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* shard_format = "rondo shard 1";
constexpr const char* file_name = "rows.json";

/// Numbers that JSON cannot represent are written as texts.
Json json_of(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

/// @throws std::runtime_error: it is not a number
double number_of(const Json& value) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (value.is_number()) return value.get<double>();
  if (value == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (value == "inf") return infinity;
  if (value == "-inf") return -infinity;
  throw std::runtime_error("no number: " + value.dump());
}

Json describe(std::size_t member, const MemberRow& row) {
  Json j;
  j["run"] = member + 1;
  j["status"] = name_of(row.status);
  j["code"] = row.code;
  j["message"] = as_utf8(row.message);
  j["steps"] = row.steps;
  j["end_time"] = json_of(row.end_time);
  j["worker"] = row.worker;
  j["wall_s"] = json_of(row.wall_s);
  j["figures"] = Json::array();
  for (const double figure : row.figures) j["figures"].push_back(json_of(figure));
  return j;
}

MemberStatus status_named(const std::string& name) {
  for (const MemberStatus status :
       {MemberStatus::waiting, MemberStatus::done, MemberStatus::failed, MemberStatus::interrupted})
    if (name == name_of(status)) return status;
  throw std::runtime_error("no status: " + name);
}

std::pair<std::size_t, MemberRow> row_of(const Json& j) {
  MemberRow row;
  row.status = status_named(j.at("status").get<std::string>());
  row.code = j.at("code").get<int>();
  row.message = j.at("message").get<std::string>();
  row.steps = j.at("steps").get<long long>();
  row.end_time = number_of(j.at("end_time"));
  row.worker = j.at("worker").get<int>();
  row.wall_s = number_of(j.at("wall_s"));
  for (const Json& figure : j.at("figures")) row.figures.push_back(number_of(figure));
  const auto run = j.at("run").get<std::size_t>();
  if (run == 0) throw std::runtime_error("run 0");
  return {run - 1, row};
}

std::string hash_of_file(const fs::path& file) {
  const std::string text = io::text_of(file);
  io::Hash hash;
  hash.add(std::span<const char>(text));
  return hash.text();
}

ShardFile parse(const Json& j) {
  ShardFile file;
  if (j.at("format") != shard_format)
    throw std::runtime_error("its format is not \"" + std::string(shard_format) + "\"");
  file.shard = {j.at("shard").get<std::size_t>(), j.at("of").get<std::size_t>()};
  file.status = j.at("status").get<std::string>();
  file.host = j.at("host").get<std::string>();
  file.process = j.at("process").get<long long>();
  SweepIdentity& identity = file.identity;
  identity.members_hash = j.at("members_hash").get<std::string>();
  identity.study_hash = j.at("study_hash").get<std::string>();
  identity.base_hash = j.at("base_hash").get<std::string>();
  identity.settings = j.at("set").get<std::vector<std::string>>();
  identity.version = j.at("version").get<std::string>();
  identity.build_id = j.at("build_id").get<std::string>();
  file.wall_s = number_of(j.at("wall_s"));
  for (const Json& row : j.at("rows")) file.rows.push_back(row_of(row));
  return file;
}

}  // namespace

SweepIdentity identity_of(const SweepRequest& request, const SweepStudy& study,
                          const PlannedSweep& plan) {
  Json program;
  describe_program(program);
  return {hash_of(study, plan), hash_of_file(study.file),    hash_of_file(study.base),
          request.settings,     text_in(program, "version"), text_in(program, "build_id")};
}

std::string difference(const SweepIdentity& found, const SweepIdentity& own) {
  if (found.members_hash != own.members_hash) {
    std::string what;
    const auto add = [&](bool differs, const char* name) {
      if (differs) what += (what.empty() ? "" : ", ") + std::string(name);
    };
    add(found.study_hash != own.study_hash, "the study file");
    add(found.base_hash != own.base_hash, "the base case");
    add(found.settings != own.settings, "--set");
    return (what.empty() ? "a mesh file" : what) +
           (what.find(',') != what.npos ? " differ" : " differs");
  }
  if (found.build_id != own.build_id || own.build_id.empty())
    return fmt::format("the program differs (version {}, build id {}; this is {}, {})",
                       found.version, found.build_id, own.version, own.build_id);
  return {};
}

fs::path shard_directory(const fs::path& sweep, const Shard& shard) {
  return sweep / shards_folder / folder_name(shard);
}

std::vector<Shard> shards_in(const fs::path& sweep) {
  std::vector<Shard> shards;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(sweep / shards_folder, error)) {
    Shard shard;
    if (shard_of_folder(entry.path().filename().string(), shard)) shards.push_back(shard);
  }
  std::ranges::sort(shards, {}, [](const Shard& s) { return std::tuple(s.count, s.number); });
  return shards;
}

bool has_shard_file(const fs::path& sweep, const Shard& shard) {
  std::error_code error;
  return fs::exists(shard_directory(sweep, shard) / file_name, error);
}

void write_shard_file(const fs::path& sweep, const ShardFile& file) {
  Json j;
  j["format"] = shard_format;
  j["shard"] = file.shard.number;
  j["of"] = file.shard.count;
  j["status"] = file.status;
  describe_program(j);
  j["process"] = ::getpid();
  j["members_hash"] = file.identity.members_hash;
  j["study_hash"] = file.identity.study_hash;
  j["base_hash"] = file.identity.base_hash;
  j["set"] = Json::array();
  for (const std::string& setting : file.identity.settings) j["set"].push_back(as_utf8(setting));
  j["rows"] = Json::array();
  for (const auto& [member, row] : file.rows) j["rows"].push_back(describe(member, row));
  j["wall_s"] = file.wall_s;
  io::write_json(shard_directory(sweep, file.shard) / file_name, j);
}

ShardFile read_shard_file(const fs::path& sweep, const Shard& shard) {
  const fs::path path = shard_directory(sweep, shard) / file_name;
  const std::string remedy =
      fmt::format("remove its folder and make shard {} again", text_of(shard));
  try {
    ShardFile file = parse(io::read_json(path));
    if (text_of(file.shard) != text_of(shard)) throw std::runtime_error("of another shard");
    return file;
  } catch (const FileError& error) {
    throw FileError(error, remedy);
  } catch (const std::exception& error) {
    throw FileError(path.string(), fmt::format("damaged: {}; {}", error.what(), remedy));
  }
}

}  // namespace rondo::study
