// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/files/regular_file.hpp"

#include <system_error>

#include "rondo/core/error.hpp"

namespace rondo {

std::string kind_of_no_file(const std::filesystem::path& file) {
  using Type = std::filesystem::file_type;
  std::error_code error;
  switch (std::filesystem::status(file, error).type()) {
    case Type::fifo:
      return "a FIFO";
    case Type::directory:
      return "a directory";
    case Type::socket:
      return "a socket";
    case Type::block:
    case Type::character:
      return "a device";
    default:
      return {};
  }
}

void demand_regular_file(const std::filesystem::path& file) {
  const std::string kind = kind_of_no_file(file);
  if (!kind.empty()) throw FileError(file.string(), "is " + kind + ", not a regular file");
}

}  // namespace rondo
