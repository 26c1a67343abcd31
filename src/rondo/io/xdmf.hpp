// SPDX-License-Identifier: BSD-3-Clause
/// @file  XDMF: a text file beside an HDF5 file that tells ParaView how its datasets form an
/// animation: a temporal collection of grids over one mesh. The file is valid after every call.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace rondo::io {

/// The cells of the mesh in a dataset of int32.
struct XdmfTopology {
  std::string
      type;  ///< "Triangle" (e, 3), "Quadrilateral" (e, 4), "Mixed" (k), "Hexahedron" (e, 8)
  std::size_t n_cells = 0;  ///< e
  std::string dataset;      ///< e.g. "/mesh/cells"
  std::vector<std::size_t> shape;
  std::size_t n_corners = 0;  ///< number of corners of all cells
};

/// The meaning of a dataset that is shown, as in the attributes of datasets.
struct ShownLabel {
  std::string units, description;
};

/// A nodal field in time, or some of its components: a dataset (t, n) or (t, n, width) of float32.
struct XdmfField {
  std::string name;
  std::string type;  ///< "Scalar", "Vector" or "Tensor6"
  std::string dataset;
  std::size_t width = 1;       ///< numbers per node in the dataset
  std::size_t first = 0;       ///< index of the first number shown
  std::size_t components = 1;  ///< number of components shown
  ShownLabel label = {};       ///< of these components; XDMF cannot express it
};

struct XdmfSeries {
  std::string data_file;  ///< name of the HDF5 file, in the same directory
  XdmfTopology topology;
  std::string reference;  ///< dataset (n, 2) or (n, 3) of float64, shown until there is a
                          ///< grid                                                           [m]
  std::size_t dimensions = 2;  ///< of `reference`
  std::string position;  ///< dataset (t, n, 3) of float32; empty: `reference` in all grids [m]
  std::size_t n_nodes = 0;
  std::size_t n_times = 0;  ///< t
  std::vector<XdmfField> fields;
  ShownLabel position_label = {}, time_label = {};  ///< not expressed in XDMF
};

class Xdmf {
 public:
  /// Creates or replaces the file with the grids of the rows that exist already, given by their
  /// times, or with the reference mesh alone. @throws FileError
  Xdmf(std::filesystem::path file, XdmfSeries series, std::vector<double> times = {});
  ~Xdmf();
  Xdmf(const Xdmf&) = delete;
  Xdmf& operator=(const Xdmf&) = delete;

  /// Adds the grid of the next row of the datasets. A file is replaced as a whole, so that it is
  /// complete if the program is killed at any moment; in a long series this happens when a
  /// sixteenth more grids were added, and at the end. @throws FileError
  void add(double time);
  /// The datasets were cut to the grids added: the file is written with that length.
  /// @throws FileError
  void close();
  [[nodiscard]] std::size_t size() const noexcept { return times_.size(); }

 private:
  void append_grid(std::size_t row);
  void append_topology();
  void append_reference_geometry();
  void append_reference_grid();
  void append_array(std::size_t row, const XdmfField& field);
  void write_whole(bool durable);
  void write_more();
  void write_grids(const std::filesystem::path& beside, const char* mode, std::size_t row,
                   bool durable);

  std::filesystem::path path_;
  XdmfSeries series_;
  std::vector<double> times_;  ///< of the grids                                       [s]
  std::string text_;           ///< reused
  std::size_t listed_ = 0;     ///< number of grids in the file
  bool closed_ = false;
};

}  // namespace rondo::io
