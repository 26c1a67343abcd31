// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/pod_files.hpp"

#include <fmt/format.h>

#include <array>
#include <system_error>
#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/basis_file.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/mesh_files.hpp"
#include "rondo/io/xdmf.hpp"

namespace rondo::io {
namespace fs = std::filesystem;
namespace {

using Eigen::Index;

constexpr std::array file_names{"pod.h5", "spectrum.csv", "modes.xdmf", "reconstruction.xdmf",
                                "basis.h5"};
using h5::Type;
using Vector = PodWriter::Vector;

std::size_t size(Index n) noexcept {
  return static_cast<std::size_t>(n);
}

using Counts = PodCounts;

Counts counts_of(const PodContent& c, std::size_t n_reconstructed) noexcept {
  RONDO_DEMAND(c.mesh && c.decomposition && c.spectrum && c.modes, c.quantity);
  return {c.mesh->n_nodes(),
          c.contact ? c.mesh->boundary.size() : c.mesh->n_nodes(),
          size(c.modes->cols()),
          size(c.decomposition->sigma.size()),
          size(c.decomposition->temporal.cols()),
          c.time.size(),
          n_reconstructed};
}

void check(const PodContent& c, const Counts& n) {
  const std::size_t weights = c.weight == "search-direction" ? 0 : n.points;
  RONDO_DEMAND(c.mass.size() == n.nodes && c.point_weight.size() == weights, c.mass.size(),
               c.point_weight.size(), weights);
  RONDO_DEMAND(n.modes == 0 || size(c.modes->rows()) == c.components * n.points, c.modes->rows(),
               n.points);
  RONDO_DEMAND(n.modes <= n.temporal && n.temporal <= n.values, n.modes, n.temporal, n.values);
  RONDO_DEMAND(size(c.decomposition->temporal.rows()) == n.times, c.decomposition->temporal.rows(),
               n.times);
  RONDO_DEMAND(c.spectrum->energy.size() == n.values && c.spectrum->cumulative.size() == n.values &&
                   c.spectrum->discarded.size() == n.values,
               c.spectrum->energy.size(), n.values);
  RONDO_DEMAND(c.angle.size() == n.times && c.run.size() == n.times && c.error.size() == n.times,
               c.angle.size(), c.run.size(), c.error.size(), n.times);
}

/// Units that follow from the weight W: Φ has the unit of W^(-1/2), Σ that of the quantity times
/// W^(1/2).
struct Units {
  std::string weight, modes, sigma;
};

Units units_of(const PodContent& c) {
  if (c.mesh->is_solid() && c.weight == "mass") return {"kg", "kg^(-1/2)", c.unit + " kg^(1/2)"};
  if (c.mesh->is_solid() && c.weight == "delassus")
    return {"1/kg", "kg^(1/2)", c.unit + " kg^(-1/2)"};
  if (c.weight == "mass") return {"kg/m", "(kg/m)^(-1/2)", c.unit + " (kg/m)^(1/2)"};
  if (c.weight == "delassus") return {"m/kg", "(kg/m)^(1/2)", c.unit + " (kg/m)^(-1/2)"};
  if (c.weight == "search-direction") return {"", c.unit + " (J/m)^(-1/2)", "(J/m)^(1/2)"};
  RONDO_DEMAND(c.weight == "none", c.weight);
  return {"1", "1", c.unit};
}

/// Datasets without numbers are left out because readers fail on them.
template <class Values>
void write(h5::File& file, const std::string& name, const h5::Shape& shape, const Values& values,
           const h5::Label& label) {
  if (!values.empty()) file.write(name, shape, values, label);
}

void write_spectrum(h5::File& file, const PodContent& c, const Counts& n) {
  const auto put = [&](const char* name, std::span<const double> values, const h5::Label& label) {
    write(file, std::string("/spectrum/") + name, {n.values}, values, label);
  };
  const Eigen::VectorXd& sigma = c.decomposition->sigma;
  put("singular_value", {sigma.data(), n.values},
      {units_of(c).sigma, fmt::format("singular values of the snapshots of {} under the weight {}",
                                      c.quantity, c.weight)});
  put("energy", c.spectrum->energy, {"1", "share of each mode in the energy of the snapshots"});
  put("cumulative_energy", c.spectrum->cumulative, {"1", "share of the modes up to each"});
  put("discarded_energy", c.spectrum->discarded, {"1", "share of the modes after each"});
}

void write_snapshots(h5::File& file, const PodContent& c, const Counts& n) {
  write(file, "/snapshots/time", {n.times}, c.time,
        {c.time_unit,
         c.time_unit == "s" ? "of each snapshot" : "of each snapshot: share of the load"});
  write(file, "/snapshots/angle", {n.times}, c.angle,
        {"rad", "angle of the co-rotating frame, counter-clockwise, at the time of the quantity"});
  write(
      file, "/snapshots/run", {n.times}, c.run,
      {"1", "run of each snapshot, from 0: the attributes run_0, run_1, ... name the directories"});
  write(
      file, "/snapshots/error", {n.times}, c.error,
      {"1",
       "norm of what the modes of /modes/spatial leave out of each snapshot, over the snapshot's"});
  if (n.times == 0) return;
  for (std::size_t i = 0; i < c.runs.size(); ++i)
    file.set_attribute("/snapshots/run", fmt::format("run_{}", i), c.runs[i]);
}

/// Written row by row because V is stored column by column.
void write_temporal(h5::File& file, const PodContent& c, const Counts& n) {
  const auto put = [&](const char* name, std::size_t columns, bool times_sigma,
                       const h5::Label& label) {
    if (n.times * columns == 0) return;
    h5::Dataset dataset = file.create(name, Type::float64, {n.times, columns}, label);
    std::vector<double> row(columns);
    for (std::size_t j = 0; j < n.times; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        const auto at = static_cast<Index>(i);
        row[i] = c.decomposition->temporal(static_cast<Index>(j), at) *
                 (times_sigma ? c.decomposition->sigma[at] : 1.0);
      }
      dataset.write_row(j, std::span<const double>(row));
    }
  };
  put("/modes/temporal", n.temporal, false,
      {"1", "V: column i is the course of mode i over the snapshots, of norm 1"});
  put("/modes/coefficients", n.modes, true,
      {units_of(c).sigma, "V Σ: coefficients of the spatial modes in each snapshot"});
}

}  // namespace

