// SPDX-License-Identifier: BSD-3-Clause
/// @file  A case for every key, and another value for it, from the table of keys itself.
#pragma once
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "rondo/case/case_keys.hpp"
#include "unit/case/case_fixture.hpp"

namespace rondo::study::test {

/// Cases in which, together, every key is written.
inline const std::vector<Case>& cases_with_every_key() {
  static const std::vector<Case> cases = [] {
    const std::vector<std::string> crush{"analysis.kind=crush",   "analysis.depth=0.01",
                                         "analysis.increments=3", "analysis.slide=0.001",
                                         "ground.profile=flat",   "analysis.slide_increments=2"};
    std::vector<std::string> latin = crush;
    latin.emplace_back("analysis.solver=latin-pgd");
    const std::vector<std::string> probe{"output.probe=[{name = 'p', position = [0.2, 0.0]}]"},
        obstacle{"ground.profile=flat", "disk.width=2.0",
                 "ground.obstacle=[{kind = 'cleat', at = 2.0, height = 0.1, length = 0.3}]"},
        pressure{"load.pressure=[{curve = 'rim', value = 3}]",
                 "material.region=[{layers = [2, 3], density = 7800}]",
                 "solver.implicit=[{slower_than = 1e-6}]"},
        layers{"solver.implicit=[{layers = [1, 2]}]"},
        parts{"time.scheme=hati", "solver.hati.ratio=2", "solver.hati.fine.layers=[11, 12]"};
    const std::string bodies = R"(schema = 1
time.end = 0.2
[mesh]
file = "/folder/two.msh"
contact = "skin"
[material]
youngs_modulus = 5e6
poissons_ratio = 0.3
density = 1100
[[material.region]]
surface = "core"
[[initial.region]]
surface = "core"
)";
    const std::string part = R"(schema = 1
[mesh]
file = "/folder/two.msh"
clamped = "rim"
contact = "skin"
[material]
youngs_modulus = 5e6
poissons_ratio = 0.3
density = 1100
[motion]
angular_velocity = 3
speed = 1
height = 1
[time]
end = 0.2
scheme = "hati"
[solver.hati]
ratio = 3
fine = {region = "skin"}
)";
    const std::string held =
        part.substr(0, part.find("scheme")) + "[[solver.implicit]]\nregion = \"core\"\n";
    const std::vector<std::string> rim{"rim.free=['speed', 'height', 'angular_velocity']",
                                       "rim.mass=100", "rim.inertia=1", "motion.gravity=9.81"};
    const std::vector<std::string> steady{"analysis.kind=steady-rolling", "ground.profile=flat",
                                          "analysis.samples_per_sector=1", "analysis.inertia=waves",
                                          "analysis.estimate_slip_error=true"},
        loaded{"analysis.kind=steady-rolling", "ground.profile=flat", "analysis.load=1e5",
               "analysis.torque=100"},
        pulled{"analysis.kind=steady-rolling", "ground.profile=flat", "analysis.traction=100"};
    const std::vector<std::string> wheel{"disk.width=2.0", "disk.crown_radius=10.0",
                                         "disk.tread.circumferential_grooves=[[0.1, 0.2]]",
                                         "motion.slip_angle=0.1"};
    const std::vector<std::string> road{
        "disk.width=0.1", "ground.road=" RONDO_CASES "/roads/cobbles.crg",
        "ground.road_offset=0.05", "ground.road_border=zero", "ground.fillet=0"};
    std::vector<std::string> turning = steady, slipping = steady;
    turning.insert(turning.end(), {"disk.width=2.0", "motion.turn_slip=0.1", "analysis.slip=upwind",
                                   "analysis.slip_angle_step=0.01", "analysis.step_distance=2.0"});
    slipping.insert(slipping.end(),
                    {"disk.width=2.0", "analysis.slip=upwind", "analysis.slip_ratio_step=0.01",
                     "analysis.step_distance=2.0"});
    const std::string section = R"(schema = 1
[section]
file = "/folder/tyre.msh"
clamped = "rim"
contact = "tread"
[material]
youngs_modulus = 5e6
poissons_ratio = 0.3
density = 1100
[motion]
angular_velocity = 3
speed = 1
height = 1
[time]
end = 0.2
)";
    const std::string inflated = section.substr(0, section.find("youngs")) +
                                 "model = 'neo-hooke'\nshear_modulus = 1e6\n" +
                                 section.substr(section.find("poissons"));
    const std::string air =
        "inflation={curve = 'liner', pressure = 1e5, spin = 3, steps = 4, nonlinear = 'window', "
        "window = 0.5, "
        "mounting = [{curve = 'rim', axial = 1e-3, radial = 1e-4}]}";
    const std::vector<std::string> cords{
        air,
        "cords=[{curve = 'belt', angle = 0.4, stiffness = 1e3, spacing = 1e-3, spacing_radius = "
        "0.3, excess_mass = 1e-4, prestrain = 0.01, compression = 0.5}]"},
        lifted{air,
               "cords=[{curve = 'ply', angle = 1.5, youngs_modulus = 1e9, area = 1e-7, spacing = "
               "1e-3, density = 1200, green_radius = 0.2, green_extension = 0.1}]"};
    const std::string without_speed = with_line(20, "");
    const std::vector<std::string> viscous{
        "material.viscosity=[{relative_modulus = 0.5, time = 0.001}]",
        "material.region=[{layers = [2], model = 'linear', youngs_modulus = 1e9, "
        "poissons_ratio = 0.3, integration = 'full'}, {layers = [3], viscosity = [[0.2, 0.01]]}]"},
        of_rubber{"material.region=[{layers = [1], viscosity = [[0.2, 0.01], [0.1, 0.1]]}]"},
        lossy{"material.loss_factor=0.1", "material.loss_band=[1.0, 100.0]",
              "material.region=[{layers = [1], loss_factor = 0.2}]"},
        by_bulk{"material.region=[{layers = [1], bulk_modulus = 3e7, c10 = 1e5}]"};
    const std::vector<std::string> rubs{
        "ground.profile=flat",
        "ground.friction={coefficient = 0.9, slip_speed = [[0, 1], [0.5, 1.2]], pressure_exponent "
        "= -0.15, pressure_reference = 1e5}",
        "disk.width=2.0", "ground.patch=[{from = 1, to = 2, side = 'left', factor = 0.5}]"};
    return std::vector<Case>{
        read_text(base, probe),
        read_text(base, obstacle),
        read_text(treaded(), pressure),
        read_text(with_line(34, "step = 1e-6")),
        read_text(bodies),
        read_text(base, layers),
        read_text(base, parts),
        read_text(part),
        read_text(held),
        read_text(base, rim),
        read_text(base, steady),
        read_text(base, lossy),
        read_text(with_line(21, "", without_speed), loaded),
        read_text(without_speed, pulled),
        read_text(rubber("model = 'neo-hooke'\nshear_modulus = 1e6"), viscous),
        read_text(rubber("model = 'neo-hooke'\nshear_modulus = 1e6"), of_rubber),
        read_text(rubber("model = 'mooney-rivlin'\nc10 = 4e5\nc01 = 1e5"),
                  {"material.region=[{layers = [1], c01 = 2e5}]"}),
        read_text(rubber("model = 'yeoh'\nc10 = 5e5\nc20 = -2e4\nc30 = 1e4", "bulk_modulus = 1e8"),
                  by_bulk),
        read_text(rubber("model = 'ogden'\nterms = [[6.3e5, 1.3], [1.2e3, "
                         "5], [-1e4, -2]]"),
                  {"material.region=[{layers = [1]}]"}),
        read_text(treaded(), wheel),
        read_text(base, rubs),
        read_text(base, road),
        read_text(base, turning),
        read_text(base, slipping),
        read_text(section),
        read_text(inflated, cords),
        read_text(inflated, lifted),
        read_text(base, latin),
        read_text(base, crush)};
  }();
  return cases;
}

