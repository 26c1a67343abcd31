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

#include "rondo/case/case_source.hpp"
#include "rondo/core/build_id.hpp"
#include "rondo/core/build_record.hpp"
#include "rondo/core/contract.hpp"
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

constexpr JsonMember<BuildRecord> record_members[] = {
    {"commit", "string", "", "Commit of the sources; \"unknown\" for a copy without git",
     [](const BuildRecord& r) -> Json { return r.commit; }},
    {"modified", "boolean or null", "", "Files differed from the commit; null: unknown",
     [](const BuildRecord& r) -> Json { return r.modified ? Json(*r.modified) : Json(); }},
    {"compiler", "string", "", "Name, version, kind of build; sanitizers",
     [](const BuildRecord& r) -> Json { return r.compiler; }},
    {"flags", "string", "", "Flags of every module; each module adds its warnings",
     [](const BuildRecord& r) -> Json { return r.flags; }},
    {"libraries", "object of string", "", "Name and version of the libraries of the build",
     [](const BuildRecord& r) {
       Json libraries;
       for (const auto& [name, number] : r.libraries) libraries[name] = number;
       return libraries;
     }},
};

struct Program {};
constexpr JsonMember<Program> program_members[] = {
    {"version", "string", "", "Version of the program",
     [](const Program&) -> Json { return version; }},
    {"build", "string", "", "Compiler, its version and the kind of build",
     [](const Program&) -> Json { return build_options; }},
    {"build_id", "string", "",
     "Hash of the library modules in the program; program and Python module of one build have the "
     "same",
     [](const Program&) -> Json { return build_id(); }},
    {"build_record", "object", "",
     "What the program was built from. Every JSON document of the program has it, and files "
     "of `rondo reduce` as an attribute; `rondo --version` prints it",
     [](const Program&) { return build_record_json(); }, build_record_members},
    {"dispatch", "string", "",
     "Instruction set of the inner loops: \"avx512\", \"avx2\" or \"baseline\"",
     [](const Program&) -> Json { return dispatch_level(); }},
    {"host", "string", "", "Name of the machine",
     [](const Program&) -> Json { return io::host_name(); }},
};

struct Ending {
  std::string_view status, message;
};
constexpr JsonMember<Ending> status_members[] = {
    {"status", "string", "",
     "\"running\", \"done\", \"interrupted\" or \"failed\"; \"running\" without a process: the run "
     "was killed",
     [](const Ending& e) -> Json { return e.status; }},
    {"message", "string", "", "Reason of a failure: step, time, quantity",
     [](const Ending& e) { return e.message.empty() ? absent() : Json(e.message); }},
};

constexpr JsonMember<Case> title_members[] = {
    {"title", "string", "", "`title` of the case", [](const Case& c) -> Json { return c.title; }},
};
constexpr JsonMember<std::string_view> begun_members[] = {
    {"process", "integer", "", "Number of the process",
     [](const std::string_view&) -> Json { return ::getpid(); }},
    {"analysis", "string", "",
     "\"dynamic\", \"crush\", \"steady-rolling\", \"inflation\" or \"modes\"",
     [](const std::string_view& analysis) -> Json { return analysis; }},
};

}  // namespace

Json build_record_json() {
  return object_of(record_members, build_record());
}

std::vector<MemberText> build_record_members() {
  return texts_of(record_members);
}

void describe_program(Json& json) {
  add_members(program_members, {}, json);
}

Json describe_run(const Case& c, std::string_view analysis) {
  Json j = object_of(status_members, {"running", {}});
  add_members(title_members, c, j);
  describe_program(j);
  add_members(begun_members, analysis, j);
  return j;
}

std::vector<MemberText> run_file_members() {
  return joined({texts_of(status_members), texts_of(title_members), texts_of(program_members),
                 texts_of(begun_members)});
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
  std::error_code error;
  if (is_on_road_surface(kept)) {
    std::string& road = kept.ground->road.file;
    road = as_utf8(std::filesystem::absolute(road, error).string());
  }
  MeshCase* const mesh = mesh_file_of(kept);
  if (!mesh) return kept;
  const std::filesystem::path whole = std::filesystem::absolute(mesh->file, error);
  mesh->file = is_copied(*mesh) ? std::filesystem::path(mesh_copy) : whole;
  return kept;
}

void write_contact_problem(const std::filesystem::path& directory, int number,
                           const contact::ProblemFile& problem) {
  RONDO_DEMAND(number >= 0, number);
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
  RONDO_DEMAND(!options.directory.empty() && json.contains("status"), options.directory.string());
  copy_mesh(c, options.directory);
  write_case_file(c, options);
  io::write_json(options.directory / "run.json", json);
}

void write_case_file(const Case& c, const RunOptions& options) {
  io::write_file(options.directory / "case.toml", write_case(kept_case(c)));
}

void note_failure(const RunOptions& options, Json json, const std::exception& error) noexcept {
  const bool memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  add_status(json, RunStatus::failed, memory ? "not enough memory" : error.what());
  io::overwrite_json(options.directory / "run.json", json);  // the disk may be full
}

void add_status(Json& json, RunStatus status, const std::string& message) {
  static constexpr std::array<const char*, 3> names{"done", "interrupted", "failed"};
  static_assert(static_cast<std::size_t>(RunStatus::failed) + 1 == names.size());
  add_members(status_members, {names[static_cast<std::size_t>(status)], message}, json);
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
