// SPDX-License-Identifier: BSD-3-Clause
/// @file  Friction that rises so steeply with the slip that slips and coefficients alternate from
/// step to step, because the coefficient is that by the slip of the step before (docs/roads.md,
/// section 6).
#pragma once
#include <optional>
#include <string>

#include "rondo/case/setup.hpp"
#include "rondo/output/contact_statistics.hpp"

namespace rondo::study {

/// Share of the friction that alternates above which a run warns.
inline constexpr double alternating_bound = 0.01;

/// Share of the friction that alternates; 0 where nothing has touched                      [-]
[[nodiscard]] double alternating_share(const ContactStatistics& found) noexcept;

/// A contact alternates if its coefficient rises between the slips before and after a step, and κ
/// (4.3e) of that rise is above its limit, or the node has no mass. The share is Σ r_n |Δμ| of
/// these contacts over Σ r_n μ of all, with the larger of both μ.
class FrictionWatch {
 public:
  /// Watches nothing where friction is constant, or a wheel is reduced. The setup must outlive it.
  explicit FrictionWatch(const Setup& setup);

  [[nodiscard]] bool watches() const noexcept { return watches_; }
  /// Limit of κ; none: it watches nothing, or contact nodes have no mass                    [-]
  [[nodiscard]] std::optional<double> limit() const noexcept;
  /// Adds the contacts of a state to the statistics. Allocates nothing.
  void look(const dynamics::State& state, ContactStatistics& found) const noexcept;
  /// A warning of what the whole run has had; empty: there is none.
  [[nodiscard]] std::string warning(const ContactStatistics& found) const;

 private:
  const Setup& setup_;
  bool watches_, has_mass_;
  double limit_;  ///< of κ                                                                [-]
};

}  // namespace rondo::study
