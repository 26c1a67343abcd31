// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/reduced/estimate_wheel.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/reduced/prepare_wheel.hpp"
#include "rondo/integrators/start.hpp"

namespace rondo::study {
namespace {

/// Start of the means, over the whole time.
constexpr double window = 0.75;

/// A mean F_x that is a smaller share of F_y is a difference of larger forces: no error is told by
/// it.
constexpr double least_share = 1e-3;

struct Means {
  double x = 0.0, y = 0.0;  ///< force of the ground                                     [N/m]
  double friction = 0.0;    ///< power that friction takes                               [W/m]
  double lateral = 0.0, aligning = 0.0;  ///< in three dimensions                    [N], [N m]
};

/// None: the run was to stop.
std::optional<Means> means_of(const Case& c, const RunOptions& options) {
  Setup setup = build(c, 1, nullptr, Steps::of_reduced_wheel);
  PreparedWheel wheel;
  prepare_wheel(c, options, {}, setup, wheel);
  const dynamics::Model& model = setup.model;
  const dynamics::State start =
      dynamics::start(model, setup.displacement, setup.velocity, setup.half_velocity);
  const std::unique_ptr<dynamics::Integrator> run = make_steps(setup, wheel, start);
  Means sum;
  double counted = 0.0;
  std::array<dynamics::StepReport, 1> report;
  for (long long k = 1; k <= setup.n_steps; ++k) {
    if (options.stop && options.stop->load()) return {};
    run->advance(report);
    if (static_cast<double>(k) <= window * static_cast<double>(setup.n_steps)) continue;
    sum.x += report[0].contact.impulse.x / model.dt;
    sum.y += report[0].contact.impulse.y / model.dt;
    sum.friction += report[0].contact.dissipation_friction / model.dt;
    sum.lateral += report[0].contact.impulse.z / model.dt;
    sum.aligning += report[0].contact.moment_aligning / model.dt;
    counted += 1.0;
  }
  return Means{sum.x / counted, sum.y / counted, sum.friction / counted, sum.lateral / counted,
               sum.aligning / counted};
}

ForceErrors difference(const Means& of, const Means& from) {
  ForceErrors e{(of.x - from.x) / from.y, (of.y - from.y) / from.y,
                (of.lateral - from.lateral) / from.y, (of.aligning - from.aligning) / from.y};
  if (std::abs(from.x) >= least_share * from.y) e.x_of_itself = (of.x - from.x) / std::abs(from.x);
  if (from.friction > 0.0) e.friction_power = (of.friction - from.friction) / from.friction;
  return e;
}

}  // namespace

ForceErrors WheelEstimate::larger() const noexcept {
  const auto most = [](double a, double b) { return std::fmax(std::abs(a), std::abs(b)); };
  return {most(step.x, modes.x),
          most(step.y, modes.y),
          most(step.lateral, modes.lateral),
          most(step.aligning, modes.aligning),
          most(step.x_of_itself, modes.x_of_itself),
          most(step.friction_power, modes.friction_power)};
}

WheelEstimate estimate_wheel(const Case& c, const RunOptions& options, double step, int n_modes) {
  RunOptions own = options;
  if (own.reduced == wheel_of_case) own.reduced_modes = n_modes;
  own.reduced_step = step;
  RunOptions finer = own, richer = own;
  finer.reduced_step = 0.5 * step;
  richer.reduced = wheel_of_case;
  richer.reduced_modes = n_modes > 0 ? 2 * n_modes : 10;
  WheelEstimate e;
  if (c.mesh && *richer.reduced_modes > most_modes_of_mesh)
    return {fmt::format("twice {} modes are more than the {} that a mesh without equal sectors may "
                        "have",
                        n_modes, most_modes_of_mesh),
            {},
            {}};
  std::array<Means, 3> means;
  std::size_t k = 0;
  for (const RunOptions* with : {&own, &finer, &richer}) {
    const std::optional<Means> found = means_of(c, *with);
    if (!found) return {"interrupted", {}, {}};
    means[k++] = *found;
  }
  for (const Means& of : means)
    if (!(of.y > 0.0)) return {"nothing presses the ground in the last quarter of the run", {}, {}};
  e.step = difference(means[0], means[1]);
  e.modes = difference(means[0], means[2]);
  return e;
}

std::string in_words(const WheelEstimate& e) {
  if (!e.none.empty()) return "none: " + e.none;
  const auto percent = [](double error) {
    return std::isnan(error) ? std::string("not known") : fmt::format("{:.2g} %", 100.0 * error);
  };
  const ForceErrors most = e.larger();
  const std::string aside =
      most.lateral == 0.0 && most.aligning == 0.0
          ? std::string()
          : fmt::format(" lateral force {:.2g} % of F_y, aligning moment {:.2g} mm of F_y;",
                        100.0 * most.lateral, 1e3 * most.aligning);
  return fmt::format(
      "F_x {:.2g} %, F_y {:.2g} % of F_y;{} over themselves F_x {}, friction power {} (half the "
      "step "
      "changes F_x by {:.2g} %, twice the modes by {:.2g} %)",
      100.0 * most.x, 100.0 * most.y, aside, percent(most.x_of_itself),
      percent(most.friction_power), 100.0 * std::abs(e.step.x), 100.0 * std::abs(e.modes.x));
}

}  // namespace rondo::study
