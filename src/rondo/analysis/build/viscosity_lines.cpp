// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/viscosity_lines.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "rondo/fem/viscosity.hpp"

namespace rondo::study {
namespace {

/// "tan δ 0.14 and stiffness 1.2 at 1 Hz, ...".
std::string at_frequencies(const std::vector<fem::ViscousBranch>& branches,
                           const std::vector<double>& frequencies) {
  std::string text;
  for (const double frequency : frequencies) {
    const double omega = 2.0 * std::numbers::pi * frequency;
    text += fmt::format("{}{:.3g} and {:.3g} at {:.4g} Hz", text.empty() ? "" : ", ",
                        fem::loss_factor(branches, omega),
                        1.0 + fem::branch_modulus(branches, omega).real(), frequency);
  }
  return "tan δ and stiffness over that of slow strains: " + text;
}

Told line_of(const std::string& name, const MaterialLaw& law, const fem::Material& m) {
  const std::vector<fem::ViscousBranch>& branches = fem::branches_of(m);
  const std::string of = name.empty() ? std::string() : fmt::format("of \"{}\": ", name);
  if (law.loss_factor == 0.0)
    return {"viscosity", of + at_frequencies(branches, {1.0, 10.0, 100.0, 1000.0})};
  const auto [low, high] = law.loss_band;
  return {
      "viscosity",
      fmt::format("{}{} branches, tan δ within {:.2g} % of {:.4g} from {:.4g} to {:.4g} Hz; {}", of,
                  branches.size(), 100.0 * fem::fit_error(branches, law.loss_factor, {low, high}),
                  law.loss_factor, low, high,
                  at_frequencies(branches, {low, std::sqrt(low * high), high}))};
}

}  // namespace

std::vector<Told> viscosity_lines(const Case& c) {
  std::vector<Told> lines;
  const auto add = [&](const std::string& name, const MaterialLaw& law, const fem::Material& m) {
    const bool told_as_rubber = has_rubber(c) && law.loss_factor == 0.0;
    if (!fem::branches_of(m).empty() && !told_as_rubber) lines.push_back(line_of(name, law, m));
  };
  add("", c.law, c.material);
  for (const MaterialRegion& region : c.regions) {
    const bool inherited = region.law.model == c.law.model &&
                           region.law.viscosity == c.law.viscosity &&
                           region.law.loss_factor == c.law.loss_factor;
    if (inherited) continue;
    add(is_generated(c) ? fmt::format("layers {}", fmt::join(region.layers, ", ")) : region.surface,
        region.law, region.material);
  }
  return lines;
}

}  // namespace rondo::study
