// SPDX-License-Identifier: BSD-3-Clause
/// @file  What is told of the equilibrium of a wheel with [inflation].
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace rondo::study {

/// The cords of a layer in an equilibrium.
struct CordFigures {
  std::string curve;
  double force_min = 0.0, force_max = 0.0;  ///< [N]
  double stretch_min = 1.0, stretch_max = 1.0;
};

/// What is told of an equilibrium, in SI units.
struct InflationFigures {
  double share = 0.0;  ///< of the loads
  double pressure = 0.0, spin = 0.0;
  double mass = 0.0;                        ///< of the whole wheel, with what is held
  double outer_radius = 0.0, growth = 0.0;  ///< of the contact curve, else of all
  double width = 0.0;
  double twist = 0.0;            ///< largest displacement around the axle
  std::optional<double> cavity;  ///< volume
  double det_f_min = 1.0, stretch_max = 1.0;
  int newton_iterations = 0;
  double residual = 0.0;
  std::vector<CordFigures> cords;
};

}  // namespace rondo::study
