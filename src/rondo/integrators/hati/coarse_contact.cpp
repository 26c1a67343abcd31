// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/hati/coarse_contact.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {

ContactReport contact_of(std::span<const FineContact> fine) noexcept {
  RONDO_DEMAND(!fine.empty());
  ContactReport sum;
  for (const FineContact& f : fine) {
    sum.add(f.report);
    sum.unseen = std::max(sum.unseen, f.report.unseen);
  }
  const ContactReport& last = fine.back().report;
  sum.nodes = last.nodes;
  sum.sticking = last.sticking;
  sum.length = last.length;
  sum.between_bodies = last.between_bodies;
  return sum;
}

void merge_contacts(std::span<const FineContact> fine, std::vector<ActiveContact>& active) {
  active.clear();
  for (std::size_t j = fine.size(); j-- > 0;)
    for (const ActiveContact& a : fine[j].active) {
      const auto known = std::ranges::find_if(active, [&](const ActiveContact& b) {
        return b.candidate == a.candidate && b.on_ground == a.on_ground && b.normal == a.normal;
      });
      if (known == active.end())
        active.push_back(a);
      else
        known->impulse += a.impulse;
    }
  std::ranges::stable_sort(active, {}, &ActiveContact::candidate);
}

}  // namespace rondo::dynamics
