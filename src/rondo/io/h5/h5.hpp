// SPDX-License-Identifier: BSD-3-Clause
/// @file  HDF5 files: the part of the C library that this program needs, with ownership and errors.
///
/// It includes no header of HDF5. Datasets have the attributes `units` and `description`. Files
/// have the oldest layout (readable by HDF5 1.8 and later) and no time stamps, so that the same
/// values give the same bytes; they are never locked, so that a run can be watched.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondo/core/vec3.hpp"
#include "rondo/io/h5/hash.hpp"

namespace rondo::io::h5 {

enum class Type { float64, float32, int32, int64, uint8 };

using Shape = std::vector<std::size_t>;
/// Number of entries in the dimensions from `first` on.
[[nodiscard]] std::size_t product(const Shape& shape, std::size_t first);
inline constexpr std::size_t any = ~std::size_t{0};  ///< a size that is not checked

struct Label {
  std::string units;  ///< "1" for pure numbers
  std::string description;
};

/// `n` numbers of one type, as which a dataset stores a C++ value.
template <Type t, std::size_t n = 1>
struct Numbers {
  static constexpr Type type = t;
  static constexpr std::size_t count = n;
};
/// How a dataset stores a C++ value.
template <class T>
struct Element;
template <>
struct Element<double> : Numbers<Type::float64> {};
template <>
struct Element<float> : Numbers<Type::float32> {};
template <>
struct Element<std::int32_t> : Numbers<Type::int32> {};
template <>
struct Element<std::int64_t> : Numbers<Type::int64> {};
template <>
struct Element<std::uint8_t> : Numbers<Type::uint8> {};
template <>
struct Element<Vec2> : Numbers<Type::float64, 2> {};
template <>
struct Element<Vec3> : Numbers<Type::float64, 3> {};
template <class T, std::size_t N>
struct Element<std::array<T, N>> : Numbers<Element<T>::type, N * Element<T>::count> {};

/// Owns one identifier of the HDF5 library (its hid_t).
class Handle {
 public:
  Handle() = default;
  explicit Handle(std::int64_t id) noexcept : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle();
  [[nodiscard]] std::int64_t get() const noexcept { return id_; }
  [[nodiscard]] std::int64_t release() noexcept { return std::exchange(id_, -1); }

 private:
  std::int64_t id_ = -1;
};

class File;

class Dataset {
 public:
  Dataset() = default;  ///< an invalid dataset, which converts to false

  explicit operator bool() const noexcept { return id_.get() >= 0; }
  [[nodiscard]] const Shape& shape() const noexcept { return shape_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// Writes the whole dataset. @pre as many numbers as the shape has. @throws FileError
  template <class T>
  void write(std::span<const T> values) {
    write_all(values.data(), Element<T>::type, values.size() * Element<T>::count);
  }
  /// Writes row `row` of the first dimension. @pre as many numbers as a row. @throws FileError
  template <class T>
  void write_row(std::size_t row, std::span<const T> values) {
    write_one(row, values.data(), Element<T>::type, values.size() * Element<T>::count);
  }
  /// Reads and converts to T. @pre T divides the dataset or its row. @throws FileError
  template <class T>
  [[nodiscard]] std::vector<T> read() const {
    std::vector<T> values(n_numbers() / Element<T>::count);
    read_all(values.data(), Element<T>::type, values.size() * Element<T>::count);
    return values;
  }
  /// Reads the entries [first, first + n) of the second dimension of row `row` into `values`.
  /// @pre n = values.size() * Element<T>::count / numbers per entry. @throws FileError
  template <class T>
  void read_part(std::size_t row, std::size_t first, std::span<T> values) const {
    read_some(row, first, values.data(), Element<T>::type, values.size() * Element<T>::count);
  }
  /// Reserves space in the file for rows, or gives up those from `rows` on. @pre made by
  /// File::create_rows, at most as many rows as given there. @throws FileError
  void resize(std::size_t rows);

  /// Copies the first rows of a dataset with the same name, row shape and type from another file.
  /// @pre this one has that many rows. @throws FileError: fewer there, or of another kind
  void copy_rows(const File& from, std::size_t rows);

  /// Hash of the rows written and copied so far, in their order in the file.
  /// @pre made by File::create_rows; each row was written once, in order
  [[nodiscard]] std::string hash_of_written() const;
  /// Hash of the first rows, read from the file. @throws FileError: cannot be read
  [[nodiscard]] std::string hash_of_rows(std::size_t rows) const;
  /// The first of these rows that contains a number that is not finite, if any.
  [[nodiscard]] std::optional<std::size_t> first_not_finite(std::size_t rows) const;

  [[nodiscard]] Label label() const;  ///< @throws FileError

 private:
  friend class File;
  [[nodiscard]] std::size_t n_numbers() const noexcept;
  [[nodiscard]] std::size_t n_in_row() const noexcept;
  void find_spaces();
  void select(std::size_t row, std::size_t first, std::size_t n) const;
  void select_row(std::size_t row) const { select(row, 0, shape_.size() > 1 ? shape_[1] : 1); }
  void each_row(std::size_t rows,
                const std::function<void(std::size_t, std::span<const std::byte>)>& take) const;
  void write_all(const void* values, Type type, std::size_t n);
  void write_one(std::size_t row, const void* values, Type type, std::size_t n);
  void read_all(void* values, Type type, std::size_t n) const;
  void read_some(std::size_t row, std::size_t first, void* values, Type type, std::size_t n) const;
  [[noreturn]] void fail(const char* doing) const;

  std::string file_, name_;
  Shape shape_;
  Handle id_, file_space_;
  Handle row_space_;             ///< of a row or a part of it; its extent changes with each call
  std::optional<Hash> written_;  ///< only if made by File::create_rows
};

class File {
 public:
  File() = default;
  /// Replaces an existing file. The first `index_bytes` are reserved for the file's own index, in
  /// which a row of create_rows() takes about `bytes_of_entry`. With room for all rows, giving up
  /// rows at the end leaves no gap, and the file becomes shorter. @throws FileError
  static File create(const std::filesystem::path& path, std::size_t index_bytes = 0);
  /// Creates a file that begins with `bytes` that do not belong to HDF5: a power of two, at
  /// least 512.
  static File create_after(const std::filesystem::path& path, std::size_t bytes);
  static constexpr std::size_t bytes_of_entry = 100;
  /// Opens for reading only, without a cache. @throws FileError: missing, not HDF5, truncated
  static File open(const std::filesystem::path& path);

