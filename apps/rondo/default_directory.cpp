// SPDX-License-Identifier: BSD-3-Clause
#include "default_directory.hpp"

#include <spdlog/spdlog.h>

#include <system_error>

namespace rondo::app {

std::filesystem::path default_directory(const std::filesystem::path& input,
                                        std::string_view suffix) {
  std::filesystem::path name = input.filename();
  if (name.has_extension())
    name.replace_extension();
  else if (suffix.empty())
    suffix = ".results";
  return name += suffix;
}

std::filesystem::path resumed_directory(const std::filesystem::path& input,
                                        std::string_view record) {
  const std::filesystem::path here = default_directory(input);
  const std::filesystem::path before = input.parent_path() / here;
  std::error_code error;
  if (std::filesystem::exists(here / record, error) ||
      !std::filesystem::exists(before / record, error))
    return here;
  spdlog::warn(
      "{}: results are there, where earlier versions put them; -o {} to resume them "
      "without this warning, -o {} to begin in the working folder",
      before.string(), before.string(), here.string());
  return before;
}

}  // namespace rondo::app
