// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/reduced/wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/analysis/dynamic.hpp"
#include "rondo/analysis/reduced/estimate_wheel.hpp"
#include "rondo/analysis/reduced/prepare_wheel.hpp"
#include "rondo/case/case_source.hpp"

namespace rondo::study {
namespace {

constexpr JsonMember<PreparedWheel> wheel_rows[] = {
    {"wheel_modes", "integer", "", "Number of modes of a reduced wheel",
     [](const PreparedWheel& w) -> Json { return w.n_modes(); }},
    {"wheel_basis", "string", "", "What its modes are: \"eigenmodes\" or \"pod\"",
     [](const PreparedWheel& w) -> Json { return name_of(w.basis); }},
    {"wheel_file", "string", "", "File of its modes (`rondo reduce`)",
     [](const PreparedWheel& w) { return w.file.empty() ? absent() : Json(as_utf8(w.file)); }},
    {"wheel_highest_mode", "number", "rad/s", "Angular frequency of its highest mode",
     [](const PreparedWheel& w) -> Json { return w.highest(); }},
    {"wheel_sector_pass", "number or null", "s",
     "Time in which a sector passes at the largest spin, of a mesh from a file a contact node in "
     "the mean; null: the wheel does not turn",
     [](const PreparedWheel& w) { return w.expected.pass > 0.0 ? Json(w.expected.pass) : Json(); }},
    {"wheel_law_residual", "number", "",
     "Of a wheel in three dimensions: largest residual of the law of contact, over the largest "
     "force, that its steps may leave",
     [](const PreparedWheel& w) { return w.solid ? Json(w.law_residual) : absent(); }},
    {"wheel_full_step", "number", "s", "Step of the full run",
     [](const PreparedWheel& w) -> Json { return w.full_step; }},
};

struct WheelEnd {
  const rom::WheelFigures& f;
  double time;  ///< simulated [s]
};
constexpr JsonMember<WheelEnd> effort_rows[] = {
    {"step_wall_s", "number", "s", "Wall time of all steps",
     [](const WheelEnd& e) -> Json { return e.f.wall_s; }},
    {"slowest_step_s", "number", "s", "Wall time of the slowest step",
     [](const WheelEnd& e) -> Json { return e.f.slowest_step_s; }},
    {"realtime_factor", "number", "", "Simulated time over `step_wall_s`",
     [](const WheelEnd& e) -> Json { return e.f.wall_s > 0.0 ? e.time / e.f.wall_s : 0.0; }},
    {"contact_steps", "integer", "", "Steps in which contact was solved",
     [](const WheelEnd& e) -> Json { return e.f.contact_steps; }},
    {"contact_iterations_mean", "number", "",
     "Mean number of iterations of the contact law in such a step",
     [](const WheelEnd& e) -> Json {
       return static_cast<double>(e.f.iterations) /
              static_cast<double>(std::max(1LL, e.f.contact_steps));
     }},
    {"contact_iterations_max", "integer", "", "Most iterations in a step",
     [](const WheelEnd& e) -> Json { return e.f.iterations_max; }},
    {"contacts_max", "integer", "", "Most nodes in contact at once",
     [](const WheelEnd& e) -> Json { return e.f.contacts_max; }},
    {"steps_pivoted", "integer", "",
     "Steps in which the contact law needed pivoting, in three dimensions Newton's method",
     [](const WheelEnd& e) -> Json { return e.f.second_method; }},
    {"steps_late_friction", "integer", "",
     "Steps whose coefficients of friction are those by slip and pressure of the step before, "
     "because those of the step itself were not found",
     [](const WheelEnd& e) -> Json { return e.f.late_friction; }},
    {"steps_not_converged", "integer", "",
     "Steps that missed the contact law by more than 1e-9, in three dimensions by more than "
     "`wheel_law_residual`, or whose brake no try held",
     [](const WheelEnd& e) -> Json { return e.f.not_converged; }},
};
constexpr JsonMember<WheelEnd> wheel_end_rows[] = {
    {"wheel", "object", "", "Effort of the steps of a reduced wheel",
     [](const WheelEnd& e) { return object_of(effort_rows, e); },
     [] { return texts_of(effort_rows); }},
};

/// Null where there is next to none of what the error is of.
Json known(double error) {
  return std::isnan(error) ? Json() : Json(error);
}

constexpr JsonMember<WheelEstimate> wheel_estimate_rows[] = {
    {"force_x", "number", "",
     "Larger change of the mean F_x by half the step or twice the modes, over the mean F_y",
     [](const WheelEstimate& e) -> Json { return e.larger().x; }},
    {"force_y", "number", "", "Likewise of the mean F_y, over itself",
     [](const WheelEstimate& e) -> Json { return e.larger().y; }},
    {"force_x_of_itself", "number or null", "", "Likewise of the mean F_x, over itself",
     [](const WheelEstimate& e) { return known(e.larger().x_of_itself); }},
    {"force_lateral", "number", "",
     "Likewise of the mean lateral force, over the mean F_y; of a disk 0",
     [](const WheelEstimate& e) -> Json { return e.larger().lateral; }},
    {"moment_aligning", "number", "m",
     "Likewise of the mean aligning moment, over the mean F_y; of a disk 0",
     [](const WheelEstimate& e) -> Json { return e.larger().aligning; }},
    {"friction_power", "number or null", "",
     "Likewise of the mean power taken by friction, over itself",
     [](const WheelEstimate& e) { return known(e.larger().friction_power); }},
    {"force_x_by_step", "number", "", "Change of the mean F_x by half the step, over the mean F_y",
     [](const WheelEstimate& e) -> Json { return e.step.x; }},
    {"force_x_by_modes", "number", "", "By twice the modes",
     [](const WheelEstimate& e) -> Json { return e.modes.x; }},
};
constexpr JsonMember<WheelEstimate> wheel_estimate_member[] = {
    {"wheel_estimate", "object", "",
     "Of a reduced wheel, with --estimate: changes of means over the last quarter",
     [](const WheelEstimate& e) {
       return e.none.empty() ? object_of(wheel_estimate_rows, e) : absent();
     },
     [] { return texts_of(wheel_estimate_rows); }},
    {"wheel_estimate_missing", "string", "", "Reason why there is no estimate",
     [](const WheelEstimate& e) { return e.none.empty() ? absent() : Json(e.none); }},
};

/// "at once 0.54, later 0.46 in 4 terms of 0.0002 to 0.06 s; a step is 1.9 of the shortest branch".
std::string told_creep(const rom::WheelModel& wheel, double dt) {
  const rom::CreepTerm &first = wheel.creep.front(), &second = wheel.creep[1];
  const auto shortest = std::ranges::min(wheel.branches, {}, &fem::ViscousBranch::time);
  const std::string when = first.time == 0.0 ? "at once" : fmt::format("in {:.3g} s", first.time);
  return fmt::format(
      "{:.3g} of the compliance {}, the others in {:.3g} to {:.3g} s; a step is {:.3g} of the "
      "shortest branch",
      first.share, when, second.time, wheel.creep.back().time, dt / shortest.time);
}

/// The loop, the files and the figures are those of motion in time; the steps are those of the
/// reduced wheel.
class WheelAnalysis final : public DynamicAnalysis {
 public:
  WheelAnalysis(const Case& c, const RunOptions& options)
      : DynamicAnalysis(c, options), case_(c), options_(options) {
    prepare_wheel(c, options, {}, own_setup(), wheel_);
    plan_snapshots();
  }

