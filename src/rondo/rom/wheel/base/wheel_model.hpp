// SPDX-License-Identifier: BSD-3-Clause
/// @file  Modes and tables of a reduced wheel, in the plane and in three dimensions.
#pragma once
#include <vector>

#include "rondo/fem/rubber.hpp"
#include "rondo/rom/wheel/creep/creep.hpp"
#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

/// What the steps of a wheel need that is found once.
struct WheelModel {
  std::vector<RingHarmonic> harmonics;
  std::vector<double> squares;          ///< s² of the residuals: one, or three between which they
                                        ///< are interpolated [1/s²]
  std::vector<RingResidual> residuals;  ///< at these
  double largest_spin = 0.0;            ///< up to which these are good                    [rad/s]
  double radius = 0.0;                  ///< largest |X| [m]
  // A body whose material has viscous branches, the same ones everywhere, has these; others have
  // none.
  std::vector<fem::ViscousBranch> branches{};
  std::vector<CreepTerm> creep{};     ///< of these and of the stiffness damping
  std::vector<RingResidual> later{};  ///< at `squares`: CreepResidual::later
  std::vector<int> one_matrix{};      ///< CreepResidual::one_matrix of the largest spin
};

}  // namespace rondo::rom
