// SPDX-License-Identifier: BSD-3-Clause
/// @file  A crush (crush.hpp) of a body of rubber at finite strain: f(u) = Hᵀ r by Newton's method,
/// the contact law of each linearisation solved as that of a linear body (docs/rubber.md, 4.1).
#pragma once
#include <memory>
#include <vector>

#include "rondo/fem/hyperelastic/hyperelasticity.hpp"
#include "rondo/statics/crush.hpp"

namespace rondo::statics {

class RubberCrush {
 public:
  /// Branches are relaxed. @param free ascending. @param reach largest clearance of the candidates
  /// condensed at first [m]
  RubberCrush(const CrushModel& model, std::shared_ptr<const fem::Hyperelasticity> body,
              std::vector<int> free, double reach);

  /// Brings the center to `depth` and `slide` [m], in as many parts as it takes. In the works the
  /// strain energy is what is stored, and the residual what was done against the forces less the
  /// work of the contact, each by mean forces. Where it is not converged the state is as it was.
  [[nodiscard]] CrushReport bring_to(double depth, double slide, CrushState& state);

  /// Candidates condensed.
  [[nodiscard]] std::size_t condensed() const noexcept { return set_.size(); }

 private:
  struct Trial;
  void lift_off(Trial& trial, CrushReport& report) const;
  [[nodiscard]] bool solve(Trial& trial, const CrushState& state, CrushReport& report);
  [[nodiscard]] bool improve(Trial& trial, const CrushState& state, CrushReport& report);
  [[nodiscard]] bool close_gaps(Trial& trial, Condensation& tangent, const std::vector<Vec2>& rest,
                                const CrushState& state, CrushReport& report);
  void hold_down(const Trial& trial, fem::BlockCsr& k, std::vector<Vec2>& rest) const;
  void solve_contact(Trial& trial, const Condensation& tangent, const std::vector<Vec2>& rest,
                     const CrushState& state, CrushReport& report);
  void find_forces(Trial& trial) const;
  void accept(Trial& trial, CrushState& state) const;

  const CrushModel& model_;
  const std::shared_ptr<const fem::Hyperelasticity> body_;
  const std::vector<int> free_;
  std::vector<std::size_t> set_;  ///< candidates condensed
};

}  // namespace rondo::statics
