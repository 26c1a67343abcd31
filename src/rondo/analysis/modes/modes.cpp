// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/modes/modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/tyre/inflation_members.hpp"
#include "rondo/analysis/modes/modes_output.hpp"
#include "rondo/analysis/modes/modes_solver.hpp"
#include "rondo/analysis/run.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/index.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/mode_files.hpp"

namespace rondo::study {
namespace {

double outer_radius(const Case& c, const ModesBody& b) {
  if (is_generated(c) && !c.inflation) return c.disk.outer_radius;
  double radius = 0.0;
  for (const int node : b.mesh.boundary)
    radius = std::max(radius, norm(b.mesh.coordinates[at(node)]));
  return radius;
}

/// The spins of the modes whose shapes are kept: each once, in the order given.
std::vector<double> chosen_spins(const Case& c, const ModesBody& b, const ModesRequest& request) {
  std::vector<double> spins = request.spins;
  if (spins.empty()) {
    spins.push_back(0.0);
    if (b.free == 0 && !request.standing) spins.push_back(c.motion.angular_velocity.at(0.0));
  }
  std::vector<double> once;
  for (const double spin : spins)
    if (std::find(once.begin(), once.end(), spin) == once.end()) once.push_back(spin + 0.0);
  return once;
}

InputError bad_sweep(const ModesRequest& request) {
  return request_error("--spins", request.sweep, "is no sweep",
                       "FROM:TO:NUMBER in rad/s with NUMBER from 2 to 10000, e.g. 0:200:41");
}

std::vector<double> sweep_spins(const ModesRequest& request) {
  if (request.sweep.empty()) return {};
  std::array<double, 3> part{};
  const char* at = request.sweep.data();
  const char* const end = at + request.sweep.size();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [next, error] = std::from_chars(at, end, part[k]);
    const bool more = k < 2;
    if (error != std::errc() || (more ? next == end || *next != ':' : next != end))
      throw bad_sweep(request);
    at = next + (more ? 1 : 0);
  }
  const auto [from, to, number] = part;
  if (!(number >= 2.0) || number > 10000.0 || number != std::floor(number) ||
      !std::isfinite(from) || !std::isfinite(to) || from == to)
    throw bad_sweep(request);
  std::vector<double> spins;
  for (int k = 0; k < static_cast<int>(number); ++k)
    spins.push_back(from + (to - from) * k / (number - 1.0));
  return spins;
}

void check_standing(const Case& c, const ModesRequest& request, const std::vector<double>& spins) {
  if (!request.standing) return;
  if (!is_solid(c))
    throw request_error("--standing", "", "is for wheels in three dimensions",
                        "a case with [section] or disk.width; or no --standing");
  if (!request.sweep.empty() || std::ranges::any_of(spins, [](double s) { return s != 0.0; }))
    throw request_error("--standing", "", "a wheel that stands does not turn",
                        "--spin 0, or neither --spin nor --spins");
}

void check_path(const Case& c) {
  if (c.analysis.turn_slip != 0.0)
    throw case_error(c, "motion.turn_slip",
                     "modes are of a wheel whose axle stays where it is, without a path that turns",
                     "0; or `rondo run`, which finds the steady state of rolling along the path");
}

void check_spins(const Case& c, const ModesBody& b, const std::string& option,
                 const std::vector<double>& spins) {
  const std::size_t sector_dofs =
      b.cyclic() ? 2 * b.mesh.n_nodes() / static_cast<std::size_t>(b.mesh.n_sectors) : 0;
  for (const double spin : spins) {
    const std::string found = fmt::format("{}", spin);
    if (!(std::abs(spin) <= b.largest_frequency))
      throw request_error(option, found, "no spin of this body",
                          fmt::format("a number of at most the largest frequency, {:.4g} rad/s",
                                      b.largest_frequency));
    if (spin == 0.0 || b.free == 0) continue;
    if (!b.cyclic())
      throw request_error(
          option, found,
          fmt::format("{} of the bodies are free: they are computed at rest", b.free),
          "0; or a mesh whose bodies are all clamped");
    if (c.stress_stiffening != StressStiffening::none)
      throw case_error(c, "material.stress_stiffening",
                       "the stress of the spin is computed for bodies held at a rim only",
                       "\"none\" for a free disk that spins");
    if (sector_dofs > modal::most_dofs_of_free_sector)
      throw request_error(
          option, found,
          fmt::format("a sector of this free disk has {} degrees of freedom", sector_dofs),
          fmt::format("at most {} for a free disk that spins: fewer layers",
                      modal::most_dofs_of_free_sector));
  }
}

SpinSummary summarise_spin(double angular_velocity, const modal::Modes& found) {
  SpinSummary s;
  s.angular_velocity = angular_velocity;
  s.modes = static_cast<int>(found.modes.size());
  for (const modal::Mode& mode : found.modes) {
    s.rigid += mode.wave == modal::Wave::rigid ? 1 : 0;
    s.growth = std::max(s.growth, mode.growth);
  }
  s.unstable = found.unstable;
  s.dimension = found.dimension;
  s.counted = found.counted;
  return s;
}

void add_lines(double angular_velocity, const SolvedModes& s, ModesReport& report,
               std::vector<ModeLine>& lines) {
  for (std::size_t i = 0; i < s.found.modes.size(); ++i) {
    const modal::Mode& mode = s.found.modes[i];
    lines.push_back({angular_velocity, mode.omega, mode.diameters, mode.wave, s.residuals[i],
                     s.damping_ratios[i]});
    report.residual_max = std::max(report.residual_max, s.residuals[i]);
  }
}

/// At its largest; an estimate [B].
std::size_t memory_of(const ModesBody& body, const ModesRequest& request, std::size_t spins) {
  const std::size_t nodes = body.mesh.n_nodes(), dofs = body.components() * nodes;
  const auto at_once = static_cast<std::size_t>(request.count);
  // Complex shapes, kept and as they are written.
  const std::size_t bytes = mesh_memory(nodes) + (spins + 1) * at_once * dofs * 2 * sizeof(double);
  constexpr std::size_t spare = 50;  // vectors of the space beyond twice the modes
  if (request.standing) return bytes + (3 * at_once + 6 * spare) * dofs * sizeof(double);
  if (body.cyclic()) return bytes;  // what one sector has is small
  return bytes + stiffness_memory(nodes, body.wide_rows) + factor_memory(dofs, body.wide_rows) +
         (2 * at_once + spare) * dofs * sizeof(double);
}

/// Bytes of modes.h5: shapes, and what ParaView reads of them.
std::size_t shapes_on_disk(const ModesBody& body, const ModesRequest& request, std::size_t spins) {
  const std::size_t bytes_of_a_node =
      2 * body.components() * sizeof(double) + 2 * 3 * sizeof(float);
  return spins * static_cast<std::size_t>(request.count) * body.mesh.n_nodes() * bytes_of_a_node;
}

/// A spin after the other: first those whose shapes are kept, then those of the sweep. Its tables
/// hold what is found so far; it has no times, and so no history and no snapshots.
class ModesAnalysis final : public Analysis {
 public:
  ModesAnalysis(const Case& c, const ModesRequest& request)
      : case_(c),
        request_(request),
        body_(make_modes_body(c)),
        spins_(chosen_spins(c, body_, request)),
        sweep_(sweep_spins(request)) {
    check_path(c);
    check_standing(c, request, spins_);
    check_spins(c, body_, request.spins.empty() ? "motion.angular_velocity" : "--spin", spins_);
    check_spins(c, body_, "--spins", sweep_);
    demand_memory(c, body_.mesh.n_nodes(), memory_of(body_, request, spins_.size()));
    report_.directory = request.run.directory;
    report_.nodes = body_.mesh.n_nodes();
    report_.dofs = body_.components() * fem::free_nodes(body_.mesh).size();
    if (body_.cyclic()) report_.outer_radius = outer_radius(c, body_);
    solver_ = is_solid(c) ? solid_modes(c, body_, request.standing) : plane_modes(c, body_);
    report_.on_ground = solver_->standing();
  }

