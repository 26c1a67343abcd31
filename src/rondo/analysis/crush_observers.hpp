// SPDX-License-Identifier: BSD-3-Clause
/// @file  The files of a crush, those of a dynamic run, with the load parameter k/increments in
/// place of time, above 1 while it slides (docs/results.md).
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "rondo/analysis/crush_build.hpp"
#include "rondo/contact/ground.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/results.hpp"

namespace rondo::study {

class CrushRecord {
 public:
  /// The first row of history.csv is that of first touch.
  CrushRecord(const std::filesystem::path& directory, const Case& c, const CrushSetup& setup);
  /// After increment k, from 1. `before` is the displacement of the increment before.
  void observe(int k, const statics::CrushState& state, const std::vector<Vec2>& before,
               const statics::CrushReport& report);
  void close();
  [[nodiscard]] std::size_t written() const { return results_.written(); }

 private:
  void write_history(double parameter, const statics::CrushState& state,
                     const statics::CrushReport& report);
  void write_contact_rows(double parameter, const statics::CrushState& state);
  void write_snapshot(int k, const statics::CrushState& state, const std::vector<Vec2>& before);
  [[nodiscard]] Vec2 position(const statics::CrushState& state, std::size_t candidate) const;

  const CrushSetup& setup_;
  contact::Ground ground_;
  int increments_;
  io::Csv history_, contact_csv_;
  io::Results results_;
  std::optional<fem::StressRecovery> stress_;
  std::vector<Vec2> rate_;         ///< (n) [m]
  std::vector<Vec2> force_fixed_;  ///< (nb) [N/m]
};

}  // namespace rondo::study
