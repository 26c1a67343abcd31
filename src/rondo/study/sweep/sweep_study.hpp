// SPDX-License-Identifier: BSD-3-Clause
/// @file  The study file of a sweep (docs/studies.md): which keys of a case are varied, and how.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/figures/figures.hpp"
#include "rondo/core/error.hpp"

namespace rondo::study {

/// One parameter: a key of the case file.
struct Vary {
  std::string key;                               ///< e.g. "ground.friction"
  std::vector<std::string> values;               ///< as TOML, of `values` or `linspace`
  std::optional<std::array<double, 2>> uniform;  ///< from, to: of a sample, instead of values
  int line = 0;                                  ///< of its table in the study file
  /// Its k-th value goes with the k-th of the parameter before: both are of one [[vary]].
  bool goes_with_previous = false;
};

/// How parameters given as `uniform` are sampled.
struct Sample {
  int count = 0;
  std::uint64_t seed = 0;
};

struct SweepStudy {
  std::filesystem::path file;
  std::string title;
  std::filesystem::path base;         ///< case file, absolute or relative to the working directory
  std::vector<std::string> settings;  ///< "a.b=value", the same for all members
  std::vector<Vary> parameters;       ///< at least one
  std::optional<Sample> sample;
  Window window;
  std::vector<std::string> columns;  ///< of history.csv, whose figures the table has besides
  bool snapshots = false;            ///< members write those of the base case; else none
};

/// @throws InputError with every fault
[[nodiscard]] SweepStudy read_study(const std::filesystem::path& file);
/// The same from a text; `file` is what messages call it, and what `base` is relative to.
[[nodiscard]] SweepStudy read_study_text(const std::filesystem::path& file, std::string text);

/// Settings that what is varied would hide, or that mean nothing. @throws InputError
void check_settings(const SweepStudy& study);

/// More members are not listed.
inline constexpr std::size_t most_members = 1'000'000;

}  // namespace rondo::study
