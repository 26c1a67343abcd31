// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/scheme_power.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rondo::study {
namespace {

std::string found(const Case& c, const statics::RollingPower& p) {
  const char* unit = is_solid(c) ? "W" : "W/m";
  return fmt::format(
      "the discretisation {} a power of {:.4g} {}, {:.3g} % of the largest of drive ({:.4g}), "
      "damping ({:.4g}) and friction ({:.4g} {})",
      p.scheme > 0.0 ? "makes" : "takes", std::abs(p.scheme), unit, 100.0 * p.scheme_share, p.drive,
      p.damping(), p.friction, unit);
}

/// What resolves the slip of the nodes better.
std::string cure(const Case& c) {
  std::string text = fmt::format("another analysis.samples_per_sector than {}, more first; ",
                                 c.analysis.samples_per_sector);
  if (c.analysis.slip == RollingSlip::upwind) text += "analysis.slip = \"bdf2\"; ";
  const char* finer = c.section      ? "more section.sectors"
                      : c.disk.tread ? "a finer disk.tread"
                                     : "more disk.mesh.circumferential";
  return text + finer;
}

}  // namespace

std::string scheme_trouble(const Case& c, const statics::RollingPower& p) {
  const bool much =
      p.scheme_share > scheme_share_bound && p.scheme_over_load > scheme_over_load_bound;
  if (c.analysis.accept_scheme_power || !much) return {};
  return fmt::format(
      "{} (bound {:.0f} %): rolling resistance is not that of the body, and forces may be wrong by "
      "as much; {}; or analysis.accept_scheme_power = true where powers do not matter",
      found(c, p), 100.0 * scheme_share_bound, cure(c));
}

std::string scheme_warning(const Case& c, const statics::RollingPower& p) {
  if (!(p.scheme_share > scheme_share_told)) return {};
  return fmt::format("{}: rolling resistance is wrong by about that much; {}", found(c, p),
                     cure(c));
}

}  // namespace rondo::study