  [[nodiscard]] CheckReport check(double trial) override {
    CheckReport r = DynamicAnalysis::check(trial);
    if (wheel_.solid) r.threads = 1;  // those of the set-up are more
    const double dt = setup().model.dt;
    r.lines.emplace_back("modes",
                         fmt::format("{}, up to {:.5g} rad/s", wheel_.n_modes(), wheel_.highest()));
    r.lines.emplace_back("step of the mesh", fmt::format("{:.4g} s, 1/{:.3g} of it",
                                                         wheel_.full_step, dt / wheel_.full_step));
    if (wheel_.expected.pass > 0.0)
      r.lines.emplace_back("steps in a pass",
                           fmt::format("{:.4g}, of a {}", wheel_.passes(dt), wheel_.passing()));
    if (wheel_.solid) tell_mesh(r);
    if (!wheel_.model.creep.empty()) r.lines.emplace_back("creep", told_creep(wheel_.model, dt));
    return r;
  }
  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = DynamicAnalysis::warnings();
    all.insert(all.end(), wheel_.warnings.begin(), wheel_.warnings.end());
    return all;
  }
  [[nodiscard]] const Checkpoint* find(const std::filesystem::path& directory) override {
    const Checkpoint* found = DynamicAnalysis::find(directory);
    if (found && !is_saved(setup(), wheel_, found->state.ring))
      throw FileError((directory / checkpoint_name).string(),
                      "is damaged: its numbers are not those of a reduced wheel");
    return found;
  }
  void close() override {
    DynamicAnalysis::close();
    warn_of_spin();
    if (std::string late = late_friction_text(wheel_.figures); !late.empty()) warn(std::move(late));
  }
  void take_tables() override {
    refuse_spin();
    DynamicAnalysis::take_tables();
  }
  void describe(Json& json) const override {
    DynamicAnalysis::describe(json);
    add_members(wheel_rows, wheel_, json);
  }
  void summarise(Json& json, RunReport& report) const override {
    DynamicAnalysis::summarise(json, report);
    add_members(wheel_end_rows, {wheel_.figures, report.simulated_s}, json);
    if (options_.reduced_estimate && report.status == RunStatus::done) {
      const WheelEstimate estimate =
          estimate_wheel(case_, options_, setup().model.dt, wheel_.n_modes());
      add_members(wheel_estimate_member, estimate, json);
      report.notes.push_back("error estimate: " + in_words(estimate));
    }
    report.step_wall_s = wheel_.figures.wall_s;
    report.slowest_step = wheel_.figures.slowest_step_s / setup().model.dt;
  }

