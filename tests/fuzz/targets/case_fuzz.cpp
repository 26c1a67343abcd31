// SPDX-License-Identifier: BSD-3-Clause
/// A case file and --set: read, written with all defaults, read again: the second writing is the
/// same text.
#include "case_input.hpp"
#include "mutate.hpp"

using namespace rondo;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  return fuzz::mutate_text(data, size, max, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::view(data, size);
  study::Case c;
  if (!fuzz::accepted([&] { c = fuzz::read_case_input(text, fuzz::scratch_folder()); })) return 0;
  const std::string written = study::write_case(c);
  const study::Case again = study::read_case_text("case.toml", written);
  fuzz::check(study::write_case(again) == written, "another case after writing:\n" + written);
  return 0;
}
