// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/tyre/inflation_members.hpp"

#include <fmt/format.h>

namespace rondo::study {
namespace {

constexpr JsonMember<CordFigures> cord_rows[] = {
    {"curve", "string", "", "Curve of the layer",
     [](const CordFigures& f) -> Json { return f.curve; }},
    {"force_min_n", "number", "", "Smallest force of a cord [N]; below 0: it is compressed",
     [](const CordFigures& f) -> Json { return f.force_min; }},
    {"force_max_n", "number", "", "Largest force of a cord [N]",
     [](const CordFigures& f) -> Json { return f.force_max; }},
    {"stretch_min", "number", "", "Smallest stretch of a cord",
     [](const CordFigures& f) -> Json { return f.stretch_min; }},
    {"stretch_max", "number", "", "Largest stretch of a cord",
     [](const CordFigures& f) -> Json { return f.stretch_max; }},
};
using F = InflationFigures;
constexpr JsonMember<F> rows[] = {
    {"share", "number", "", "Share of pressure, spin and mounting that was reached; 1: all",
     [](const F& f) -> Json { return f.share; }},
    {"pressure_pa", "number", "Pa", "Pressure of the air",
     [](const F& f) -> Json { return f.pressure; }},
    {"spin_rad_s", "number", "rad/s", "Spin of the equilibrium",
     [](const F& f) -> Json { return f.spin; }},
    {"mass_kg", "number", "kg", "Mass of rubber and cords of the whole wheel",
     [](const F& f) -> Json { return f.mass; }},
    {"outer_radius_m", "number", "m",
     "Largest distance from the axle, of `section.contact`, else of all nodes",
     [](const F& f) -> Json { return f.outer_radius; }},
    {"growth_m", "number", "m", "`outer_radius_m` less that of the undeformed section",
     [](const F& f) -> Json { return f.growth; }},
    {"width_m", "number", "m", "Width along the axle", [](const F& f) -> Json { return f.width; }},
    {"twist_m", "number", "m", "Largest displacement around the axle",
     [](const F& f) -> Json { return f.twist; }},
    {"cavity_volume_m3", "number or null", "m³",
     "Volume between `inflation.curve` and the ring that joins its ends; null: it has not two ends",
     [](const F& f) -> Json { return f.cavity ? Json(*f.cavity) : Json(); }},
    {"det_f_min", "number", "", "Smallest det F at a point of the rubber",
     [](const F& f) -> Json { return f.det_f_min; }},
    {"stretch_max", "number", "", "Largest principal stretch at a point of the rubber",
     [](const F& f) -> Json { return f.stretch_max; }},
    {"newton_iterations", "integer", "", "Iterations of Newton's method, of all steps",
     [](const F& f) -> Json { return f.newton_iterations; }},
    {"residual", "number", "",
     "Largest force at a free node over the largest reaction or load, after the last step",
     [](const F& f) -> Json { return f.residual; }},
    {"cords", "array", "", "The layers of cords, in the order of the case",
     [](const F& f) -> Json { return objects_of(cord_rows, std::span(f.cords)); },
     [] { return texts_of(cord_rows); }},
};
constexpr JsonMember<F> outer_rows[] = {
    {"inflation", "object", "", "The equilibrium of a wheel with [inflation]",
     [](const F& f) -> Json { return object_of(rows, f); }, [] { return texts_of(rows); }},
};

}  // namespace

void add_inflation(const InflationFigures& figures, Json& json) {
  add_members(outer_rows, figures, json);
}

std::vector<MemberText> inflated_members() {
  return texts_of(outer_rows);
}

std::vector<Told> told_of(const InflationFigures& f) {
  std::vector<Told> told{
      {"inflated", fmt::format("radius {:.6g} m ({:+.3g} mm), width {:.6g} m, mass {:.4g} kg",
                               f.outer_radius, 1e3 * f.growth, f.width, f.mass)},
      {"largest stretch", fmt::format("{:.4g} of the rubber", f.stretch_max)}};
  for (const CordFigures& cords : f.cords)
    told.emplace_back(fmt::format("cords \"{}\"", cords.curve),
                      fmt::format("{:.4g} to {:.4g} N", cords.force_min, cords.force_max));
  return told;
}

}  // namespace rondo::study
