// SPDX-License-Identifier: BSD-3-Clause
/// The bytes of results.h5, which the HDF5 library reads first. Input: "P" and patches (mutate.hpp)
/// of the results.h5 of a small run, or the bytes of such a file. Faults within the library end the
/// process (hdf5_faults.hpp).
#include "fuzz.hpp"
#include "hdf5_faults.hpp"
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
