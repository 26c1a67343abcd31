// SPDX-License-Identifier: BSD-3-Clause
/// @file  Equilibrium of a wheel under the pressure of its air, its spin and the places of its rim,
/// at finite strain; all sectors deform alike. Newton's method in steps of the loads.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rondo/fem/finite/sector_energy.hpp"

namespace rondo::statics {

struct InflationLoads {
  fem::finite::SectorLoads sector;
  std::vector<Vec3> mounting;  ///< (n) displacements, read where they are given; empty: 0    [m]
  int steps = 5;               ///< in which all loads grow together
};

struct Inflation {
  bool found = false;      ///< also where it is not stable: see unstable_harmonic()
  double share = 0.0;      ///< of the loads that has an equilibrium; 1: all
  std::vector<Vec3> u;     ///< (n) at that share [m]
  std::vector<int> turns;  ///< of Newton's method in each step
  double residual = 0.0;   ///< largest force at a free node, over the largest reaction or load
  std::optional<std::size_t> inverted;  ///< quadrilateral inside out at the end of the last attempt
  fem::finite::SectorState state;       ///< at that share
};

/// The equilibria on the way to the loads, one after the other.
class InflationSteps {
 public:
  /// Both must outlive it.
  InflationSteps(const fem::finite::SectorEnergy& wheel, const InflationLoads& loads);
  ~InflationSteps();
  InflationSteps(const InflationSteps&) = delete;
  InflationSteps& operator=(const InflationSteps&) = delete;

  /// Goes on to the next equilibrium, at most one of `loads.steps` equal parts. False: it was not
  /// found, and now() is the last one.
  [[nodiscard]] bool advance();
  [[nodiscard]] const Inflation& now() const noexcept { return now_; }

 private:
  class Step;
  std::unique_ptr<Step> step_;
  int parts_ = 1;
  double size_ = 1.0;
  int halvings_ = 0;
  Inflation now_;
};

/// All steps.
[[nodiscard]] Inflation inflate(const fem::finite::SectorEnergy& wheel,
                                const InflationLoads& loads);

/// The lowest harmonic around the wheel in which the equilibrium is not stable, as seen by who
/// turns with it: K(k) - s² M P is not positive definite to round-off. A wheel that nothing holds
/// against a rigid motion is not. @param state in which no quadrilateral is
/// inverted, of this spin @param most the last harmonic that is looked at; < 0: all
[[nodiscard]] std::optional<int> unstable_harmonic(const fem::finite::SectorEnergy& wheel,
                                                   const fem::finite::SectorState& state,
                                                   double spin_squared, int most = -1);

}  // namespace rondo::statics
