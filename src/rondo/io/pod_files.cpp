// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/pod_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <system_error>
#include <utility>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/mesh_files.hpp"
#include "rondo/io/xdmf.hpp"

namespace rondo::io {
namespace fs = std::filesystem;
namespace {

using Eigen::Index;
using h5::Type;
using Vector = std::array<float, 3>;  ///< of ParaView

std::size_t size(Index n) noexcept {
  return static_cast<std::size_t>(n);
}

struct Counts {
  std::size_t nodes, points, modes, values, temporal, times, reconstructed;
};

Counts counts_of(const PodContent& c, std::size_t n_reconstructed) noexcept {
  return {c.mesh->n_nodes(),
          c.contact ? c.mesh->boundary.size() : c.mesh->n_nodes(),
          size(c.modes->cols()),
          size(c.decomposition->sigma.size()),
          size(c.decomposition->temporal.cols()),
          c.time.size(),
          n_reconstructed};
}

void check(const PodContent& c, const Counts& n) {
  RONDO_DEMAND(c.mass.size() == n.nodes && c.point_weight.size() == n.points, c.mass.size(),
               c.point_weight.size(), n.points);
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

/// Units that follow from the weight W: Φ has that of W^(-1/2), Σ that of the quantity times
/// W^(1/2).
struct Units {
  std::string weight, modes, sigma;
};

Units units_of(const PodContent& c) {
  if (c.weight == "mass") return {"kg/m", "(kg/m)^(-1/2)", c.unit + " (kg/m)^(1/2)"};
  if (c.weight == "delassus") return {"m/kg", "(kg/m)^(1/2)", c.unit + " (kg/m)^(-1/2)"};
  RONDO_DEMAND(c.weight == "none", c.weight);
  return {"1", "1", c.unit};
}

/// Datasets without numbers are left out: readers trip over them.
template <class T>
void write(h5::File& file, const std::string& name, const h5::Shape& shape,
           std::span<const T> values, const h5::Label& label) {
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
        {"rad", "angle of the turning frame, counter-clockwise, at the time of the quantity"});
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

/// Row by row: V lies in memory column after column.
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

struct PodWriter::Impl {
  Impl(const fs::path& directory, const PodContent& content, std::size_t n_reconstructed);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  void write_all(const PodContent& c);
  void write_modes(const PodContent& c);
  void write_csv(const PodContent& c) const;
  void create_reconstruction(const PodContent& c);
  [[nodiscard]] XdmfSeries series(const PodContent& c, std::size_t times) const;
  void add_fields(XdmfSeries& s, const std::string& name, const std::string& dataset) const;
  void put(h5::Dataset& dataset, std::size_t row, FieldView values);
  void commit();

  fs::path directory, folder;  ///< folder: where the files are made
  Counts n;
  std::vector<int> boundary;       ///< nodes of the points; empty: points are the nodes
  std::vector<Vector> field;       ///< (n) reused
  std::vector<double> difference;  ///< (n_points, components) reused
  std::size_t added = 0;
  double last = 0.0;  ///< time added [s]
  h5::File file;
  struct {
    h5::Dataset original, reconstructed, error;
  } d;
  std::unique_ptr<Xdmf> xdmf;
};

PodWriter::Impl::Impl(const fs::path& where, const PodContent& c, std::size_t n_reconstructed)
    : directory(where),
      folder(where / fmt::format(".pod.{}.tmp", ::getpid())),
      n(counts_of(c, n_reconstructed)),
      field(n.nodes, Vector{}),
      difference(n.points * c.components) {
  check(c, n);
  if (c.contact) boundary = c.mesh->boundary;
  demand_room(directory / "pod.h5", bytes(c, n_reconstructed));
  std::error_code error;
  fs::remove_all(folder, error);
  if (!fs::create_directory(folder, error))
    throw FileError(folder.string(), "cannot create directory: " + error.message());
  try {
    write_all(c);
  } catch (...) {
    fs::remove_all(folder, error);
    throw;
  }
}

PodWriter::Impl::~Impl() {
  d = {};
  xdmf.reset();
  file = {};
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

void PodWriter::Impl::write_all(const PodContent& c) {
  file = h5::File::create(folder / "pod.h5");
  file.set_attribute("/", "format", "rondo pod 1");
  for (const auto& [name, text] : {std::pair("quantity", c.quantity), std::pair("frame", c.frame),
                                   std::pair("shift", c.shift), std::pair("weight", c.weight)})
    file.set_attribute("/", name, text);
  write_mesh(file, *c.mesh, c.mass);
  write(file, "/weight", {n.points}, c.point_weight,
        {units_of(c).weight, "weight W of each point in the norm: " + c.weight});
  write_spectrum(file, c, n);
  write_snapshots(file, c, n);
  write_temporal(file, c, n);
  write_modes(c);
  write_csv(c);
  if (n.reconstructed > 0) create_reconstruction(c);
  file.flush();
}

/// Φ lies in memory as it does in the file, mode after mode.
void PodWriter::Impl::write_modes(const PodContent& c) {
  Xdmf modes(folder / "modes.xdmf", series(c, n.modes));
  if (n.modes == 0) return modes.close();
  const Units units = units_of(c);
  const std::string place = c.contact ? "node of /mesh/boundary: normal, tangential" : "node: x, y";
  file.write("/modes/spatial", {n.modes, n.points, c.components},
             std::span<const double>(c.modes->data(), size(c.modes->size())),
             {units.modes, "spatial modes Φ at each " + place});
  h5::Dataset dataset = file.create("/fields/modes", Type::float32, {n.modes, n.nodes, 3},
                                    {units.modes, "/modes/spatial for ParaView, at all nodes"});
  for (std::size_t i = 0; i < n.modes; ++i) {
    const auto column = c.modes->col(static_cast<Index>(i));
    put(dataset, i, {{column.data(), size(column.size())}, c.components});
    modes.add(static_cast<double>(i + 1));
  }
  modes.close();
}

void PodWriter::Impl::write_csv(const PodContent& c) const {
  Csv csv(folder / "spectrum.csv",
          {"mode", "singular_value", "energy", "cumulative_energy", "discarded_energy"});
  for (std::size_t i = 0; i < n.values; ++i)
    csv.row(std::array<double, 5>{
        static_cast<double>(i + 1), c.decomposition->sigma[static_cast<Index>(i)],
        c.spectrum->energy[i], c.spectrum->cumulative[i], c.spectrum->discarded[i]});
  csv.close();
}

void PodWriter::Impl::create_reconstruction(const PodContent& c) {
  const h5::Shape shape = {n.reconstructed, n.nodes, 3};
  const std::string of = c.quantity + ", frame of the analysis";
  d.original =
      file.create("/fields/original", Type::float32, shape, {c.unit, "snapshots of " + of});
  d.reconstructed = file.create("/fields/reconstructed", Type::float32, shape,
                                {c.unit, "the same from the spatial modes: " + of});
  d.error = file.create("/fields/error", Type::float32, shape,
                        {c.unit, "/fields/original minus /fields/reconstructed"});
  XdmfSeries s = series(c, n.reconstructed);
  s.fields.clear();
  for (const char* name : {"original", "reconstructed", "error"})
    add_fields(s, name, std::string("/fields/") + name);
  xdmf = std::make_unique<Xdmf>(folder / "reconstruction.xdmf", std::move(s));
}

XdmfSeries PodWriter::Impl::series(const PodContent& c, std::size_t times) const {
  XdmfSeries s;
  s.data_file = "pod.h5";
  s.topology = topology_of(*c.mesh);
  s.reference = "/mesh/coordinates";
  s.n_nodes = n.nodes;
  s.n_times = times;
  add_fields(s, c.contact ? "" : "mode", "/fields/modes");
  return s;
}

/// Normal and tangential are no vector of the fixed axes: two scalars.
void PodWriter::Impl::add_fields(XdmfSeries& s, const std::string& name,
                                 const std::string& dataset) const {
  if (boundary.empty()) {
    s.fields.push_back({name, "Vector", dataset, 3, 0, 3});
    return;
  }
  const std::string front = name.empty() ? name : name + "_";
  s.fields.push_back({front + "normal", "Scalar", dataset, 3, 0, 1});
  s.fields.push_back({front + "tangential", "Scalar", dataset, 3, 1, 1});
}

void PodWriter::Impl::put(h5::Dataset& dataset, std::size_t row, FieldView values) {
  for (std::size_t i = 0; i < n.points; ++i) {
    Vector& to = field[boundary.empty() ? i : static_cast<std::size_t>(boundary[i])];
    for (std::size_t k = 0; k < values.components; ++k) to[k] = static_cast<float>(values[i][k]);
  }
  dataset.write_row(row, std::span<const Vector>(field));
}

void PodWriter::Impl::commit() {
  RONDO_DEMAND(file && added == n.reconstructed, added, n.reconstructed);
  if (xdmf) xdmf->close();
  d = {};
  file.close();
  const auto remove = [&](const char* name) {
    std::error_code error;
    fs::remove(directory / name, error);
    if (error) throw FileError((directory / name).string(), "cannot remove: " + error.message());
  };
  remove("pod.json");
  if (!xdmf) remove("reconstruction.xdmf");
  for (const char* name : {"pod.h5", "spectrum.csv", "modes.xdmf", "reconstruction.xdmf"})
    if (xdmf || std::string_view(name) != "reconstruction.xdmf")
      replace_file(folder / name, directory / name);
}

PodWriter::PodWriter(const fs::path& directory, const PodContent& content,
                     std::size_t n_reconstructed) {
  RONDO_DEMAND(content.mesh && content.decomposition && content.spectrum && content.modes,
               content.quantity);
  impl_ = std::make_unique<Impl>(directory, content, n_reconstructed);
}

PodWriter::~PodWriter() = default;
PodWriter::PodWriter(PodWriter&&) noexcept = default;
PodWriter& PodWriter::operator=(PodWriter&&) noexcept = default;

void PodWriter::add(double time, FieldView original, FieldView reconstructed) {
  Impl& m = *impl_;
  RONDO_DEMAND(m.added == 0 || time > m.last, time, m.last);  // as ParaView wants them
  RONDO_DEMAND(m.added < m.n.reconstructed && original.size() == m.n.points &&
                   reconstructed.size() == m.n.points,
               m.added, original.size(), reconstructed.size(), m.n.points);
  for (std::size_t i = 0; i < m.difference.size(); ++i)
    m.difference[i] = original.values[i] - reconstructed.values[i];
  m.put(m.d.original, m.added, original);
  m.put(m.d.reconstructed, m.added, reconstructed);
  m.put(m.d.error, m.added, {m.difference, original.components});
  ++m.added;
  m.last = time;
  m.xdmf->add(time);
}

void PodWriter::commit() {
  impl_->commit();
}

std::size_t PodWriter::bytes(const PodContent& content, std::size_t n_reconstructed) noexcept {
  const Counts n = counts_of(content, n_reconstructed);
  constexpr std::size_t real = 8, whole = 4, vector = sizeof(Vector), description = 65536;
  const std::size_t modes = n.modes * (content.components * n.points * real + n.nodes * vector);
  const std::size_t times = n.times * ((n.temporal + n.modes + 3) * real + whole);
  return description + mesh_bytes(*content.mesh) + modes + times + 4 * n.values * real +
         n.points * real + 3 * n_reconstructed * n.nodes * vector;
}

}  // namespace rondo::io
