// SPDX-License-Identifier: BSD-3-Clause
#include "location.hpp"

#include <algorithm>
#include <charconv>

#include "rondo/core/error.hpp"

namespace rondo::fmu {
namespace {

InputError location_error(const std::string& uri, const std::string& message) {
  return request_error("fmuResourceLocation", uri, message,
                       "the folder \"resources\" of the unpacked FMU as file:///folder/resources, "
                       "each of its bytes as it is or as % and two hexadecimal digits");
}

}  // namespace

std::filesystem::path folder_of(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string::npos || uri.find('/') < colon) return uri;
  if (uri.compare(0, colon, "file") != 0)
    throw location_error(uri, "is of another scheme than file");
  std::string text = uri.substr(colon + 1), path;
  if (text.rfind("//", 0) == 0) {
    const std::string host = text.substr(2, text.find('/', 2) - 2);
    if (!host.empty() && host != "localhost")
      throw location_error(uri, "is on another machine, \"" + host + "\"");
    text.erase(0, 2 + host.size());
  }
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '%') {
      path += text[k];
      continue;
    }
    unsigned code = 0;
    const char* const digits = text.data() + k + 1;
    const char* const end = digits + std::min<std::size_t>(2, text.size() - k - 1);
    if (std::from_chars(digits, end, code, 16).ptr != digits + 2 || code == 0)
      throw location_error(uri, "has \"" + text.substr(k, 3) + "\", which codes no byte of a path");
    path += static_cast<char>(code);
    k += 2;
  }
  return path;
}

}  // namespace rondo::fmu
