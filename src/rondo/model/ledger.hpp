// SPDX-License-Identifier: BSD-3-Clause
/// @file  Energy ledger of a run: closes to round-off at every step (docs/theory.md, section 5).
/// The integrators give the sums over the nodes of each step; the ledger accumulates and compares.
#pragma once
#include <array>
#include <span>

#include "rondo/core/sum.hpp"

namespace rondo::dynamics {

/// Works from the start to the half step n+1/2 [J/m].
struct Works {
  double frame = 0.0;    ///< inertia of the frame and gravity
  double contact = 0.0;  ///< = rim - friction - impact
  double dissipation_friction = 0.0;
  double loss_impact = 0.0;
  double load = 0.0;  ///< of pressures on the boundary
  double rim = 0.0;   ///< done by the rim against the ground's impulses
  double dissipation_mass = 0.0;
  double dissipation_stiffness = 0.0;
  double scheme = 0.0;  ///< work created by the scheme: 0 if symplectic; 10.5 for a loaded rim
  // The works below are of a loaded rim only (docs/theory.md, 10.5).
  double gravity = 0.0;   ///< on nodes and rim
  double rim_load = 0.0;  ///< of the forces on the center
  double torque = 0.0;    ///< of the torque on the rim
  double held = 0.0;      ///< of the reactions on the rim
  double dissipation_brake = 0.0;
  double dissipation_support = 0.0;
  /// Work where the two parts of the scheme "hati" are joined: round-off (docs/theory.md, 12.4)
  double interface = 0.0;
};

/// Sums over the nodes of the step at t_{n+1}: the energy before it, and its works [J/m].
struct StepEnergy {
  double kinetic = 0.0;  ///< ½ v_{n+1/2}ᵀ M v_{n+1/2}; with a loaded rim, of absolute velocities
  double strain = 0.0;   ///< ½ u_{n+1}ᵀ K u_n
  double kinetic_rim = 0.0;  ///< of a loaded rim
  double support = 0.0;      ///< energy of its springs
  Works works;               ///< works of this step alone
};

/// The balance at half step n+1/2.
struct Balance {
  double kinetic = 0.0;      ///< as in StepEnergy                                     [J/m]
  double strain = 0.0;       ///< ½ u_{n+1}ᵀ K u_n                                     [J/m]
  double kinetic_rim = 0.0;  ///< [J/m]
  double support = 0.0;      ///< [J/m]
  Works works;
  double residual = 0.0;   ///< E - E_{1/2} - works                                    [J/m]
  double exchanged = 0.0;  ///< largest |E| + Σ |works| so far                      [J/m]
  double otherwise = 0.0;  ///< largest |E_{1/2}| + Σ |works| so far without that of the scheme: the
                           ///< exchanged energy that the scheme did not create           [J/m]
  double relative = 0.0;  ///< largest |residual| / exchanged so far; includes the step's works
};

class Ledger {
 public:
  /// Compares the energy before the step with the works so far, then adds the works of the step.
  void add(const StepEnergy& step) noexcept;
  /// The two parts of add(), for a scheme that knows energies at the ends of its steps. compare()
  /// does not read the works.
  /// @param to_come energy that the step exchanges, which is part of the scale: if nothing was
  /// exchanged before, the energy is the round-off of this                           [J/m]
  void compare(const StepEnergy& energy, double to_come = 0.0) noexcept;
  void add_works(const Works& step) noexcept;

  /// The balance at the half step before the step that was added last.
  [[nodiscard]] const Balance& last() const noexcept { return balance_; }

  /// The complete memory: a ledger restored from these numbers gives bitwise the same results. Of
  /// last(), only the largest values are included.
  static constexpr std::size_t n_works = 16;
  static constexpr std::size_t n_numbers = 2 * n_works + 5;
  [[nodiscard]] std::array<double, n_numbers> save() const noexcept;
  void restore(std::span<const double, n_numbers> numbers) noexcept;

 private:
  std::array<CompensatedSum, n_works> works_;
  double start_ = 0.0;
  bool started_ = false;
  Balance balance_;
};

}  // namespace rondo::dynamics