  [[nodiscard]] CheckReport check(double) override {
    CheckReport r;
    r.nodes = report_.nodes;
    r.elements = body_.mesh.n_elements();
    r.dofs = report_.dofs;
    r.steps = progress().all;
    r.memory_bytes = memory_of(body_, request_, spins_.size());
    r.disk_bytes = shapes_on_disk(body_, request_, spins_.size());
    return r;
  }
  [[nodiscard]] RecordPlan record_plan() const override {
    RecordPlan plan;
    plan.results.words.analysis = "modes";
    plan.own_bytes = shapes_on_disk(body_, request_, spins_.size());
    return plan;
  }
  [[nodiscard]] std::vector<std::string> warnings() const override { return body_.warnings; }
  void describe(Json& json) const override {
    describe_modes(report_, spins_.size() + sweep_.size(), json);
    if (body_.inflation) add_inflation(*body_.inflation, json);
  }

  Progress begin(Recorder&) override { return progress(); }
  Progress advance(Recorder&) override {
    const std::size_t at = report_.spins.size();
    if (at < spins_.size()) {
      solved_.push_back(solve(spins_[at]));
      report_.spins.push_back(summarise_spin(spins_[at], solved_.back().found));
      judge(report_.spins.back());
      add_lines(spins_[at], solved_.back(), report_, report_.modes);
      if (report_.spins.size() == spins_.size()) write_shapes();
    } else {
      const double spin = sweep_[report_.sweep.size()];
      const SolvedModes s = solve(spin);
      report_.sweep.push_back(summarise_spin(spin, s.found));
      judge(report_.sweep.back());
      add_lines(spin, s, report_, sweep_lines_);
    }
    write_tables();
    return progress();
  }
  [[nodiscard]] const std::optional<std::string>& trouble() const override { return trouble_; }
  void close() override {
    report_.critical = solver_->critical(request_.diameters);
    if (body_.cyclic() && !request_.standing)
      io::write_file(request_.run.directory / "critical-speeds.csv", critical_table(report_));
    warn_of_critical_spin();
    if (!wrong_ && !(report_.residual_max <= mode_residual_bound))
      wrong_ = fmt::format("a mode fulfils its equation to {:.1e} only, bound {:.0e}",
                           report_.residual_max, mode_residual_bound);
    trouble_ = wrong_;
    report_.wall_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - made_).count();
  }
  void summarise(Json& json, RunReport& r) const override {
    const Progress at = progress();
    if (wrong_) json["message"] = *wrong_;
    for (const std::string& warning : said_) json["warnings"].push_back(warning);
    io::write_json(request_.run.directory / "modes.json",
                   modes_json(case_, request_, report_, json));
    r.steps = at.done;
    r.reached = fmt::format("{} of {} spins", at.done, at.all);
    summarise_modes(report_, json);
  }

