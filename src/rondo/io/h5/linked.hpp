// SPDX-License-Identifier: BSD-3-Clause
/// @file  A small HDF5 file that refers to another one, assembled in memory: external links to
/// datasets of the other file, virtual datasets that show parts of them in another shape. Readers
/// need HDF5 1.10. The other file is found in the directory of this one.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rondo/io/h5/h5.hpp"

namespace rondo::io::h5 {

/// A dataset (t, n) or (t, n, width) of float32 in another file, whose rows are shown.
struct Shown {
  std::string file, dataset;
  std::size_t rows = 0;   ///< number of rows shown, at most t
  std::size_t nodes = 0;  ///< n
  std::size_t width = 1;
  /// Indices of the numbers of a node, in the order shown; empty: all.
  std::vector<std::size_t> columns = {};
};

/// Names are paths; groups are created as needed. The same calls give the same bytes.
class LinkedFile {
 public:
  LinkedFile();  ///< @throws FileError

  /// Adds a dataset of int64 with one constant value, which takes no space.
  void fill(const std::string& name, const Shape& shape, std::int64_t value);
  /// Adds a dataset of float64 or int64 without rows, for at most shape[0] of them; a row that is
  /// not set has the given value and takes no space.
  void create_rows(const std::string& name, Type type, const Shape& shape, std::int64_t value);
  void set_rows(const std::string& name, std::size_t rows);
  /// Sets an entry of a dataset (rows). @pre row < rows
  void set_row(const std::string& name, std::size_t row, double value);
  void set_row(const std::string& name, std::size_t row, std::int64_t value);
  /// Gives a dataset of this file another name.
  void call(const std::string& name, const std::string& existing);
  /// Links to a dataset of another file; a reader without that file does not see it.
  void link(const std::string& name, const std::string& file, const std::string& dataset);
  /// Shows a dataset (rows * n) or (rows * n, columns) of float32; NaN if the file is missing.
  void show(const std::string& name, const Shown& what);
  /// Sets an attribute of a group or a dataset, or replaces it.
  void set_attribute(const std::string& group, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& group, const std::string& name,
                     std::span<const std::int64_t> values);
  /// Sets an attribute of the length of the text, which is ASCII. @pre text is not empty
  void set_attribute(const std::string& group, const std::string& name, const std::string& text);

  /// The file in its present state. @throws FileError
  [[nodiscard]] std::string bytes();

 private:
  void put(const std::string& name, Type type, const Shape& shape, const Shape& most,
           std::int64_t properties);
  void put_row(const std::string& name, Type type, std::size_t row, const void* value);
  void put_attribute(const std::string& group, const std::string& name, std::int64_t type,
                     std::int64_t space, const void* value);

  Handle id_, groups_;  ///< the file; property list for links
};

}  // namespace rondo::io::h5
