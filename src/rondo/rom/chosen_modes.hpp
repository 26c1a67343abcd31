// SPDX-License-Identifier: BSD-3-Clause
/// @file  Modes that are best in another norm than that of a decomposition (docs/reduced.md, 3).
#pragma once
#include "rondo/pod/decompose.hpp"

namespace rondo::rom {

/// Modes of what a decomposition holds, best in the norm ‖a‖² + ‖E a‖².
struct ChosenModes {
  Eigen::VectorXd sigma;  ///< (k) singular values in that norm, falling
  Eigen::MatrixXd
      modes;  ///< (rows, k) orthonormal in the norm of the decomposition, the first j of
              ///<     them spanning the j best
  /// (k + 1) energy, in the norm of the decomposition, that the first j modes leave out of all.
  Eigen::VectorXd left;
};

/// Without E, the decomposition's own modes. @param extra (m, found.modes.cols()) E times the modes
/// of the decomposition; m may be 0. @param most k at the most
[[nodiscard]] ChosenModes choose_modes(const pod::Decomposition& found,
                                       const Eigen::MatrixXd& extra, Eigen::Index most);

}  // namespace rondo::rom
