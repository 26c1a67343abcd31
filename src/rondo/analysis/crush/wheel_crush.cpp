// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/wheel_crush.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/analysis/base/disk.hpp"
#include "rondo/analysis/base/strain_watch.hpp"
#include "rondo/analysis/build/ground/contact_law.hpp"
#include "rondo/analysis/build/ground/held_ground.hpp"
#include "rondo/analysis/build/ground/rolling_law.hpp"
#include "rondo/analysis/build/physical.hpp"
#include "rondo/analysis/build/plausible/plausible.hpp"
#include "rondo/analysis/crush/crush_members.hpp"
#include "rondo/analysis/crush/crush_record.hpp"
#include "rondo/analysis/crush/wheel_crush_record.hpp"
#include "rondo/analysis/out_of_range.hpp"
#include "rondo/analysis/steady/steady_body.hpp"
#include "rondo/analysis/steady/steady_remainder.hpp"
#include "rondo/core/keep_larger.hpp"

namespace rondo::study {
namespace {

using Body = SteadyBody<3>;

/// Height of the center above the ground where the wheel first touches, in X [m].
double touch_height_of(const mesh::Mesh& mesh, double camber) {
  double height = 0.0;
  for (const int node : mesh.boundary) {
    const Vec3 x{mesh.coordinates[at(node)], mesh.axial[at(node)]};
    height = std::max(height, -GroundFrame(camber).from_wheel(x).y);
  }
  return height;
}

class WheelCrush final : public Analysis {
 public:
  WheelCrush(const Case& c, const RunOptions& options)
      : case_(c),
        threads_(options.threads),
        path_(c.analysis),
        body_(std::static_pointer_cast<Body>(rolled_body(c, options.shared))),
        ground_(c.ground->shape),
        held_reach_(path_.has_load() ? held_reach(body_->mesh, c.motion.camber) : 0.0),
        strain_(body_->mesh, body_->materials) {
    if (has_large_strains(c)) strain_.take_large_strains();
    refuse_held_in_ground(c, body_->mesh, path_, touch_height_of(body_->mesh, c.motion.camber));
    tell_physical_figures(c, {body_->mesh, body_->materials, body_->inflation}, path_, told_);
    refuse_resume(c, options);
  }

  [[nodiscard]] CheckReport check(double trial) override;
  [[nodiscard]] RecordPlan record_plan() const override;
  void prepare() override;
  [[nodiscard]] std::vector<std::string> warnings() const override {
    return all_warnings(case_, *body_, told_.warnings);
  }
  void describe(Json& json) const override;

  Progress begin(Recorder& recorder) override;
  Progress advance(Recorder& recorder) override;
  [[nodiscard]] const std::optional<std::string>& trouble() const override { return trouble_; }
  void summarise(Json& json, RunReport& report) const override;

 private:
  [[nodiscard]] int n_increments() const noexcept { return path_.n_increments(); }
  [[nodiscard]] statics::StandingTarget target(int k) const;
  [[nodiscard]] std::string press(int k);
  [[nodiscard]] std::string not_solved(statics::RollingEnd end) const;
  [[nodiscard]] std::string wrong_state() const;
  void count();
  [[nodiscard]] const char* finer() const;
  WheelCrushSums append(int k, Recorder& recorder);

