// SPDX-License-Identifier: BSD-3-Clause
/// @file  Faults within the HDF5 library on damaged bytes are known and none of ours
/// (docs/reliability.md): where the address sanitizer reports one of a call that came through that
/// library, the process ends with the code 0 and libFuzzer (-fork) starts another. To be included
/// by one source of a target.
#pragma once
#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <string_view>

/// The address sanitizer calls it before it reports.
extern "C" void __asan_on_error() {
  std::array<void*, 64> frames{};
  const int n = backtrace(frames.data(), static_cast<int>(frames.size()));
  for (int k = 0; k < n; ++k) {
    Dl_info info{};
    if (dladdr(frames[static_cast<std::size_t>(k)], &info) == 0 || info.dli_fname == nullptr ||
        std::strstr(info.dli_fname, "libhdf5") == nullptr)
      continue;
    constexpr std::string_view said = "fault within the HDF5 library\n";
    static_cast<void>(!write(STDERR_FILENO, said.data(), said.size()));
    _exit(0);
  }
}
