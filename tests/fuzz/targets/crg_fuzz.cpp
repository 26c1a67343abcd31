// SPDX-License-Identifier: BSD-3-Clause
/// A road file of OpenCRG: what is read is a road whose two surfaces give numbers, the smooth one
/// between the corners of its cell, and lines that say so. Beside it is a sound file to refer to.
#include <algorithm>
#include <cmath>

#include "fuzz.hpp"
#include "mutate.hpp"
#include "rondo/road/crg/crg_reader.hpp"
#include "rondo/road/road_report.hpp"

using namespace rondo;
using namespace rondo::road;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  return fuzz::mutate_text(data, size, max, seed);
}

namespace {

constexpr const char* sound_file =
    "$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 1\nLONG_SECTION_V_INCREMENT = 1\n$\n$KD_Definition\n"
    "#:LRFI\nD:long section 1,m\nD:long section 2,m\n$\n$$$$\n 0.0000000 1.0000000\n 0.0000000 "
    "1.0000000\n";

void check_road(const Road& r) {
  fuzz::check(r.n_u() >= 2 && r.n_v() >= 2, "a road without cells");
  fuzz::check(r.heights.size() == r.n_u() * r.n_v() && r.line_height.size() == r.n_u(),
              "arrays that do not fit together");
  for (const auto* const values : {&r.slope, &r.banking, &r.heading})
    fuzz::check(values->size() == 1 || values->size() == r.n_u(), "a channel of another length");
  fuzz::check(std::ranges::is_sorted(r.v) && r.u_step > 0.0, "positions that do not ascend");
  fuzz::check(std::ranges::all_of(r.line_height, [](double z) { return std::isfinite(z); }),
              "a reference line that is nowhere");
}

/// Between the corners of its cell but for round-off.
void check_place(const Surface& surface, double u, double v) {
  const SurfacePoint smooth = surface.at(u, v);
  const double bilinear = surface.bilinear(u, v);
  fuzz::check(std::isfinite(bilinear), "no height");
  fuzz::check(std::isfinite(smooth.slope_u) && std::isfinite(smooth.slope_v), "no slope");
  const std::size_t i = surface.u_axis().locate(u).cell, j = surface.v_axis().locate(v).cell;
  const auto corners = {surface.height_at(i, j), surface.height_at(i + 1, j),
                        surface.height_at(i, j + 1), surface.height_at(i + 1, j + 1)};
  const double slack = 1e-13 * (std::abs(std::min(corners)) + std::abs(std::max(corners)));
  for (const double z : {smooth.height, bilinear})
    fuzz::check(z >= std::min(corners) - slack && z <= std::max(corners) + slack,
                "a surface that leaves its cell");
}

void check_surface(const Road& road, Border border) {
  const Surface surface(road, {.u = border, .v = border});
  for (const double s : {-0.3, 0.0, 0.1, 0.5, 0.77, 1.0, 2.6})
    for (const double t : {-1.4, 0.0, 0.2, 0.63, 1.0, 1.1})
      check_place(surface, road.u_first + s * (road.u_last() - road.u_first),
                  road.v.front() + t * (road.v.back() - road.v.front()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto file = fuzz::scratch_folder() / "road.crg";
  static const bool sound = (fuzz::put(fuzz::scratch_folder() / "other.crg", sound_file), true);
  fuzz::check(sound, "the file to refer to");
  fuzz::put(file, fuzz::view(data, size));
  Road road;
  if (!fuzz::accepted([&] { road = read_crg(file); })) return 0;
  check_road(road);
  for (const Border border : {Border::keep, Border::repeat, Border::reflect})
    check_surface(road, border);
  const Surface as_asked(road);
  for (const std::string& line : lines_of(road, report_of(road, as_asked), road.edges))
    fuzz::check(!line.empty(), "a line that says nothing");
  return 0;
}
