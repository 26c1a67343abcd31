// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/h5/h5.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/io/h5/library.hpp"

namespace rondo::io::h5 {
namespace {

/// Layout of a dataset written row by row (results.hpp: readable after a kill at any moment).
bool set_rows_layout(hid_t properties, const Shape& shape, Type type) {
  const auto chunk = extents(chunk_shape(shape, bytes_of(type)));
  return H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()) >= 0 &&
         H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY) >= 0 &&
         H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER) >= 0;
}

/// A text of any length in UTF-8, which h5py reads as str.
Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

bool write_text(hid_t object, const std::string& name, const std::string& text) {
  const Handle type = text_type(), space(H5Screate(H5S_SCALAR));
  const Handle attribute(
      H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT));
  const char* const value = text.c_str();
  return attribute.get() >= 0 && H5Awrite(attribute.get(), type.get(), &value) >= 0;
}

bool read_text(hid_t object, const std::string& name, std::string& text) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT));
  if (attribute.get() < 0) return false;
  // As many pointers are returned as the attribute has texts; there is room for one only.
  const Handle space(H5Aget_space(attribute.get())), type = text_type();
  if (H5Sget_simple_extent_npoints(space.get()) != 1) return false;
  char* value = nullptr;
  if (H5Aread(attribute.get(), type.get(), static_cast<void*>(&value)) < 0) return false;
  if (value != nullptr) text = value;
  H5free_memory(value);
  return true;
}

}  // namespace

Handle::~Handle() {
  if (id_ >= 0) H5Idec_ref(id_);
}

void Dataset::fail(const char* doing) const {
  fail_in(file_, std::string("cannot ") + doing + " " + name_);
}

void Dataset::find_spaces() {
  file_space_ = Handle(H5Dget_space(id_.get()));
  const int rank = H5Sget_simple_extent_ndims(file_space_.get());
  if (rank < 0) fail("open");
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(file_space_.get(), dims.data(), nullptr);
  shape_.assign(dims.begin(), dims.end());
  Shape row = shape_;  // same rank as the file: HDF5 then copies at once, not singly
  if (!row.empty()) row[0] = 1;
  row_space_ = make_space(row, row);
}

/// Selects entries [first, first + n) of the second dimension of a row; n is 1 without one.
void Dataset::select(std::size_t row, std::size_t first, std::size_t n) const {
  be_quiet();  // the thread may not be the one that made the file
  constexpr std::size_t most = 8;
  const std::size_t places = shape_.size() > 1 ? shape_[1] : 1;
  RONDO_DEMAND(!shape_.empty() && shape_.size() <= most && row < shape_[0], name_, shape_.size(),
               row);
  RONDO_DEMAND(n <= places && first <= places - n, name_, row, first, n);
  std::array<hsize_t, most> start{}, count{};
  std::copy(shape_.begin(), shape_.end(), count.begin());
  start[0] = row, count[0] = 1;
  if (shape_.size() > 1) start[1] = first, count[1] = n;
  if (H5Sselect_hyperslab(file_space_.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                          nullptr) < 0 ||
      H5Sset_extent_simple(row_space_.get(), static_cast<int>(shape_.size()), count.data(),
                           nullptr) < 0)
    fail("select in");
}

