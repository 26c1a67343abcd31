// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/h5/library.hpp"

#include "rondo/core/error.hpp"

namespace rondo::io::h5 {

namespace {

/// Innermost message of HDF5's error stack; for a system call only the system's message.
std::string reason() {
  std::string text;
  const auto visit = [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
    if (error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, visit, &text);
  H5Eclear2(H5E_DEFAULT);
  const std::string mark = "error message = '";
  if (const auto begin = text.find(mark); begin != std::string::npos) {
    const auto from = begin + mark.size();
    return text.substr(from, text.find('\'', from) - from);
  }
  return text.empty() ? "HDF5 gives no reason" : text;
}

}  // namespace

void fail_in(const std::string& path, const std::string& doing) {
  throw FileError(path, doing + ": " + reason());
}

void be_quiet() {
  static const herr_t no_work_at_exit = H5dont_atexit();
  static_cast<void>(no_work_at_exit);
  thread_local const herr_t done = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static_cast<void>(done);
}

hid_t native(Type type) {
  switch (type) {
    case Type::float64:
      return H5T_NATIVE_DOUBLE;
    case Type::float32:
      return H5T_NATIVE_FLOAT;
    case Type::int32:
      return H5T_NATIVE_INT32;
    case Type::int64:
      return H5T_NATIVE_INT64;
    case Type::uint8:
      return H5T_NATIVE_UINT8;
  }
  return H5I_INVALID_HID;
}

std::vector<hsize_t> extents(const Shape& shape) {
  return {shape.begin(), shape.end()};
}

Handle make_space(const Shape& shape, const Shape& most) {
  const auto dims = extents(shape), max = extents(most);
  return Handle(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), max.data()));
}

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  H5Pset_file_locking(access.get(), false, true);
  return access;
}

}  // namespace rondo::io::h5
