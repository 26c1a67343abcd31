// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/kept_runs.hpp"

#include <cmath>
#include <system_error>

#include "rondo/analysis/crush/pgd_files.hpp"
#include "rondo/analysis/figures/history_statistics.hpp"
#include "rondo/analysis/registry.hpp"
#include "rondo/core/build_id.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/basis_file.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/run_reader.hpp"
#include "rondo/output/kept/kept_files.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;

/// Whether the files have their contents. @throws FileError, InputError: changed, or unreadable
bool is_whole(const fs::path& directory, const Case& c, const Json& j) {
  const auto number = [&](const char* key) { return number_in(j, key); };
  demand_kept(directory, kept_files_of(j.at("files")));
  const Columns history = io::read_columns(directory / "history.csv");
  const std::vector<double>& time = column(history, "time_s", directory / "history.csv");
  if (std::abs(time.back() - number("last_time")) > 1e-9 * time.back()) return false;
  if (type_of(c).finds_modes && text_in(j, "status") == "done")
    static_cast<void>(io::read_basis(pgd_basis_file(directory)));
  if (number("snapshots") == 0.0) return true;
  return static_cast<double>(io::RunReader(directory).n_snapshots()) == number("snapshots") &&
         fs::is_regular_file(directory / "fields.xdmf");
}

/// Whether a run ended: a failed run must have failed at a step, not because the disk was full.
bool ended(const Json& j) {
  const std::string status = text_in(j, "status");
  return status == "done" || (status == "failed" && j.contains("steps_done"));
}

}  // namespace

bool is_of_this_program(const Json& j) {
  static const std::string own = build_id();
  return !own.empty() && text_in(j, "build_id") == own;
}

double number_in(const Json& j, const char* key) {
  return j.is_object() && j.contains(key) && j[key].is_number() ? j[key].get<double>() : -1.0;
}

bool is_case_of(const fs::path& directory, const Case& c) {
  const Case kept = kept_case(c);
  if (io::text_of(directory / "case.toml") != write_case(kept)) return false;
  const MeshCase* const mesh = mesh_file_of(kept);
  const bool is_copy = mesh && mesh->file.is_relative();
  return !is_copy || io::text_of(directory / mesh->file) == io::text_of(mesh_file_of(c)->file);
}

bool run_is_there(const fs::path& directory, const Case& c, const std::string& modes) {
  try {
    const Json j = io::read_json(directory / "run.json");
    return ended(j) && is_of_this_program(j) && is_case_of(directory, c) &&
           text_in(j, "modes_from") == modes && is_whole(directory, c, j);
  } catch (const std::exception&) {  // unreadable results are computed again
    return false;
  }
}

void remove_unfinished(const fs::path& directory) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error))
    if (entry.path().extension() == ".tmp") fs::remove_all(entry.path(), error);
}

}  // namespace rondo::study
