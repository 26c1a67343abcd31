// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a spectrum says: energies, numbers of modes, errors (docs/theory.md, 7.2).
#pragma once
#include <vector>

#include "rondo/reduction/decompose.hpp"

namespace rondo::reduction {

/// Shares of the energy ‖A‖²; all 0 where that is 0.
struct Spectrum {
  std::vector<double> energy;      ///< (k) σ_i² / ‖A‖²
  std::vector<double> cumulative;  ///< (k) of the modes up to i
  std::vector<double> discarded;   ///< (k) of the modes after i: the sum of the tail itself, not
                                   ///<     1 minus a sum, with what was truncated
};

[[nodiscard]] Spectrum spectrum(const Decomposition& d);

/// Least number of modes that leave at most `share` of the energy; -1: more than there are.
[[nodiscard]] Index modes_for(const Spectrum& s, double share);

/// (columns) ‖a_j - U_r U_rᵀ a_j‖² from σ and V, for the first r = `modes` modes. Without what an
/// incremental decomposition truncated.
[[nodiscard]] std::vector<double> squared_errors(const Decomposition& d, Index modes);

/// The error identity ‖A - U_r U_rᵀ A‖² = Σ_{i>r} σ_i², its left side from the snapshots read anew.
/// The right side holds what was truncated; the left is then the smaller one, by at most that.
struct Identity {
  Index modes = 0;                      ///< r
  double residual = 0.0;                ///< left side, share of the energy
  double tail = 0.0;                    ///< right side, share of the energy
  double difference = 0.0;              ///< |left - right|, share of the energy
  double orthonormality = 0.0;          ///< max |UᵀU - I|
  std::vector<double> snapshot_energy;  ///< (columns) ‖a_j‖²
  std::vector<double> squared_error;    ///< (columns) ‖a_j - U_r U_rᵀ a_j‖²
};

/// For all modes kept. Reads the snapshots once, `block` columns at a time.
[[nodiscard]] Identity check_identity(SnapshotMatrix& snapshots, const Decomposition& d,
                                      Index block = 32);

}  // namespace rondo::reduction
