// SPDX-License-Identifier: BSD-3-Clause
/// @file  POD of the snapshots of one or several runs: reads results directories and writes a
/// directory of modes and spectra (docs/theory.md, section 7; docs/results.md).
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rondo::study {

/// The user's request in the words of the command line.
struct PodRequest {
  std::vector<std::filesystem::path> runs;  ///< results directories; several: one common basis
  std::string field = "displacement";       ///< "displacement" | "velocity" | "contact"
  std::string frame = "co-rotating";        ///< or "rectified"; files call the first "rotating"
  std::string weight;               ///< "mass" | "delassus" | "none"; empty: the field's own
  std::string shift = "fourier";    ///< "fourier" | "pitch": rectified frame only
  std::string method = "auto";      ///< "auto" | "direct" | "tsqr" | "incremental"
  std::optional<double> from, to;   ///< window of the field's times, both ends included  [s]
  std::optional<long long> modes;   ///< number kept; none: as many as leave 1e-6 of the energy
  std::string memory = "2GB";       ///< limit for the decomposition, e.g. "500MB"
  int reconstruct = 20;             ///< snapshots rebuilt from the modes for ParaView
  std::filesystem::path directory;  ///< of the results; empty: RUN/pod
  std::function<void(const std::string&)> warn, say;   ///< may be empty
  std::function<void(long long, long long)> progress;  ///< done, total; may be empty
};

/// Number of modes that leave at most a share of the energy; -1: more than were found.
struct PodCount {
  double discarded = 0.0;
  long long modes = -1;
};

/// Error of the common basis for one run: ‖S - ΦΦᵀMS‖ / ‖S‖ over its snapshots.
struct PodRun {
  std::filesystem::path directory;
  std::string title, status;
  std::size_t snapshots = 0;
  double from = 0.0, to = 0.0;  ///< times of the first and last snapshot used                [s]
  double energy_share = 0.0;    ///< of the energy of all runs
  double error = 0.0;           ///< with all modes kept
  /// With the modes of each PodReport::counts; none if these are more than are kept.
  std::vector<std::optional<double>> count_errors;
};

struct PodReport {
  std::filesystem::path directory;  ///< where the files are
  std::string method, unit, weight;
  std::string time_unit;  ///< "s"; "1" for a crush, whose times are fractions of its load
  std::size_t rows = 0, snapshots = 0;
  double energy = 0.0;  ///< Σσ², including the truncated part
  double sigma_1 = 0.0;
  double sigma_bound = 0.0;       ///< bound of the error of singular values / the first one
  long long rank = 0, modes = 0;  ///< modes: number kept
  bool rank_is_known = true;      ///< false: truncated, the rank is at least `rank`
  std::vector<PodCount> counts;
  double worst_error = 0.0;  ///< largest error of a snapshot over its norm, with the modes kept
  double worst_time = 0.0;   ///< [s]
  std::filesystem::path worst_run;
  double residual = 0.0, tail = 0.0, difference = 0.0;  ///< error identity, shares of the energy
  double lost = 0.0;            ///< truncated share, included in the tail: a bound of the residual
  double orthonormality = 0.0;  ///< max |ΦᵀMΦ - I|
  std::string
      trouble;  ///< the identity does not hold or the modes are not orthonormal; empty: fine
  std::vector<PodRun> runs;
  std::size_t memory_estimate = 0, peak_memory = 0;  ///< [B]
  double wall_s = 0.0;
};

/// @throws InputError: an unknown word, no such field, empty window, runs of different meshes,
/// rectified frame without sectors; FileError: damaged files, cannot write.
[[nodiscard]] PodReport run_pod(const PodRequest& request);

}  // namespace rondo::study
