// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/reduced/wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/dynamic.hpp"
#include "rondo/analysis/elements/combinations.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/fem/contact_mass.hpp"
#include "rondo/rom/wheel_run.hpp"

namespace rondo::study {
namespace {

constexpr double longest_step = 4e-4;      ///< chosen without a wish                     [s]
constexpr double fewest_passes = 1.618;    ///< steps in the pass of a sector
constexpr double beyond_whole = 0.618;     ///< so that nodes are seen at all their phases
constexpr double steps_in_contact = 20.0;  ///< while a node passes it
constexpr int most_modes = 40, most_modes_of_tread = 90, fewest_modes = 10;
constexpr double highest_mode = 1.5;  ///< ω Δt of the modes that are taken

/// What the case says about contact, before the run.
struct Expected {
  double spin = 0.0;     ///< largest |ω|                                             [rad/s]
  double speed = 0.0;    ///< largest of |V| and |ω| R                                  [m/s]
  double length = 0.0;   ///< of the contact at the lowest height, on flat ground         [m]
  double pass = 0.0;     ///< time in which a sector passes; 0: it does not turn            [s]
  double spacing = 0.0;  ///< of contact nodes, in the mean                                 [m]
};

double radius_of(const Setup& setup) {
  double radius = 0.0;
  for (const Vec2 x : setup.model.reference) radius = std::max(radius, norm(x));
  return radius;
}

Expected expected(const Case& c, const Setup& setup) {
  Expected e;
  const double radius = radius_of(setup);
  e.spin = c.motion.angular_velocity.largest();
  e.speed = std::max(c.motion.speed.largest(), e.spin * radius);
  double lowest = radius;
  for (const auto& point : c.motion.height.points()) lowest = std::min(lowest, point[1]);
  const double top = setup.model.contact->ground.top();
  const double above = std::clamp(lowest - (std::isfinite(top) ? top : 0.0), 0.0, radius);
  e.length = 2.0 * std::sqrt(radius * radius - above * above);
  if (e.spin > 0.0) e.pass = 2.0 * std::numbers::pi / setup.mesh.n_sectors / e.spin;
  e.spacing = 2.0 * std::numbers::pi * radius / static_cast<double>(setup.mesh.boundary.size());
  return e;
}

/// The step that is asked for, else one that sees contact and the nodes that pass it.
double step_of(const RunOptions& options, const Expected& e) {
  const std::string& wish = options.reduced_step;
  if (wish != "midpoint") {
    double step = 0.0;
    const auto [end, error] = std::from_chars(wish.data(), wish.data() + wish.size(), step);
    if (error != std::errc() || end != wish.data() + wish.size() || !(step > 0.0) ||
        !std::isfinite(step))
      throw request_error("--reduced-step", wish,
                          "is no step of a reduced wheel that is made of the case",
                          "a number of seconds above 0, e.g. 0.0004; or no --reduced-step");
    return step;
  }
  double step = longest_step;
  if (e.speed > 0.0 && e.length > 0.0)
    step = std::min(step, e.length / (steps_in_contact * e.speed));
  if (e.pass == 0.0) return step;
  const double passes = std::max(fewest_passes, e.pass / step);
  return e.pass / (std::max(1.0, std::ceil(passes - beyond_whole - 1e-9)) + beyond_whole);
}

rom::ModeChoice modes_of(const RunOptions& options, const Setup& setup) {
  if (options.reduced_modes) {
    if (*options.reduced_modes < 0 || *options.reduced_modes > 100000)
      throw request_error("--modes", std::to_string(*options.reduced_modes),
                          "is no number of modes", "a whole number from 0 to 100000");
    return {.wanted = static_cast<int>(*options.reduced_modes)};
  }
  const bool tread = setup.mesh.boundary.size() > static_cast<std::size_t>(setup.mesh.n_sectors);
  return {.wanted = tread ? most_modes_of_tread : most_modes,
          .highest = highest_mode / setup.model.dt,
          .fewest = fewest_modes};
}

void refuse(const Case& c, const RunOptions& options, const Setup& setup) {
  if (options.step_factor != RunOptions().step_factor)
    throw request_error("--step-factor", fmt::format("{:.9g}", options.step_factor),
                        "is of the step of a model, not of a wheel that is made of the case",
                        "--reduced-step, in seconds");
  if (options.reduced_snapshots != "fields")
    throw request_error("--snapshots", options.reduced_snapshots,
                        "a reduced wheel that is made of the case has snapshots of fields",
                        "fields");
  refuse_combinations(c, setup.model, dynamics::has::reduced | dynamics::has::exact_wheel);
  if (!c.ground)
    throw case_error(c, "ground",
                     "a reduced wheel of the case is one of exact contact, and there "
                     "is no ground",
                     "a [ground]; or the full run, without --reduced");
}

/// The mass of contact nodes goes to their neighbours.
void move_masses(const Case& c, Setup& setup) {
  dynamics::Model& model = setup.model;
  fem::MovedMass moved = fem::move_contact_mass(setup.mesh, model.mass, model.contact->nodes);
  if (moved.without_neighbour >= 0) {
    const Vec2 x = model.reference[static_cast<std::size_t>(moved.without_neighbour)];
    throw case_error(
        c, "disk.mesh.radial",
        fmt::format("the contact node at ({:.4g}, {:.4g}) m has no free neighbour that "
                    "could carry its mass",
                    x.x, x.y),
        "at least two layers of elements");
  }
  model.lumped_mass = std::exchange(model.mass, std::move(moved.mass));
}

struct Wheel {
  rom::WheelModel model;
  Expected expected;
  double full_step = 0.0;
  rom::WheelFigures figures;
  std::vector<std::string> warnings;

