// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where the center of a crush is after each increment (docs/theory.md, 6.4).
#pragma once
#include <string>

#include "rondo/case/case.hpp"

namespace rondo::study {

/// A depth or a load in equal parts, then a slide in equal parts; or tables of depth and slide over
/// the number of the increment. All of them begin at first touch, increment 0.
class CrushPath {
 public:
  CrushPath() = default;
  /// @pre the analysis is a crush, validated
  explicit CrushPath(const AnalysisCase& analysis);

  [[nodiscard]] int n_increments() const noexcept { return increments_ + slide_increments_; }
  /// A load is given, and the depth follows from it.
  [[nodiscard]] bool has_load() const noexcept { return load_ > 0.0; }
  /// Force of the ground along its normal after increment k. @pre has_load() [N]
  [[nodiscard]] double load(int k) const noexcept;
  /// Way of the center below first touch after increment k, 0 to n_increments(), >= 0. @pre no load
  /// is given [m]
  [[nodiscard]] double depth(int k) const noexcept;
  /// Way of the center along +x after increment k [m]
  [[nodiscard]] double slide(int k) const noexcept;
  /// In the place of time: k over analysis.increments, above 1 only while a slide is drawn that is
  /// a number [-]
  [[nodiscard]] double parameter(double k) const noexcept { return k / increments_; }
  /// Change of the parameter in an increment is 1 over this.
  [[nodiscard]] int increments_of_parameter() const noexcept { return increments_; }
  /// [m], > 0
  [[nodiscard]] double largest_depth() const noexcept { return depth_.largest(); }
  /// The center moves along the ground.
  [[nodiscard]] bool has_slide() const noexcept { return slide_.largest() > 0.0; }
  /// Tables give the depth, and the slide where there is one.
  [[nodiscard]] bool is_of_tables() const noexcept { return depth_.points().size() > 1; }
  /// "depth 0.02 m, slide 0.001 m" after increment k, or "load 2000 N, slide 0.001 m"
  [[nodiscard]] std::string target(int k) const;

 private:
  dynamics::Table depth_, slide_;
  double load_ = 0.0;  ///< at the end [N]; 0: none is given
  int increments_ = 1, slide_increments_ = 0;
};

}  // namespace rondo::study
