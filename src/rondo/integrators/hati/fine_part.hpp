// SPDX-License-Identifier: BSD-3-Clause
/// @file  The explicit part A of the scheme "hati" (docs/theory.md, 12.1): m fine steps in a coarse
/// one. A fine step is half a step of motion, the kick of the general step (3.3) with its contacts,
/// and half a step of motion, so that velocities and displacements are known at the same times.
#pragma once
#include <vector>

#include "rondo/integrators/general/general_contact.hpp"
#include "rondo/model/integrator.hpp"

namespace rondo::dynamics {

/// Displacement and velocity of a part at the end of a coarse step.
struct PartFields {
  Field u, v;  ///< (n) 0 where the part has no nodes                    [m], [m/s]
};

/// The contacts that a fine step found.
struct FineContact {
  ContactReport report;
  std::vector<ActiveContact> active;  ///< by candidate
};

class FinePart {
 public:
  /// @pre whole.subdomains; scheme "hati", a constant angular velocity, no loaded rim, no free
  /// body, no contact between bodies, no pressure; all candidates are nodes of A alone.
  FinePart(const Model& whole, const PartFields& start);
  FinePart(const FinePart&) = delete;
  FinePart& operator=(const FinePart&) = delete;

  /// The fine steps of the n-th coarse one, n >= 1, from fields(), which stay as they are.
  /// @param multiplier (interface) force on these nodes                               [N/m]
  void attempt(long long n, std::span<const Vec2> multiplier);
  /// Accepts what was attempted last.
  void accept();

  // Results of the last attempt ------------------------------------------------------------------
  /// (interface) by which the nodes moved                                             [m]
  [[nodiscard]] std::span<const Vec2> travel() const noexcept { return travel_; }
  /// (m)
  [[nodiscard]] std::span<const FineContact> contacts() const noexcept { return contacts_; }
  /// The contacts found the same impulses, to the bit, as in the attempt before.
  [[nodiscard]] bool same_impulses() const noexcept;
  /// Works of all fine steps, those of the contacts among them.
  [[nodiscard]] const Works& works() const noexcept { return works_; }
  /// Rᵀ(c̈ - g), mean over the kicks: what B feels of it                               [m/s²]
  [[nodiscard]] Vec2 pull() const noexcept { return pull_; }

  // State that was accepted last -----------------------------------------------------------------
  [[nodiscard]] const PartFields& fields() const noexcept { return fields_; }
  void add_energy(double& kinetic, double& strain);
  [[nodiscard]] const contact::KeptImpulses& impulses() const noexcept { return kept_; }
  void set(PartFields fields, contact::KeptImpulses impulses);
  [[nodiscard]] std::vector<contact::ProblemFile> take_difficult() {
    return contact_.coupled().difficult.take();
  }

  /// By how much the interface moves in a coarse step under a multiplier, from rest, undeformed,
  /// with nothing else that acts: linear in it. @param travel (interface)              [m]
  void respond(std::span<const Vec2> multiplier, std::span<Vec2> travel);

 private:
  void move_half() noexcept;
  void find_forces(std::span<const Vec2> multiplier) noexcept;
  void find_free_velocities(const BodyFrame& frame, std::span<const Vec2> reference) noexcept;
  void add_travel(std::span<Vec2> travel) const noexcept;
  void add_works(const FrameStep& frame) noexcept;
  void solve_contacts(const BodyFrames& frames, FineContact& found);

  const Model model_;  ///< model of A alone, with the fine step
  const std::vector<int> interface_;
  const int ratio_;
  PartFields fields_;
  contact::KeptImpulses kept_;
  State state_;  ///< state of the attempt: u; v⁻, and v⁺ in v_next
  GeneralContact contact_;
  std::vector<FineContact> contacts_, contacts_before_;  ///< (m)
  std::vector<Vec2> force_, rate_;                       ///< (n) K u + β K v⁻ - λ, K v⁻
  const std::vector<Vec2> nowhere_;                      ///< (n) 0
  std::vector<Vec2> travel_;
  Works works_;
  Vec2 pull_;
};

}  // namespace rondo::dynamics
