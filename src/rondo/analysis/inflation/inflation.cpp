// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/inflation/inflation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/base/shared_members.hpp"
#include "rondo/analysis/build/bodies.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/build/plausible/plausible.hpp"
#include "rondo/analysis/build/solid/wheel_mesh.hpp"
#include "rondo/analysis/build/tyre/inflation_members.hpp"
#include "rondo/analysis/inflation/cord_table.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

using F = InflationFigures;

double largest_force(const F& f) {
  double force = -1e300;
  for (const CordFigures& cords : f.cords) force = std::max(force, cords.force_max);
  return f.cords.empty() ? 0.0 : force;
}
double smallest_force(const F& f) {
  double force = 1e300;
  for (const CordFigures& cords : f.cords) force = std::min(force, cords.force_min);
  return f.cords.empty() ? 0.0 : force;
}

constexpr std::array columns{
    Column<F>{"load_share", "1", "of pressure, spin and mounting",
              [](const F& f) { return f.share; }},
    Column<F>{"pressure_pa", "Pa", "of the air", [](const F& f) { return f.pressure; }},
    Column<F>{"spin_rad_s", "rad/s", "of the equilibrium", [](const F& f) { return f.spin; }},
    Column<F>{"outer_radius_m", "m", "of the contact curve, else of all nodes",
              [](const F& f) { return f.outer_radius; }},
    Column<F>{"width_m", "m", "along the axle", [](const F& f) { return f.width; }},
    Column<F>{"twist_m", "m", "largest displacement around the axle",
              [](const F& f) { return f.twist; }},
    Column<F>{"cavity_volume_m3", "m³", "between the liner and the ring that joins its ends",
              [](const F& f) { return f.cavity.value_or(std::nan("")); }},
    Column<F>{"det_f_min", "1", "smallest at a point of the rubber",
              [](const F& f) { return f.det_f_min; }},
    Column<F>{"stretch_max", "1", "largest principal stretch at a point of the rubber",
              [](const F& f) { return f.stretch_max; }},
    Column<F>{"cord_force_min_n", "N", "smallest of all cords; 0: there are none", smallest_force},
    Column<F>{"cord_force_max_n", "N", "largest of all cords; 0: there are none", largest_force},
    Column<F>{"newton_iterations", "1", "so far",
              [](const F& f) { return static_cast<double>(f.newton_iterations); }},
    Column<F>{"residual", "1", "largest force at a free node over the largest reaction or load",
              [](const F& f) { return f.residual; }},
};

constexpr JsonMember<int> done_rows[] = {
    {"equilibria", "integer", "", "Equilibria found, the last under the share of the loads reached",
     [](const int& n) -> Json { return n; }},
};

io::ResultsWords words() {
  return {.analysis = "inflation",
          .time_unit = "1",
          .time = "share of the loads, of displacement and fields; NaN: snapshot not written",
          .velocity_time = "of velocity: that of /frame/time",
          .velocity_unit = "m",
          .velocity = "0: an equilibrium",
          .field_velocity = "0: an equilibrium"};
}

class InflationAnalysis final : public Analysis {
 public:
  InflationAnalysis(const Case& c, const RunOptions& options)
      : case_(c),
        directory_(options.directory),
        mesh_(build_mesh(c, &warnings_)),
        materials_(materials_of(c, mesh_)),
        wheel_(c, build_section(c, nullptr), materials_),
        steps_(wheel_.energy(), wheel_.loads()) {
    warn_of_units(c, mesh_, materials_, warnings_);
    warn_of_senses(c, mesh_, materials_, warnings_);
    demand_memory(c, mesh_.n_nodes(), mesh_memory(mesh_.n_nodes()));
    if (options.resume)
      throw case_error(c, "analysis.kind", "an inflation has no checkpoints to resume from",
                       "\"dynamic\", or --overwrite instead of --resume");
    for (int j = 0; j < mesh_.n_sectors; ++j)
      mass_.insert(mass_.end(), wheel_.energy().mass().begin(), wheel_.energy().mass().end());
  }