  [[nodiscard]] int n_modes() const { return rom::count_modes(model.harmonics); }
  [[nodiscard]] double highest() const {
    double most = 0.0;
    for (const rom::RingHarmonic& h : model.harmonics)
      most = std::max(most, h.squares.size() > 0 ? std::sqrt(h.squares.maxCoeff()) : 0.0);
    return most;
  }
  [[nodiscard]] double passes(double dt) const { return expected.pass / dt; }
};

void warn_of(const Setup& setup, Wheel& w) {
  const Expected& e = w.expected;
  const double dt = setup.model.dt;
  const auto warn = [&](std::string text) { w.warnings.push_back(std::move(text)); };
  if (e.length > 0.0 && e.length < 5.0 * e.spacing)
    warn(
        fmt::format("contact has {:.1f} nodes at the lowest motion.height: forces of fewer than 5 "
                    "nodes depend on where the nodes are; a finer mesh sees more",
                    e.length / e.spacing));
  if (w.highest() * dt > 2.0)
    warn(
        fmt::format("the highest mode, of {:.5g} rad/s, turns by {:.2g} rad in a step, where 2 are "
                    "accurate: fewer --modes, or a smaller --reduced-step",
                    w.highest(), w.highest() * dt));
  if (e.length > 0.0 && e.speed * dt > e.length / 12.0)
    warn(
        fmt::format("a step moves by {:.3g} m, of a contact of {:.3g} m: a --reduced-step of at "
                    "most {:.2g} s sees what happens within it",
                    e.speed * dt, e.length, e.length / 12.0 / e.speed));
  if (e.pass > 0.0 && w.passes(dt) < 1.5)
    warn(
        fmt::format("{:.2g} steps in the pass of a sector: forces of fewer than 1.5 swing; a "
                    "--reduced-step of at most {:.2g} s",
                    w.passes(dt), e.pass / 1.618));
  for (const rom::RingResidual& r : w.model.residuals)
    if (!r.made_static.empty())
      return warn(
          fmt::format("at {:.4g} rad/s the mesh is beyond the critical spin of harmonic {}: "
                      "the inertia of what no mode has is left out of {} harmonics",
                      e.spin, r.made_static.front(), r.made_static.size()));
}

constexpr JsonMember<Wheel> wheel_rows[] = {
    {"wheel_modes", "integer", "", "Number of modes of a reduced wheel made of the case",
     [](const Wheel& w) -> Json { return w.n_modes(); }},
    {"wheel_highest_mode", "number", "rad/s", "Angular frequency of its highest mode",
     [](const Wheel& w) -> Json { return w.highest(); }},
    {"wheel_sector_pass", "number or null", "s",
     "Time in which a sector passes at the largest spin; null: the wheel does not turn",
     [](const Wheel& w) { return w.expected.pass > 0.0 ? Json(w.expected.pass) : Json(); }},
    {"wheel_full_step", "number", "s", "Step of the full run",
     [](const Wheel& w) -> Json { return w.full_step; }},
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
    {"steps_pivoted", "integer", "", "Steps in which the contact law needed pivoting",
     [](const WheelEnd& e) -> Json { return e.f.pivoted; }},
    {"steps_not_converged", "integer", "", "Steps that missed the contact law by more than 1e-9",
     [](const WheelEnd& e) -> Json { return e.f.not_converged; }},
};
constexpr JsonMember<WheelEnd> wheel_end_rows[] = {
    {"wheel", "object", "", "Effort of the steps of a reduced wheel made of the case",
     [](const WheelEnd& e) { return object_of(effort_rows, e); },
     [] { return texts_of(effort_rows); }},
};

/// The loop, the files and the figures are those of motion in time; the steps are those of the
/// reduced wheel.
class WheelAnalysis final : public DynamicAnalysis {
 public:
  WheelAnalysis(const Case& c, const RunOptions& options) : DynamicAnalysis(c, options), case_(c) {
    Setup& setup = own_setup();
    refuse(c, options, setup);
    move_masses(c, setup);
    wheel_.full_step = setup.model.dt;
    wheel_.expected = expected(c, setup);
    setup.model.dt = step_of(options, wheel_.expected);
    setup.n_steps = count_steps(c, setup.model.dt);
    ring_.emplace(rom::ring_of(setup.model));
    wheel_.model = rom::make_wheel_model(*ring_, setup.model.motion, modes_of(options, setup));
    setup.reduced = fmt::format("a reduced wheel of {} modes with a step of {:.17g} s",
                                wheel_.n_modes(), setup.model.dt);
    setup.saved_numbers = rom::RingWheel::n_numbers(*ring_, wheel_.model);
    warn_of(setup, wheel_);
    plan_snapshots();
  }

