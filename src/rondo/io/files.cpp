// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <system_error>
#include <thread>

#include "rondo/core/error.hpp"

namespace rondo::io {
namespace fs = std::filesystem;
namespace {

/// Any of these: the directory holds a run.
constexpr std::array run_marks = {"run.json", "results.h5", "history.csv", "modes.json",
                                  "modes.h5"};
constexpr std::array run_files = {
    "case.toml",  "mesh.msh",    "run.json",      "history.csv",        "contact.csv",
    "results.h5", "fields.xdmf", "checkpoint.h5", "modes.json",         "modes.h5",
    "modes.xdmf", "modes.csv",   "campbell.csv",  "critical-speeds.csv"};
constexpr std::array pod_files = {"pod.json", "pod.h5", "spectrum.csv", "modes.xdmf",
                                  "reconstruction.xdmf"};

std::string message(int code) {
  return std::generic_category().message(code);
}

/// There is something of that name, be it a link to nowhere.
bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

void remove_one(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw FileError(file.string(), "cannot remove: " + message(error.value()));
}

/// PODs of a run that is no more: in the run's own pod/, their files and folders that are then
/// empty.
void remove_pods(const fs::path& directory) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory / "pod", error)) {
    for (const char* name : pod_files) remove_one(entry.path() / name);
    if (fs::is_empty(entry.path(), error)) remove_one(entry.path());
  }
  if (fs::is_empty(directory / "pod", error)) remove_one(directory / "pod");
}

/// Contact problems kept by a run that is no more.
void remove_contact_problems(const fs::path& directory) {
  const fs::path folder = directory / "contact-problems";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") remove_one(entry.path());
  if (fs::is_empty(folder, error)) remove_one(folder);
}

void remove_run(const fs::path& directory) {
  for (const char* name : run_files) remove_one(directory / name);
  remove_pods(directory);
  remove_contact_problems(directory);
}

/// Descriptor of a file being written; removes it unless kept.
class Beside {
 public:
  explicit Beside(const fs::path& target)
      : target_(target), path_(target.string() + fmt::format(".{}.tmp", ::getpid())) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("create");
  }
  ~Beside() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!kept_) ::unlink(path_.c_str());
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  void write(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t n = ::write(descriptor_, text.data() + done, text.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail("write");
      done += static_cast<std::size_t>(n);
    }
  }
  void keep() {
    if (::fsync(descriptor_) != 0) fail("write");
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) fail("write");
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail("replace");
    kept_ = true;
  }

 private:
  [[noreturn]] void fail(const char* doing) const {
    const int code = errno;
    throw FileError(target_.string(), fmt::format("cannot {}: {}", doing, message(code)));
  }
  fs::path target_, path_;
  int descriptor_ = -1;
  bool kept_ = false;
};

}  // namespace

void refuse_directory(const fs::path& directory, const std::string& what,
                      const std::string& to_do) {
  Fault fault;
  fault.key = "-o";
  fault.found = directory.string();
  fault.message = what;
  fault.allowed = to_do;
  throw InputError(fault);
}

void prepare_results_directory(const fs::path& directory, bool overwrite) {
  const std::string elsewhere = "choose another -o";
  std::error_code error;
  if (is_there(directory) && !fs::is_directory(directory, error))
    refuse_directory(directory, "is there and is not a directory", elsewhere);
  fs::create_directories(directory, error);
  if (error)
    throw FileError(directory.string(), "cannot create directory: " + message(error.value()));
  if (overwrite) return remove_run(directory);
  for (const char* name : run_marks)
    if (is_there(directory / name))
      refuse_directory(directory, fmt::format("holds another run ({} is there)", name),
                       elsewhere + ", or give --overwrite");
}

void write_file(const fs::path& file, const std::string& text) {
  Beside beside(file);
  beside.write(text);
  beside.keep();
}

void write_json(const fs::path& file, const nlohmann::ordered_json& json) {
  constexpr int indent = 2;
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_file(file, json.dump(indent, ' ', false, replace) + "\n");
}

nlohmann::ordered_json read_json(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(file.string(), "cannot read: " + message(errno));
  constexpr bool exceptions = false;
  auto json = nlohmann::ordered_json::parse(in, nullptr, exceptions);
  if (json.is_discarded()) throw FileError(file.string(), "is damaged: not JSON");
  return json;
}

void replace_file(const fs::path& file, const fs::path& target) {
  const auto fail = [&](const char* doing) {
    throw FileError(target.string(), fmt::format("cannot {}: {}", doing, message(errno)));
  };
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail("open what replaces it");
  const bool written = ::fsync(descriptor) == 0;
  ::close(descriptor);
  if (!written) fail("write");
  if (::rename(file.c_str(), target.c_str()) != 0) fail("replace");
}

void demand_room(const fs::path& file, std::size_t bytes) {
  std::error_code error;
  const auto space = fs::space(file.parent_path(), error);
  if (error || space.capacity == 0 || space.available >= bytes) return;
  constexpr double mega = 1e6;
  throw FileError(file.string(), fmt::format("disk full: {:.1f} MB needed, {:.1f} MB free",
                                             static_cast<double>(bytes) / mega,
                                             static_cast<double>(space.available) / mega));
}

bool overwrite_json(const fs::path& file, const nlohmann::ordered_json& json) noexcept {
  try {
    const std::string text = json.dump(2) + "\n";
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    if (!stream) return false;
    fs::resize_file(file, text.size());
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

DirectoryLock::DirectoryLock(const fs::path& directory)
    : descriptor_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw FileError(directory.string(), "cannot open the directory: " + message(errno));
  int code = 0;
  for (int tries = 0; tries < 20; ++tries) {  // a second: processes of a killed one may be ending
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    code = errno;
    if (code != EWOULDBLOCK && code != EINTR) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ::close(descriptor_);
  throw FileError(directory.string(), code == EWOULDBLOCK
                                          ? "another rondo is at work here; wait until it ends"
                                          : "cannot lock: " + message(code));
}

DirectoryLock::~DirectoryLock() {
  ::close(descriptor_);
}

}  // namespace rondo::io
