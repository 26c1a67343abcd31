// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/run_files.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <system_error>

#include "rondo/dynamics/dispatch.hpp"
#include "rondo/io/files.hpp"
#include "rondo/study/build_id.hpp"
#include "rondo/study/version.hpp"

namespace rondo::study {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// The case as run is written into the directory as case.toml: it must not replace the user's file.
void keep_the_users_case(const Case& c, const std::filesystem::path& directory) {
  std::error_code error;
  if (!std::filesystem::equivalent(c.file, directory / "case.toml", error) || error) return;
  io::refuse_directory(
      directory, "the case file is this directory's own case.toml, which a run there would replace",
      "choose another -o");
}

}  // namespace

void describe_program(Json& json) {
  json["version"] = version;
  json["build"] = build_options;
  json["build_id"] = build_id();
  json["host"] = host_name();
}

Json describe_run(const Case& c, std::string_view analysis, std::size_t nodes, std::size_t dofs) {
  Json j;
  j["status"] = "running";
  j["title"] = c.title;
  describe_program(j);
  j["analysis"] = analysis;
  j["nodes"] = nodes;
  j["dofs"] = dofs;
  return j;
}

std::string text_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void give_warnings(const std::vector<std::string>& warnings, const RunOptions& options) {
  if (!options.warn) return;
  for (const std::string& warning : warnings) options.warn(warning);
}

void begin_modes_directory(const Case& c, const std::filesystem::path& directory, bool overwrite) {
  keep_the_users_case(c, directory);
  io::prepare_results_directory(directory, overwrite);
  io::write_file(directory / "case.toml", write_case(c));
}

void begin_directory(const Case& c, const RunOptions& options, const Json& json) {
  if (options.before_loop) options.before_loop();
  begin_modes_directory(c, options.directory, options.overwrite);
  io::write_json(options.directory / "run.json", json);
}

void note_failure(const RunOptions& options, Json json, const std::exception& error) noexcept {
  json["status"] = "failed";
  json["message"] = error.what();
  io::overwrite_json(options.directory / "run.json", json);  // the disk may be full
}

void add_status(Json& json, RunStatus status, const std::string& message) {
  static constexpr std::array<const char*, 3> names{"done", "interrupted", "failed"};
  json["status"] = names[static_cast<std::size_t>(status)];
  if (!message.empty()) json["message"] = message;
}

const char* dispatch_level() {
  return dynamics::kernel_table().name;
}

long long peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024LL;
}

}  // namespace rondo::study
