// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case of steady rolling to its body and the harmonics of a sector (docs/theory.md,
/// 11.1, and docs/wheel3d.md), in the plane (D = 2) or in space: what does not depend on height,
/// speed, slip angle and friction.
#pragma once
#include <memory>
#include <optional>

#include "rondo/analysis/steady/steady_case.hpp"
#include "rondo/statics/steady/rolling_window.hpp"

namespace rondo::study {

template <int D>
class SteadyBody final : public RolledBody {
 public:
  [[nodiscard]] std::size_t memory(const Case& c) const override;
  void assemble(const Case& c) override;
  /// Finds the harmonics of a sector; in the plane it makes the window as well.
  void find_harmonics(const Case& c, int threads) override;
  [[nodiscard]] bool has_solution() const noexcept override { return harmonics->finite(); }
  [[nodiscard]] std::unique_ptr<RolledState> solve(const Case& c) const override;
  void add_columns(RecordPlan& plan) const override;
  /// The window of one state. In the plane it is a copy of the window of the body, because camber
  /// and weight are the same in all states, unless the slip is another than the case's.
  [[nodiscard]] statics::RollingWindow<D> window_of(const Case& c,
                                                    statics::SlipDifference slip) const;

  fem::SectorBlocks<D> sector;
  std::vector<fem::ViscousPart<fem::SectorBlocks<D>>> viscous;  ///< of materials with branches
  std::optional<dynamics::SweptPart> swept;  ///< what is not linear about the state, in space
  std::optional<statics::RollingHarmonics<D>> harmonics;
  std::optional<statics::RollingWindow<D>> window;  ///< without pairs: to be copied
};

}  // namespace rondo::study
