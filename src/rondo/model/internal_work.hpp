// SPDX-License-Identifier: BSD-3-Clause
/// @file  The work done against forces of the deformation that are not K u alone, for the readable
/// steps (docs/rubber.md, section 3).
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "rondo/core/sum.hpp"
#include "rondo/model/model.hpp"

namespace rondo::dynamics {

template <class Vec>
class InternalWork {
 public:
  /// Begins with the energy that is stored at displacements u (n) [J/m], in space [J].
  void start(std::span<const Vec> u, double stored) {
    u_.assign(u.begin(), u.end());
    sum_.add(stored);
  }
  /// Adds the step to displacements u: ½ (f_n + f_{n+1})·Δu. @param before, now f_n and f_{n+1},
  /// (n)
  /// @return A_n + ½ f_n·Δu, the strain energy of the half step
  double add(const Model& model, std::span<const Vec> u, std::span<const Vec> before,
             std::span<const Vec> now) noexcept {
    double at_start = 0.0, at_end = 0.0;
    for_free_nodes(model, [&](std::size_t k) {
      const Vec way = u[k] - u_[k];
      at_start += dot(before[k], way);
      at_end += dot(now[k], way);
    });
    const double half = sum_.value() + 0.5 * at_start;
    sum_.add(0.5 * (at_start + at_end));
    std::ranges::copy(u, u_.begin());
    return half;
  }
  /// A.
  [[nodiscard]] double value() const noexcept { return sum_.value(); }
  /// (n) The last displacements.
  [[nodiscard]] std::span<const Vec> u() const noexcept { return u_; }

  [[nodiscard]] const CompensatedSum& sum() const noexcept { return sum_; }
  void restore(std::span<const Vec> u, CompensatedSum sum) {
    u_.assign(u.begin(), u.end());
    sum_ = sum;
  }

 private:
  std::vector<Vec> u_;
  CompensatedSum sum_;
};

}  // namespace rondo::dynamics
