// SPDX-License-Identifier: BSD-3-Clause
/// @file  Finds the tables of a reduced wheel, by its modes and for the spins of a run.
#pragma once
#include <vector>

#include "rondo/rom/solid/solid_ring.hpp"
#include "rondo/rom/wheel/base/wheel_model.hpp"
#include "rondo/rom/wheel/whole_mesh.hpp"

namespace rondo::rom {

/// Spins up to which the residual of a wheel is to be known [rad/s].
struct KnownSpins {
  double least = 0.0;
  double most = 0.0;    ///< where no spin up to it is critical
  bool change = false;  ///< false: the spin is always `least`, or its opposite
};
/// What a viscous material adds to the model of a wheel.
struct WheelViscosity {
  std::vector<fem::ViscousBranch> branches{};  ///< the same ones in all of the body; none: elastic
  double stiffness_damping = 0.0;              ///< β beside them [s]
};

/// @param whole of a ring of one sector (whole_mesh.hpp); of others null
[[nodiscard]] WheelModel make_wheel_model(const Ring& ring, std::vector<RingHarmonic> harmonics,
                                          const KnownSpins& spins, const WholeMesh* whole = nullptr,
                                          const WheelViscosity& viscosity = {});
[[nodiscard]] WheelModel make_solid_model(const SolidRing& ring,
                                          std::vector<RingHarmonic> harmonics,
                                          const KnownSpins& spins,
                                          const WheelViscosity& viscosity = {});

}  // namespace rondo::rom
