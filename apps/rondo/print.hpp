// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace rondo::app {

/// Prints at once. What cannot be printed is left out: a terminal that is gone ends no run.
inline void print(std::FILE* out, const std::string& text) {
  std::fputs(text.c_str(), out);
  std::fflush(out);
}

}  // namespace rondo::app
