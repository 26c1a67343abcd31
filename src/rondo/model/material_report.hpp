// SPDX-License-Identifier: BSD-3-Clause
/// @file  Energies of rubber that are reported in addition to those of the ledger.
#pragma once

namespace rondo::dynamics {

/// Energies of rubber at t_{n+1}, accumulated since the start (docs/rubber.md, section 3).
struct MaterialReport {
  double internal_work = 0.0;        ///< A: work done against the internal forces           [J/m]
  double stored_energy = 0.0;        ///< U of the elements, including branches              [J/m]
  double window_work = 0.0;          ///< W: by the motion of a window of nonlinear rubber   [J]
  double dissipation_viscous = 0.0;  ///< of the branches                                 [J/m]
  double least_volume = 1.0;         ///< smallest det F; <= 0: an element is inverted     [-]

  /// Error of the integration, A + W - ΔU - D, of second order in Δt                         [J/m]
  [[nodiscard]] double integration() const noexcept {
    return internal_work + window_work - stored_energy - dissipation_viscous;
  }
  /// That over the energy exchanged; 0 where nothing is but rounding.
  [[nodiscard]] double relative_integration(double exchanged) const noexcept {
    constexpr double rounding = 1e-14;  // J, J/m
    return exchanged > rounding ? integration() / exchanged : 0.0;
  }
};

}  // namespace rondo::dynamics