PodWriter::PodWriter(const fs::path& directory, const PodContent& c, std::size_t n_reconstructed)
    : directory_(directory),
      folder_(directory / (".pod" + unfinished_ending())),
      n_(counts_of(c, n_reconstructed)),
      field_(n_.nodes, Vector{}),
      difference_(n_.points * c.components),
      components_(c.components) {
  check(c, n_);
  if (c.contact) boundary_ = c.mesh->boundary;
  demand_room(directory_ / "pod.h5", bytes(c, n_reconstructed));
  remove_left_unfinished(directory_);
  at_signal_.emplace_back(folder_);
  for (const char* name : file_names) at_signal_.emplace_back(folder_ / name);
  std::error_code error;
  fs::remove_all(folder_, error);
  if (!fs::create_directory(folder_, error))
    throw FileError(folder_.string(), "cannot create directory: " + error.message());
  try {
    write_all(c);
  } catch (...) {
    fs::remove_all(folder_, error);
    throw;
  }
}

PodWriter::~PodWriter() {
  d_ = {};
  xdmf_.reset();
  file_ = {};
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void PodWriter::write_all(const PodContent& c) {
  file_ = h5::File::create(folder_ / "pod.h5");
  file_.set_attribute("/", "format", "rondo pod 1");
  for (const auto& [name, text] : {std::pair("quantity", c.quantity), std::pair("frame", c.frame),
                                   std::pair("shift", c.shift), std::pair("weight", c.weight)})
    file_.set_attribute("/", name, text);
  write_mesh(file_, *c.mesh, c.mass);
  write(file_, "/weight", {c.point_weight.size()}, c.point_weight,
        {units_of(c).weight, "weight W of each point in the norm: " + c.weight});
  write_spectrum(file_, c, n_);
  write_snapshots(file_, c, n_);
  write_temporal(file_, c, n_);
  write_modes(c);
  write_csv(c);
  if (n_.reconstructed > 0) create_reconstruction(c);
  if (c.basis) write_basis(folder_ / "basis.h5", *c.mesh, c.mass, *c.basis);
  file_.flush();
}

/// Φ is stored in memory as in the file, mode after mode.
void PodWriter::write_modes(const PodContent& c) {
  Xdmf modes(folder_ / "modes.xdmf", series(c, n_.modes));
  if (n_.modes == 0) return modes.close();
  const Units units = units_of(c);
  const bool solid = c.components == 3;
  const std::string place = c.contact ? std::string("node of /mesh/boundary: normal, tangential") +
                                            (solid ? ", lateral" : "")
                                      : std::string("node: x, y") + (solid ? ", z" : "");
  file_.write("/modes/spatial", {n_.modes, n_.points, c.components},
              std::span<const double>(c.modes->data(), size(c.modes->size())),
              {units.modes, "spatial modes Φ at each " + place});
  h5::Dataset dataset = file_.create("/fields/modes", Type::float32, {n_.modes, n_.nodes, 3},
                                     {units.modes, "/modes/spatial for ParaView, at all nodes"});
  for (std::size_t i = 0; i < n_.modes; ++i) {
    const auto column = c.modes->col(static_cast<Index>(i));
    put(dataset, i, {{column.data(), size(column.size())}, c.components});
    modes.add(static_cast<double>(i + 1));
  }
  modes.close();
}

void PodWriter::write_csv(const PodContent& c) const {
  Csv csv(folder_ / "spectrum.csv",
          {"mode", "singular_value", "energy", "cumulative_energy", "discarded_energy"});
  for (std::size_t i = 0; i < n_.values; ++i)
    csv.row(std::array<double, 5>{
        static_cast<double>(i + 1), c.decomposition->sigma[static_cast<Index>(i)],
        c.spectrum->energy[i], c.spectrum->cumulative[i], c.spectrum->discarded[i]});
  csv.close();
}

void PodWriter::create_reconstruction(const PodContent& c) {
  const h5::Shape shape = {n_.reconstructed, n_.nodes, 3};
  const std::string of = c.quantity + ", frame of the analysis";
  d_.original =
      file_.create("/fields/original", Type::float32, shape, {c.unit, "snapshots of " + of});
  d_.reconstructed = file_.create("/fields/reconstructed", Type::float32, shape,
                                  {c.unit, "the same from the spatial modes: " + of});
  d_.error = file_.create("/fields/error", Type::float32, shape,
                          {c.unit, "/fields/original minus /fields/reconstructed"});
  XdmfSeries s = series(c, n_.reconstructed);
  s.fields.clear();
  for (const char* name : {"original", "reconstructed", "error"})
    add_fields(s, name, std::string("/fields/") + name);
  xdmf_ = std::make_unique<Xdmf>(folder_ / "reconstruction.xdmf", std::move(s));
}

XdmfSeries PodWriter::series(const PodContent& c, std::size_t times) const {
  XdmfSeries s;
  s.data_file = "pod.h5";
  s.topology = topology_of(*c.mesh);
  s.reference = "/mesh/coordinates";
  s.dimensions = c.mesh->is_solid() ? 3 : 2;
  s.n_nodes = n_.nodes;
  s.n_times = times;
  add_fields(s, c.contact ? "" : "mode", "/fields/modes");
  return s;
}

/// Normal and tangential components are shown as two scalars: they are not a vector in fixed axes.
void PodWriter::add_fields(XdmfSeries& s, const std::string& name,
                           const std::string& dataset) const {
  if (boundary_.empty()) {
    s.fields.push_back({name, "Vector", dataset, 3, 0, 3});
    return;
  }
  const std::string front = name.empty() ? name : name + "_";
  s.fields.push_back({front + "normal", "Scalar", dataset, 3, 0, 1});
  s.fields.push_back({front + "tangential", "Scalar", dataset, 3, 1, 1});
  if (components_ == 3) s.fields.push_back({front + "lateral", "Scalar", dataset, 3, 2, 1});
}

void PodWriter::put(h5::Dataset& dataset, std::size_t row, FieldView values) {
  for (std::size_t i = 0; i < n_.points; ++i) {
    Vector& to = field_[boundary_.empty() ? i : static_cast<std::size_t>(boundary_[i])];
    for (std::size_t k = 0; k < values.components; ++k) to[k] = static_cast<float>(values[i][k]);
  }
  dataset.write_row(row, std::span<const Vector>(field_));
}

void PodWriter::commit() {
  RONDO_DEMAND(file_ && added_ == n_.reconstructed, added_, n_.reconstructed);
  if (xdmf_) xdmf_->close();
  d_ = {};
  file_.close();
  const auto remove = [&](const char* name) {
    std::error_code error;
    fs::remove(directory_ / name, error);
    if (error) throw FileError((directory_ / name).string(), "cannot remove: " + error.message());
  };
  remove("pod.json");
  for (const char* name : file_names) {
    std::error_code none;
    if (fs::exists(folder_ / name, none))
      replace_file(folder_ / name, directory_ / name);
    else
      remove(name);
  }
}

void PodWriter::add(double time, FieldView original, FieldView reconstructed) {
  RONDO_DEMAND(added_ == 0 || time > last_, time, last_);  // required by ParaView
  RONDO_DEMAND(added_ < n_.reconstructed && original.size() == n_.points &&
                   reconstructed.size() == n_.points,
               added_, original.size(), reconstructed.size(), n_.points);
  for (std::size_t i = 0; i < difference_.size(); ++i)
    difference_[i] = original.values[i] - reconstructed.values[i];
  put(d_.original, added_, original);
  put(d_.reconstructed, added_, reconstructed);
  put(d_.error, added_, {difference_, original.components});
  ++added_;
  last_ = time;
  xdmf_->add(time);
}

std::size_t PodWriter::bytes(const PodContent& content, std::size_t n_reconstructed) noexcept {
  const Counts n = counts_of(content, n_reconstructed);
  constexpr std::size_t real = 8, whole = 4, vector = sizeof(Vector), description = 65536;
  const std::size_t modes = n.modes * (content.components * n.points * real + n.nodes * vector);
  const std::size_t times = n.times * ((n.temporal + n.modes + 3) * real + whole);
  const std::size_t basis = content.basis ? basis_bytes(*content.mesh, *content.basis) : 0;
  return description + basis + mesh_bytes(*content.mesh) + modes + times + 4 * n.values * real +
         n.points * real + 3 * n_reconstructed * n.nodes * vector;
}

}  // namespace rondo::io
