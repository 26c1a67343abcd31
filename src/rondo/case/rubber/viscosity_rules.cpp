// SPDX-License-Identifier: BSD-3-Clause
/// Where viscous branches of materials at small strain are understood (docs/rolling-resistance.md).
#include <fmt/format.h>

#include "rondo/case/case_rules.hpp"
#include "rondo/case/rubber/material.hpp"
#include "rondo/fem/viscosity.hpp"

namespace rondo::study {
namespace {

/// The key that makes a law viscous; empty: none.
std::string viscous_key(const MaterialLaw& law, const std::string& table, bool is_region) {
  if (law.loss_factor > 0.0) return table + ".loss_factor";
  if (law.viscosity.empty()) return {};
  return is_region ? table + ".viscosity" : item_of(table + ".viscosity", 0);
}

enum class Viscous { any, linear, by_factor };

/// The key of the first law of this kind.
std::string first_viscous(const Case& c, Viscous kind) {
  const auto find = [&](const MaterialLaw& law, const std::string& table, bool is_region) {
    const bool is_other = (kind == Viscous::linear && law.is_rubber()) ||
                          (kind == Viscous::by_factor && law.loss_factor == 0.0);
    return is_other ? std::string{} : viscous_key(law, table, is_region);
  };
  std::string key = find(c.law, "material", false);
  for (std::size_t k = 0; k < c.regions.size() && key.empty(); ++k)
    key = find(c.regions[k].law, item_of("material.region", k), true);
  return key;
}

/// Where the branches do not have the loss factor that they stand for.
void warn_of_fits(Case& c) {
  constexpr double most = 0.05;
  const auto look = [&](const std::string& table, const MaterialLaw& law, const fem::Material& m) {
    if (law.loss_factor == 0.0 || !has_band(law)) return;
    const auto [low, high] = law.loss_band;
    const double error = fem::fit_error(fem::branches_of(m), law.loss_factor, {low, high});
    if (error > most)
      c.warnings.push_back(
          fmt::format("{}.loss_factor: tan δ of the branches is within {:.2g} % of it only: a "
                      "smaller factor, or "
                      "a narrower material.loss_band than {:.4g} to {:.4g} Hz",
                      table, 100.0 * error, low, high));
  };
  look("material", c.law, c.material);
  for (std::size_t k = 0; k < c.regions.size(); ++k)
    if (c.regions[k].law.loss_factor != c.law.loss_factor)
      look(item_of("material.region", k), c.regions[k].law, c.regions[k].material);
}

}  // namespace

void check_viscosity(CaseValues& in, Case& c) {
  if (in.has("material.loss_band") && in.good({"material.loss_factor"}) &&
      !in.has("material.loss_factor") && first_viscous(c, Viscous::by_factor).empty())
    in.fault("material.loss_band", "is the band of a loss factor, and there is none",
             "material.loss_factor, or that of a region, beside it");
  if (!has_viscosity(c) || !in.good({"material.model"})) return;
  warn_of_fits(c);
  if (has_rubber(c)) {
    const std::string key = first_viscous(c, Viscous::linear);
    if (!key.empty())
      in.fault(key, "makes a linear material viscous in a body of rubber at finite strain",
               "none, or a law of rubber for this region too");
    return;
  }
  const std::string key = first_viscous(c, Viscous::any);
  if (c.analysis.kind == AnalysisKind::crush)
    c.warnings.push_back(key + " has no effect in a crush, which is of slow strains");
  if (c.analysis.kind == AnalysisKind::dynamic && c.initial.state == InitialState::steady_rolling)
    in.fault("initial.state",
             "a start in steady rolling does not know how far viscous branches have relaxed",
             "\"stationary\", and a run long enough to settle");
  if (c.analysis.kind == AnalysisKind::steady_rolling && c.inflation &&
      c.inflation->nonlinear != TyreMotion::linear)
    in.fault(key,
             "steady rolling with nonlinear forces (inflation.nonlinear) has no viscous branches",
             "inflation.nonlinear = \"none\"");
}

}  // namespace rondo::study
