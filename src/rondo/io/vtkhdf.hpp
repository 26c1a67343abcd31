// SPDX-License-Identifier: BSD-3-Clause
/// @file  VTKHDF: a small file beside an HDF5 file that presents its fields to VTK and ParaView in
/// VTK's own layout (docs.vtk.org, "VTKHDF format specification": UnstructuredGrid, version 2.0,
/// temporal). No data is stored twice: cells are links, positions and fields are virtual datasets
/// that show (t, n, 3) as (t * n, 3) (docs/decisions/040).
#pragma once
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "rondo/io/h5/h5.hpp"
#include "rondo/io/h5/linked.hpp"
#include "rondo/io/xdmf.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::io {

/// Writes the cells in VTK's layout into the group /mesh/vtk of the file. @throws FileError
void write_vtk_cells(h5::File& file, const mesh::Mesh& mesh);

/// Size in bytes of the datasets of write_vtk_cells().
std::size_t vtk_cells_bytes(const mesh::Mesh& mesh) noexcept;

/// Has a step for each complete row of the datasets; without rows there is no file. The file is
/// complete at any moment, because it is replaced by a new one from time to time. Its bytes depend
/// neither on how it was closed nor on an earlier file.
class Vtkhdf {
 public:
  /// Time between two replacements, so that a run of many snapshots makes few files.
  static constexpr std::chrono::milliseconds interval{100};

  /// Creates or replaces the file; without rows, removes it. @param times of the rows that exist
  /// already. @pre the series has positions. @throws FileError
  Vtkhdf(std::filesystem::path file, XdmfSeries series, std::vector<double> times = {});

  /// Adds the step of the next row. The first step is written at once, another together with the
  /// next one that is written. @throws FileError
  void add(double time);
  /// Writes the file for datasets that were cut to the steps added. @throws FileError
  void close();
  /// Writes all steps and makes sure that they are on the disk even if the machine fails.
  /// @throws FileError
  void sync();

 private:
  void build();
  void build_steps();
  void label(const std::string& name, const ShownLabel& of);
  void put_step(std::size_t k);
  void put();

  std::filesystem::path path_;
  XdmfSeries series_;
  std::vector<double> times_;  ///< of the steps                                       [s]
  std::optional<h5::LinkedFile> file_;
  std::size_t put_ = 0;  ///< number of steps in the file
  std::chrono::steady_clock::time_point put_at_{};
};

}  // namespace rondo::io