  [[nodiscard]] CheckReport check(double trial) override {
    CheckReport r = DynamicAnalysis::check(trial);
    for (auto& [name, text] : r.lines)
      if (name == "integrator") text = "reduced wheel with exact contact";
    const double dt = setup().model.dt;
    r.lines.emplace_back("modes",
                         fmt::format("{}, up to {:.5g} rad/s", wheel_.n_modes(), wheel_.highest()));
    r.lines.emplace_back("step of the mesh", fmt::format("{:.4g} s, 1/{:.3g} of it",
                                                         wheel_.full_step, dt / wheel_.full_step));
    if (wheel_.expected.pass > 0.0)
      r.lines.emplace_back("steps in a pass",
                           fmt::format("{:.4g}, of a sector", wheel_.passes(dt)));
    return r;
  }
  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = DynamicAnalysis::warnings();
    all.insert(all.end(), wheel_.warnings.begin(), wheel_.warnings.end());
    return all;
  }
  [[nodiscard]] const Checkpoint* find(const std::filesystem::path& directory) override {
    const Checkpoint* found = DynamicAnalysis::find(directory);
    if (found && !rom::RingWheel::is_saved(*ring_, wheel_.model, found->state.ring))
      throw FileError((directory / checkpoint_name).string(),
                      "is damaged: its numbers are not those of a reduced wheel");
    return found;
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
    report.step_wall_s = wheel_.figures.wall_s;
    report.slowest_step = wheel_.figures.slowest_step_s / setup().model.dt;
  }

 protected:
  [[nodiscard]] bool guards_impacts() const noexcept override { return false; }
  [[nodiscard]] std::unique_ptr<dynamics::Integrator> make_integrator(
      dynamics::State& start) override {
    return std::make_unique<rom::WheelRun>(setup().model, *ring_, wheel_.model, wheel_.figures,
                                           start);
  }

 private:
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
    throw case_error(case_, "motion.angular_velocity",
                     stays ? "the tables of this reduced wheel are for a spin that stays"
                           : fmt::format("the tables of this reduced wheel are for spins up to "
                                         "{:.6g} rad/s",
                                         known),
                     "a table from the start that reaches the largest spin, e.g. [[0, w], [1, w]]");
  }

  const Case& case_;
  std::optional<rom::Ring> ring_;
  Wheel wheel_;
};

}  // namespace

std::unique_ptr<Analysis> make_wheel(const Case& c, const RunOptions& options) {
  if (c.analysis.kind != AnalysisKind::dynamic)
    throw case_error(c, "analysis.kind", "a reduced wheel of the case moves in time",
                     "\"dynamic\"; or this analysis of the mesh, without --reduced");
  return std::make_unique<WheelAnalysis>(c, options);
}

std::vector<MemberText> wheel_members() {
  return joined({texts_of(wheel_rows), texts_of(wheel_end_rows)});
}

}  // namespace rondo::study
