// SPDX-License-Identifier: BSD-3-Clause
/// @file  All data that a reduced integrator carries from one step to the next, bit for bit:
/// another one with the same model, case and step resumes from it with bitwise the same results.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/model/ledger.hpp"

namespace rondo::rom {

/// Contact points at one phase of the disk. Their Delassus blocks are computed for some points at a
/// time, and the last bits of a product depend on how many: restore computes the same portions.
struct SavedPhase {
  double share = 0.0;                      ///< in sectors
  std::int64_t used = 0;                   ///< step of the last use
  std::vector<std::vector<int>> portions;  ///< points of each prepare(), in order
};

struct SavedContact {
  std::int64_t steps = 0;
  std::vector<std::pair<int, Vec2>> impulses;  ///< by material: of the previous step      [N·s/m]
  std::vector<SavedPhase> phases;
};

/// State of a free rim in addition to the modes, counter-clockwise.
struct SavedRim {
  /// Sums and corrections of x, y, angle; center; velocities (3); spin one step before; spin of the
  /// matrices; turn and travel of the last step (2).
  std::array<double, 16> numbers{};
  std::vector<double> displacement_before, late;  ///< (r); the first is empty if no step was made
};

struct SavedReducedState {
  std::int64_t step = 0;  ///< the last step made
  /// (r) coefficients of displacement and velocity at its end; velocity half a step before, and
  /// before the push.
  std::vector<double> displacement, velocity, velocity_middle, velocity_carried;
  /// Spins and rate of the present matrices (StepMatrixKey: carry, spin, spin_rate); none: no step
  /// was made.
  std::optional<std::array<double, 3>> matrices;
  std::optional<SavedContact> contact;  ///< none: no ground
  std::optional<SavedRim> rim;          ///< none: [motion] drives the rim
  std::array<double, dynamics::Ledger::n_numbers> ledger{};
};

}  // namespace rondo::rom
