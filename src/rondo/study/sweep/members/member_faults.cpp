// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/members/member_faults.hpp"

#include <fmt/format.h>

namespace rondo::study {
namespace {

constexpr std::size_t most_faults = 20;

}  // namespace

void MemberFaults::add(std::size_t member, const std::string& kind, const std::string& text) {
  faulty_[member] = true;
  const auto [place, is_new] = place_.try_emplace(kind, found_.size());
  if (is_new) found_.push_back({text, member, 1, member});
  Found& found = found_[place->second];
  if (is_new || found.last == member) return;
  ++found.members;
  found.last = member;
}

void MemberFaults::raise(const std::vector<PlannedMember>& members) const {
  std::vector<Fault> faults;
  const std::string file = study_.file.string();
  for (const Found& found : found_) {
    if (faults.size() == most_faults) {
      faults.push_back({file, 0, 0, "", "",
                        fmt::format("and {} more kinds of errors", found_.size() - most_faults),
                        ""});
      break;
    }
    const std::string whom = name_of(study_, members[found.first].member, found.first + 1);
    const std::string more = found.members == 1
                                 ? ""
                                 : fmt::format(" and {} of {} other{}", found.members - 1,
                                               members.size() - 1, members.size() == 2 ? "" : "s");
    faults.push_back({file, 0, 0, "", "", whom + more + ": " + found.text, ""});
  }
  throw InputError(std::move(faults));
}

}  // namespace rondo::study