  explicit operator bool() const noexcept { return id_.get() >= 0; }

  /// Creates a dataset of fixed size, with its groups. @throws FileError
  Dataset create(const std::string& name, Type type, const Shape& shape, const Label& label);
  /// Creates a dataset that is written row by row, for at most shape[0] rows; it has none until
  /// resize(), which allocates all of them in the file. A row is written directly to the operating
  /// system and changes nothing else in the file. @pre shape without zeros. @throws FileError
  Dataset create_rows(const std::string& name, Type type, const Shape& shape, const Label& label);
  /// create() and Dataset::write() at once. @throws FileError
  template <class T>
  void write(const std::string& name, const Shape& shape, std::span<const T> values,
             const Label& label) {
    create(name, Element<T>::type, shape, label).write(values);
  }
  template <class T>
  void write(const std::string& name, const Shape& shape, const std::vector<T>& values,
             const Label& label) {
    write(name, shape, std::span<const T>(values), label);
  }

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// Sets the name used in errors of this file and its future datasets: the name after renaming.
  void call_it(const std::filesystem::path& path) { path_ = path.string(); }
  [[nodiscard]] bool contains(const std::string& name) const;
  [[nodiscard]] Dataset dataset(const std::string& name) const;  ///< @throws FileError: none such
  /// Opens a dataset of a file that may be damaged or foreign. @param shape required; `any` accepts
  /// all. @throws FileError: missing, of another shape, larger than the file
  [[nodiscard]] Dataset dataset(const std::string& name, const Shape& shape) const;
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& name) const {
    return dataset(name).read<T>();
  }

  /// Text attribute of a group or dataset, "/" for the file. @throws FileError
  void set_attribute(const std::string& object, const std::string& name, const std::string& text);
  [[nodiscard]] std::string attribute(const std::string& object, const std::string& name) const;

  void flush();  ///< passes everything to the operating system. @throws FileError
  void close();  ///< @pre none of its Datasets is alive. @throws FileError

 private:
  static File create(const std::filesystem::path& path, const Handle& creation,
                     std::size_t index_bytes);
  Dataset make(const std::string& name, Type type, const Shape& shape, const Label& label,
               bool rows);
  [[noreturn]] void fail(const std::string& doing) const;

  std::string path_;
  Handle id_;
};

/// Chunk of a dataset written by rows: one row, a part of a row that is longer than `limit` bytes,
/// or several rows if they are tiny.
Shape chunk_shape(const Shape& shape, std::size_t bytes_per_number, std::size_t limit = 1U << 30U);

std::size_t bytes_of(Type type) noexcept;

}  // namespace rondo::io::h5
