// SPDX-License-Identifier: BSD-3-Clause
#include "source_text.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>

namespace rondo::reader {

SourceText::SourceText(const std::string& path) : file(open(path.c_str(), O_RDONLY | O_NONBLOCK)) {
  struct stat status {};
  if (file < 0 || fstat(file, &status) != 0) throw std::string(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) throw std::string("it is not a regular file");
  size = static_cast<std::uint64_t>(status.st_size);
  if (size == 0) throw std::string("the file is empty");
  void* const place = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  if (place == MAP_FAILED) throw std::string(std::strerror(errno));
  text = static_cast<const char*>(place);
}

SourceText::~SourceText() {
  if (text != nullptr) munmap(const_cast<char*>(text), size);
  if (file >= 0) close(file);
}

std::string SourceText::missing_end() const {
  const std::string_view all(text, size);
  std::string missing;
  for (const char* name : {"Nodes", "Elements"}) {
    const auto start = all.find(std::string("\n$") + name);
    const std::string end = std::string("$End") + name;
    if (start == std::string_view::npos || all.find(end, start) != std::string_view::npos) continue;
    missing += (missing.empty() ? "" : " and ") + end;
  }
  return missing;
}

std::uint64_t SourceText::n_nodes() const {
  const std::string_view all(text, size), heading = "\n$Nodes";
  const auto start = all.find(heading);
  if (!all.starts_with("$MeshFormat") || start == std::string_view::npos) return 0;
  const auto version = all.find_first_not_of("\r\n", std::strlen("$MeshFormat"));
  if (all.substr(version, 4) != "2.2 ") return 0;
  const auto number = all.find_first_not_of(" \r\n", start + heading.size());
  if (number == std::string_view::npos) return 0;
  std::uint64_t n = 0;
  std::from_chars(all.data() + number, all.data() + size, n);
  return n;
}

}  // namespace rondo::reader
