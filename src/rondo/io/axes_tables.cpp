// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/axes_tables.hpp"

#include <fmt/format.h>

#include <system_error>

#include "rondo/core/error.hpp"

namespace rondo::io {

void remove_axes_tables(const std::filesystem::path& directory, std::string_view table) {
  for (const std::string_view axes : axes_names)
    for (const char* ending : {"csv", "json"}) {
      const std::filesystem::path file = directory / fmt::format("{}-{}.{}", table, axes, ending);
      std::error_code error;
      std::filesystem::remove(file, error);
      if (error) throw FileError(file.string(), "cannot remove: " + error.message());
    }
}

}  // namespace rondo::io
