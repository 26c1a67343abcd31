// SPDX-License-Identifier: BSD-3-Clause
#include "report/python_package.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>

#include "rondo/core/error.hpp"

namespace rondo::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* needed =
    "import importlib.util as u, sys; sys.exit(sys.version_info < (3, 11) or not "
    "all(map(u.find_spec, "
    "('numpy', 'h5py', 'matplotlib', 'PIL'))))";

fs::path own_program() {
  std::error_code error;
  fs::path own = fs::read_symlink("/proc/self/exe", error);
  if (error) throw FileError("/proc/self/exe", error.message());
  return own;
}

bool is_package(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "rondo" / "__main__.py", error);
}

/// The package of a build, whose source folder CMake has recorded.
fs::path of_build(const fs::path& own) {
  std::string line;
  std::ifstream file(own / "python" / "package-folder.txt");
  std::getline(file, line);
  return line;
}

/// PREFIX/lib/python3*/{dist,site}-packages, sorted: the folder may have been moved after the
/// installation.
std::vector<fs::path> of_installation(const fs::path& own) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(own.parent_path() / "lib", error))
    if (entry.path().filename().string().starts_with("python3"))
      for (const char* packages : {"dist-packages", "site-packages"})
        found.push_back(entry.path() / packages);
  std::ranges::sort(found);
  return found;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Exit code of a program; -1: it could not be started, or a signal ended it.
/// @param discarded  streams that are /dev/null to it
int exit_code(std::vector<std::string> words, std::initializer_list<int> discarded) {
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : discarded)
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", stream == 0 ? O_RDONLY : O_WRONLY,
                                     0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, words.front().c_str(), &quiet, nullptr,
                                 pointers_to(words).data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool has_needed(const std::string& python) {
  return exit_code({python, "-c", needed}, {0, 1, 2}) == 0;
}

/// `python -m rondo arguments`, and the environment in which it finds the package and this program.
std::vector<std::string> prepared(const std::vector<std::string>& arguments) {
  const std::string package = find_python_package(), python = find_python(package);
  const char* before = std::getenv("PYTHONPATH");
  const std::string path = before != nullptr && *before != '\0' ? package + ":" + before : package;
  setenv("PYTHONPATH", path.c_str(), 1);
  setenv("RONDO", own_program().c_str(), 1);  // the program that the package calls
  // -P: no file in the working folder is imported as a module.
  std::vector<std::string> words{python, "-P", "-m", "rondo"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::fflush(stdout);
  return words;
}

}  // namespace

std::string find_python_package() {
  const fs::path own = own_program().parent_path();
  std::vector<fs::path> places = of_installation(own);
  places.insert(places.begin(), {of_build(own), own.parent_path().parent_path()});
  for (const fs::path& place : places)
    if (!place.empty() && is_package(place)) return place.string();
  throw FileError(own.string(),
                  "the Python package that belongs to this program is not there, which does this "
                  "command; install both (cmake --install BUILD, pip install ./python), or build "
                  "rondo where its sources are");
}

std::string find_python(const std::string& package) {
  std::vector<std::string> candidates;
  const char* given = std::getenv("RONDO_PYTHON");
  if (given != nullptr && *given != '\0') {
    candidates = {given};
  } else {
    // ENVIRONMENT/lib/python3.N/site-packages
    const fs::path around =
        fs::path(package).parent_path().parent_path().parent_path() / "bin" / "python3";
    std::error_code error;
    if (fs::exists(around, error)) candidates.push_back(around.string());
    candidates.insert(candidates.end(), {"/usr/bin/python3", "python3"});
  }
  for (const std::string& python : candidates)
    if (has_needed(python)) return python;
  std::string tried;
  for (const std::string& python : candidates) tried += (tried.empty() ? "" : ", ") + python;
  throw FileError(tried,
                  "no Python 3.11 or later with numpy, h5py, matplotlib and Pillow, which this "
                  "command needs: bash scripts/setup.sh installs them on Debian; or give one as "
                  "RONDO_PYTHON=...");
}

void become_python(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = prepared(arguments);
  execvp(words.front().c_str(), pointers_to(words).data());
  throw FileError(words.front(), std::string("cannot be started: ") + std::strerror(errno));
}

int run_python(const std::vector<std::string>& arguments, bool silent) {
  const std::vector<std::string> words = prepared(arguments);
  const int code = silent ? exit_code(words, {1}) : exit_code(words, {});
  if (code < 0) throw FileError(words.front(), "was ended by a signal, or cannot be started");
  return code;
}

}  // namespace rondo::app
