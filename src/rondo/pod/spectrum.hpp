// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a spectrum says: energies, numbers of modes, errors (docs/theory.md, 7.2).
#pragma once
#include <functional>
#include <vector>

#include "rondo/pod/decompose.hpp"

namespace rondo::pod {

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
  /// (fewer.size()) of (columns): ‖a_j - U_q U_qᵀ a_j‖² of the first q modes
  std::vector<std::vector<double>> fewer_error;
};

struct IdentityOptions {
  Index block = 32;                         ///< columns read at once
  std::vector<Index> fewer;                 ///< the q of fewer_error, each 0 to r
  std::function<void(long long)> progress;  ///< numbers read since the last call; may be empty
};

/// For all modes kept. Reads the snapshots once. What it says holds for any method: nothing of it
/// is taken from σ or V but the tail.
[[nodiscard]] Identity check_identity(SnapshotMatrix& snapshots, const Decomposition& d,
                                      const IdentityOptions& options = {});

}  // namespace rondo::pod
