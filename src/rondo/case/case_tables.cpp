// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_keys.hpp"

namespace rondo::study {
namespace {

std::size_t one(const Case& /*c*/) {
  return 1;
}
std::size_t with_disk(const Case& c) {
  return is_generated(c) ? 1 : 0;
}

std::size_t with_rim(const Case& c) {
  return c.rim ? 1 : 0;
}

std::size_t with_ground(const Case& c) {
  return c.ground ? 1 : 0;
}

std::size_t with_inflation(const Case& c) {
  return c.inflation ? 1 : 0;
}

std::size_t with_hati(const Case& c) {
  return c.hati ? 1 : 0;
}

template <class T>
void set_there(std::optional<T>& part, std::size_t n) {
  part.reset();
  if (n > 0) part.emplace();
}

constexpr CaseTable tables[] = {
    {"", one, nullptr},
    {"disk", with_disk, nullptr},
    {"disk.mesh", with_disk, nullptr},
    {"disk.tread",
     [](const Case& c) -> std::size_t { return is_generated(c) && c.disk.tread ? 1 : 0; },
     [](Case& c, std::size_t n) { set_there(c.disk.tread, n); }},
    {"mesh", [](const Case& c) -> std::size_t { return c.mesh ? 1 : 0; },
     [](Case& c, std::size_t n) { set_there(c.mesh, n); }},
    {"section", [](const Case& c) -> std::size_t { return c.section ? 1 : 0; },
     [](Case& c, std::size_t n) { set_there(c.section, n); }},
    {"material", one, nullptr},
    {"material.viscosity[]", [](const Case& c) { return c.law.viscosity.size(); },
     [](Case& c, std::size_t n) { c.law.viscosity.resize(n); }},
    {"material.region[]", [](const Case& c) { return c.regions.size(); },
     [](Case& c, std::size_t n) {
       c.regions.resize(n, {{}, {}, c.material, c.law});
     }},
    {"cords[]", [](const Case& c) { return c.cords.size(); },
     [](Case& c, std::size_t n) { c.cords.resize(n); }},
    {"inflation", with_inflation, [](Case& c, std::size_t n) { set_there(c.inflation, n); }},
    {"inflation.mounting[]",
     [](const Case& c) { return c.inflation ? c.inflation->mounting.size() : 0; },
     [](Case& c, std::size_t n) {
       if (c.inflation) c.inflation->mounting.resize(n);
     }},
    {"damping", one, nullptr, in_motion},
    {"motion", one, nullptr},
    {"rim", with_rim, [](Case& c, std::size_t n) { set_there(c.rim, n); }, in_time_untold},
    {"rim.support.x", with_rim, nullptr, in_time_untold},
    {"rim.support.y", with_rim, nullptr, in_time_untold},
    {"ground", with_ground, [](Case& c, std::size_t n) { set_there(c.ground, n); }},
    {"ground.obstacle[]",
     [](const Case& c) -> std::size_t { return c.ground ? c.ground->obstacles.size() : 0; },
     [](Case& c, std::size_t n) {
       if (c.ground) c.ground->obstacles.resize(n);
     }},
    {"ground.friction", with_ground, nullptr},
    {"ground.patch[]",
     [](const Case& c) -> std::size_t { return c.ground ? c.ground->friction.patches.size() : 0; },
     [](Case& c, std::size_t n) {
       if (c.ground) c.ground->friction.patches.resize(n);
     }},
    {"contact", one, nullptr, in_time_untold},
    {"load.pressure[]", [](const Case& c) { return c.pressures.size(); },
     [](Case& c, std::size_t n) { c.pressures.resize(n); }, in_motion_untold},
    {"initial", one, nullptr, in_time},
    {"initial.region[]", [](const Case& c) { return c.initial.regions.size(); },
     [](Case& c, std::size_t n) {
       c.initial.regions.resize(n, {{}, c.initial.velocity, c.initial.angular_velocity});
     },
     in_time_untold},
    {"analysis", one, nullptr},
    {"time", one, nullptr, in_time},
    {"solver", one, nullptr},
    {"solver.implicit[]", [](const Case& c) { return c.implicit.size(); },
     [](Case& c, std::size_t n) { c.implicit.resize(n); }, in_time},
    {"solver.hati", with_hati, [](Case& c, std::size_t n) { set_there(c.hati, n); }, in_time},
    {"solver.hati.fine", with_hati, nullptr, in_time_untold},
    {"output", one, nullptr},
    {"output.probe[]", [](const Case& c) { return c.output.probes.size(); },
     [](Case& c, std::size_t n) { c.output.probes.resize(n); }, in_time},
};

}  // namespace

std::span<const CaseTable> case_tables() noexcept {
  return tables;
}

}  // namespace rondo::study
