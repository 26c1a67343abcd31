// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/exact_sums.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "rondo/core/contract.hpp"

namespace rondo {
namespace {

constexpr double high_unit = 0x1p-28, middle_unit = 0x1p-64, low_unit = 0x1p-100;
constexpr double largest = 0x1p30;                       // of one number
constexpr std::int64_t width = std::int64_t{1} << 36;    // of a whole number in the next one
constexpr std::int64_t fullest = std::int64_t{1} << 53;  // of the highest, exact as a double

void add_to(std::int64_t& sum, double whole) noexcept {
  if (whole == 0.0) return;
  std::atomic_ref<std::int64_t>(sum).fetch_add(static_cast<std::int64_t>(whole),
                                               std::memory_order_relaxed);
}

/// Moves what is beyond half a unit of the next whole number.
void carry(std::int64_t& from, std::int64_t& to) noexcept {
  std::int64_t over = from / width;
  const std::int64_t rest = from - over * width;
  if (rest >= width / 2) ++over;
  if (rest < -width / 2) --over;
  from -= over * width;
  to += over;
}

}  // namespace

void ExactSums::add(std::size_t k, double number) noexcept {
  RONDO_ASSERT(k < parts_.size(), k, parts_.size());
  if (!(std::abs(number) < largest)) {
    std::atomic_ref<std::int64_t>(lost_).store(1, std::memory_order_relaxed);
    return;
  }
  const double high = std::nearbyint(number / high_unit);
  const double below = number - high * high_unit;
  const double middle = std::nearbyint(below / middle_unit);
  const double low = std::nearbyint((below - middle * middle_unit) / low_unit);
  add_to(parts_[k].high, high);
  add_to(parts_[k].middle, middle);
  add_to(parts_[k].low, low);
}

void ExactSums::settle() noexcept {
  for (Parts& p : parts_) {
    carry(p.low, p.middle);
    carry(p.middle, p.high);
    if (std::abs(p.high) >= fullest) lost_ = 1;
  }
}

double ExactSums::at(std::size_t k) const noexcept {
  RONDO_ASSERT(k < parts_.size(), k, parts_.size());
  if (is_lost()) return std::numeric_limits<double>::quiet_NaN();
  const Parts& p = parts_[k];
  return static_cast<double>(p.high) * high_unit +
         (static_cast<double>(p.middle) * middle_unit + static_cast<double>(p.low) * low_unit);
}

std::vector<double> ExactSums::save() const {
  std::vector<double> numbers{static_cast<double>(lost_)};
  numbers.reserve(1 + 3 * parts_.size());
  for (const Parts& p : parts_)
    for (const std::int64_t part : {p.high, p.middle, p.low})
      numbers.push_back(static_cast<double>(part));
  return numbers;
}

bool ExactSums::is_saved(std::span<const double> numbers) const noexcept {
  return numbers.size() == 1 + 3 * parts_.size() && std::ranges::all_of(numbers, [](double number) {
           return std::abs(number) <= static_cast<double>(fullest) &&
                  std::nearbyint(number) == number;
         });
}

void ExactSums::restore(std::span<const double> numbers) noexcept {
  RONDO_DEMAND(is_saved(numbers), numbers.size(), parts_.size());
  lost_ = static_cast<std::int64_t>(numbers[0]);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const auto part = [&](std::size_t i) {
      return static_cast<std::int64_t>(numbers[1 + 3 * k + i]);
    };
    parts_[k] = {part(0), part(1), part(2)};
  }
}

void ExactSums::clear() noexcept {
  std::ranges::fill(parts_, Parts{});
  lost_ = 0;
}

}  // namespace rondo
