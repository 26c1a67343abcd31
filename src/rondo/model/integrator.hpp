// SPDX-License-Identifier: BSD-3-Clause
/// @file  What makes the steps of a run, many at a time. What comes out is the same to the last bit
/// for any number of threads and however the steps are cut into calls.
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

/// Motion of a loaded rim around t_{n+1}, and what holds it where it is not free; with > 0
/// clockwise, as the user's signs are.
struct RimReport {
  Vec2 velocity;        ///< of the center, mean of both half steps                  [m/s]
  double spin = 0.0;    ///< ω, likewise, > 0 clockwise                              [rad/s]
  Vec2 force;           ///< that holds the center; 0 where it is free               [N/m]
  double torque = 0.0;  ///< that holds the spin, > 0 clockwise; 0 where it is free  [N]
};

/// What a step leaves for those who look on.
struct StepReport {
  long long step = 0;       ///< n + 1
  FrameStep frame;          ///< of t_{n+1}
  ContactReport contact;    ///< of t_{n+1}
  Balance balance;          ///< of t_{n+1/2}
  RimReport rim;            ///< of t_{n+1}, of a loaded rim
  MaterialReport material;  ///< of rubber
  /// Of the scheme "hati": contact impulses are not those that the parts were joined with.
  bool contact_felt_joint = false;
};

/// What goes on to the same bits from what it was before.
class Resumable {
 public:
  /// Between two steps. What restore() gets must come from save() of an integrator of the same kind
  /// and model, on however many threads. @throws std::bad_alloc
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

  /// Makes as many steps as there are reports, and fills these. `last`, if given, gets step, frame,
  /// u, v, contacts and, where it has room for it, v_next of the last of them; `force` and
  /// `force_before` are left alone. If it has no room for v, u need be right at the candidates of
  /// the ground's contact alone.
  /// @pre at least one report; *last was made for this model, not copied (a copy has no room for
  /// contacts). Allocates nothing; the general integrator, and the fused ones near sharp corners,
  /// as little as the contacts of a step need more place than any before.
  virtual void advance(std::span<StepReport> reports, State* last = nullptr) noexcept = 0;

  /// Fields as they stand between two steps: u_{n+2} and v_{n+3/2}, n + 1 the last step made.
  /// Fills u and v_next.
  virtual void fields(State& state) const noexcept = 0;

  /// None: it cannot go on from where it was.
  [[nodiscard]] virtual Resumable* resumable() noexcept { return nullptr; }

  /// Contact problems kept since the last call, as model.coupled says.
  [[nodiscard]] virtual std::vector<contact::ProblemFile> take_difficult() { return {}; }
};

}  // namespace rondo::dynamics
