// SPDX-License-Identifier: BSD-3-Clause
/// @file  The files that a run had written at some moment, with hashes that verify them later.
/// Stored in checkpoint.h5 and, at the end of a run, as `files` in run.json (docs/results.md).
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "rondo/io/csv.hpp"
#include "rondo/io/results.hpp"

namespace rondo::study {

struct KeptFiles {
  std::map<std::string, io::CsvPlace, std::less<>> tables;  ///< by name: history.csv, contact.csv
  io::KeptSnapshots snapshots;                              ///< in results.h5

  /// @throws FileError: there is no entry for that table
  [[nodiscard]] const io::CsvPlace& table(const std::string& name) const;

  friend bool operator==(const KeptFiles&, const KeptFiles&) = default;
};

nlohmann::ordered_json as_json(const io::CsvPlace& place);
nlohmann::ordered_json as_json(const KeptFiles& files);
/// @throws std::exception: it has not this form
KeptFiles kept_files_of(const nlohmann::ordered_json& json);

/// Reads all files. @throws FileError: one cannot be read, or differs in a bit from what is kept
void demand_kept(const std::filesystem::path& directory, const KeptFiles& files);

}  // namespace rondo::study
