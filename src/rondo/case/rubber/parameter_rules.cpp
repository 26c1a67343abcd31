// SPDX-License-Identifier: BSD-3-Clause
/// Rules between the parameters of a material: exactly those of its model, and stable.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "rondo/case/case_rules.hpp"
#include "rondo/case/rubber/material.hpp"
#include "rondo/case/rubber/stable_range.hpp"

namespace rondo::study {
namespace {

using enum MaterialModel;

struct ModelWords {
  std::string_view name;
  std::string_view parameters;  ///< the list given for a parameter that is not in it
  std::string_view about;       ///< the parameter on which stability depends
};

constexpr const char* bulk = "bulk_modulus or poissons_ratio";
/// In the order of MaterialModel.
constexpr ModelWords models[] = {
    {"linear", "youngs_modulus, poissons_ratio", "youngs_modulus"},
    {"neo-hooke", "shear_modulus", "shear_modulus"},
    {"mooney-rivlin", "c10, c01", "c01"},
    {"yeoh", "c10, c20, c30", "c20"},
    {"ogden", "terms = [[mu, alpha], ...]", "terms"},
};

const ModelWords& words_of(MaterialModel model) {
  return models[static_cast<std::size_t>(model)];
}

std::string parameters_of(MaterialModel model) {
  const std::string_view own = words_of(model).parameters;
  return model == linear ? std::string(own) : fmt::format("{}, and {}", own, bulk);
}

/// A parameter and the models that use it.
struct Parameter {
  std::string_view leaf;
  std::array<bool, std::size(models)> of;
  bool is_needed = true;  ///< required by each of them
};

constexpr Parameter parameters[] = {
    {"youngs_modulus", {true, false, false, false, false}},
    {"shear_modulus", {false, true, false, false, false}},
    {"c10", {false, false, true, true, false}},
    {"c01", {false, false, true, false, false}},
    {"c20", {false, false, false, true, false}},
    {"c30", {false, false, false, true, false}},
    {"terms", {false, false, false, false, true}},
    {"bulk_modulus", {false, true, true, true, true}, false},
};

/// One of the tables that describe a material: [material] or one of its regions.
struct Described {
  std::string table;
  MaterialLaw& law;
  fem::Material& material;