void Dataset::write_all(const void* values, Type type, std::size_t n) {
  RONDO_DEMAND(n == n_numbers(), name_, n, n_numbers());
  if (n == 0) return;
  if (H5Dwrite(id_.get(), native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail("write");
}

void Dataset::write_one(std::size_t row, const void* values, Type type, std::size_t n) {
  RONDO_DEMAND(n == n_in_row(), name_, n, n_in_row());
  select_row(row);
  if (H5Dwrite(id_.get(), native(type), row_space_.get(), file_space_.get(), H5P_DEFAULT, values) <
      0)
    fail("write");
  if (written_) written_->add(std::span(static_cast<const std::byte*>(values), n * bytes_of(type)));
}

void Dataset::read_all(void* values, Type type, std::size_t n) const {
  RONDO_DEMAND(n == n_numbers(), name_, n, n_numbers());
  if (n == 0) return;
  if (H5Dread(id_.get(), native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail("read");
}

void Dataset::read_some(std::size_t row, std::size_t first, void* values, Type type,
                        std::size_t n) const {
  if (n == 0) return;
  const std::size_t place = product(shape_, 2);
  RONDO_DEMAND(n % place == 0, name_, n, place);
  select(row, first, n / place);
  if (H5Dread(id_.get(), native(type), row_space_.get(), file_space_.get(), H5P_DEFAULT, values) <
      0)
    fail("read");
}

void Dataset::resize(std::size_t rows) {
  RONDO_DEMAND(!shape_.empty(), name_, rows);
  if (rows == shape_[0]) return;
  auto dims = extents(shape_);
  dims[0] = rows;
  if (H5Dset_extent(id_.get(), dims.data()) < 0) fail("resize");
  find_spaces();
}

void Dataset::copy_rows(const File& from, std::size_t rows) {
  Shape shape = shape_;
  shape[0] = any;
  const Dataset source = from.dataset(name_, shape);
  const Handle type(H5Dget_type(id_.get())), other(H5Dget_type(source.id_.get()));
  if (H5Tequal(type.get(), other.get()) <= 0 || source.shape_[0] < rows)
    throw FileError(source.file_, name_ + " holds less than it did: damaged");
  source.each_row(rows, [&](std::size_t r, std::span<const std::byte> row) {
    select_row(r);
    if (H5Dwrite(id_.get(), type.get(), row_space_.get(), file_space_.get(), H5P_DEFAULT,
                 row.data()) < 0)
      fail("write");
    if (written_) written_->add(row);
  });
}

void Dataset::each_row(
    std::size_t rows,
    const std::function<void(std::size_t, std::span<const std::byte>)>& take) const {
  const Handle type(H5Dget_type(id_.get()));
  std::vector<std::byte> row(n_in_row() * H5Tget_size(type.get()));
  for (std::size_t r = 0; r < rows; ++r) {
    select_row(r);
    if (H5Dread(id_.get(), type.get(), row_space_.get(), file_space_.get(), H5P_DEFAULT,
                row.data()) < 0)
      fail("read");
    take(r, row);
  }
}

std::string Dataset::hash_of_written() const {
  RONDO_DEMAND(written_.has_value(), name_);
  return written_->text();
}

std::string Dataset::hash_of_rows(std::size_t rows) const {
  Hash hash;
  each_row(rows, [&](std::size_t, std::span<const std::byte> row) { hash.add(row); });
  return hash.text();
}

std::optional<std::size_t> Dataset::first_not_finite(std::size_t rows) const {
  std::vector<double> row(n_in_row());
  for (std::size_t r = 0; r < rows; ++r) {
    read_some(r, 0, row.data(), Type::float64, row.size());
    if (!std::ranges::all_of(row, [](double x) { return std::isfinite(x); })) return r;
  }
  return std::nullopt;
}

Label Dataset::label() const {
  Label label;
  if (!read_text(id_.get(), "units", label.units) ||
      !read_text(id_.get(), "description", label.description))
    fail("read units and description of");
  return label;
}

void File::fail(const std::string& doing) const {
  fail_in(path_, "cannot " + doing);
}

File File::create(const std::filesystem::path& path, std::size_t index_bytes) {
  be_quiet();
  return create(path, Handle(H5Pcreate(H5P_FILE_CREATE)), index_bytes);
}

File File::create_after(const std::filesystem::path& path, std::size_t bytes) {
  be_quiet();
  const Handle creation(H5Pcreate(H5P_FILE_CREATE));
  H5Pset_userblock(creation.get(), bytes);
  return create(path, creation, 0);
}

File File::create(const std::filesystem::path& path, const Handle& creation,
                  std::size_t index_bytes) {
  File file;
  file.path_ = path.string();
  const Handle access = file_access();
  if (index_bytes > 0) H5Pset_meta_block_size(access.get(), index_bytes);
  file.id_ = Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()));
  if (!file) file.fail("create");
  return file;
}

File File::open(const std::filesystem::path& path) {
  demand_regular_file(path);
  be_quiet();
  File file;
  file.path_ = path.string();
  const Handle access = file_access();
  file.id_ = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()));
  if (!file) file.fail("open");
  return file;
}

