// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/reduced/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/elements/combinations.hpp"
#include "rondo/core/error.hpp"

namespace rondo::study {

bool sees_velocities_alone(const ReducedRun& run) {
  return run.file.model.form == rom::ContactForm::nodes && run.scheme == rom::StepScheme::central;
}

void add_said(std::string warning, std::vector<std::string>& warnings) {
  if (!warning.empty()) warnings.push_back(std::move(warning));
}

double points_passed(const Setup& setup, double turned, const ReducedRun& run) {
  const rom::ReducedModel& m = run.file.model;
  const bool standing = m.form != rom::ContactForm::nodes;
  // Nodes of a tread are not evenly spaced; in the mean they are.
  const double points =
      static_cast<double>(standing ? m.contact.points.size() : setup.mesh.boundary.size());
  return turned * points / (2.0 * std::numbers::pi);
}

std::string passed_points(const Case& c, const Setup& setup, double spin, const ReducedRun& run) {
  const double passed = points_passed(setup, spin * setup.model.dt, run);
  if (!c.ground || passed <= 1.0) return {};
  return fmt::format(
      "--step-factor: the disk turns by {:.3g} contact points in a step; contact needs at most 1, "
      "a factor of {:.3g}",
      passed, run.step_factor / passed);
}

namespace {

/// Names of the command line.
constexpr std::array<std::pair<const char*, rom::StepScheme>, 2> step_names{
    {{"midpoint", rom::StepScheme::midpoint}, {"explicit", rom::StepScheme::central}}};

constexpr std::array<std::pair<const char*, bool>, 2> snapshot_names{
    {{"fields", true}, {"modes", false}}};

template <class Names>
bool is_known(const Names& names, const std::string& name) {
  return std::ranges::any_of(names, [&](const auto& known) { return name == known.first; });
}

void check_case(const Case& c, const RunOptions& options, const Setup& setup) {
  if (options.resume)
    throw request_error("--resume", "",
                        "a reduced run keeps no checkpoints, it is too short for them",
                        "--overwrite to run it again, or another -o");
  if (!(options.step_factor > 0.0 && std::isfinite(options.step_factor)))
    throw request_error("--step-factor", fmt::format("{:.9g}", options.step_factor),
                        "not a factor for the step of the full run", "a number above 0, e.g. 20");
  if (!is_known(step_names, options.reduced_step))
    throw request_error("--reduced-step", options.reduced_step, "no such step",
                        "midpoint or explicit");
  if (!is_known(snapshot_names, options.reduced_snapshots))
    throw request_error("--snapshots", options.reduced_snapshots, "no such snapshots",
                        "fields or modes");
  refuse_combinations(c, setup.model, dynamics::has::reduced | dynamics::has::model_of_runs);
}

void check_model(const Case& c, const RunOptions& options, const ReducedFile& file,
                 const Setup& setup) {
  const std::string difference = body_difference(body_text(c), file.body);
  if (!difference.empty())
    throw request_error(
        "--reduced", options.reduced.string(),
        fmt::format("the model has another mesh or material: the case has {} of the model",
                    difference),
        "a model built from runs of this mesh and material (rondo reduce)");
  const bool same =
      file.mesh.n_nodes() == setup.mesh.n_nodes() &&
      file.mesh.coordinates == setup.mesh.coordinates &&
      file.mesh.boundary == setup.mesh.boundary && file.mesh.n_sectors == setup.mesh.n_sectors &&
      file.mesh.sector == setup.mesh.sector && file.mesh.sector_node == setup.mesh.sector_node &&
      file.mass == setup.model.mass;
  if (!same)
    throw request_error("--reduced", options.reduced.string(),
                        "the mesh in the model is not the one this program makes of the case",
                        "a model built anew by this version (rondo reduce)");
}

void check_impacts(const Case& c, const ReducedRun& run) {
  if (!c.ground || c.ground->impact == contact::Impact::moreau || sees_velocities_alone(run))
    return;
  throw case_error(c, "ground.impact",
                   "in a reduced run impacts of this law may create energy, except with contact at "
                   "nodes and explicit steps",
                   "\"moreau\", or a model of rondo reduce --contact nodes and "
                   "--reduced-step explicit");
}

void refuse_estimate(const RunOptions& options) {
  if (options.reduced_estimate)
    throw request_error("--estimate", "", "is of a wheel that is made of the case",
                        "--reduced without a file; rondo reduce estimates the errors of a model");
}

void refuse_rim(const Case& c) {
  if (!c.rim) return;
  throw case_error(c, "rim", "the rim of a model of runs follows the tables of [motion]",
                   "--reduced without a file: a wheel that is made of the case");
}

/// Warns by what the motion says before the run.
void warn_of_range(const Case& c, const Setup& setup, ReducedRun& run) {
  const ModelRanges& built = run.file.ranges;
  ModelRanges wanted;
  if (c.ground) wanted.friction.take(c.ground->friction);
  constexpr long long most = 10000;
  const long long samples = std::min(most, setup.n_steps);
  for (long long k = 0; k <= samples; ++k) {
    const double t = c.time.end * static_cast<double>(k) / static_cast<double>(samples);
    wanted.angular_velocity.take(c.motion.angular_velocity.at(t));
    wanted.speed.take(c.motion.speed.at(t));
    wanted.height.take(c.motion.height.at(t));
    wanted.slip_ratio.take(slip_ratio_at(c, t));
  }
  const auto check = [&](const char* what, ModelRange ModelRanges::*range, double scale = 0.0) {
    add_said(outside(what, built.*range, wanted.*range, scale), run.warnings);
  };
  check("ground.friction", &ModelRanges::friction);
  check("motion.angular_velocity", &ModelRanges::angular_velocity);
  check("motion.speed", &ModelRanges::speed);
  check("motion.height", &ModelRanges::height);
  check("the slip ratio", &ModelRanges::slip_ratio, 1.0);
  if (c.ground && built.friction.empty())
    run.warnings.emplace_back(
        "the model was built from runs without ground: its modes contain no contact");
}

/// The step that is asked for; where nodes come by at a constant spin, so much less that a whole
/// number of steps goes to a sector: the phases of the disk are then as many, and known.
double step_of(const Case& c, const Setup& setup, const ReducedRun& run) {
  const double dt = run.full_step * run.step_factor;
  const dynamics::Table& spin = c.motion.angular_velocity;
  const bool phases = c.ground && run.file.model.form == rom::ContactForm::nodes &&
                      run.file.model.frame == rom::ModelFrame::rectified;
  if (!phases || spin.points().size() != 1 || spin.largest() == 0.0) return dt;
  const double sector = 2.0 * std::numbers::pi / setup.mesh.n_sectors / spin.largest();
  return dt < sector ? sector / std::ceil(sector / dt * (1.0 - 1e-9))
                     : sector * std::floor(dt / sector * (1.0 + 1e-9));
}

/// Central differences have a limit.
void check_step(const Case& c, const ReducedRun& run, double dt) {
  if (run.scheme != rom::StepScheme::central) return;
  const double limit = rom::critical_step(run.file.model, c.damping.stiffness);
  if (dt <= c.time.safety * limit) return;
  throw request_error(
      "--step-factor", fmt::format("{:.6g}", run.step_factor),
      fmt::format("a step of {:.6g} s; the explicit step is stable up to {:.6g} s with these modes",
                  dt, limit),
      fmt::format("up to {:.4g} with time.safety = {:.6g}, or --reduced-step midpoint",
                  c.time.safety * limit / run.full_step, c.time.safety));
}

/// Start that the modes do not hold.
void warn_of_start(const Setup& setup, ReducedRun& run) {
  rom::Lift lift(setup.mesh, run.file.model);
  const auto check = [&](std::span<const Vec2> field, const char* name) {
    double all = 0.0;
    for (std::size_t i = 0; i < field.size(); ++i)
      all += setup.model.mass[i] * dot(field[i], field[i]);
    if (all == 0.0) return;
    const double inside = lift.restrict_to_modes(0.0, field, setup.model.mass).squaredNorm();
    const double left = std::sqrt(std::max(0.0, 1.0 - inside / all));
    if (left > 0.01)
      run.warnings.push_back(fmt::format(
          "[initial]: the modes represent all but {:.2g} % of the initial {}", 100.0 * left, name));
  };
  check(setup.displacement, "displacement");
  check(setup.velocity, "velocity");
}

}  // namespace

ReducedRun prepare_reduced(const Case& c, const RunOptions& options, Setup& setup) {
  check_case(c, options, setup);
  ReducedRun run;
  run.file = read_reduced_file(options.reduced);
  check_model(c, options, run.file, setup);
  for (const auto& [name, scheme] : step_names)
    if (options.reduced_step == name) run.scheme = scheme;
  for (const auto& [name, lifts] : snapshot_names)
    if (options.reduced_snapshots == name) run.lifts = lifts;
  check_impacts(c, run);
  refuse_estimate(options);
  refuse_rim(c);
  run.step_factor = options.step_factor;
  run.full_step = setup.model.dt;
  run.constant_spin = c.motion.angular_velocity.points().size() == 1;
  setup.model.dt = step_of(c, setup, run);
  run.step_factor = setup.model.dt / run.full_step;
  check_step(c, run, setup.model.dt);
  setup.n_steps = count_steps(c, setup.model.dt);
  warn_of_range(c, setup, run);
  add_said(passed_points(c, setup, c.motion.angular_velocity.largest(), run), run.warnings);
  warn_of_start(setup, run);
  return run;
}

}  // namespace rondo::study
