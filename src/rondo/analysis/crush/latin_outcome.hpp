// SPDX-License-Identifier: BSD-3-Clause
/// @file  What LATIN has found, increment by increment (docs/latin.md).
#pragma once
#include <optional>
#include <string>

#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/statics/condensation.hpp"
#include "rondo/statics/latin/latin.hpp"
#include "rondo/statics/latin/pgd.hpp"

namespace rondo::study {

/// Histories over the m candidates of the condensation's set and N increments.
struct LatinHistories {
  statics::LatinPair balanced;  ///< what is written; the laws hold but for a residual
  Eigen::MatrixXd lawful;       ///< (2m, N) forces that obey them: what is in contact
  Eigen::VectorXd residuals;    ///< (N)
  std::optional<statics::Separated> separated;  ///< fields of LATIN-PGD
};

/// Holds references to all but the histories.
class LatinOutcome {
 public:
  LatinOutcome(const CrushSetup& setup, const fem::BlockCsr& stiffness,
               const statics::Condensation& body, LatinHistories histories);

  /// From increment k - 1 to k, k >= 1. @param tolerance of the iterations @param trouble gets what
  /// is wrong
  [[nodiscard]] statics::CrushReport take(int k, double tolerance, statics::CrushState& state,
                                          std::string& trouble);
  /// Modes written; 0: of LATIN.
  [[nodiscard]] Eigen::Index modes() const noexcept;

 private:
  [[nodiscard]] std::vector<Vec2> field(Eigen::Index column) const;
  [[nodiscard]] statics::CrushEquilibrium equilibrium(int k) const;
  void measure(statics::CrushEquilibrium& e, statics::CrushReport& report);
  [[nodiscard]] std::string missed(const statics::CrushState& state, double tolerance) const;

  const CrushSetup& setup_;
  const fem::BlockCsr& stiffness_;
  const statics::Condensation& body_;
  const std::vector<std::size_t> outside_;  ///< candidates that are not of the histories
  LatinHistories histories_;
  double largest_force_ = 0.0;  ///< so far, ‖Hᵀ r‖ [N/m]
};

}  // namespace rondo::study
