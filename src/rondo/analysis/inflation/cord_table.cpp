// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/inflation/cord_table.hpp"

#include <fmt/format.h>

#include "rondo/core/contract.hpp"
#include "rondo/io/files.hpp"

namespace rondo::study {
namespace {

using Places = std::vector<fem::finite::SectorEnergy::CordPlace>;

/// A point along the edge: the mean of those before and behind the middle of the sector, which are
/// alike but for the bend of the face.
std::string row_of(const std::string& curve, const Places& at_rest, const Places& now,
                   std::size_t first, std::size_t second) {
  const auto mean = [&](const Places& of, auto value) {
    return 0.5 * (value(of[first]) + value(of[second]));
  };
  const auto angle = [](const auto& p) { return p.angle; };
  return fmt::format("{},{},{},{},{},{},{}\n", curve,
                     mean(now, [](const auto& p) { return norm(p.place.plane()); }),
                     mean(now, [](const auto& p) { return p.place.z; }), mean(at_rest, angle),
                     mean(now, angle), mean(now, [](const auto& p) { return p.state.stretch; }),
                     mean(now, [](const auto& p) { return p.state.force; }));
}

}  // namespace

void write_cords(const std::filesystem::path& directory, const InflatedWheel& wheel,
                 const statics::Inflation& now) {
  const auto& layers = wheel.energy().section().cords;
  if (layers.empty()) return;
  const std::vector<Vec3> none(now.u.size());
  std::string text = "curve,r_m,z_m,angle_rad,angle_inflated_rad,stretch,force_n\n";
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Places at_rest = wheel.energy().cords(k, none), deformed = wheel.energy().cords(k, now.u);
    RONDO_DEMAND(deformed.size() == 4 * layers[k].lines.size(), deformed.size());
    for (std::size_t e = 0; e < deformed.size(); e += 4)
      for (const std::size_t along : {0UL, 1UL})  // 0 and 3 are side by side, as are 1 and 2
        text += row_of(layers[k].name, at_rest, deformed, e + along, e + 3 - along);
  }
  io::write_file(directory / "cords.csv", text);
}

}  // namespace rondo::study
