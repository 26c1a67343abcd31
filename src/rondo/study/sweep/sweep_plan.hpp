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

/// Members in the order of their numbers: the last parameter of the grid changes fastest, and the
/// points of the sample faster still; parameters of one [[vary]] count as one. The order is the
/// same on every machine. @throws InputError: too many
[[nodiscard]] std::vector<Member> members_of(const SweepStudy& study);

/// `n` points in [0, 1) of `dimensions`, by dimension: each n-th part of each has one point.
[[nodiscard]] std::vector<std::vector<double>> latin_hypercube(int dimensions, int n,
                                                               std::uint64_t seed);

/// The settings "a.b=value" of a member.
[[nodiscard]] std::vector<std::string> settings_of(const SweepStudy& study, const Member& member);

/// The name of a member in messages: "run 3 (ground.friction = 0.2, motion.speed = 10.0)".
[[nodiscard]] std::string name_of(const SweepStudy& study, const Member& member,
                                  std::size_t number);

}  // namespace rondo::study
