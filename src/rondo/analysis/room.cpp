// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/room.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "rondo/core/bytes.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/memory_limits.hpp"
#include "rondo/io/results.hpp"
#include "rondo/output/checkpoint.hpp"
#include "rondo/output/observers.hpp"
#include "rondo/output/probes.hpp"

namespace rondo::study {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t bytes_of_a_number = 21;  ///< in a CSV file, with its comma
constexpr std::size_t bytes_of_a_field = 600;  ///< of a snapshot in fields.xdmf
constexpr std::size_t small_files = 20'000;    ///< case.toml, run.json
constexpr std::size_t checkpoints = 2;         ///< the new one is written beside the old

/// A candidate in four in contact at a time: more than any but a flat body that lies on its face.
std::size_t contact_csv_bytes(std::size_t candidates, std::size_t snapshots) {
  return (candidates / 4 + 1) * snapshots * contact_columns().size() * bytes_of_a_number;
}

std::size_t xdmf_bytes(const Case& c, bool contact, std::size_t snapshots) {
  const std::size_t fields = 4 + (contact ? 1 : 0) + (c.output.stress ? 6 : 0);
  return fields * bytes_of_a_field * snapshots;
}

std::size_t history_bytes(const Case& c, const Setup& setup) {
  const double interval = std::max(c.output.history_interval, setup.model.dt);
  const std::size_t rows = static_cast<std::size_t>(c.time.end / interval) + 2;
  return rows * bytes_of_a_number *
         (history_columns().size() + probe_columns(c.output.probes).size());
}

DiskNeed need_of(const std::array<std::size_t, 4>& growing, std::size_t others) {
  DiskNeed need;
  for (const std::size_t bytes : growing) {
    need.all += bytes;
    need.largest_file = std::max(need.largest_file, bytes);
  }
  need.all += others + small_files;
  return need;
}

/// The directory or, while it is not there, the nearest one above it.
fs::path existing(const fs::path& directory) {
  std::error_code error;
  fs::path at = fs::absolute(directory, error);
  while (!error && !fs::exists(at, error) && at.has_parent_path() && at != at.parent_path())
    at = at.parent_path();
  return at;
}

/// Of what is in the directory already: replaced, or gone on with. A run that is gone on with has
/// its results.h5 twice while the kept snapshots are copied.
std::size_t bytes_there(const RunOptions& options) {
  std::size_t bytes = 0;
  for (const std::string name : {"results.h5", "history.csv", "contact.csv", "fields.xdmf"}) {
    const bool counts = options.overwrite || (options.resume && name != "results.h5");
    std::error_code error;
    const auto size = fs::file_size(options.directory / name, error);
    if (counts && !error) bytes += size;
  }
  return bytes;
}

}  // namespace

void demand_memory(const Case& c, std::size_t nodes, std::size_t needed) {
  const AllowedMemory allowed = allowed_memory();
  if (needed <= allowed.bytes) return;
  throw case_error(
      c, c.mesh ? "mesh.file" : std::string(largest_count(c.disk)),
      fmt::format("the mesh of {} nodes needs about {} of memory, and {} {}", nodes,
                  readable_bytes(needed), allowed.source, readable_bytes(allowed.bytes)),
      "a coarser mesh, or more memory");
}

DiskNeed disk_needed(const Case& c, const Setup& setup, const SnapshotSchedule& schedule) {
  const bool contact = has_candidates(setup.model);
  const std::size_t snapshots = schedule.steps.size();
  const std::size_t checkpoint =
      setup.mesh.n_nodes() * numbers_of_a_checkpoint * sizeof(double) + 50'000;
  return need_of({io::Results::bytes({&setup.mesh, setup.model.mass, snapshots, contact,
                                      c.output.stress, false, setup.model.free_body}),
                  history_bytes(c, setup),
                  contact ? contact_csv_bytes(setup.mesh.boundary.size(), snapshots) : 0,
                  xdmf_bytes(c, contact, snapshots)},
                 checkpoints * checkpoint);
}

DiskNeed disk_needed(const Case& c, const CrushSetup& setup) {
  const int all_increments = c.analysis.increments + c.analysis.slide_increments;
  const auto increments = static_cast<std::size_t>(all_increments);
  constexpr bool contact = true, quasi_static = true;
  return need_of({io::Results::bytes({&setup.mesh, setup.mass, increments, contact, c.output.stress,
                                      quasi_static}),
                  increments * history_columns().size() * bytes_of_a_number,
                  contact_csv_bytes(setup.mesh.boundary.size(), increments),
                  xdmf_bytes(c, contact, increments)},
                 0);
}

void demand_disk(const RunOptions& options, const DiskNeed& need) {
  const fs::path& directory = options.directory;
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      limit.rlim_cur < need.largest_file)
    throw FileError(directory.string(),
                    fmt::format("a file of about {} would be written here, and the limit of a "
                                "file's size (ulimit -f) is {}; nothing was written",
                                readable_bytes(need.largest_file), readable_bytes(limit.rlim_cur)));
  std::error_code error;
  const auto space = fs::space(existing(directory), error);
  if (error || space.capacity == 0) return;  // not known: the run will show
  const std::size_t free = space.available + bytes_there(options);
  if (free < need.all)
    throw FileError(directory.string(),
                    fmt::format("disk full: the run needs about {}, and {} are free; nothing was "
                                "written. Fewer output.snapshots, output.stress = false or a "
                                "longer output.history_interval need less",
                                readable_bytes(need.all), readable_bytes(free)));
}

}  // namespace rondo::study
