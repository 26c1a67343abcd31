// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/make_wheel_model.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "rondo/core/index.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/rom/solid/solid_residual.hpp"

namespace rondo::rom {
namespace {

Vec2 in_plane(Vec2 x) noexcept {
  return x;
}
Vec2 in_plane(Vec3 x) noexcept {
  return x.plane();
}

/// All but the tables.
template <int D>
WheelModel begin_model(const SectorRing<D>& ring, std::vector<RingHarmonic> harmonics,
                       const WheelViscosity& viscosity) {
  WheelModel wheel;
  wheel.harmonics = std::move(harmonics);
  for (const auto& x : ring.place) wheel.radius = std::max(wheel.radius, norm(in_plane(x)));
  wheel.branches = viscosity.branches;
  if (!wheel.branches.empty())
    wheel.creep = creep_terms(wheel.branches, viscosity.stiffness_damping);
  return wheel;
}

/// Finds the tables of a wheel: one for a spin that stays; else three between 0 and the largest,
/// where a polynomial in s² errs least (Chebyshev). @param residual by s²
void spread_residuals(const KnownSpins& spins, WheelModel& wheel,
                      const std::function<CreepResidual(double)>& residual) {
  const auto keep = [&](CreepResidual of) {
    wheel.residuals.push_back(std::move(of.at_once));
    if (!wheel.creep.empty()) wheel.later.push_back(std::move(of.later));
    wheel.one_matrix = std::move(of.one_matrix);
  };
  if (!spins.change || spins.most == 0.0) {
    wheel.largest_spin = spins.least;
    wheel.squares = {spins.least * spins.least};
    keep(residual(wheel.squares[0]));
    return;
  }
  const auto place = [](double most, int i) {
    return 0.5 * most * most * (1.0 - std::cos(std::numbers::pi * (2 * i + 1) / 6.0));
  };
  double most = spins.most;
  CreepResidual last = residual(place(most, 2));
  while (!last.at_once.made_static.empty() && most > spins.least) {
    most = std::max(spins.least, 0.9 * most);
    last = residual(place(most, 2));
  }
  wheel.largest_spin = most;
  for (int i = 0; i < 3; ++i) wheel.squares.push_back(place(most, i));
  for (int i = 0; i < 2; ++i) keep(residual(wheel.squares[at(i)]));
  keep(std::move(last));
}

}  // namespace

WheelModel make_wheel_model(const Ring& ring, std::vector<RingHarmonic> harmonics,
                            const KnownSpins& spins, const WholeMesh* whole,
                            const WheelViscosity& viscosity) {
  const OneBlasThread one;
  WheelModel wheel = begin_model(ring, std::move(harmonics), viscosity);
  spread_residuals(spins, wheel, [&](double square) -> CreepResidual {
    if (whole) {
      const RingResidual still = whole_residual(ring, *whole, wheel.harmonics, square);
      return {still, wheel.creep.empty() ? RingResidual{} : still, {}};
    }
    if (wheel.creep.empty())
      return {ring_residual(ring, wheel.harmonics, square, ResidualForm::convected), {}, {}};
    return creep_residual(ring, wheel.harmonics, square, wheel.creep);
  });
  return wheel;
}

WheelModel make_solid_model(const SolidRing& ring, std::vector<RingHarmonic> harmonics,
                            const KnownSpins& spins, const WheelViscosity& viscosity) {
  const OneBlasThread one;
  WheelModel wheel = begin_model(ring, std::move(harmonics), viscosity);
  spread_residuals(spins, wheel, [&](double square) -> CreepResidual {
    if (wheel.creep.empty()) return {solid_residual(ring, wheel.harmonics, square), {}, {}};
    return solid_creep_residual(ring, wheel.harmonics, square, wheel.creep);
  });
  return wheel;
}

}  // namespace rondo::rom
