// SPDX-License-Identifier: BSD-3-Clause
/// A results directory: all its fields, and a POD of them. Input: "E" and edits
/// (edited_results.hpp) of the results.h5 of a small run, or else the text of its run.json.
#include "edited_results.hpp"
#include "fuzz.hpp"
#include "mutate.hpp"
#include "results_checks.hpp"
#include "tiny_run.hpp"

using namespace rondo;
namespace fs = std::filesystem;

namespace {

constexpr char edits_mark = 'E';

const fs::path& folder() {
  static const fs::path path = fuzz::scratch_folder() / "base";
  return path;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  if (!fuzz::view(data, size).starts_with(edits_mark))
    return fuzz::mutate_text(data, size, max, seed);
  return 1 + fuzz::mutate_records(data + 1, size - 1, max - 1, seed, fuzz::edit_size);
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  fuzz::make_tiny_run(folder());
  fs::create_directories(fuzz::scratch_folder() / "run");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string summary = fuzz::text_of(folder() / "run.json");
  const std::string_view bytes = fuzz::view(data, size);
  const bool edits = bytes.starts_with(edits_mark);
  const fs::path run = fuzz::scratch_folder() / "run";
  fuzz::write_edited(folder() / "results.h5", run / "results.h5", edits ? bytes.substr(1) : "");
  fuzz::put(run / "run.json", edits ? std::string_view(summary) : bytes);
  fuzz::check_results(run, fuzz::hash(bytes));
  return 0;
}
