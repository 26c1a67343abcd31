// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/general/late_contact.hpp"

#include <algorithm>
#include <cmath>

namespace rondo::dynamics {

bool was_found(const contact::KeptImpulses& before, std::uint64_t key) noexcept {
  const auto point = [](std::uint64_t of) { return of >> key_bits_of_edge; };
  const auto found = std::ranges::lower_bound(before, point(key), {},
                                              [&](const auto& kept) { return point(kept.first); });
  return found != before.end() && point(found->first) == point(key);
}

bool came_round_an_end(Vec2 point, Vec2 a, Vec2 b, double along,
                       const std::array<int, 2>& beside) noexcept {
  const double length = norm(b - a), foot = dot(b - a, point - a) / length;
  const double way = 1.01 * std::abs(along);
  return (foot <= way && beside[0] < 0) || (length - foot <= way && beside[1] < 0);
}

}  // namespace rondo::dynamics
