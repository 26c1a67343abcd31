// SPDX-License-Identifier: BSD-3-Clause
/// @file  Modes of one body at several spins: in the plane on any mesh, or of a wheel in three
/// dimensions, also where it stands on the ground.
#pragma once
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "rondo/analysis/modes/modes_body.hpp"
#include "rondo/analysis/modes/standing.hpp"
#include "rondo/modal/critical_speeds.hpp"
#include "rondo/modal/modes.hpp"
#include "rondo/modal/viscous_mode.hpp"

namespace rondo::study {

/// Modes at one spin, and a residual and a damping ratio of each.
struct SolvedModes {
  modal::Modes found;
  std::vector<double> residuals, damping_ratios;  ///< ratios: NaN of rigid-body motions
  int overdamped = 0;  ///< of a viscous body: their rows are those of slow strains
};

/// Frequencies and damping ratios with the viscous branches of the body; the order stays, and so do
/// modes that are overdamped.
template <class Stiffness>
void take_branches(std::span<const fem::ViscousPart<Stiffness>> parts, std::span<const double> mass,
                   double spin, modal::Damping damping, SolvedModes& s) {
  for (std::size_t i = 0; i < s.found.modes.size() && !parts.empty(); ++i) {
    modal::Mode& mode = s.found.modes[i];
    const double ratio = modal::take_branches(parts, mass, spin, damping, mode);
    if (!std::isnan(ratio))
      s.damping_ratios[i] = ratio;
    else if (mode.wave != modal::Wave::rigid)
      ++s.overdamped;
  }
}

class ModesSolver {
 public:
  ModesSolver() = default;
  ModesSolver(const ModesSolver&) = delete;
  ModesSolver& operator=(const ModesSolver&) = delete;
  virtual ~ModesSolver() = default;

  /// @param angular_velocity of the case, > 0 rolls towards +x [rad/s] @throws InputError
  [[nodiscard]] virtual SolvedModes modes(double angular_velocity, int count) = 0;
  /// For each n = 1 … last that has one; of an inflated wheel about the state of the case.
  [[nodiscard]] virtual std::vector<modal::CriticalSpeed> critical(int last) = 0;
  /// None: it does not touch the ground.
  [[nodiscard]] virtual std::optional<Standing> standing() const { return std::nullopt; }
};

/// Case and body must outlive the solver. @throws InputError
[[nodiscard]] std::unique_ptr<ModesSolver> plane_modes(const Case& c, const ModesBody& body);
/// @param standing the nodes in contact with the ground are held
[[nodiscard]] std::unique_ptr<ModesSolver> solid_modes(const Case& c, const ModesBody& body,
                                                       bool standing);

}  // namespace rondo::study
