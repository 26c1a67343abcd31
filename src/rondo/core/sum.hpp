// SPDX-License-Identifier: BSD-3-Clause
/// @file  Compensated summation, for works accumulated over millions of steps.
/// Method: Neumaier, ZAMM 54 (1974) 39.
#pragma once
#include <cmath>

namespace rondo {

class CompensatedSum {
 public:
  CompensatedSum() = default;
  CompensatedSum(double sum, double correction) noexcept : sum_(sum), correction_(correction) {}
  void add(double value) noexcept {
    const double total = sum_ + value;
    correction_ +=
        std::abs(sum_) >= std::abs(value) ? (sum_ - total) + value : (value - total) + sum_;
    sum_ = total;
  }
  [[nodiscard]] double value() const noexcept { return sum_ + correction_; }
  /// The two parts of the sum: from both, a resumed summation gives bitwise the same results.
  [[nodiscard]] double sum() const noexcept { return sum_; }
  [[nodiscard]] double correction() const noexcept { return correction_; }

 private:
  double sum_ = 0.0;
  double correction_ = 0.0;
};

}  // namespace rondo
