// SPDX-License-Identifier: BSD-3-Clause
/// What chunks show of their edges to each other.
#include <algorithm>

#include "rondo/integrators/fused/cyclic_chunk.hpp"

namespace rondo::dynamics {

void CyclicChunk::wrap(int a, int field) noexcept {
  for (int component = 0; component < 2; ++component) {
    double* u = this->field(a, field) + component * plan_.stride;
    u[-1] = u[range_.columns - 1];
    u[range_.columns] = u[0];
  }
}

int CyclicChunk::edge_width() const noexcept {
  return plan_.halo == Halo::wide ? halo_columns : 1;
}

/// A wide halo is advanced with all its fields, a narrow one only read.
std::size_t CyclicChunk::n_edge_fields() const noexcept {
  return plan_.halo == Halo::wide ? (plan_.keeps_force ? 3 : 2) : 1;
}

void CyclicChunk::give_edges() noexcept {
  const int width = edge_width();
  double* left = edges_[passes_ % 2][0].data();
  double* right = edges_[passes_ % 2][1].data();
  const std::array<int, 3> fields = edge_fields();
  for (int a = 0; a < plan_.n_local; ++a)
    for (std::size_t i = 0; i < n_edge_fields(); ++i)
      for (int component = 0; component < 2; ++component) {
        const double* x = field(a, fields[i]) + component * plan_.stride;
        left = std::copy_n(x, width, left);
        right = std::copy_n(x + range_.columns - width, width, right);
      }
}

void CyclicChunk::take_halo(const CyclicChunk& left, const CyclicChunk& right) noexcept {
  const int width = edge_width();
  const double* from_left = left.edges_[passes_ % 2][1].data();
  const double* from_right = right.edges_[passes_ % 2][0].data();
  const std::array<int, 3> fields = edge_fields();
  for (int a = 0; a < plan_.n_local; ++a)
    for (std::size_t i = 0; i < n_edge_fields(); ++i)
      for (int component = 0; component < 2; ++component) {
        double* x = field(a, fields[i]) + component * plan_.stride;
        std::copy_n(from_left, width, x - width);
        std::copy_n(from_right, width, x + range_.columns);
        from_left += width;
        from_right += width;
      }
}

}  // namespace rondo::dynamics
