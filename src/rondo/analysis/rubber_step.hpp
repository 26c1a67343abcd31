// SPDX-License-Identifier: BSD-3-Clause
/// @file  Whether the step is still below the critical one: rubber that is compressed is stiffer
/// than it was (docs/rubber.md, section 4).
#pragma once
#include <string>

#include "rondo/case/setup.hpp"
#include "rondo/model/saved_state.hpp"

namespace rondo::study {

/// Δt_c of the body as it is deformed, its strain histories held [s]; infinite where it is not
/// found. @pre setup.rubber
[[nodiscard]] double critical_step_now(const Setup& setup, const dynamics::SavedState& now);

class RubberStepWatch {
 public:
  /// A look costs as much as some hundreds of steps: it is due every 2,000, and where strains have
  /// grown by 0.05 since the last. @param strain the largest so far
  [[nodiscard]] bool is_due(long long step, double strain) noexcept;
  /// The trouble, empty: there is none.
  [[nodiscard]] static std::string look(const Setup& setup, const dynamics::SavedState& now);

 private:
  double strain_ = 0.0;  ///< at the last look
};

}  // namespace rondo::study
