// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/rubber_step.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "rondo/fem/hyperelastic/hyperelasticity.hpp"

namespace rondo::study {
namespace {

std::vector<fem::Hyperelasticity::History> histories_of(const dynamics::SavedState& now) {
  std::vector<fem::Hyperelasticity::History> histories;
  for (std::size_t i = 0; i < now.branches.size(); i += 3)
    histories.push_back({now.branches[i], now.branches[i + 1], now.branches[i + 2]});
  return histories;
}

/// Row sums of M^-½ K M^-½: no eigenvalue is above the largest (Gershgorin) [1/s²].
double row_sum_bound(const fem::BlockCsr& k, std::span<const double> mass,
                     std::span<const int> free) {
  double largest = 0.0;
  for (const int node : free) {
    const auto row = static_cast<std::size_t>(node);
    double x = 0.0, y = 0.0;
    for (auto b = k.row_start[row]; b < k.row_start[row + 1]; ++b) {
      const auto at = static_cast<std::size_t>(b);
      const auto [xx, yx, xy, yy] = k.values[at];
      const double scale =
          1.0 / std::sqrt(mass[row] * mass[static_cast<std::size_t>(k.column[at])]);
      x += scale * (std::abs(xx) + std::abs(xy));
      y += scale * (std::abs(yx) + std::abs(yy));
    }
    largest = std::max({largest, x, y});
  }
  return largest;
}

}  // namespace

double critical_step_now(const Setup& setup, const dynamics::SavedState& now) {
  const dynamics::Model& m = setup.model;
  const fem::BlockCsr k = setup.rubber->tangent(now.u, histories_of(now));
  const dynamics::LaggedDamping damping{m.stiffness_damping, m.rim ? m.mass_damping : 0.0};
  const dynamics::CriticalStep found = dynamics::critical_step(
      k, m.mass, m.free, damping, row_sum_bound(k, m.mass, m.free), m.threads);
  return found.converged ? found.step : std::numeric_limits<double>::infinity();
}

bool RubberStepWatch::is_due(long long step, double strain) noexcept {
  constexpr long long steps = 2000;
  constexpr double growth = 0.05;
  if (step % steps != 0 && strain < strain_ + growth) return false;
  strain_ = strain;
  return true;
}

std::string RubberStepWatch::look(const Setup& setup, const dynamics::SavedState& now) {
  const double critical = critical_step_now(setup, now), dt = setup.model.dt;
  if (dt <= critical) return {};
  return fmt::format(
      "the step {:.6g} s is above the critical step {:.6g} s of the body as it is deformed now "
      "({:.6g} s undeformed): time.safety or time.step so much smaller, or less load",
      dt, critical, setup.critical.step);
}

}  // namespace rondo::study
