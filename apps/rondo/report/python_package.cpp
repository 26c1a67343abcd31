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

/// Whether the process ends with exit code 0; its output is discarded.
bool succeeds(const std::string& program, const char* code) {
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {0, 1, 2})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", stream == 0 ? O_RDONLY : O_WRONLY,
                                     0);
  std::string first = program, flag = "-c", text = code;
  char* const arguments[] = {first.data(), flag.data(), text.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &quiet, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) return false;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
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
    if (succeeds(python, needed)) return python;
  std::string tried;
  for (const std::string& python : candidates) tried += (tried.empty() ? "" : ", ") + python;
  throw FileError(tried,
                  "no Python 3.11 or later with numpy, h5py, matplotlib and Pillow, which this "
                  "command needs: bash scripts/setup.sh installs them on Debian; or give one as "
                  "RONDO_PYTHON=...");
}

void become_python(const std::vector<std::string>& arguments) {
  const std::string package = find_python_package(), python = find_python(package);
  const char* before = std::getenv("PYTHONPATH");
  const std::string path = before != nullptr && *before != '\0' ? package + ":" + before : package;
  setenv("PYTHONPATH", path.c_str(), 1);
  setenv("RONDO", own_program().c_str(), 1);  // the program that the package calls
  // -P: no file in the working folder is imported as a module.
  std::vector<std::string> words{python, "-P", "-m", "rondo"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::fflush(stdout);
  execvp(python.c_str(), pointers.data());
  throw FileError(python, std::string("cannot be started: ") + std::strerror(errno));
}

}  // namespace rondo::app
