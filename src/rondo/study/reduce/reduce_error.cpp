// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/reduce/reduce_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <system_error>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/integrators/start.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/rom/integrator.hpp"
#include "rondo/study/reduce/reduce_steady.hpp"

namespace rondo::study {
namespace {

/// Start of the averaging window, relative to the whole time.
constexpr double window = 0.75;

/// For a steady state, the modes start from its fields, so that nothing has to settle.
Setup setup_of(const Case& c, const io::RunReader& run) {
  if (!is_steady(run)) return build(c, 1);
  Setup setup = build(off_the_ground(c), 1);
  setup.model.motion = c.motion;
  run.read(io::Quantity::displacement, 0, 0, setup.displacement);
  run.read(io::Quantity::velocity, 0, 0, setup.velocity);
  return setup;
}

}  // namespace

std::optional<MeanForce> mean_force_of(const io::RunReader& run) {
  const std::filesystem::path file = run.directory() / "history.csv";
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return {};
  const auto columns = io::read_columns(file);
  const auto time = columns.find("time_s"), x = columns.find("force_x"),
             y = columns.find("force_y");
  if (time == columns.end() || x == columns.end() || y == columns.end() || time->second.empty())
    return {};
  MeanForce sum;
  double rows = 0.0;
  std::size_t first = 0;
  for (std::size_t k = 0; k < time->second.size(); ++k) {
    if (!is_steady(run) && time->second[k] <= window * time->second.back()) continue;
    if (rows == 0.0) first = k;
    sum.x += x->second[k];
    sum.y += y->second[k];
    rows += 1.0;
  }
  MeanForce mean{sum.x / rows, sum.y / rows};
  const auto lost = columns.find("dissipation_friction");
  if (is_steady(run) || lost == columns.end() || first == 0) return mean;
  mean.friction = (lost->second.back() - lost->second[first - 1]) /
                  (time->second.back() - time->second[first - 1]);
  return mean;
}

ForceErrors errors_of(const MeanForce& predicted, const MeanForce& own) noexcept {
  ForceErrors e{(predicted.x - own.x) / own.y, (predicted.y - own.y) / own.y};
  if (std::abs(own.x) >= least_share * own.y)
    e.x_of_itself = (predicted.x - own.x) / std::abs(own.x);
  if (own.friction > 0.0) e.friction_power = (predicted.friction - own.friction) / own.friction;
  return e;
}

MeanForce predicted_force(const Case& c, const rom::ReducedModel& model, const io::RunReader& run) {
  Setup setup = setup_of(c, run);
  dynamics::Model& full = setup.model;
  const double points =
      static_cast<double>(model.form == rom::ContactForm::nodes ? setup.mesh.boundary.size()
                                                                : model.contact.points.size());
  full.dt *= RunOptions{}.step_factor;
  if (const double spin = c.motion.angular_velocity.largest(); spin > 0.0)
    full.dt = std::min(full.dt, 2.0 * std::numbers::pi / points / spin);
  const long long steps = count_steps(c, full.dt);
  rom::StepFigures figures;
  rom::ReducedIntegrator integrator(
      {setup.mesh, full, model, figures},
      dynamics::start(full, std::move(setup.displacement), std::move(setup.velocity)));
  MeanForce sum;
  double counted = 0.0, lost = 0.0;
  std::array<dynamics::StepReport, 1> report;
  for (long long k = 1; k <= steps; ++k) {
    integrator.advance(report);
    if (static_cast<double>(k) <= window * static_cast<double>(steps)) continue;
    sum.x += report[0].contact.impulse.x / full.dt;
    sum.y += report[0].contact.impulse.y / full.dt;
    lost += report[0].contact.dissipation_friction / full.dt;
    counted += 1.0;
  }
  return {sum.x / counted, sum.y / counted, lost / counted};
}

}  // namespace rondo::study
