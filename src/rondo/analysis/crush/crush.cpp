// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/crush.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/base/shared_members.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/ground/held_ground.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/crush/crush_members.hpp"
#include "rondo/analysis/crush/crush_record.hpp"
#include "rondo/analysis/crush/crush_solver.hpp"
#include "rondo/analysis/out_of_range.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

class CrushAnalysis final : public Analysis {
 public:
  CrushAnalysis(const Case& c, const RunOptions& options)
      : case_(c),
        setup_(build_crush(c)),
        ground_(c.ground->shape),
        boundary_(setup_.mesh),
        strain_(setup_.mesh, setup_.materials),
        solver_(make_crush_solver(c, options, setup_)) {
    refuse_held_in_ground(c, setup_);
    tell_physical_figures(c, setup_);
    refuse_resume(c, options);
  }

  [[nodiscard]] CheckReport check(double trial) override;
  [[nodiscard]] RecordPlan record_plan() const override;
  void prepare() override;
  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = case_.warnings;
    all.insert(all.end(), setup_.warnings.begin(), setup_.warnings.end());
    return all;
  }
  void describe(Json& json) const override;

  Progress begin(Recorder& recorder) override;
  Progress advance(Recorder& recorder) override;
  [[nodiscard]] const std::optional<std::string>& trouble() const override { return trouble_; }
  void summarise(Json& json, RunReport& report) const override;

 private:
  [[nodiscard]] int n_increments() const noexcept { return setup_.path.n_increments(); }
  [[nodiscard]] bool iterate();
  Progress take_next(Recorder& recorder);

  const Case& case_;
  CrushSetup setup_;
  contact::Ground ground_;
  mesh::DeformedBoundary boundary_;
  StrainWatch strain_;
  std::unique_ptr<CrushSolver> solver_;
  double prepare_s_ = 0.0;
  statics::CrushState state_;
  bool iterated_ = false;  ///< the solver has nothing left to iterate
  int increments_ = 0;     ///< done, whose results are kept
  CrushLargest largest_;
  std::optional<std::string> trouble_;
};

CheckReport CrushAnalysis::check(double /*trial*/) {
  const CrushPath& path = setup_.path;
  const int n = n_increments();
  CheckReport r;
  r.nodes = setup_.mesh.n_nodes();
  r.elements = setup_.mesh.cells.size();
  r.dofs = setup_.n_dofs();
  r.bodies = mesh::find_bodies(setup_.mesh).count;
  r.candidates = setup_.mesh.boundary.size();
  r.wave_speeds = fem::wave_speeds(case_.material);
  r.steps = n;
  r.snapshots = static_cast<std::size_t>(n);
  r.memory_bytes = crush_memory(case_, setup_);
  r.disk_bytes = disk_needed(record_plan(), false).all;
  r.lines = setup_.figures;
  r.lines.insert(r.lines.end(),
                 {{"condensed", fmt::format("{} contact nodes", setup_.within_reach)},
                  {"increments", reached_text(n, path.depth(n), path.slide(n))}});
  if (path.is_of_tables())
    r.lines.emplace_back("largest depth", fmt::format("{:.6g} m", path.largest_depth()));
  r.warnings = warnings();
  return r;
}

RecordPlan CrushAnalysis::record_plan() const {
  RecordPlan plan;
  plan.results = {.mesh = &setup_.mesh,
                  .mass = setup_.mass,
                  .n_snapshots = static_cast<std::size_t>(n_increments()),
                  .contact = true,
                  .stress = case_.output.stress,
                  .words = crush_words(setup_.path),
                  .series = crush_series()};
  plan.columns = crush_columns();
  plan.n_rows = plan.results.n_snapshots + 1;
  plan.materials = setup_.materials;
  plan.ground = &ground_;
  return plan;
}

void CrushAnalysis::prepare() {
  const auto begin = Clock::now();
  solver_->prepare();
  prepare_s_ = std::chrono::duration<double>(Clock::now() - begin).count();
}

void CrushAnalysis::describe(Json& j) const {
  add_size(setup_.mesh.n_nodes(), setup_.n_dofs(), j);
  describe_path(case_.analysis, setup_.path, prepare_s_, j);
  solver_->describe(j);
}

/// The first row is that of first touch.
Progress CrushAnalysis::begin(Recorder& recorder) {
  state_ = statics::start_crush(setup_.model, setup_.mesh.n_nodes());
  const statics::CrushReport nothing;
  const CrushSums sums = sum_up(setup_, boundary_, state_);
  append_row(setup_, {0, state_, nothing, sums}, recorder.rows());
  recorder.rows_added();
  static_cast<void>(strain_.look(state_.u, {}, 0.0));  // undeformed
  return {0, n_increments()};
}

/// The solver is not done with all increments at once.
bool CrushAnalysis::iterate() {
  if (iterated_) return false;
  std::string wrong;
  iterated_ = !solver_->iterate(wrong);
  if (!wrong.empty()) trouble_ = wrong;
  return !iterated_ || trouble_;
}

Progress CrushAnalysis::advance(Recorder& recorder) {
  return iterate() ? Progress{0, n_increments()} : take_next(recorder);
}

Progress CrushAnalysis::take_next(Recorder& recorder) {
  const int k = increments_ + 1, n = n_increments();
  const std::vector<Vec2> before = state_.u;
  std::string wrong;
  const statics::CrushReport report = solver_->take(k, state_, wrong);
  largest_.take(report.residual, report.equilibrium, report.penetration);
  if (wrong.empty()) wrong = beyond_files(setup_, state_);
  if (wrong.empty()) wrong = strain_.look(state_.u, {}, setup_.path.parameter(k));
  if (!wrong.empty()) {
    trouble_ = fmt::format("increment {} of {}, {}: {}", k, n, setup_.path.target(k), wrong);
    return {increments_, n};
  }
  increments_ = k;
  const CrushSums sums = sum_up(setup_, boundary_, state_);
  const CrushRecord record{k, state_, report, sums};
  append_row(setup_, record, recorder.rows());
  recorder.rows_added();
  fill(setup_, record, before, recorder.next_snapshot());
  recorder.add_snapshot();
  return {k, n};
}

void CrushAnalysis::summarise(Json& j, RunReport& r) const {
  summarise_crush({increments_, state_.depth, state_.slide, state_.works}, largest_, setup_.path,
                  strain_, j, r);
  solver_->summarise(state_, j, r);
}

}  // namespace

std::unique_ptr<Analysis> make_crush(const Case& c, const RunOptions& options) {
  return std::make_unique<CrushAnalysis>(c, options);
}

std::vector<MemberText> crush_members() {
  return joined({crush_path_members(), crush_solver_members()});
}

}  // namespace rondo::study
