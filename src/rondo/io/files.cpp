// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/io/directory.hpp"

namespace rondo::io {
namespace fs = std::filesystem;
namespace {

/// Descriptor of a temporary file beside `target`.
class Beside {
 public:
  Beside(const fs::path& target, const std::string& suffix)
      : target_(target), file_(target.string() + suffix) {
    descriptor_ = ::open(file_.path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail_on(target_, "create");
  }
  ~Beside() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  void write(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t n = ::write(descriptor_, text.data() + done, text.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail_on(target_, "write");
      done += static_cast<std::size_t>(n);
    }
  }
  void sync() const {
    if (::fsync(descriptor_) != 0) fail_on(target_, "write");
  }
  void keep() {
    if (::close(std::exchange(descriptor_, -1)) != 0) fail_on(target_, "write");
    if (::rename(file_.path.c_str(), target_.c_str()) != 0) fail_on(target_, "replace");
  }

 private:
  fs::path target_;
  UnfinishedFile file_;
  int descriptor_ = -1;
};

}  // namespace

void fail_on(const fs::path& file, const char* doing) {
  const int code = errno;
  throw FileError(file.string(),
                  fmt::format("cannot {}: {}", doing, std::generic_category().message(code)));
}

std::string text_of(const fs::path& file) {
  if (!kind_of_no_file(file).empty()) return {};
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const fs::path& file, const std::string& text) {
  Beside beside(file, unfinished_ending());
  beside.write(text);
  beside.sync();
  beside.keep();
}

void write_beside(const fs::path& file, const std::string& text) {
  Beside beside(file, ".new");
  beside.write(text);
  beside.keep();
}

void write_json(const fs::path& file, const nlohmann::ordered_json& json) {
  constexpr int indent = 2;
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;
  write_file(file, json.dump(indent, ' ', false, replace) + "\n");
}

nlohmann::ordered_json read_json(const fs::path& file) {
  demand_regular_file(file);
  std::ifstream in(file, std::ios::binary);
  if (!in) fail_on(file, "read");
  constexpr bool exceptions = false;
  auto json = nlohmann::ordered_json::parse(in, nullptr, exceptions);
  if (json.is_discarded()) throw FileError(file.string(), "is damaged: not JSON");
  return json;
}

std::string unfinished_ending() {
  return fmt::format(".{}.{}.tmp", host_name(), ::getpid());
}

namespace {

/// The process of this machine in the name of an unfinished file; 0: it has none.
pid_t process_in(const std::string& name) {
  constexpr std::string_view ending = ".tmp";
  const std::string host = fmt::format(".{}.", host_name());
  const std::size_t at = name.rfind(host);
  if (!name.ends_with(ending) || at == name.npos) return 0;
  const std::size_t begin = at + host.size(), end = name.size() - ending.size();
  if (begin >= end) return 0;
  pid_t process = 0;
  const auto [stop, error] = std::from_chars(&name[begin], &name[end], process);
  return error == std::errc() && stop == &name[end] ? process : 0;
}

}  // namespace

void remove_left_unfinished(const fs::path& directory) {
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code removed;
    const pid_t process = process_in(entry->path().filename().string());
    if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH)
      fs::remove_all(entry->path(), removed);
  }
}

UnfinishedFile::~UnfinishedFile() {
  std::error_code error;
  fs::remove(path, error);
}

void sync_file(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail_on(file, "open");
  const bool written = ::fsync(descriptor) == 0;
  ::close(descriptor);
  if (!written) fail_on(file, "write");
}

void replace_file(const fs::path& file, const fs::path& target) {
  sync_file(file);
  if (::rename(file.c_str(), target.c_str()) != 0) fail_on(target, "replace");
  sync_file(target.has_parent_path() ? target.parent_path() : fs::path("."));
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
    write_json(file, json);
    return true;
  } catch (const std::exception&) {  // then overwrite in place
  }
  try {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    std::string text = json.dump(2) + "\n";
    if (!error && text.size() < size) text.append(size - text.size(), ' ');  // covers the old text
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    return static_cast<bool>(stream);
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace rondo::io
