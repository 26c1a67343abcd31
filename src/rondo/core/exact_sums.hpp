// SPDX-License-Identifier: BSD-3-Clause
/// @file  Sums that do not depend on the order in which numbers come, so that any number of threads
/// may add to them in any order and the results have the same bits. A number is rounded once, to a
/// multiple of 2^-100, and added as three whole numbers.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rondo {

class ExactSums {
 public:
  /// @param n number of sums, all 0
  explicit ExactSums(std::size_t n) : parts_(n) {}

  [[nodiscard]] std::size_t size() const noexcept { return parts_.size(); }
  /// Adds to sum k; several threads may do so at the same time. A number of 2^30 or more, or one
  /// that is not finite, spoils all sums: is_lost().
  void add(std::size_t k, double number) noexcept;
  /// Must be called, while nobody adds, before a single sum has taken 2^26 numbers since the last
  /// call: carries from one whole number to the next.
  void settle() noexcept;
  /// Whether numbers came that cannot be added.
  [[nodiscard]] bool is_lost() const noexcept { return lost_ != 0; }
  /// NaN if it is lost. @pre settled
  [[nodiscard]] double at(std::size_t k) const noexcept;

  /// The complete memory, which is exact in these numbers. @pre settled
  [[nodiscard]] std::vector<double> save() const;
  /// Whether numbers can be those of save() of as many sums.
  [[nodiscard]] bool is_saved(std::span<const double> numbers) const noexcept;
  void restore(std::span<const double> numbers) noexcept;
  void clear() noexcept;

 private:
  struct Parts {
    std::int64_t high = 0, middle = 0, low = 0;  ///< in units of 2^-28, 2^-64, 2^-100
  };
  std::vector<Parts> parts_;
  std::int64_t lost_ = 0;
};

}  // namespace rondo
