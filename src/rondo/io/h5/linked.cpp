// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/h5/linked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "rondo/core/contract.hpp"
#include "rondo/io/h5/library.hpp"

namespace rondo::io::h5 {
namespace {

constexpr const char* called = "HDF5 file in memory";
constexpr hsize_t rows_of_chunk = 1024;
constexpr std::size_t memory_step = 1U << 16U;  ///< increment of the memory [bytes]

/// There is no file of that name, but HDF5 distinguishes open files by their names.
std::string next_name() {
  static std::atomic<unsigned long> number{0};
  return fmt::format("rondo-memory-{}", ++number);
}

void demand(bool well, const std::string& doing) {
  if (!well) fail_in(called, "cannot " + doing);
}

Handle dataset_properties() {
  Handle properties(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

/// Selects numbers [first, first + count) of the nodes in the first rows of the source.
Handle source_space(const Shown& s, std::size_t first, std::size_t count) {
  Shape shape = {s.rows, s.nodes};
  std::vector<hsize_t> start = {0, 0}, size = {s.rows, s.nodes};
  if (s.width > 1) {
    shape.push_back(s.width);
    start.push_back(first);
    size.push_back(count);
  }
  Handle space = make_space(shape, shape);
  demand(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(),
                             nullptr) >= 0,
         "select in " + s.dataset);
  return space;
}

/// Selects columns [first, first + count) of the shown dataset.
Handle shown_space(const Shape& shape, std::size_t first, std::size_t count) {
  std::vector<hsize_t> start = {0}, size = {shape[0]};
  if (shape.size() > 1) {
    start.push_back(first);
    size.push_back(count);
  }
  Handle space = make_space(shape, shape);
  demand(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(),
                             nullptr) >= 0,
         "select in what is shown");
  return space;
}

void map(hid_t properties, const Shown& s, const Shape& shape) {
  const auto part = [&](std::size_t from, std::size_t to, std::size_t count) {
    const Handle there = source_space(s, from, count), here = shown_space(shape, to, count);
    demand(
        H5Pset_virtual(properties, here.get(), s.file.c_str(), s.dataset.c_str(), there.get()) >= 0,
        "map " + s.dataset);
  };
  if (s.columns.empty()) return part(0, 0, s.width);
  for (std::size_t k = 0; k < s.columns.size(); ++k) part(s.columns[k], k, 1);
}

}  // namespace

LinkedFile::LinkedFile() {
  be_quiet();
  const Handle access = file_access();
  H5Pset_fapl_core(access.get(), memory_step, false);
  id_ = Handle(H5Fcreate(next_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()));
  demand(id_.get() >= 0, "create");
  groups_ = Handle(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(groups_.get(), 1);
}

void LinkedFile::put(const std::string& name, Type type, const Shape& shape, const Shape& most,
                     std::int64_t properties) {
  const Handle space = make_space(shape, most);
  const Handle dataset(H5Dcreate2(id_.get(), name.c_str(), native(type), space.get(), groups_.get(),
                                  properties, H5P_DEFAULT));
  demand(dataset.get() >= 0, "create " + name);
}

void LinkedFile::fill(const std::string& name, const Shape& shape, std::int64_t value) {
  const Handle properties = dataset_properties();
  H5Pset_fill_value(properties.get(), H5T_NATIVE_INT64, &value);
  put(name, Type::int64, shape, shape, properties.get());
}

void LinkedFile::create_rows(const std::string& name, Type type, const Shape& shape,
                             std::int64_t value) {
  const Handle properties = dataset_properties();
  H5Pset_fill_value(properties.get(), H5T_NATIVE_INT64, &value);
  std::vector<hsize_t> chunk = extents(shape);
  chunk[0] = std::min<hsize_t>(chunk[0], rows_of_chunk);
  H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  Shape none = shape;
  none[0] = 0;
  put(name, type, none, shape, properties.get());
}

void LinkedFile::set_rows(const std::string& name, std::size_t rows) {
  const Handle dataset(H5Dopen2(id_.get(), name.c_str(), H5P_DEFAULT));
  const Handle space(H5Dget_space(dataset.get()));
  std::array<hsize_t, 2> shape{};
  demand(H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr) > 0, "measure " + name);
  shape[0] = rows;
  demand(H5Dset_extent(dataset.get(), shape.data()) >= 0, "resize " + name);
}

void LinkedFile::put_row(const std::string& name, Type type, std::size_t row, const void* value) {
  const Handle dataset(H5Dopen2(id_.get(), name.c_str(), H5P_DEFAULT));
  const Handle there(H5Dget_space(dataset.get())), here(H5Screate(H5S_SCALAR));
  const hsize_t start = row, count = 1;
  demand(
      H5Sselect_hyperslab(there.get(), H5S_SELECT_SET, &start, nullptr, &count, nullptr) >= 0 &&
          H5Dwrite(dataset.get(), native(type), here.get(), there.get(), H5P_DEFAULT, value) >= 0,
      "write " + name);
}

void LinkedFile::set_row(const std::string& name, std::size_t row, double value) {
  put_row(name, Type::float64, row, &value);
}

void LinkedFile::set_row(const std::string& name, std::size_t row, std::int64_t value) {
  put_row(name, Type::int64, row, &value);
}

void LinkedFile::call(const std::string& name, const std::string& existing) {
  demand(H5Lcreate_hard(id_.get(), existing.c_str(), id_.get(), name.c_str(), groups_.get(),
                        H5P_DEFAULT) >= 0,
         "create " + name);
}

void LinkedFile::link(const std::string& name, const std::string& file,
                      const std::string& dataset) {
  demand(H5Lcreate_external(file.c_str(), dataset.c_str(), id_.get(), name.c_str(), groups_.get(),
                            H5P_DEFAULT) >= 0,
         "create " + name);
}

void LinkedFile::show(const std::string& name, const Shown& what) {
  RONDO_DEMAND(what.rows > 0 && what.nodes > 0, name, what.rows, what.nodes);
  const std::size_t columns = what.columns.empty() ? what.width : what.columns.size();
  Shape shape = {what.rows * what.nodes};
  if (columns > 1) shape.push_back(columns);
  const Handle properties = dataset_properties();
  const float none = std::numeric_limits<float>::quiet_NaN();
  H5Pset_fill_value(properties.get(), H5T_NATIVE_FLOAT, &none);
  map(properties.get(), what, shape);
  put(name, Type::float32, shape, shape, properties.get());
}

void LinkedFile::put_attribute(const std::string& group, const std::string& name, std::int64_t type,
                               std::int64_t space, const void* value) {
  const Handle at(H5Oopen(id_.get(), group.c_str(), H5P_DEFAULT));
  const bool there = H5Aexists(at.get(), name.c_str()) > 0;
  const Handle attribute(
      there ? H5Aopen(at.get(), name.c_str(), H5P_DEFAULT)
            : H5Acreate2(at.get(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
  demand(attribute.get() >= 0 && H5Awrite(attribute.get(), type, value) >= 0,
         "write attribute " + name);
}

void LinkedFile::set_attribute(const std::string& group, const std::string& name,
                               std::int64_t value) {
  const Handle space(H5Screate(H5S_SCALAR));
  put_attribute(group, name, H5T_NATIVE_INT64, space.get(), &value);
}

void LinkedFile::set_attribute(const std::string& group, const std::string& name,
                               std::span<const std::int64_t> values) {
  const Shape shape = {values.size()};
  put_attribute(group, name, H5T_NATIVE_INT64, make_space(shape, shape).get(), values.data());
}

void LinkedFile::set_attribute(const std::string& group, const std::string& name,
                               const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1)), space(H5Screate(H5S_SCALAR));
  H5Tset_size(type.get(), text.size());
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  put_attribute(group, name, type.get(), space.get(), text.data());
}

std::string LinkedFile::bytes() {
  demand(H5Fflush(id_.get(), H5F_SCOPE_GLOBAL) >= 0, "flush");
  const ssize_t size = H5Fget_file_image(id_.get(), nullptr, 0);
  demand(size > 0, "measure");
  std::string image(static_cast<std::size_t>(size), '\0');
  demand(H5Fget_file_image(id_.get(), image.data(), image.size()) == size, "copy");
  return image;
}

}  // namespace rondo::io::h5
