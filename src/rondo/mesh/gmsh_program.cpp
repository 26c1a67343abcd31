// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/gmsh_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "rondo/core/error.hpp"

namespace rondo::mesh {
namespace {

namespace fs = std::filesystem;

constexpr const char* program_name = "rondo-mesh-reader";

bool can_run(const fs::path& program) {
  std::error_code error;
  return fs::is_regular_file(program, error) && access(program.c_str(), X_OK) == 0;
}

/// Sets one thread: the numerical libraries of Gmsh would start one per core when loaded.
std::vector<char*> child_environment() {
  static char blas[] = "OPENBLAS_NUM_THREADS=1", openmp[] = "OMP_NUM_THREADS=1";
  std::vector<char*> variables{blas, openmp};  // the first variable of a name counts
  for (char** at = environ; *at != nullptr; ++at) variables.push_back(*at);
  variables.push_back(nullptr);
  return variables;
}

/// Owns the objects that posix_spawn requires to be initialised and destroyed.
struct SpawnSettings {
  SpawnSettings(int output, int errors) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    posix_spawnattr_init(&attributes);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

/// None if the system does not keep the status (SIGCHLD is ignored).
std::optional<int> status_of(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) return std::nullopt;
  return status;
}

}  // namespace

fs::path find_reader_program() {
  if (const char* given = std::getenv("RONDO_MESH_READER"); given != nullptr && *given != '\0') {
    if (can_run(given)) return given;
    throw FileError(given, "is no program that can be run, and RONDO_MESH_READER names it");
  }
  std::error_code error;
  const fs::path own = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {own, fs::path(RONDO_INSTALLED_PROGRAMS)})
    if (can_run(folder / program_name)) return folder / program_name;
  throw FileError(
      program_name,
      fmt::format("is not found: it reads Gmsh meshes and belongs into {} or {}; or set "
                  "the environment variable RONDO_MESH_READER to its path",
                  own.string(), RONDO_INSTALLED_PROGRAMS));
}

ReaderProgram::ReaderProgram(fs::path program, const fs::path& file)
    : program_(std::move(program)) {
  std::array<int, 2> ends{-1, -1};
  errors_ = memfd_create(program_name, MFD_CLOEXEC);
  if (errors_ < 0 || pipe2(ends.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    if (errors_ >= 0) close(errors_);
    throw FileError(program_.string(), fmt::format("cannot be started: {}", std::strerror(error)));
  }
  const SpawnSettings settings(ends[1], errors_);
  std::string name = program_name, argument = fs::absolute(file).string();
  std::array<char*, 3> arguments{name.data(), argument.data(), nullptr};
  const int error = posix_spawn(&pid_, program_.c_str(), &settings.actions, &settings.attributes,
                                arguments.data(), child_environment().data());
  close(ends[1]);
  pipe_ = ends[0];
  if (error == 0) return;
  close(pipe_);
  close(errors_);
  throw FileError(program_.string(), fmt::format("cannot be started: {}", std::strerror(error)));
}

ReaderProgram::~ReaderProgram() {
  kill();
  close(pipe_);
  close(errors_);
}

std::size_t ReaderProgram::read(void* data, std::size_t size) {
  ssize_t got = 0;
  do got = ::read(pipe_, data, size);
  while (got < 0 && errno == EINTR);
  return got > 0 ? static_cast<std::size_t>(got) : 0;
}

std::string ReaderProgram::said() const {
  std::array<char, 400> text{};
  const ssize_t got = pread(errors_, text.data(), text.size(), 0);
  std::string words(text.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  while (!words.empty() && words.back() == '\n') words.pop_back();
  return words.empty() ? words : fmt::format(", saying: {}", words);
}

std::string ReaderProgram::wait() {
  if (pid_ < 0) return {};
  const std::optional<int> status = status_of(std::exchange(pid_, -1));
  if (!status || (WIFEXITED(*status) && WEXITSTATUS(*status) == 0)) return {};
  if (!WIFSIGNALED(*status)) return fmt::format("exit code {}{}", WEXITSTATUS(*status), said());
  const int number = WTERMSIG(*status);
  if (number == SIGXCPU) return "its limit of time";
  return fmt::format("signal {} ({}){}", number, strsignal(number), said());
}

void ReaderProgram::kill() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  static_cast<void>(status_of(std::exchange(pid_, -1)));
}

}  // namespace rondo::mesh