  [[nodiscard]] std::string key(std::string_view leaf) const {
    return fmt::format("{}.{}", table, leaf);
  }
};

std::string models_with(const Parameter& parameter) {
  std::string said;
  for (std::size_t k = 0; k < std::size(models); ++k)
    if (parameter.of[k]) said += fmt::format("{}\"{}\"", said.empty() ? "" : ", ", models[k].name);
  return said;
}

std::string instead_of(const Parameter& parameter, MaterialModel model) {
  if (parameter.leaf == "c10" && model == neo_hooke)
    return "shear_modulus = 2 c10, or another model";
  return fmt::format("{} of \"{}\", or another model", parameters_of(model), words_of(model).name);
}

void refuse_of_others(CaseValues& in, const Described& d) {
  for (const Parameter& parameter : parameters) {
    std::string key = d.key(parameter.leaf);
    if (in.n_items(key) > 0) key = item_of(key, 0);
    const bool given = in.has(key) || in.has_table(key);
    if (!given || parameter.of[static_cast<std::size_t>(d.law.model)]) continue;
    in.fault(key,
             fmt::format("is a parameter of model = {}, but {}.model is \"{}\"",
                         models_with(parameter), d.table, words_of(d.law.model).name),
             instead_of(parameter, d.law.model));
  }
}

void check_quadrature(CaseValues& in, const Described& d) {
  const std::string key = d.key("integration");
  if (!in.good({key}) || !in.has(key)) return;
  if (d.law.is_rubber() && d.law.integration == Quadrature::full)
    in.fault(key, "locks, because rubber hardly changes its volume", "\"b-bar\" or \"one-point\"");
  if (!d.law.is_rubber() && d.law.integration == Quadrature::one_point)
    in.fault(key, "is for rubber, but the model is \"linear\"", "\"full\" or \"b-bar\"");
}

bool are_good(const CaseValues& in, const Described& d) {
  for (const Parameter& parameter : parameters)
    if (!in.good({d.key(parameter.leaf)})) return false;
  return in.good({d.key("poissons_ratio"), d.key("viscosity"), d.key("loss_factor")});
}

void check_branches(CaseValues& in, const Described& d) {
  const std::string key = d.key("viscosity");
  for (std::size_t k = 0; k < d.law.viscosity.size() && in.has(key); ++k) {
    const auto& [modulus, time] = d.law.viscosity[k];
    if (!(modulus > 0.0 && modulus <= most_relative_modulus && time > 0.0))
      in.fault_at_item(
          key, static_cast<int>(k),
          fmt::format("is no branch: a relative modulus above 0, at most {:.0e}, and a "
                      "time above 0",
                      most_relative_modulus));
  }
}

/// By branches or by a factor, for which the band is there.
void check_loss(CaseValues& in, const Described& d) {
  check_branches(in, d);
  const std::string factor = d.key("loss_factor");
  constexpr std::string_view band = "material.loss_band";
  if (d.law.loss_factor > 0.0 && !d.law.viscosity.empty() && in.has(factor))
    in.fault(factor, "is given together with viscosity: the branches follow from the loss factor",
             "one of loss_factor and viscosity");
  if (d.law.loss_factor > 0.0 && in.has(band) && in.good({band}) && !has_band(d.law))
    in.fault(
        band, "is no band of frequencies",
        fmt::format("[lowest, highest] in Hz, {:.0e} to {:.0e}, the highest at most {:.0e} times "
                    "the lowest, for example [5.0, 500.0]",
                    slowest_band, fastest_band, widest_band));
}

bool has_exponents(CaseValues& in, const Described& d) {
  for (std::size_t k = 0; k < d.law.terms.size(); ++k)
    if (d.law.terms[k][1] == 0.0)
      return in.fault_at_item(d.key("terms"), static_cast<int>(k),
                              "has the exponent 0, by which its modulus is divided"),
             false;
  return true;
}

/// κ must be at least that of ν = 0, at which the sides of a stretched body do not move, and not so
/// large that double precision cannot distinguish it from incompressible.
void check_volume(CaseValues& in, const Described& d, double mu) {
  constexpr double most = 1e7;  // shear moduli: 1 - 2ν is known to 1e-9
  const double kappa = d.material.rubber->bulk_modulus;
  const std::string key = d.key(d.law.bulk_modulus ? "bulk_modulus" : "poissons_ratio");
  if (kappa < 2.0 / 3.0 * mu * (1.0 - 1e-12))
    in.fault(
        key,
        fmt::format("makes the bulk modulus {:.4g} of the shear modulus of {:.6g} Pa: below 2/3 "
                    "Poisson's ratio is below 0, which no rubber has",
                    kappa / mu, mu),
        "bulk_modulus >= 2/3 of the shear modulus, poissons_ratio >= 0; 100 to 10,000 shear "
        "moduli or 0.495 to 0.49995 are usual");
  if (kappa > most * mu)
    in.fault(key,
             fmt::format("makes the bulk modulus {:.4g} times the shear modulus of {:.6g} Pa: "
                         "beyond {:.0e} double precision does not resolve it",
                         kappa / mu, mu, most),
             "100 to 10,000 shear moduli, or a Poisson's ratio of 0.495 to 0.49995: the step goes "
             "with the root");
}

/// Checks the three tests used to fit laws; a fitted law may be unstable far beyond its data.
void check_stability(CaseValues& in, const Described& d) {
  const double mu = shear_modulus_of(d.law);
  const std::string key = d.key(words_of(d.law.model).about);
  if (!(mu > 0.0) || !std::isfinite(mu))
    return in.fault(key, fmt::format("makes the shear modulus of small strain {:.6g} Pa", mu),
                    "parameters whose shear modulus is above 0: 2 (c10 + c01), 2 c10 or half the "
                    "sum of mu alpha");
  fill_material(d.law, d.material);
  if (!std::isfinite(d.material.rubber->bulk_modulus) || !std::isfinite(d.material.youngs_modulus))
    return in.fault(key, "makes the moduli exceed the range of floating-point numbers",
                    "moduli in Pa");
  check_volume(in, d, mu);
  const auto unstable = find_unstable(*d.material.rubber);
  if (!unstable) return;
  in.fault(key,
           fmt::format("the law is unstable: in {} tension and compression its nominal stress does "
                       "not rise with the stretch at {:.3g}",
                       unstable->test, unstable->stretch),
           fmt::format("parameters whose stress rises with the stretch from {} to {} in uniaxial, "
                       "equibiaxial and planar tests; a fit to data of that range",
                       least_stretch, largest_stretch));
}

void check_rubber_law(CaseValues& in, const Described& d) {
  if (in.has(d.key("bulk_modulus")) && in.has(d.key("poissons_ratio")))
    in.fault(d.key("bulk_modulus"),
             "is given together with poissons_ratio: one follows from the other",
             "one of bulk_modulus and poissons_ratio");
  if (are_good(in, d) && has_exponents(in, d)) check_stability(in, d);
}

void check_described(CaseValues& in, const Described& d) {
  refuse_of_others(in, d);
  check_quadrature(in, d);
  check_loss(in, d);
  if (d.law.is_rubber())
    check_rubber_law(in, d);
  else
    fill_material(d.law, d.material);
}

/// Missing parameters are those of [material] if that has the same model.
void complete_region(CaseValues& in, const Case& c, MaterialRegion& region, const Described& d) {
  MaterialLaw& law = region.law;
  const bool has_ratio = in.has(d.key("poissons_ratio")), has_bulk = in.has(d.key("bulk_modulus"));
  const bool same = law.model == c.law.model;
  law.loss_band = c.law.loss_band;
  // One of both takes the place of what [material] has.
  const bool has_branches = in.has(d.key("viscosity")), has_factor = in.has(d.key("loss_factor"));
  if (has_branches && !has_factor) law.loss_factor = 0.0;
  if (has_factor && !has_branches) law.viscosity.clear();
  if (!in.has(d.key("integration")))
    law.integration = same              ? c.law.integration
                      : law.is_rubber() ? Quadrature::b_bar
                                        : Quadrature::full;
  if (!has_bulk && (has_ratio || !same)) law.bulk_modulus.reset();
  if (same) return;
  if (!has_branches) law.viscosity.clear();
  if (!has_factor) law.loss_factor = 0.0;
  for (const Parameter& parameter : parameters)
    if (parameter.is_needed && parameter.of[static_cast<std::size_t>(law.model)] &&
        !in.has(d.key(parameter.leaf)))
      in.missing(d.key(parameter.leaf));
  if (!has_ratio && !has_bulk) in.missing(d.key("poissons_ratio"));
}

}  // namespace

void check_materials(CaseValues& in, Case& c) {
  if (!in.good({"material.model"})) return;
  const Described body{"material", c.law, c.material};
  if (c.law.is_rubber() && !in.has("material.integration")) c.law.integration = Quadrature::b_bar;
  check_described(in, body);
  for (std::size_t k = 0; k < c.regions.size(); ++k) {
    const Described part{item_of("material.region", k), c.regions[k].law, c.regions[k].material};
    if (!in.good({part.key("model")})) continue;
    complete_region(in, c, c.regions[k], part);
    check_described(in, part);
  }
}

}  // namespace rondo::study