  const Case& case_;
  int threads_;  ///< 0: chosen by size
  CrushPath path_;
  std::shared_ptr<Body> body_;
  contact::Ground ground_;
  double held_reach_;  ///< of held nodes below the center, where a load is given [m]; else 0
  StrainWatch strain_;
  PhysicalFigures told_;
  std::unique_ptr<SteadyRemainder> remainder_;     ///< null: the forces are linear
  std::unique_ptr<statics::StandingWheel> wheel_;  ///< null: the harmonics have no solution
  std::unique_ptr<WheelCrushRecord> record_;
  int increments_ = 0;  ///< done, whose results are kept
  CrushLargest largest_;
  WheelEffort effort_;
  std::optional<std::string> trouble_;
};

CheckReport WheelCrush::check(double /*trial*/) {
  const int n = n_increments();
  CheckReport r;
  r.lines = told_.figures;
  add_body(case_, *body_, r);
  r.steps = n;
  r.snapshots = static_cast<std::size_t>(n);
  r.disk_bytes = disk_needed(record_plan(), false).all;
  r.lines.emplace_back("sectors", fmt::format("{} of {} degrees of freedom", body_->mesh.n_sectors,
                                              body_->sector_dofs));
  r.lines.emplace_back("increments", fmt::format("{} to {}", n, path_.target(n)));
  if (path_.is_of_tables())
    r.lines.emplace_back("largest depth", fmt::format("{:.6g} m", path_.largest_depth()));
  r.warnings = warnings();
  return r;
}

RecordPlan WheelCrush::record_plan() const {
  RecordPlan plan;
  plan.results = {.mesh = &body_->mesh,
                  .mass = body_->mass,
                  .n_snapshots = static_cast<std::size_t>(n_increments()),
                  .contact = true,
                  .stress = case_.output.stress,
                  .components = 3U,
                  .camber = case_.motion.camber,
                  .words = crush_words(path_),
                  .series = wheel_crush_series()};
  plan.columns = wheel_crush_columns();
  plan.n_rows = plan.results.n_snapshots + 1;
  plan.materials = body_->materials;
  plan.ground = &ground_;
  return plan;
}

void WheelCrush::prepare() {
  body_->find_harmonics(case_, threads_);
  if (!body_->has_solution()) {
    trouble_ = no_solution(case_);
    return;
  }
  const statics::RollingBody<3>& body = body_->harmonics->body();
  if (body_->swept)
    remainder_ =
        std::make_unique<SteadyRemainder>(body_->mesh, body_->sector, *body_->swept,
                                          body.candidates, body.samples, 0.0, body.threads);
  wheel_ = std::make_unique<statics::StandingWheel>(
      *body_->harmonics, case_.motion.camber, law_of(*case_.ground).friction, remainder_.get(),
      extents_of<3>(body_->mesh, body_->sector, body.candidates));
  record_ = std::make_unique<WheelCrushRecord>(body_->mesh, *wheel_);
}

void WheelCrush::describe(Json& j) const {
  describe_body(case_, *body_, j);
  describe_path(case_.analysis, path_, body_->harmonics_wall_s, j);
}

WheelCrushSums WheelCrush::append(int k, Recorder& recorder) {
  const WheelCrushSums sums = record_->sum_up(GroundFrame(case_.motion.camber));
  append_row({path_, k, floor_of(case_), GroundFrame(case_.motion.camber), wheel_->state(), sums},
             recorder.rows());
  recorder.rows_added();
  return sums;
}

/// The first row is that of first touch.
Progress WheelCrush::begin(Recorder& recorder) {
  if (!wheel_) return {0, n_increments()};
  append(0, recorder);
  static_cast<void>(strain_.look(Field(wheel_->state().nodes), {}, 0.0));  // undeformed
  return {0, n_increments()};
}

statics::StandingTarget WheelCrush::target(int k) const {
  statics::StandingTarget to{.slide = path_.slide(k)};
  if (path_.has_load())
    to.load = path_.load(k);
  else
    to.depth = path_.depth(k);
  return to;
}

/// What makes the increment smaller that is not solved.
const char* WheelCrush::finer() const {
  const bool slides = !path_.is_of_tables() && increments_ >= case_.analysis.increments;
  return slides ? "analysis.slide_increments" : "analysis.increments";
}

std::string WheelCrush::not_solved(statics::RollingEnd end) const {
  const statics::StandingState& left = wheel_->left();
  const char* const less =
      path_.has_load() ? "a smaller analysis.load" : "a smaller analysis.depth";
  if (end == statics::RollingEnd::no_contact)
    return path_.has_load() ? fmt::format("no contact was found that carries it; {}", less)
                            : fmt::format("nothing touches any more; {}", less);
  if (remainder_ && left.effort.turns > 1)
    return fmt::format(
        "the nonlinear forces (inflation.nonlinear) were not balanced: {} problems of contact "
        "leave {:.2g} of the load (bound {:.0e}); more {}, {}, a smaller "
        "ground.friction, or inflation.nonlinear = \"none\"",
        left.effort.turns, left.effort.residual, statics::finite_rolling_bound, finer(), less);
  const statics::RollingEffort& effort = left.solution.effort;
  return fmt::format(
      "the contact was not solved after {} Newton steps and {} sweeps on {} contact nodes; more "
      "{}, "
      "{}, a smaller ground.friction, or a coarser {}",
      effort.newton_steps, effort.sweeps, wheel_->window().pairs().size(), finer(), less,
      case_.section ? "section.file or fewer section.sectors" : "disk.mesh");
}

/// What is wrong with a state that was found; empty: nothing.
std::string WheelCrush::wrong_state() const {
  const statics::StandingState& s = wheel_->state();
  if (s.solution.height <= held_reach_)
    return fmt::format(
        "the ground is within the rim: the center is {:.6g} m above it; a smaller analysis.load",
        s.solution.height);
  if (!(s.residual <= statics::rolling_residual_bound))
    return fmt::format("contact residual {:.3g}, bound {:.0e}; a smaller ground.friction",
                       s.residual, statics::rolling_residual_bound);
  // Nonlinear forces are balanced to a share of the load.
  if (!remainder_ && !(s.equilibrium <= residual_bound))
    return fmt::format("residual of the equilibrium {:.3g}, bound {:.0e}", s.equilibrium,
                       residual_bound);
  if (!(s.works.relative <= residual_bound))
    return fmt::format("the energy does not balance: relative residual {:.3g}, bound {:.0e}",
                       s.works.relative, residual_bound);
  return beyond_files(body_->mesh, body_->materials, s.nodes);
}

/// @return what is wrong; empty: all is well
std::string WheelCrush::press(int k) {
  const statics::StandingTarget to = target(k);
  const statics::RollingEnd end = wheel_->press(to);
  const bool lifted = end == statics::RollingEnd::no_contact && !to.load && to.depth <= 0.0;
  if (end != statics::RollingEnd::solved && !lifted) return not_solved(end);
  count();
  std::string wrong = wrong_state();
  return wrong.empty() ? strain_.look(Field(wheel_->state().nodes), {}, path_.parameter(k)) : wrong;
}

Progress WheelCrush::advance(Recorder& recorder) {
  const int k = increments_ + 1, n = n_increments();
  if (trouble_) return {increments_, n};
  const std::vector<Vec3> before = wheel_->state().nodes;
  if (const std::string wrong = press(k); !wrong.empty()) {
    trouble_ = fmt::format("increment {} of {}, {}: {}", k, n, path_.target(k), wrong);
    return {increments_, n};
  }
  increments_ = k;
  const WheelCrushSums sums = append(k, recorder);
  record_->fill(
      {path_, k, floor_of(case_), GroundFrame(case_.motion.camber), wheel_->state(), sums}, before,
      recorder.next_snapshot());
  recorder.add_snapshot();
  return {k, n};
}

void WheelCrush::count() {
  const statics::StandingState& s = wheel_->state();
  largest_.take(s.residual, s.equilibrium, s.penetration);
  effort_.height = floor_of(case_) + s.solution.height;
  effort_.depth = s.depth;
  effort_.newton_steps = std::max(effort_.newton_steps, s.solution.effort.newton_steps);
  effort_.pairs = wheel_->window().pairs().size();
  effort_.is_nonlinear = remainder_ != nullptr;
  effort_.balance_residual = keep_larger(effort_.balance_residual, s.effort.residual);
  effort_.contact_problems += s.effort.turns;
}

void WheelCrush::summarise(Json& j, RunReport& r) const {
  r.steps = increments_;
  if (!wheel_) return;
  const statics::StandingState& s = wheel_->state();
  summarise_crush({increments_, s.depth, s.slide, s.works}, largest_, path_, strain_, j, r);
  if (increments_ == 0) return;
  add_wheel_effort(effort_, j);
  const statics::RollingForces& f = s.solution.forces;
  r.notes.push_back(fmt::format(
      "load {:.6g} N, force along x {:.6g} N, lateral force {:.6g} N, overturning moment {:.6g} "
      "N m; center {:.6g} m high",
      f.normal, f.heading, f.lateral, f.overturning, effort_.height));
  const std::optional<Wall> wall = wall_of(body_->mesh);
  if (!case_.analysis.load || !wall) return;
  if (std::string warning = hardly_pressed("analysis.load", s.depth, wall->radius);
      !warning.empty()) {
    j["warnings"].push_back(warning);
    r.warnings.push_back(std::move(warning));
  }
}

}  // namespace

std::unique_ptr<Analysis> make_wheel_crush(const Case& c, const RunOptions& options) {
  return std::make_unique<WheelCrush>(c, options);
}

}  // namespace rondo::study