  [[nodiscard]] CheckReport check(double trial) override;
  [[nodiscard]] RecordPlan record_plan() const override;
  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = case_.warnings;
    all.insert(all.end(), warnings_.begin(), warnings_.end());
    return all;
  }
  void describe(Json& json) const override {
    add_size(mesh_.n_nodes(), dofs(), json);
    add_wheel(width_of_mesh(), mesh_.n_sectors, 0.0, json);
  }

  Progress begin(Recorder& recorder) override;
  Progress advance(Recorder& recorder) override;
  [[nodiscard]] const std::optional<std::string>& trouble() const override { return trouble_; }
  void summarise(Json& json, RunReport& report) const override;

 private:
  [[nodiscard]] int planned() const noexcept { return wheel_.loads().steps; }
  [[nodiscard]] std::size_t dofs() const noexcept {
    return 3 * (mesh_.n_nodes() - mesh_.clamped.size());
  }
  [[nodiscard]] double width_of_mesh() const {
    const auto [left, right] = std::ranges::minmax(mesh_.axial);
    return right - left;
  }
  void record(Recorder& recorder);
  [[nodiscard]] Progress progress() const noexcept;

  const Case& case_;
  std::filesystem::path directory_;
  std::vector<std::string> warnings_;
  mesh::Mesh mesh_;
  std::vector<fem::Material> materials_;
  InflatedWheel wheel_;
  statics::InflationSteps steps_;
  std::vector<double> mass_;
  int equilibria_ = 0;
  std::optional<std::string> trouble_;
};

/// It finds the equilibrium, because this takes as long as a run.
CheckReport InflationAnalysis::check(double /*trial*/) {
  CheckReport r;
  r.nodes = mesh_.n_nodes();
  r.elements = mesh_.n_elements();
  r.dofs = dofs();
  r.candidates = mesh_.boundary.size();
  r.wave_speeds = fem::wave_speeds(case_.material);
  r.steps = planned();
  r.snapshots = static_cast<std::size_t>(planned());
  r.memory_bytes = mesh_memory(mesh_.n_nodes());
  r.disk_bytes = disk_needed(record_plan(), false).all;
  r.lines = told_of(figures_of(wheel_, equilibrium_of(case_, wheel_)));
  r.warnings = warnings();
  return r;
}

RecordPlan InflationAnalysis::record_plan() const {
  RecordPlan plan;
  plan.results = {.mesh = &mesh_,
                  .mass = mass_,
                  .n_snapshots = static_cast<std::size_t>(planned()) + 1,
                  .components = 3,
                  .words = words()};
  plan.columns = labels_of(std::span<const Column<F>>(columns));
  plan.n_rows = plan.results.n_snapshots;
  plan.materials = materials_;
  return plan;
}

Progress InflationAnalysis::progress() const noexcept {
  return {static_cast<long long>(std::floor(steps_.now().share * planned() + 1e-9)), planned()};
}

void InflationAnalysis::record(Recorder& recorder) {
  append_values(std::span<const Column<F>>(columns), figures_of(wheel_, steps_.now()),
                recorder.rows());
  recorder.rows_added();
  const double part = steps_.now().share * planned();
  if (std::abs(part - std::round(part)) > 1e-9) return;
  Snapshot& s = recorder.next_snapshot();
  s.time = s.time_velocity = steps_.now().share;
  const std::vector<Vec3> u = in_all_sectors(mesh_, steps_.now().u);
  s.u = u;
  s.v = std::vector<Vec3>(u.size());
  recorder.add_snapshot();
}

Progress InflationAnalysis::begin(Recorder& recorder) {
  record(recorder);
  return progress();
}

Progress InflationAnalysis::advance(Recorder& recorder) {
  if (!steps_.advance()) {
    trouble_ = no_equilibrium(wheel_, steps_.now());
    return progress();
  }
  ++equilibria_;
  record(recorder);
  write_cords(directory_, wheel_, steps_.now());
  if (const std::string text = instability(wheel_, steps_.now()); !text.empty()) trouble_ = text;
  return progress();
}

void InflationAnalysis::summarise(Json& j, RunReport& r) const {
  r.steps = equilibria_;
  r.reached = steps_.now().found ? fmt::format("all loads in {} equilibria", equilibria_)
                                 : fmt::format("{:.4g} of the loads in {} equilibria",
                                               steps_.now().share, equilibria_);
  add_members(done_rows, equilibria_, j);
  add_steps_done(r, j);
  add_inflation(figures_of(wheel_, steps_.now()), j);
}

}  // namespace

std::unique_ptr<Analysis> make_inflation(const Case& c, const RunOptions& options) {
  return std::make_unique<InflationAnalysis>(c, options);
}

std::vector<MemberText> inflation_members() {
  return texts_of(done_rows);
}

}  // namespace rondo::study