  [[nodiscard]] ModesReport take_report() { return std::move(report_); }

 private:
  [[nodiscard]] Progress progress() const noexcept {
    return {static_cast<long long>(report_.spins.size() + report_.sweep.size()),
            static_cast<long long>(spins_.size() + sweep_.size())};
  }
  void write_shapes() const {
    std::vector<io::SpinModes> shapes;
    for (std::size_t k = 0; k < solved_.size(); ++k)
      shapes.push_back({spins_[k], &solved_[k].found.modes});
    io::write_mode_shapes(request_.run.directory, body_.mesh, body_.mass, shapes);
  }
  void write_tables() const {
    const std::filesystem::path& directory = request_.run.directory;
    io::write_file(directory / "modes.csv", modes_table(report_.modes));
    if (sweep_.empty() && spins_.size() < 2) return;
    const std::vector<ModeLine>& campbell = sweep_.empty() ? report_.modes : sweep_lines_;
    io::write_file(directory / "campbell.csv", campbell_table(campbell, body_.mesh.n_sectors));
  }
  void say(const std::string& text) {
    give_warnings({text}, request_.run);
    said_.push_back(text);
  }
  [[nodiscard]] SolvedModes solve(double spin);
  void judge(const SpinSummary& s);
  void warn_of_critical_spin();

  const Case& case_;
  const ModesRequest& request_;
  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
  const ModesBody body_;
  const std::vector<double> spins_, sweep_;  ///< [rad/s]
  std::unique_ptr<ModesSolver> solver_;
  std::vector<SolvedModes> solved_;    ///< results of spins_
  std::vector<ModeLine> sweep_lines_;  ///< lines of sweep_
  ModesReport report_;
  std::vector<std::string> said_;     ///< warnings
  std::optional<std::string> wrong_;  ///< the first thing, which ends nothing but counts at the end
  std::optional<std::string> trouble_;
};

/// Nothing where an inflated wheel has no state at this spin.
SolvedModes ModesAnalysis::solve(double spin) {
  try {
    SolvedModes s = solver_->modes(spin, request_.count);
    if (s.overdamped > 0)
      say(
          fmt::format("at {} rad/s {} of the modes do not oscillate with the branches of the "
                      "material and [damping]: their rows are those of slow strains",
                      spin, s.overdamped));
    return s;
  } catch (const InputError& none) {
    if (!wrong_) wrong_ = fmt::format("at {} rad/s: {}", spin, none.what());
    return {};
  }
}

/// If the body of the case turns as fast as a wave that stands still in space.
void ModesAnalysis::warn_of_critical_spin() {
  if (report_.critical.empty() || body_.free > 0) return;
  const auto lowest = std::ranges::min_element(report_.critical, {}, &modal::CriticalSpeed::spin);
  const double spin = std::abs(case_.motion.angular_velocity.at(0.0));
  if (spin < lowest->spin) return;
  say(
      fmt::format("motion.angular_velocity: {:.6g} rad/s is above the critical speed {:.5g} rad/s "
                  "({} nodal diameters), at which a wave stands still in space: on the ground only "
                  "damping limits the deformation",
                  spin, lowest->spin, lowest->diameters));
}

/// Tells what went wrong, or less well than the user may think.
void ModesAnalysis::judge(const SpinSummary& s) {
  if (s.unstable > 0 && !wrong_)
    wrong_ = fmt::format(
        "at {} rad/s the softening by the spin exceeds the stiffness: K - s²M has {} negative "
        "eigenvalue{}. There is no stable state, and there are no modes; take a lower rotation "
        "speed",
        s.angular_velocity, s.unstable, s.unstable == 1 ? "" : "s");
  else if (s.unstable == 0 && s.modes > 0 && !s.counted)
    say(fmt::format("at {} rad/s the modes are not counted: some may be missing",
                    s.angular_velocity));
  if (s.growth > 1e-3 * std::abs(s.angular_velocity))
    say(fmt::format(
        "at {} rad/s the rotation of the free disk against its frame is not restrained: in this "
        "model without the stress of the spin it grows at {:.4g} 1/s",
        s.angular_velocity, s.growth));
}

}  // namespace

ModesReport run_modes(const Case& c, const ModesRequest& request) {
  ModesAnalysis analysis(c, request);
  const RunReport run = run_analysis(analysis, c, request.run);
  ModesReport report = analysis.take_report();
  report.run = run;
  return report;
}

}  // namespace rondo::study
