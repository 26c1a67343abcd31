// SPDX-License-Identifier: BSD-3-Clause
/// @file  The study file of a sweep (docs/studies.md): the keys of a case that vary, and how.
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

/// One parameter: a key of the case file with its values.
struct Vary {
  std::string key;                               ///< e.g. "ground.friction"
  std::vector<std::string> values;               ///< as TOML, from `values` or `linspace`
  std::optional<std::array<double, 2>> uniform;  ///< from, to: range of a sample, instead of values
  int line = 0;                                  ///< of its table in the study file
  /// It belongs to the same [[vary]] as the previous parameter: their k-th values are combined.
  bool goes_with_previous = false;
};

/// How parameters with `uniform` are sampled.
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
  std::vector<std::string> columns;  ///< of history.csv, whose figures are added to the table
  bool snapshots = false;            ///< members write those of the base case; else none
};

/// @throws InputError with every fault
[[nodiscard]] SweepStudy read_study(const std::filesystem::path& file);
/// Reads the text of a study; messages call it `file`, to which `base` is relative.
[[nodiscard]] SweepStudy read_study_text(const std::filesystem::path& file, std::string text);

/// Refuses settings that varied keys would hide or that have no meaning. @throws InputError
void check_settings(const SweepStudy& study);

/// Studies with more members are refused.
inline constexpr std::size_t most_members = 1'000'000;

}  // namespace rondo::study
