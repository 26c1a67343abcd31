// SPDX-License-Identifier: BSD-3-Clause
/// @file  VTKHDF: the small file beside an HDF5 file that shows its fields to VTK and ParaView by
/// VTK's own layout (docs.vtk.org, "VTKHDF format specification": UnstructuredGrid, version 2.0,
/// temporal). Nothing is stored twice: cells are links, positions and fields virtual datasets that
/// show (t, n, 3) as (t * n, 3) (docs/decisions/040).
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

/// The cells as VTK wants them, into the group /mesh/vtk of the HDF5 file. @throws FileError
void write_vtk_cells(h5::File& file, const mesh::Mesh& mesh);

/// Bytes of what write_vtk_cells() writes.
std::size_t vtk_cells_bytes(const mesh::Mesh& mesh) noexcept;

/// A step for each row of the datasets that is complete; no file where there is none. At any moment
/// the file is whole: a new one takes its place now and then. What closes it, or was there before,
/// leaves no trace in its bytes.
class Vtkhdf {
 public:
  /// Between two files that take each other's place: a run of many snapshots makes few of them.
  static constexpr std::chrono::milliseconds interval{100};

  /// Creates, replaces or, without rows, removes the file. @param times of the rows that are there
  /// already. @pre the series has positions. @throws FileError
  Vtkhdf(std::filesystem::path file, XdmfSeries series, std::vector<double> times = {});

  /// Adds the step of the next row; it is in the file with the next one that is written, the first
  /// at once. @throws FileError
  void add(double time);
  /// The datasets were cut to the steps added: written anew with that length. @throws FileError
  void close();
  /// All steps are in the file, and it is on the disk whatever happens to the machine.
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
  std::size_t put_ = 0;  ///< steps in the file
  std::chrono::steady_clock::time_point put_at_{};
};

}  // namespace rondo::io
