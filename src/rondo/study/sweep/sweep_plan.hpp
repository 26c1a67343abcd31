// SPDX-License-Identifier: BSD-3-Clause
/// @file  The members of a study: the full grid of all values, times the sample.
#pragma once
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/study/sweep/sweep_study.hpp"

namespace rondo::study {

struct Member {
  std::vector<std::string> values;  ///< (parameters) as TOML
};

/// In the order of their numbers: the last parameter of the grid changes fastest, and the points of
/// the sample faster than those; parameters that go together are one. The same on every machine.
/// @throws InputError: too many
[[nodiscard]] std::vector<Member> members_of(const SweepStudy& study);

/// `n` points in [0, 1) of `dimensions`, by dimension: in each, one point in each n-th part.
[[nodiscard]] std::vector<std::vector<double>> latin_hypercube(int dimensions, int n,
                                                               std::uint64_t seed);

/// "a.b=value" of a member.
[[nodiscard]] std::vector<std::string> settings_of(const SweepStudy& study, const Member& member);

/// A member's name in messages: "run 3 (ground.friction = 0.2, motion.speed = 10.0)".
[[nodiscard]] std::string name_of(const SweepStudy& study, const Member& member,
                                  std::size_t number);

}  // namespace rondo::study
