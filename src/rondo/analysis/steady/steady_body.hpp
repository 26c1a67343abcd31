// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case of steady rolling to its body and the harmonics of a sector
/// (docs/theory.md, 11.1): what does not hang on height, speed and friction.
#pragma once
#include <memory>
#include <optional>

#include "rondo/analysis/steady/steady_case.hpp"
#include "rondo/statics/steady/rolling_window.hpp"

namespace rondo::study {

class SteadyBody final : public RolledBody {
 public:
  [[nodiscard]] std::size_t memory(const Case& c) const override;
  void assemble(const Case& c) override;
  /// And the window.
  void find_harmonics(const Case& c, int threads) override;
  [[nodiscard]] bool has_solution() const noexcept override { return harmonics->finite(); }
  [[nodiscard]] std::unique_ptr<RolledState> solve(const Case& c) const override;
  void add_columns(RecordPlan& plan) const override;

  fem::SectorStiffness sector;
  std::optional<statics::RollingHarmonics> harmonics;
  std::optional<statics::RollingWindow> window;  ///< without pairs: to be copied
};

}  // namespace rondo::study
