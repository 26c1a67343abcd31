// SPDX-License-Identifier: BSD-3-Clause
/// @file  How a wheel stands on the ground, as `rondo modes --standing` reports it.
#pragma once

namespace rondo::study {

struct Standing {
  double height = 0.0;  ///< of the center above the ground [m]
  double load = 0.0;    ///< of the ground, along its normal, without friction [N]
  int nodes = 0;        ///< that touch
};

}  // namespace rondo::study
