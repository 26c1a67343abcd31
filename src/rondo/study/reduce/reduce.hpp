// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo reduce`: keeps the modes of a reduced wheel, with its matrices and tables, in a
/// file: eigenmodes of a case, or the POD of fields that runs went through (docs/reduced.md).
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rondo::study {

/// Modes of a POD that nobody asked for otherwise.
inline constexpr long long default_pod_modes = 40;

/// The user's request in the words of the command line.
struct ReduceRequest {
  /// A case file, or results directories of runs of one body.
  std::vector<std::filesystem::path> sources;
  std::vector<std::string> settings;             ///< "a.b=value", of the case
  std::filesystem::path output;                  ///< the file
  std::string basis;                             ///< "eigenmodes" | "pod"; empty: by the sources
  std::optional<long long> modes;                ///< none: chosen
  std::optional<double> from, to;                ///< window of the snapshots of a POD [s]
  std::function<void(const std::string&)> warn;  ///< may be empty
  std::function<void(long long, long long)> progress;  ///< done, total; may be empty
};

struct ReduceReport {
  std::string basis;
  long long dofs = 0;         ///< of the mesh
  long long modes = 0;        ///< of the wheel
  double highest = 0.0;       ///< angular frequency of the highest                       [rad/s]
  std::vector<double> spins;  ///< of the tables of compliance                         [rad/s]
  long long contact_nodes = 0;
  long long snapshots = 0;  ///< of a POD
  double left = 0.0;        ///< of a POD: share of their energy that the modes leave out
  std::size_t file_bytes = 0;
  double wall_s = 0.0;
};

/// @throws InputError: what has no reduced wheel, or runs without one POD; FileError
[[nodiscard]] ReduceReport run_reduce(const ReduceRequest& request);

}  // namespace rondo::study
