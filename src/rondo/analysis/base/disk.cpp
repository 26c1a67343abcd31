// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/base/disk.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <system_error>

#include "rondo/core/bytes.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/results.hpp"
#include "rondo/output/columns.hpp"

namespace rondo::study {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t bytes_of_a_number = 21;  ///< in a CSV file, with its comma
constexpr std::size_t bytes_of_a_field = 600;  ///< one field of a snapshot in fields.xdmf
constexpr std::size_t small_files = 20'000;    ///< case.toml, run.json
constexpr std::size_t checkpoints = 2;         ///< the new one is written beside the old

/// A candidate in four in contact at a time: more than any but a flat body that lies on its face.
std::size_t contact_csv_bytes(const RecordPlan& plan) {
  if (!plan.results.contact) return 0;
  const std::size_t candidates = plan.results.mesh->boundary.size();
  const std::size_t own = contact_columns(plan.results.mesh->is_solid()).size();
  const std::size_t columns = own + plan.contact_columns.size();
  return (candidates / 4 + 1) * plan.results.n_snapshots * columns * bytes_of_a_number;
}

std::size_t xdmf_bytes(const io::ResultsLayout& layout) {
  const std::size_t fields = 4 + (layout.contact ? 1 : 0) + (layout.stress ? 6 : 0);
  return fields * bytes_of_a_field * layout.n_snapshots;
}

/// The directory or, while it is not there, the nearest one above it.
fs::path existing(const fs::path& directory) {
  std::error_code error;
  fs::path at = fs::absolute(directory, error);
  while (!error && !fs::exists(at, error) && at.has_parent_path() && at != at.parent_path())
    at = at.parent_path();
  return at;
}

/// Bytes that the directory has already: replaced, or gone on with. A run that is gone on with has
/// its results.h5 twice while the kept snapshots are copied.
std::size_t bytes_there(const RunOptions& options) {
  std::size_t bytes = 0;
  for (const std::string name :
       {"results.h5", "history.csv", "contact.csv", "fields.xdmf", "fields.vtkhdf"}) {
    const bool counts = options.overwrite || (options.resume && name != "results.h5");
    std::error_code error;
    const auto size = fs::file_size(options.directory / name, error);
    if (counts && !error) bytes += size;
  }
  return bytes;
}

}  // namespace

DiskNeed disk_needed(const RecordPlan& plan, bool keeps_checkpoints) {
  const io::ResultsLayout& layout = plan.results;
  DiskNeed need;
  if (!layout.mesh) return {plan.own_bytes + small_files, plan.own_bytes};
  for (const std::size_t bytes :
       {io::Results::bytes(layout), plan.n_rows * bytes_of_a_number * plan.columns.size(),
        contact_csv_bytes(plan), xdmf_bytes(layout)}) {
    need.all += bytes;
    need.largest_file = std::max(need.largest_file, bytes);
  }
  const std::size_t numbers =
      layout.mesh->is_solid() ? numbers_of_a_solid_checkpoint : numbers_of_a_checkpoint;
  const std::size_t checkpoint = layout.mesh->n_nodes() * numbers * sizeof(double) + 50'000;
  need.all += small_files + (keeps_checkpoints ? checkpoints * checkpoint : 0);
  return need;
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
