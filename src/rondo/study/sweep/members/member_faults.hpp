// SPDX-License-Identifier: BSD-3-Clause
/// @file  Faults in the members of a study: each is reported once, with the members it concerns.
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/study/sweep/sweep_members.hpp"

namespace rondo::study {

class MemberFaults {
 public:
  MemberFaults(const SweepStudy& study, std::size_t members) : study_(study), faulty_(members) {}

  /// Faults with the same `kind` count as one, which is reported with the first text.
  void add(std::size_t member, const std::string& kind, const std::string& text);
  [[nodiscard]] bool any() const noexcept { return !found_.empty(); }
  [[nodiscard]] bool has(std::size_t member) const { return faulty_[member]; }

  /// @param members all of the study. @throws InputError
  [[noreturn]] void raise(const std::vector<PlannedMember>& members) const;

 private:
  struct Found {
    std::string text;
    std::size_t first = 0, members = 0, last = 0;
  };
  const SweepStudy& study_;
  std::vector<bool> faulty_;
  std::vector<Found> found_;
  std::map<std::string, std::size_t> place_;
};

}  // namespace rondo::study
