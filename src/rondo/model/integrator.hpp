// SPDX-License-Identifier: BSD-3-Clause
/// @file  Interface of the time steps of a run, many per call. The results are bitwise the same for
/// any number of threads and any division of the steps into calls.
#pragma once
#include <span>
#include <vector>

#include "rondo/contact/coupled/problem_file.hpp"
#include "rondo/model/contact_node.hpp"
#include "rondo/model/ledger.hpp"
#include "rondo/model/material_report.hpp"
#include "rondo/model/model.hpp"
#include "rondo/model/saved_state.hpp"

namespace rondo::dynamics {

/// Motion of a loaded rim around t_{n+1}, and the reactions on its prescribed degrees of freedom.
/// Rotations > 0 are clockwise, as in the user's signs.
struct RimReport {
  Vec2 velocity;        ///< of the center, mean over both half steps              [m/s]
  double spin = 0.0;    ///< ω, mean over both half steps, > 0 clockwise        [rad/s]
  Vec2 force;           ///< reaction on the center; 0 where it is free            [N/m]
  double torque = 0.0;  ///< reaction on the spin, > 0 clockwise; 0 where it is free  [N]
};

/// What a step reports to observers.
struct StepReport {
  long long step = 0;       ///< n + 1
  FrameStep frame;          ///< of t_{n+1}
  ContactReport contact;    ///< of t_{n+1}
  Balance balance;          ///< of t_{n+1/2}
  RimReport rim;            ///< of t_{n+1}, only of a loaded rim
  MaterialReport material;  ///< only of rubber
  /// Scheme "hati": the contact impulses differ from those with which the parts were joined.
  bool contact_felt_joint = false;
};

/// An integrator that can be saved and resumed with bitwise the same results.
class Resumable {
 public:
  /// Called between two steps. The argument of restore() must come from save() of an integrator of
  /// the same kind and model, with any number of threads. @throws std::bad_alloc
  [[nodiscard]] virtual SavedState save() const = 0;
  virtual void restore(const SavedState& saved) = 0;

 protected:
  ~Resumable() = default;
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// Makes as many steps as there are reports, and fills these. `last`, if given, receives step,
  /// frame, u, v, contacts and, if it has room for it, v_next of the last step; `force` and
  /// `force_before` are unchanged. If it has no room for v, only u at the candidates of the ground
  /// contact is valid.
  /// @pre at least one report; *last was made for this model, not copied (a copy has no room for
  /// contacts). Allocates nothing, except that the general integrator, and the fused ones near
  /// sharp corners, allocate when the contacts of a step need more room than ever before.
  virtual void advance(std::span<StepReport> reports, State* last = nullptr) noexcept = 0;

  /// The fields between two steps: u_{n+2} and v_{n+3/2}, where n + 1 is the last step made. Fills
  /// u and v_next.
  virtual void fields(State& state) const noexcept = 0;

  /// Null: this integrator cannot be resumed.
  [[nodiscard]] virtual Resumable* resumable() noexcept { return nullptr; }

  /// Contact problems kept since the last call, as selected by model.coupled.
  [[nodiscard]] virtual std::vector<contact::ProblemFile> take_difficult() { return {}; }
};

}  // namespace rondo::dynamics
