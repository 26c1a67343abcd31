// SPDX-License-Identifier: BSD-3-Clause
/// The ground's profile of a CSV file, by way of a case that names it: what is read is written into
/// the case as run and read again to the same text.
#include <cmath>

#include "fuzz.hpp"
#include "mutate.hpp"
#include "rondo/case/case.hpp"
#include "rondo/case/ground/profile_file.hpp"

using namespace rondo;

namespace {

constexpr const char* case_text =
    "schema = 1\n[disk]\nouter_radius = 0.3\ninner_radius = 0.15\n[disk.mesh]\nradial = 2\n"
    "circumferential = 8\n[material]\nyoungs_modulus = 2e7\npoissons_ratio = 0.3\ndensity = 1100\n"
    "[motion]\nangular_velocity = 1\nspeed = 0.3\nheight = 0.3\n[ground]\nprofile = \"road.csv\"\n"
    "[time]\nend = 0.01\n";

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  return fuzz::mutate_text(data, size, max, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::view(data, size);
  const study::ProfileFile found = study::parse_profile("road.csv", text);
  fuzz::check(found.faults.empty() == (found.points.size() >= 2), "neither points nor a fault");
  fuzz::check(found.lines.size() == found.points.size(), "points without a line");
  for (const Vec2 p : found.points) fuzz::check(fuzz::is_finite(p), "a point that is not finite");
  const auto& folder = fuzz::scratch_folder();
  fuzz::put(folder / "road.csv", text);
  study::Case c;
  if (!fuzz::accepted([&] { c = study::read_case_text(folder / "case.toml", case_text); }))
    return 0;
  fuzz::check(c.ground->shape.profile == found.points, "other points in the case");
  const std::string written = study::write_case(c);
  fuzz::check(study::write_case(study::read_case_text("case.toml", written)) == written,
              "another case after writing:\n" + written);
  return 0;
}
