// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/modes/modes_output.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <tuple>

#include "rondo/analysis/base/shared_members.hpp"

namespace rondo::study {
namespace {

using modal::Wave;

std::string diameters_text(int n) {
  return n < 0 ? std::string() : fmt::to_string(n);
}

/// The frequency in the fixed frame of a wave that travels with or against the spin (8.7).
double in_fixed_frame(const ModeLine& m, Wave wave) {
  const double turn = m.diameters * std::abs(m.angular_velocity);
  if (wave == Wave::backward) return std::abs(m.omega - turn);
  return wave == Wave::forward ? m.omega + turn : m.omega;
}

Json summary_of(const SpinSummary& s) {
  Json j;
  j["spin_rad_s"] = s.angular_velocity;
  j["modes"] = s.modes;
  j["rigid_body_motions"] = s.rigid;
  j["counted"] = s.counted;
  j["krylov_dimension"] = s.dimension;
  if (s.unstable > 0) j["unstable"] = s.unstable;
  if (s.growth > 0.0) j["rotation_growth"] = s.growth;
  return j;
}

constexpr JsonMember<std::size_t> spins_rows[] = {
    {"spins", "integer", "", "Spins that were asked for, those of a sweep included",
     [](const std::size_t& n) -> Json { return n; }},
};
constexpr JsonMember<ModesReport> modes_end_rows[] = {
    {"spins_done", "integer", "", "Spins whose modes were found",
     [](const ModesReport& r) -> Json { return r.spins.size() + r.sweep.size(); }},
    {"residual_max", "number", "", "Largest residual of a mode",
     [](const ModesReport& r) -> Json { return r.residual_max; }},
};

}  // namespace

void describe_modes(const ModesReport& report, std::size_t spins, Json& json) {
  add_size(report.nodes, report.dofs, json);
  add_members(spins_rows, spins, json);
}

void summarise_modes(const ModesReport& report, Json& json) {
  add_members(modes_end_rows, report, json);
}

std::vector<MemberText> modes_members() {
  return joined({texts_of(spins_rows), texts_of(modes_end_rows)});
}

std::string name_of(Wave wave) {
  static constexpr std::array<const char*, 5> names{"", "standing", "forward", "backward", "rigid"};
  return names[static_cast<std::size_t>(wave)];
}

std::string modes_table(const std::vector<ModeLine>& modes) {
  std::string text =
      "mode,frequency_rad_s,frequency_hz,nodal_diameters,wave,spin_rad_s,residual,damping_ratio\n";
  int number = 0;
  for (const ModeLine& m : modes)
    text += fmt::format(
        "{},{},{},{},{},{},{},{}\n", ++number, m.omega, m.omega / (2.0 * std::numbers::pi),
        diameters_text(m.diameters), name_of(m.wave), m.angular_velocity, m.residual,
        std::isnan(m.damping_ratio) ? std::string() : fmt::to_string(m.damping_ratio));
  return text;
}

std::string critical_table(const ModesReport& report) {
  std::string text = "nodal_diameters,critical_spin_rad_s,rim_speed_m_s,residual\n";
  for (const modal::CriticalSpeed& c : report.critical)
    text +=
        fmt::format("{},{},{},{}\n", c.diameters, c.spin, c.spin * report.outer_radius, c.residual);
  return text;
}

std::string campbell_table(const std::vector<ModeLine>& modes, int n_sectors) {
  std::string text =
      "spin_rad_s,nodal_diameters,wave,order,frequency_rad_s,frequency_fixed_rad_s\n";
  std::map<std::tuple<double, int, Wave>, int> orders;
  for (const ModeLine& m : modes) {
    Wave wave = m.wave;
    if (m.angular_velocity == 0.0 && wave == Wave::standing && m.diameters > 0 &&
        2 * m.diameters < n_sectors) {
      const bool first =
          orders[{0.0, m.diameters, Wave::backward}] == orders[{0.0, m.diameters, Wave::forward}];
      wave = first ? Wave::backward : Wave::forward;
    }
    const int order = ++orders[{m.angular_velocity, m.diameters, wave}];
    text += fmt::format("{},{},{},{},{},{}\n", m.angular_velocity, diameters_text(m.diameters),
                        name_of(wave), order, m.omega,
                        m.diameters < 0 ? std::string() : fmt::to_string(in_fixed_frame(m, wave)));
  }
  return text;
}

Json modes_json(const Case& c, const ModesRequest& request, const ModesReport& r, const Json& run) {
  Json j;
  for (const char* key : {"status", "message"})
    if (run.contains(key)) j[key] = run[key];
  j["title"] = c.title;
  describe_program(j);
  j["nodes"] = r.nodes;
  j["dofs"] = r.dofs;
  j["count"] = request.count;
  j["stress_stiffening"] =
      c.stress_stiffening == StressStiffening::centrifugal ? "centrifugal" : "none";
  j["outer_radius"] = r.outer_radius;
  if (r.on_ground) {
    j["standing"]["height"] = r.on_ground->height;
    j["standing"]["load"] = r.on_ground->load;
    j["standing"]["nodes"] = r.on_ground->nodes;
  }
  for (const SpinSummary& s : r.spins) j["spins"].push_back(summary_of(s));
  for (const SpinSummary& s : r.sweep) j["sweep"].push_back(summary_of(s));
  j["residual_max"] = r.residual_max;
  j["wall_s"] = r.wall_s;
  j["peak_memory_bytes"] = peak_memory_bytes();
  return j;
}

}  // namespace rondo::study
