// SPDX-License-Identifier: BSD-3-Clause
/// @file  All data that an integrator carries from one step to the next, bit for bit, so that a run
/// can resume from them. Components and times are the integrator's own (those of the cyclic one are
/// polar), so that nothing is computed anew; unused fields are empty.
#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "rondo/model/ledger.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

struct SavedState {
  long long step = 0;          ///< the last step made
  Field u;                     ///< (n) displacement                                  [m]
  Field v;                     ///< (n) velocity                                      [m/s]
  Field force;                 ///< (n) K u; with stiffness damping or free bodies        [N/m], [N]
  Field u_before;              ///< (n) u one step before; with a loaded rim                    [m]
  std::vector<Vec2> gradient;  ///< (n) derivative of the energy, general model       [N/m]
  std::vector<double> energy;  ///< (free_bodies)                                     [J/m]
  std::vector<Pose> poses;     ///< (free_bodies)
  /// By contact, ascending: coupled contacts start from the impulses of the previous step [N·s/m].
  std::vector<std::pair<std::uint64_t, Vec2>> impulses;
  std::vector<double> branches;       ///< of rubber: C_i of element and branch, xx, yy, xy
  std::vector<double> internal_work;  ///< of rubber (rubber_work.hpp, hyperelastic.hpp)
  /// A window of nonlinear rubber has its work W and what its rounding left [J]; then the weights
  /// of all columns, and their energies [J] (swept_part.hpp)
  std::vector<double> window;
  std::vector<double> rim;   ///< state of a loaded rim (loaded_rim.hpp)
  std::vector<double> ring;  ///< contacts of a massless boundary (MasslessContact::save)
  /// For each node where the parts of the scheme "hati" meet: u and v of the coarse part [m],
  /// [m/s], and the multiplier [N/m]; (3 interface).
  std::vector<Vec2> interface;
  /// FrictionWork::save() of model.friction_work. The integrator does not save it: whoever saves
  /// the integrator adds it.
  std::vector<double> friction_work;
  std::array<double, Ledger::n_numbers> ledger{};
};

}  // namespace rondo::dynamics
