// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/run_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/io/mesh_files.hpp"

namespace rondo::io {
namespace fs = std::filesystem;
namespace {

constexpr const char* results_format = "rondo results 1";

[[noreturn]] void refuse(
    const fs::path& directory, const std::string& what,
    const char* wanted = "the directory of a run, as `rondo run CASE.toml -o RUN` makes it") {
  throw request_error("RUN", directory.string(), what, wanted);
}

/// The path of results.h5 in a directory that contains one.
fs::path results_of(const fs::path& directory) {
  std::error_code error;
  if (!fs::exists(directory, error)) refuse(directory, "there is no such directory");
  if (!fs::is_directory(directory, error)) refuse(directory, "is not a directory");
  if (!fs::exists(directory / "results.h5", error)) refuse(directory, "holds no results.h5");
  return directory / "results.h5";
}

h5::File open_results(const fs::path& path) {
  h5::File file = h5::File::open(path);
  std::string format = "none";
  try {
    format = file.attribute("/", "format");
  } catch (const FileError&) {  // reported below
  }
  if (format != results_format)
    throw FileError(path.string(),
                    fmt::format("not a results file of this version: its format is \"{}\", not "
                                "\"{}\"; run the case again",
                                format, results_format));
  return file;
}

std::string text_in(const nlohmann::json& json, const char* key) {
  if (!json.contains(key) || !json[key].is_string()) return "unknown";
  return json[key].get<std::string>();
}

}  // namespace

RunReader::RunReader(fs::path directory)
    : directory_(std::move(directory)), file_(open_results(results_of(directory_))) {
  read_summary();
  read_analysis();
  MeshWithMass read = read_mesh(file_);
  mesh_ = std::move(read.mesh);
  mass_ = std::move(read.mass);
  read_times();
  open_snapshots();
}

void RunReader::read_summary() {
  demand_regular_file(directory_ / "run.json");
  std::ifstream in(directory_ / "run.json", std::ios::binary);
  constexpr bool exceptions = false;
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, exceptions);
  title_ = text_in(json, "title");
  status_ = text_in(json, "status");
}

void RunReader::read_analysis() {
  std::string found;
  try {
    found = file_.attribute("/", "analysis");
  } catch (const FileError&) {  // file of an earlier version
    return;
  }
  analysis_ = found;
}

/// A run without snapshots has no group /frame.
void RunReader::read_times() {
  if (!file_.contains("/frame/time") && !file_.contains("/snapshots")) return;
  times_.time = file_.dataset("/frame/time", {h5::any}).read<double>();
  time_unit_ = file_.attribute("/frame/time", "units");
  if (time_unit_ != "s" && time_unit_ != "1")
    throw FileError(file_.path(), fmt::format("/frame/time is in \"{}\"; rondo writes \"s\", or "
                                              "\"1\" for a share of the load: damaged",
                                              time_unit_));
  n_planned_ = times_.time.size();
  std::size_t n = 0;
  while (n < n_planned_ && std::isfinite(times_.time[n]) &&
         (n == 0 || times_.time[n] > times_.time[n - 1]))
    ++n;
  for (std::size_t k = n; k < n_planned_; ++k)
    if (!std::isnan(times_.time[k]))
      throw FileError(file_.path(), fmt::format("/frame/time[{}] = {}: times must rise, and be NaN "
                                                "from the first snapshot not written: damaged",
                                                k, times_.time[k]));
  const auto read = [&](const char* name, std::vector<double>& values) {
    values = file_.dataset(name, {n_planned_}).read<double>();
    values.resize(n);
    for (std::size_t k = 0; k < n; ++k)
      if (!std::isfinite(values[k]))
        throw FileError(file_.path(), fmt::format("{}[{}] = {}: damaged", name, k, values[k]));
  };
  times_.time.resize(n);
  read("/frame/time_velocity", times_.time_velocity);
  for (std::size_t k = 1; k < n; ++k)
    if (times_.time_velocity[k] <= times_.time_velocity[k - 1])
      throw FileError(file_.path(),
                      fmt::format("/frame/time_velocity[{}] = {} after {}: times must "
                                  "rise: damaged",
                                  k, times_.time_velocity[k], times_.time_velocity[k - 1]));
  read("/frame/angle", times_.angle);
  if (file_.contains("/frame/angle_velocity")) read("/frame/angle_velocity", times_.angle_velocity);
}

void RunReader::open_snapshots() {
  if (file_.contains("/reduced/modes"))
    refuse(directory_,
           "holds snapshots of modes, which an earlier version wrote (rondo run --snapshots modes)",
           "the same case run again");
  const std::size_t n_components = mesh_.is_solid() ? 3 : 2;
  const auto open = [&](const char* name, std::size_t points, h5::Dataset& dataset) {
    if (file_.contains(name)) dataset = file_.dataset(name, {n_planned_, points, n_components});
  };
  open("/snapshots/displacement", mesh_.n_nodes(), displacement_);
  open("/snapshots/velocity", mesh_.n_nodes(), velocity_);
  open("/contact/force", mesh_.boundary.size(), contact_);
  if (n_planned_ > 0 && (!displacement_ || !velocity_))
    throw FileError(file_.path(), "times without /snapshots: damaged, or not of this program");
}

const h5::Dataset& RunReader::dataset(Quantity quantity) const noexcept {
  if (quantity == Quantity::displacement) return displacement_;
  return quantity == Quantity::velocity ? velocity_ : contact_;
}

bool RunReader::has(Quantity quantity) const noexcept {
  return static_cast<bool>(dataset(quantity));
}

std::size_t RunReader::n_points(Quantity quantity) const noexcept {
  return quantity == Quantity::contact ? mesh_.boundary.size() : mesh_.n_nodes();
}

std::size_t RunReader::n_components(Quantity quantity) const noexcept {
  return has(quantity) ? dataset(quantity).shape().back() : 0;
}

void RunReader::read(Quantity quantity, std::size_t snapshot, std::size_t first,
                     MutableFieldView out) const {
  RONDO_DEMAND(has(quantity) && snapshot < n_snapshots(), snapshot, n_snapshots());
  RONDO_DEMAND(out.components == dataset(quantity).shape().back(), out.components);
  dataset(quantity).read_part(snapshot, first, out.values);
}

std::string mesh_difference(const RunReader& a, const RunReader& b) {
  if (const std::string text = mesh_difference(a.mesh(), b.mesh()); !text.empty()) return text;
  std::size_t i = 0;
  while (i < a.mass().size() && a.mass()[i] == b.mass()[i]) ++i;
  if (i == a.mass().size()) return {};
  return fmt::format("masses differ at node {}: {:.6g} {} against {:.6g}", i, a.mass()[i],
                     a.mesh().is_solid() ? "kg" : "kg/m", b.mass()[i]);
}

}  // namespace rondo::io