 protected:
  [[nodiscard]] bool guards_impacts() const noexcept override { return false; }
  [[nodiscard]] double contact_bound() const noexcept override {
    return wheel_.solid ? wheel_.law_residual : residual_bound;
  }
  [[nodiscard]] std::string_view contact_cure() const noexcept override {
    if (!wheel_.solid) return {};
    return "; a smaller --reduced-step, a smaller friction, or the full run, without --reduced";
  }
  [[nodiscard]] std::string told_integrator() const override {
    return "reduced wheel with exact contact";
  }
  [[nodiscard]] std::unique_ptr<dynamics::Integrator> make_integrator(
      dynamics::State& start) override {
    return make_steps(setup(), wheel_, start);
  }

 private:
  /// Whether the reduction pays: on coarse wheels the fused step of the mesh is as fast.
  void tell_mesh(CheckReport& r) const {
    constexpr double per_dof = 2e-9;  // of the fused step in three dimensions, one thread [s]
    const double mesh = per_dof * static_cast<double>(r.dofs) * case_.time.end / wheel_.full_step;
    if (!(r.seconds > 0.0)) return;
    r.lines.emplace_back("time of the mesh",
                         fmt::format("about {:.2g} s of stepping at 2 ns a dof and step, {:.2g} "
                                     "times that of the reduced wheel",
                                     mesh, mesh / r.seconds));
    if (mesh < r.seconds)
      r.warnings.push_back(
          fmt::format("the mesh is so coarse that its own steps take about {:.2g} s, less than the "
                      "{:.2g} s of the reduced wheel: the full run, without --reduced, is faster",
                      mesh, r.seconds));
  }
  /// A rim that moves by itself may have come to turn faster than what was chosen for it.
  void warn_of_spin() {
    const double spin = wheel_.figures.spin_max, dt = setup().model.dt;
    if (spin > wheel_.model.largest_spin * (1.0 + 1e-9))
      warn(
          fmt::format("the spin of the rim reached {:.5g} rad/s, and what no mode has is known up "
                      "to {:.5g} rad/s: beyond it is extrapolated",
                      spin, wheel_.model.largest_spin));
    const double passes = 2.0 * std::numbers::pi / setup().mesh.n_sectors / (spin * dt);
    const bool was_told = wheel_.expected.pass > 0.0 && wheel_.passes(dt) < 1.5;
    if (passes < 1.5 && !was_told)
      warn(fmt::format(
          "the spin of the rim reached {:.5g} rad/s, {:.2g} steps in the pass of a "
          "sector: forces of fewer than 1.5 swing; a --reduced-step of at most {:.2g} s",
          spin, passes, passes * dt / 1.618));
  }
  /// The residual is known for the spins of the case at the start.
  void refuse_spin() const {
    const double known = wheel_.expected.spin;
    const dynamics::Table& spin = case_.motion.angular_velocity;
    const double first = spin.points().front()[1];
    const auto is_first = [&](const std::array<double, 2>& point) { return point[1] == first; };
    const bool stays = wheel_.model.squares.size() == 1;
    if (stays ? std::abs(std::abs(first) - known) <= 1e-9 * known &&
                    std::ranges::all_of(spin.points(), is_first)
              : spin.largest() <= known * (1.0 + 1e-9))
      return;
    throw case_error(
        case_, "motion.angular_velocity",
        stays ? "the tables of this reduced wheel are for a spin that stays"
              : fmt::format("the tables of this reduced wheel are for spins up to "
                            "{:.6g} rad/s",
                            known),
        fmt::format("a table of the case from the start that reaches the largest spin, "
                    "e.g. [[0, {0:.6g}], [1e6, {0:.6g}], [2e6, w]]",
                    std::abs(first)));
  }

  const Case& case_;
  const RunOptions& options_;
  PreparedWheel wheel_;
};

}  // namespace

std::unique_ptr<Analysis> make_wheel(const Case& c, const RunOptions& options) {
  if (c.analysis.kind != AnalysisKind::dynamic)
    throw case_error(c, "analysis.kind", "a reduced wheel moves in time",
                     "\"dynamic\"; or this analysis of the mesh, without --reduced");
  return std::make_unique<WheelAnalysis>(c, options);
}

std::vector<MemberText> wheel_members() {
  return joined({texts_of(wheel_rows), texts_of(wheel_end_rows), texts_of(wheel_estimate_member)});
}

}  // namespace rondo::study
