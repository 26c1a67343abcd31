// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/vtkhdf.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/linked.hpp"

namespace rondo::io {
namespace {

constexpr std::uint8_t triangle = 5, quadrilateral = 9, hexahedron = 12;  // numbers of VTK

struct VtkCells {
  std::vector<std::int64_t> connectivity, offsets = {0};
  std::vector<std::uint8_t> types;

  template <class Nodes>
  void add(std::uint8_t type, const Nodes& nodes, std::size_t n) {
    types.push_back(type);
    for (std::size_t k = 0; k < n; ++k) connectivity.push_back(nodes[k]);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
};

VtkCells cells_of(const mesh::Mesh& m) {
  VtkCells cells;
  for (const mesh::Hexahedron& nodes : m.hexahedra) cells.add(hexahedron, nodes, nodes.size());
  for (const mesh::Cell& nodes : m.cells) {
    const auto corners = static_cast<std::size_t>(mesh::n_corners(nodes));
    cells.add(corners == 3 ? triangle : quadrilateral, nodes, corners);
  }
  return cells;
}

std::string in_steps(const std::string& name) {
  return "/VTKHDF/Steps/" + name;
}

/// VTK's order of a symmetric tensor is xx, yy, zz, xy, yz, xz; that of the datasets is xx, xy, xz,
/// yy, yz, zz.
std::vector<std::size_t> columns_of(const XdmfField& f) {
  if (f.type == "Tensor6") return {0, 3, 5, 1, 4, 2};
  if (f.components == f.width) return {};
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < f.components; ++k) columns.push_back(f.first + k);
  return columns;
}

}  // namespace

void write_vtk_cells(h5::File& file, const mesh::Mesh& mesh) {
  const VtkCells cells = cells_of(mesh);
  file.write("/mesh/vtk/connectivity", {cells.connectivity.size()}, cells.connectivity,
             {"1", "corner nodes of all cells, one after another, for fields.vtkhdf"});
  file.write(
      "/mesh/vtk/offsets", {cells.offsets.size()}, cells.offsets,
      {"1", "where each cell begins in /mesh/vtk/connectivity, and where the last one ends"});
  file.write("/mesh/vtk/types", {cells.types.size()}, cells.types,
             {"1", "kind of each cell: 5 triangle, 9 quadrilateral, 12 hexahedron"});
}

std::size_t vtk_cells_bytes(const mesh::Mesh& m) noexcept {
  constexpr std::size_t whole = 8;
  std::size_t corners = 8 * m.hexahedra.size();
  for (const mesh::Cell& cell : m.cells) corners += static_cast<std::size_t>(mesh::n_corners(cell));
  const std::size_t cells = m.hexahedra.size() + m.cells.size();
  return whole * (corners + cells + 1) + cells;
}

Vtkhdf::Vtkhdf(std::filesystem::path file, XdmfSeries series, std::vector<double> times)
    : path_(std::move(file)), series_(std::move(series)), times_(std::move(times)) {
  RONDO_DEMAND(!series_.position.empty() && times_.size() <= series_.n_times, times_.size());
  build();
  if (!times_.empty()) {
    put();
    return;
  }
  std::error_code error;
  std::filesystem::remove(path_, error);
  if (error) throw FileError(path_.string(), "cannot remove: " + error.message());
}

/// Builds the file for n_times rows with the steps so far.
void Vtkhdf::build() {
  h5::LinkedFile& file = file_.emplace();
  const auto count = [&](const char* name, std::size_t n) {
    file.fill(std::string("/VTKHDF/") + name, {1}, static_cast<std::int64_t>(n));
  };
  count("NumberOfPoints", series_.n_nodes);
  count("NumberOfCells", series_.topology.n_cells);
  count("NumberOfConnectivityIds", series_.topology.n_corners);
  file.set_attribute("/VTKHDF", "Version", std::array<std::int64_t, 2>{2, 0});
  file.set_attribute("/VTKHDF", "Type", "UnstructuredGrid");
  file.link("/VTKHDF/Connectivity", series_.data_file, "/mesh/vtk/connectivity");
  file.link("/VTKHDF/Offsets", series_.data_file, "/mesh/vtk/offsets");
  file.link("/VTKHDF/Types", series_.data_file, "/mesh/vtk/types");
  const std::size_t rows = series_.n_times, n = series_.n_nodes;
  file.show("/VTKHDF/Points", {series_.data_file, series_.position, rows, n, 3, {}});
  label("/VTKHDF/Points", series_.position_label);
  for (const XdmfField& f : series_.fields) {
    const std::string name = "/VTKHDF/PointData/" + f.name;
    file.show(name, {series_.data_file, f.dataset, rows, n, f.width, columns_of(f)});
    label(name, f.label);
  }
  build_steps();
  label(in_steps("Values"), series_.time_label);
  for (std::size_t k = 0; k < times_.size(); ++k) put_step(k);
}

/// Readers of VTKHDF ignore attributes that they do not know.
void Vtkhdf::label(const std::string& name, const ShownLabel& of) {
  if (of.units.empty()) return;
  file_->set_attribute(name, "units", of.units);
  file_->set_attribute(name, "description", of.description);
}

/// The offsets of points, cells and fields of each step in the arrays: cells are always at the
/// beginning, points and fields of the steps follow one another.
void Vtkhdf::build_steps() {
  const std::size_t t = series_.n_times;
  file_->create_rows(in_steps("Values"), h5::Type::float64, {t}, 0);
  file_->create_rows(in_steps("NumberOfParts"), h5::Type::int64, {t}, 1);
  file_->create_rows(in_steps("PartOffsets"), h5::Type::int64, {t}, 0);
  file_->create_rows(in_steps("PointOffsets"), h5::Type::int64, {t}, 0);
  file_->create_rows(in_steps("CellOffsets"), h5::Type::int64, {t, 1}, 0);
  file_->call(in_steps("ConnectivityIdOffsets"), in_steps("CellOffsets"));
  for (const XdmfField& f : series_.fields)
    file_->call(in_steps("PointDataOffsets/") + f.name, in_steps("PointOffsets"));
}

void Vtkhdf::put_step(std::size_t k) {
  for (const char* name : {"Values", "NumberOfParts", "PartOffsets", "PointOffsets", "CellOffsets"})
    file_->set_rows(in_steps(name), k + 1);
  file_->set_row(in_steps("Values"), k, times_[k]);
  file_->set_row(in_steps("PointOffsets"), k, static_cast<std::int64_t>(k * series_.n_nodes));
  file_->set_attribute("/VTKHDF/Steps", "NSteps", static_cast<std::int64_t>(k + 1));
}

void Vtkhdf::put() {
  write_beside(path_, file_->bytes());
  put_ = times_.size();
  put_at_ = std::chrono::steady_clock::now();
}

void Vtkhdf::add(double time) {
  RONDO_DEMAND(times_.size() < series_.n_times, series_.n_times);
  times_.push_back(time);
  put_step(times_.size() - 1);
  if (std::chrono::steady_clock::now() - put_at_ >= interval) put();
}

void Vtkhdf::close() {
  if (!file_) return;
  if (!times_.empty()) {
    series_.n_times = times_.size();
    build();
    put();
  }
  file_.reset();
}

void Vtkhdf::sync() {
  if (times_.empty()) return;
  if (put_ < times_.size()) put();
  sync_file(path_);
}

}  // namespace rondo::io
