// SPDX-License-Identifier: BSD-3-Clause
/// @file  Modes that are optimal in another norm than that of a decomposition (docs/reduced.md, 3).
#pragma once
#include "rondo/pod/decompose.hpp"

namespace rondo::rom {

/// Modes in the span of a decomposition that are optimal in the norm ‖a‖² + ‖E a‖².
struct ChosenModes {
  Eigen::VectorXd sigma;  ///< (k) singular values in that norm, descending
  Eigen::MatrixXd
      modes;  ///< (rows, k) orthonormal in the norm of the decomposition; the first j of
              ///<     them span the j optimal modes
  /// (k + 1) energy outside the first j modes, in the norm of the decomposition.
  Eigen::VectorXd left;
};

/// Without E, the decomposition's own modes. @param extra (m, found.modes.cols()) E times the modes
/// of the decomposition; m may be 0. @param most largest k
[[nodiscard]] ChosenModes choose_modes(const pod::Decomposition& found,
                                       const Eigen::MatrixXd& extra, Eigen::Index most);

}  // namespace rondo::rom
