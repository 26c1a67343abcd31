// SPDX-License-Identifier: BSD-3-Clause
/// @file  checkpoint.h5 of a run (docs/results.md): all data that it needs to resume bit for bit.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rondo/case/setup.hpp"
#include "rondo/fem/strain.hpp"
#include "rondo/model/saved_state.hpp"
#include "rondo/output/contact_statistics.hpp"
#include "rondo/output/history.hpp"
#include "rondo/output/kept/kept_files.hpp"
#include "rondo/output/snapshot_schedule.hpp"

namespace rondo::study {

/// The identity of a run: it is resumed only if all of this is the same.
struct RunIdentity {
  std::string version, build_id;
  std::string dispatch;     ///< instruction set of the inner loops
  std::string case_text;    ///< as read, all defaults written out
  std::string mesh_hash;    ///< of nodes, cells, boundary, because a mesh file may change
  std::string reduced;      ///< Setup::reduced
  double step = 0.0;        ///< Δt [s]
  std::string road_hash{};  ///< of the road under a wheel in three dimensions; empty: there is none
};

struct Checkpoint {
  RunIdentity identity;
  dynamics::SavedState state;
  long long n_steps = 0;  ///< of the whole run
  HistoryPlace history;
  std::vector<double> last_row;  ///< of history.csv at the end; kept only if the run ends there
  SnapshotSchedule schedule;
  ContactStatistics contact;
  fem::LargestDeformation deformation;
  int problems_kept = 0;  ///< in contact-problems/
  double loop_wall_s = 0.0, loop_cpu_s = 0.0;
  KeptFiles files;
  bool is_at_end = false;  ///< a run resumed from it would end at once; not in the file
};

/// Largest number of values per node: u, v, K u, gradient.
inline constexpr std::size_t numbers_of_a_checkpoint = 8;
/// Largest number in three dimensions: u, v, K u, and u one step before.
inline constexpr std::size_t numbers_of_a_solid_checkpoint = 12;

inline constexpr const char* checkpoint_name = "checkpoint.h5";

RunIdentity identity_of(const Case& c, const Setup& setup);

/// Replaces directory/checkpoint.h5. @throws FileError
void write_checkpoint(const std::filesystem::path& directory, const Checkpoint& checkpoint);

/// @param check receives the identity first and may throw, because a file of another version may
/// have another layout. @throws FileError: missing, damaged, of another format
Checkpoint read_checkpoint(const std::filesystem::path& directory,
                           const std::function<void(const RunIdentity&)>& check = {});

}  // namespace rondo::study
