// SPDX-License-Identifier: BSD-3-Clause
/// @file  What chunks of a ring show of their edges to each other, whatever the components of their
/// vectors.
#pragma once
#include <array>
#include <cstddef>

#include "rondo/core/large_array.hpp"
#include "rondo/integrators/fused/cyclic_plan.hpp"

namespace rondo::dynamics {

/// Memory of the fields of a chunk: rows, in them fields, in them components, `stride` apart.
struct ChunkFields {
  double* first;  ///< field 0 of row 0, sector 0
  std::ptrdiff_t row_size, stride;
  int n_rows, components, columns;

  [[nodiscard]] double* at(int row, int field) const noexcept {
    return first + row * row_size + field * stride;
  }
};

/// The field's first and last sector on the other side of it: a chunk that is its own neighbour.
void wrap(const ChunkFields& chunk, int row, int field) noexcept;

/// Places of the fields of a halo; the last ones may be unused.
using EdgeFields = std::array<int, 4>;

class RingEdges {
 public:
  RingEdges() = default;
  /// A wide halo, which is advanced, takes the first `n_fields` of the fields; a narrow one, which
  /// is only read, takes u
  RingEdges(Halo halo, std::size_t n_fields, int n_rows, int components);

  /// @param fields of u, v and what else is kept, at the end of the pass
  /// @param pass number of those made so far: its parity tells which copy is read and which written
  void give(const ChunkFields& chunk, const EdgeFields& fields, std::size_t pass) noexcept;
  void take(const ChunkFields& chunk, const EdgeFields& fields, std::size_t pass,
            const RingEdges& left, const RingEdges& right) const noexcept;

 private:
  int width_ = 0;
  std::size_t n_fields_ = 0;
  std::array<std::array<LargeArray, 2>, 2> edges_;  ///< [parity of the pass][left, right]
};

}  // namespace rondo::dynamics
