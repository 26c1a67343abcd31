// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "rondo/io/h5/h5.hpp"

namespace rondo::io::h5 {
namespace {

constexpr std::size_t tiny_row = 512;        ///< shorter rows share a chunk [bytes]
constexpr std::size_t rows_together = 1024;  ///< number of rows in such a chunk

}  // namespace

std::size_t product(const Shape& shape, std::size_t from) {
  std::size_t n = 1;
  for (std::size_t i = from; i < shape.size(); ++i) n *= shape[i];
  return n;
}

std::size_t Dataset::n_numbers() const noexcept {
  return product(shape_, 0);
}
std::size_t Dataset::n_in_row() const noexcept {
  return product(shape_, 1);
}

std::size_t bytes_of(Type type) noexcept {
  if (type == Type::uint8) return 1;
  return type == Type::float64 || type == Type::int64 ? 8 : 4;
}

Shape chunk_shape(const Shape& shape, std::size_t bytes_per_number, std::size_t limit) {
  Shape chunk = shape;
  const std::size_t row = product(shape, 1) * bytes_per_number;
  chunk[0] = row < tiny_row ? std::min(shape[0], rows_together) : 1;
  if (row > limit && shape.size() > 1) {
    const std::size_t parts = (row + limit - 1) / limit;
    chunk[1] = (shape[1] + parts - 1) / parts;
  }
  return chunk;
}

}  // namespace rondo::io::h5
