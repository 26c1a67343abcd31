// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/slip_error.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rondo::study {

SlipError slip_error_of(const statics::RollingForces& upwind,
                        const statics::RollingForces& bdf2) noexcept {
  const auto difference = [&](double statics::RollingForces::*of) { return upwind.*of - bdf2.*of; };
  using F = statics::RollingForces;
  SlipError e;
  e.difference = {difference(&F::normal), difference(&F::heading),  difference(&F::lateral),
                  difference(&F::torque), difference(&F::aligning), difference(&F::overturning)};
  const double mean =
      0.5 * std::hypot(upwind.heading + bdf2.heading, upwind.lateral + bdf2.lateral);
  e.share = std::hypot(e.difference.heading, e.difference.lateral) / mean;
  return e;
}

std::string slip_warning(const Case& c, const std::optional<SlipError>& found,
                         const statics::RollingForces& used) {
  constexpr double least_share_of_load = 1e-2;
  if (!c.analysis.estimate_slip_error) return {};
  const char* other = c.analysis.slip == RollingSlip::bdf2 ? "upwind" : "bdf2";
  if (!found)
    return fmt::format(
        "analysis.estimate_slip_error: the contact was not solved with analysis.slip = \"{}\": the "
        "error of the forces along the ground is not known",
        other);
  const bool has_force = std::hypot(used.heading, used.lateral) > least_share_of_load * used.normal;
  if (!has_force || found->share <= slip_error_told) return {};
  return fmt::format(
      "analysis.samples_per_sector = {}: the force along the ground differs by {:.3g} % between "
      "analysis.slip = \"upwind\" and \"bdf2\" (bound {:.0f} %); more samples, or more {}",
      c.analysis.samples_per_sector, 100.0 * found->share, 100.0 * slip_error_told,
      c.section ? "section.sectors" : "disk.mesh.circumferential");
}

}  // namespace rondo::study
