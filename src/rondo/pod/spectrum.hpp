// SPDX-License-Identifier: BSD-3-Clause
/// @file  Evaluation of a spectrum: energies, numbers of modes, errors (docs/theory.md, 7.2).
#pragma once
#include <functional>
#include <vector>

#include "rondo/pod/decompose.hpp"

namespace rondo::pod {

/// Shares of the energy ‖A‖²; all 0 if that is 0.
struct Spectrum {
  std::vector<double> energy;      ///< (k) σ_i² / ‖A‖²
  std::vector<double> cumulative;  ///< (k) sum over the modes up to i
  std::vector<double> discarded;   ///< (k) sum over the modes after i: of the tail itself, not
                                   ///<     1 minus a sum, with the truncated part
};

[[nodiscard]] Spectrum spectrum(const Decomposition& d);

/// Smallest number of modes that leave at most `share` of the energy; -1: more than exist.
[[nodiscard]] Index modes_for(const Spectrum& s, double share);

/// The error identity ‖A - U_r U_rᵀ A‖² = Σ_{i>r} σ_i², its left side from snapshots read again.
/// The right side includes the truncated part; the left may be smaller by at most that.
struct Identity {
  Index modes = 0;                      ///< r
  double residual = 0.0;                ///< left side, share of the energy
  double tail = 0.0;                    ///< right side, share of the energy
  double difference = 0.0;              ///< |left - right|, share of the energy
  double orthonormality = 0.0;          ///< max |UᵀU - I|
  std::vector<double> snapshot_energy;  ///< (columns) ‖a_j‖²
  std::vector<double> squared_error;    ///< (columns) ‖a_j - U_r U_rᵀ a_j‖²
  /// (fewer.size()) arrays of (columns): ‖a_j - U_q U_qᵀ a_j‖² with the first q modes
  std::vector<std::vector<double>> fewer_error;
};

struct IdentityOptions {
  Index block = 32;                         ///< columns per block read
  std::vector<Index> fewer;                 ///< the values of q for fewer_error, each 0 to r
  std::function<void(long long)> progress;  ///< numbers read since the last call; may be empty
};

/// Checks all modes kept, reading the snapshots once. The result is valid for any method, because
/// it uses nothing of σ and V except the tail.
[[nodiscard]] Identity check_identity(SnapshotMatrix& snapshots, const Decomposition& d,
                                      const IdentityOptions& options = {});

}  // namespace rondo::pod
