// SPDX-License-Identifier: BSD-3-Clause
/// The bytes of results.h5, which the HDF5 library reads first. Input: "P" and patches (mutate.hpp)
/// of the results.h5 of a small run, or the bytes of such a file. A fault within the library is
/// known and none of ours (docs/reliability.md): it ends this process, and nothing is said; so the
/// target runs as jobs of libFuzzer (-fork).
#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "fuzz.hpp"
#include "mutate.hpp"
#include "results_checks.hpp"
#include "tiny_run.hpp"

using namespace rondo;
namespace fs = std::filesystem;

namespace {

constexpr char patch_mark = 'P';
constexpr std::size_t mark_length = 8;  ///< of HDF5's mark, without which nothing is read

const fs::path& folder() {
  static const fs::path path = fuzz::scratch_folder() / "run";
  return path;
}

const std::string& base() {
  static const std::string bytes = fuzz::text_of(folder() / "results.h5");
  return bytes;
}

}  // namespace

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

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  if (fuzz::view(data, size).starts_with(patch_mark))
    return 1 + fuzz::mutate_patches(data + 1, size - 1, max - 1, seed, base());
  return fuzz::mutate_in_place(data, size, seed, mark_length);
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  fuzz::make_tiny_run(folder());
  return base().empty() ? 1 : 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = fuzz::view(data, size);
  const bool patches = bytes.starts_with(patch_mark);
  fuzz::put(folder() / "results.h5",
            patches ? fuzz::patched(base(), bytes.substr(1)) : std::string(bytes));
  fuzz::check_results(folder(), fuzz::hash(bytes));
  return 0;
}
