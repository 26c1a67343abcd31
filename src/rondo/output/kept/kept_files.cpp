// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/kept/kept_files.hpp"

#include <fmt/format.h>

#include "rondo/core/error.hpp"

namespace rondo::study {

const io::CsvPlace& KeptFiles::table(const std::string& name) const {
  const auto found = tables.find(name);
  if (found != tables.end()) return found->second;
  throw FileError(name, "what was written into it is not known: damaged");
}

nlohmann::ordered_json as_json(const io::CsvPlace& place) {
  return {{"bytes", place.bytes}, {"xxh3-128", place.hash}};
}

nlohmann::ordered_json as_json(const KeptFiles& files) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, place] : files.tables) json[name] = as_json(place);
  json["results.h5"] = {{"snapshots", files.snapshots.count}, {"xxh3-128", files.snapshots.hashes}};
  return json;
}

KeptFiles kept_files_of(const nlohmann::ordered_json& json) {
  KeptFiles files;
  for (const auto& [name, place] : json.items())
    if (name == "results.h5")
      files.snapshots = {place.at("snapshots").get<std::size_t>(),
                         place.at("xxh3-128").get<std::map<std::string, std::string>>()};
    else
      files.tables[name] = {place.at("bytes").get<std::size_t>(),
                            place.at("xxh3-128").get<std::string>()};
  return files;
}

void demand_kept(const std::filesystem::path& directory, const KeptFiles& files) {
  for (const auto& [name, place] : files.tables) io::demand_kept(directory / name, place);
  io::demand_kept(directory / "results.h5", files.snapshots);
}

}  // namespace rondo::study
