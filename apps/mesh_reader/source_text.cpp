// SPDX-License-Identifier: BSD-3-Clause
#include "source_text.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

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

}  // namespace rondo::reader
