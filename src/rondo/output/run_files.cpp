// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/run_files.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <new>
#include <system_error>

#include "rondo/core/build_id.hpp"
#include "rondo/core/build_record.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/version.hpp"
#include "rondo/integrators/fused/dispatch.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/io/files.hpp"

namespace rondo::study {
namespace {

constexpr const char* mesh_copy = "mesh.msh";
constexpr std::uintmax_t largest_copy = 50'000'000;  ///< largest mesh file that is copied [bytes]

/// case.toml and mesh.msh are written into the directory; they must not replace the user's files
/// there.
void keep_the_users_files(const Case& c, const std::filesystem::path& directory) {
  const auto refuse_replacing = [&](const std::filesystem::path& file, const char* name,
                                    const char* what) {
    std::error_code error;
    if (!std::filesystem::equivalent(file, directory / name, error) || error) return;
    io::refuse_directory(
        directory,
        fmt::format("the {} is this directory's own {}, which a run there would replace", what,
                    name),
        "choose another -o");
  };
  refuse_replacing(c.file, "case.toml", "case file");
  if (const MeshCase* mesh = mesh_file_of(c)) refuse_replacing(mesh->file, mesh_copy, "mesh file");
}

bool is_copied(const MeshCase& mesh) {
  std::error_code error;
  const auto size = std::filesystem::file_size(mesh.file, error);
  return !error && size <= largest_copy;
}

void copy_mesh(const Case& c, const std::filesystem::path& directory) {
  const MeshCase* const mesh = mesh_file_of(c);
  if (!mesh || !is_copied(*mesh)) return;
  std::error_code error;
  if (std::filesystem::equivalent(mesh->file, directory / mesh_copy, error)) return;
  std::ifstream in(mesh->file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  if (in.bad()) throw FileError(mesh->file.string(), "cannot be read again, to be copied");
  io::write_file(directory / mesh_copy, text);
}

}  // namespace

Json build_record_json() {
  const BuildRecord record = build_record();
  Json json, libraries;
  json["commit"] = record.commit;
  json["modified"] = record.modified ? Json(*record.modified) : Json();
  json["compiler"] = record.compiler;
  json["flags"] = record.flags;
  for (const auto& [name, number] : record.libraries) libraries[name] = number;
  json["libraries"] = std::move(libraries);
  return json;
}

void describe_program(Json& json) {
  json["version"] = version;
  json["build"] = build_options;
  json["build_id"] = build_id();
  json["build_record"] = build_record_json();
  json["dispatch"] = dispatch_level();
  json["host"] = io::host_name();
}

Json describe_run(const Case& c, std::string_view analysis) {
  Json j;
  j["status"] = "running";
  j["title"] = c.title;
  describe_program(j);
  j["process"] = ::getpid();
  j["analysis"] = analysis;
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

Case kept_case(const Case& c) {
  Case kept = c;
  MeshCase* const mesh = mesh_file_of(kept);
  if (!mesh) return kept;
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(mesh->file, error);
  mesh->file = is_copied(*mesh) ? std::filesystem::path(mesh_copy) : whole;
  return kept;
}

void write_contact_problem(const std::filesystem::path& directory, int number,
                           const contact::ProblemFile& problem) {
  const std::filesystem::path folder = directory / "contact-problems";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileError(folder.string(), "cannot create: " + error.message());
  const std::filesystem::path file = folder / fmt::format("{:04}.json", number);
  const io::UnfinishedFile beside(file.string() + ".new");
  contact::write_problem(beside.path, problem);
  io::replace_file(beside.path, file);
}

io::DirectoryLock take_directory(const Case& c, const RunOptions& options) {
  if (options.before_loop) options.before_loop();
  // If a run is resumed, these files are the run's own.
  if (!options.resume || io::mark_of_run(options.directory).empty())
    keep_the_users_files(c, options.directory);
  return io::take_results_directory(options.directory, options.resume ? io::DirectoryUse::go_on
                                                       : options.overwrite
                                                           ? io::DirectoryUse::overwrite
                                                           : io::DirectoryUse::begin);
}

std::string warning_of_another_host(const std::filesystem::path& directory) {
  const std::string host = io::holder_of(directory).host;
  if (host.empty() || host == io::host_name()) return {};
  return fmt::format(
      "{} was begun on {}, and its files do not say that it has ended there: make sure that it "
      "does not go on there, locks do not reach across machines",
      directory.string(), host);
}

void begin_files(const Case& c, const RunOptions& options, const Json& json) {
  copy_mesh(c, options.directory);
  write_case_file(c, options);
  io::write_json(options.directory / "run.json", json);
}

void write_case_file(const Case& c, const RunOptions& options) {
  io::write_file(options.directory / "case.toml", write_case(kept_case(c)));
}

void note_failure(const RunOptions& options, Json json, const std::exception& error) noexcept {
  json["status"] = "failed";
  const bool memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  json["message"] = memory ? "not enough memory" : error.what();
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
