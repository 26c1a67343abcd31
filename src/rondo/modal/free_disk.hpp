// SPDX-License-Identifier: BSD-3-Clause
/// @file  Harmonic 0 of a spinning free disk, for which K' is indefinite (docs/theory.md, 8.5).
#pragma once
#include <vector>

#include "rondo/modal/harmonic_problem.hpp"

namespace rondo::modal {

struct RotationalRoots {
  std::vector<HarmonicRoot> vibrations;  ///< ω > 0, ascending
  HarmonicRoot rotation;
  double growth = 0.0;  ///< of the rotation, > 0 if nothing restrains it [1/s]
};

/// Uses a dense eigensolver for unsymmetric matrices.
/// @param a A' = A(0) - s², as HarmonicProblem::dense_rotational() gives it. @param spin s ≠ 0
RotationalRoots rotational_roots(const Eigen::MatrixXd& a, double spin);

}  // namespace rondo::modal