/// Of the keys of a table in a list some are left out for others.
inline bool is_given(const CaseKey& key, const Case& c) {
  Case fields = c;
  const CaseMember field = key.field(fields, 0);
  if (const auto* number = std::get_if<std::optional<double>*>(&field))
    return (*number)->has_value();
  if (const auto* numbers = std::get_if<std::vector<int>*>(&field)) return !(*numbers)->empty();
  const auto* text = std::get_if<std::string*>(&field);
  return !text || !(*text)->empty();
}

inline bool is_written(const CaseKey& key, const Case& c) {
  const CaseTable& table = table_with(key);
  return means_to(key, c.analysis.kind) && table.count(c) > 0 && counts(key, c, 0) &&
         (!table.is_list() || is_given(key, c));
}

/// The first case that writes the key. @throws std::runtime_error where none does
inline const Case& case_with(const CaseKey& key) {
  for (const Case& c : cases_with_every_key())
    if (is_written(key, c)) return c;
  throw std::runtime_error("no case of the tests has " + std::string(key.path));
}

/// Puts another value into a field: one that goes with the other keys of the cases above.
struct Change {
  const CaseKey& key;

  void operator()(int* value) const { *value = *value > 1 ? *value - 1 : *value + 4; }
  void operator()(double* value) const {
    const double less = *value == 0.0 ? 0.0625 : 0.9 * *value;
    *value = key.allowed.range.contains(less) ? less : 1.1 * *value;
  }
  void operator()(std::optional<double>* value) const { *value = 0.9 * value->value(); }
  void operator()(bool* value) const { *value = !*value; }
  void operator()(std::string* value) const {
    const auto& choices = key.allowed.choices;
    *value = key.allowed.is_choice() ? std::string(choices[*value == choices[0] ? 1 : 0])
                                     : *value + "-2";
  }
  void operator()(std::filesystem::path* value) const { *value = "/other/a \"b\".msh"; }
  void operator()(const Choice& value) const {
    value.set(value.target, value.get(value.target) == 0 ? 1 : 0);
  }
  void operator()(const ChoiceList& value) const { *value.among[1] = !*value.among[1]; }
  void operator()(Vec2* value) const { *value = {value->x + 0.1, value->y - 0.3}; }
  void operator()(Matrix* value) const { *value = {{{0.1, -2.0}, {1e-300, 0.7}}}; }
  void operator()(dynamics::Table* value) const {
    if (key.allowed.of_increments) {
      *value = dynamics::Table(0.9 * value->at(0.0));
      return;
    }
    const double high = key.allowed.range.contains(3.0) ? 3.0 : 0.25;
    *value = dynamics::Table({{-1.0, value->at(0.0) + 0.5}, {0.5, high}});
  }
  void operator()(std::vector<int>* value) const { *value = {3, 7}; }
  void operator()(std::vector<std::array<double, 2>>* value) const { *value = {{0.7, 1.3}}; }
  void operator()(std::vector<std::string>* value) const { *value = {"rim-2", "bead"}; }
  void operator()(std::vector<Vec2>* value) const { *value = {{-1.5, 0.25}, {2.0, 0.25}}; }
};

inline Case with_another_value(const CaseKey& key, Case c) {
  if (key.allowed.range.low == key.allowed.range.high) return c;  // schema: there is no other
  std::visit(Change{key}, key.field(c, 0));
  return c;
}

}  // namespace rondo::study::test