Dataset File::make(const std::string& name, Type type, const Shape& shape, const Label& label,
                   bool rows) {
  RONDO_DEMAND(!rows || (!shape.empty() && product(shape, 0) > 0), name);
  const Handle links(H5Pcreate(H5P_LINK_CREATE));
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE));
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS));
  H5Pset_create_intermediate_group(links.get(), 1);
  H5Pset_obj_track_times(creation.get(), false);
  if (rows) {
    if (!set_rows_layout(creation.get(), shape, type)) fail("lay out " + name);
    H5Pset_chunk_cache(access.get(), 0, 0, H5D_CHUNK_CACHE_W0_DEFAULT);
  }
  Dataset dataset;
  dataset.file_ = path_;
  dataset.name_ = name;
  Shape first = shape;
  if (rows) first[0] = 0;
  const Handle space = make_space(first, shape);
  dataset.id_ = Handle(H5Dcreate2(id_.get(), name.c_str(), native(type), space.get(), links.get(),
                                  creation.get(), access.get()));
  if (!dataset || !write_text(dataset.id_.get(), "units", label.units) ||
      !write_text(dataset.id_.get(), "description", label.description))
    dataset.fail("create");
  dataset.find_spaces();
  if (rows) dataset.written_.emplace();
  return dataset;
}

Dataset File::create(const std::string& name, Type type, const Shape& shape, const Label& label) {
  return make(name, type, shape, label, false);
}

Dataset File::create_rows(const std::string& name, Type type, const Shape& shape,
                          const Label& label) {
  return make(name, type, shape, label, true);
}

bool File::contains(const std::string& name) const {
  for (auto slash = name.find('/', 1); slash != std::string::npos;
       slash = name.find('/', slash + 1))
    if (H5Lexists(id_.get(), name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(id_.get(), name.c_str(), H5P_DEFAULT) > 0;
}

Dataset File::dataset(const std::string& name) const {
  Dataset dataset;
  dataset.file_ = path_;
  dataset.name_ = name;
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS));
  H5Pset_chunk_cache(access.get(), 0, 0, H5D_CHUNK_CACHE_W0_DEFAULT);
  dataset.id_ = Handle(H5Dopen2(id_.get(), name.c_str(), access.get()));
  if (!dataset) dataset.fail("open");
  dataset.find_spaces();
  return dataset;
}

Dataset File::dataset(const std::string& name, const Shape& shape) const {
  Dataset found = dataset(name);
  const auto text = [](const Shape& s) {
    std::string list;
    for (const std::size_t n : s)
      list += (list.empty() ? "" : ", ") + (n == any ? "any" : std::to_string(n));
    return "(" + list + ")";
  };
  const bool fits = std::equal(shape.begin(), shape.end(), found.shape_.begin(), found.shape_.end(),
                               [](std::size_t a, std::size_t b) { return a == any || a == b; });
  if (!fits)
    throw FileError(path_, name + " has the shape " + text(found.shape_) + " where " + text(shape) +
                               " is expected: damaged, or not of this program");
  hsize_t bytes = 0;
  if (H5Fget_filesize(id_.get(), &bytes) < 0) fail("measure");
  const Handle type(H5Dget_type(found.id_.get()));
  double wanted = static_cast<double>(H5Tget_size(type.get()));
  for (const std::size_t n : found.shape_) wanted *= static_cast<double>(n);
  if (wanted > static_cast<double>(bytes))
    throw FileError(path_, name + " is larger than the file: damaged");
  return found;
}

void File::set_attribute(const std::string& object, const std::string& name,
                         const std::string& text) {
  const Handle at(H5Oopen(id_.get(), object.c_str(), H5P_DEFAULT));
  if (at.get() < 0 || !write_text(at.get(), name, text)) fail("write attribute " + name);
}

std::string File::attribute(const std::string& object, const std::string& name) const {
  const Handle at(H5Oopen(id_.get(), object.c_str(), H5P_DEFAULT));
  std::string text;
  if (at.get() < 0 || !read_text(at.get(), name, text)) fail("read attribute " + name);
  return text;
}

void File::flush() {
  if (H5Fflush(id_.get(), H5F_SCOPE_GLOBAL) < 0) fail("flush");
}

void File::close() {
  if (id_.get() >= 0 && H5Fclose(id_.release()) < 0) fail("close");
}

}  // namespace rondo::io::h5
