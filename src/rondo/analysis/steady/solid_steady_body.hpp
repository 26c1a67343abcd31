// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case of steady rolling in three dimensions to its wheel and the harmonics of a
/// sector (docs/wheel3d.md): what does not hang on height, speed, slip angle, camber and friction.
#pragma once
#include <memory>
#include <optional>

#include "rondo/analysis/steady/steady_case.hpp"
#include "rondo/statics/steady_solid/solid_window.hpp"

namespace rondo::study {

class SolidSteadyBody final : public RolledBody {
 public:
  [[nodiscard]] std::size_t memory(const Case& c) const override;
  void assemble(const Case& c) override;
  void find_harmonics(const Case& c, int threads) override;
  [[nodiscard]] bool has_solution() const noexcept override { return harmonics->finite(); }
  [[nodiscard]] std::unique_ptr<RolledState> solve(const Case& c) const override;
  void add_columns(RecordPlan& plan) const override;

  fem::SolidSector sector;
  double radius = 0.0;  ///< outer, undeformed [m]
  std::optional<statics::SolidHarmonics> harmonics;
};

}  // namespace rondo::study
