// SPDX-License-Identifier: BSD-3-Clause
/// What chunks of a wheel in three dimensions show of their edges to each other.
#include <algorithm>

#include "rondo/integrators/fused/solid/solid_chunk.hpp"

namespace rondo::dynamics {

void SolidChunk::wrap(int row, int field) noexcept {
  for (int component = 0; component < 3; ++component) {
    double* u = this->field(row, field) + component * plan_.stride;
    u[-1] = u[range_.columns - 1];
    u[range_.columns] = u[0];
  }
}

/// What is right of the chunk's own nodes, where it is read for the next pass.
void SolidChunk::show_to_others() noexcept {
  if (plan_.cut.halo != Halo::ring) return give_edges();
  for (int a = 0; a < plan_.n_local; ++a) wrap(a, field_now());
}

int SolidChunk::edge_width() const noexcept {
  return plan_.cut.halo == Halo::wide ? halo_columns : 1;
}

std::array<int, 3> SolidChunk::edge_fields() const noexcept {
  return {field_now(), field_v, field_force};
}

/// A wide halo is advanced with all its fields, a narrow one only read.
std::size_t SolidChunk::n_edge_fields() const noexcept {
  return plan_.cut.halo == Halo::wide ? (plan_.keeps_force ? 3 : 2) : 1;
}

void SolidChunk::give_edges() noexcept {
  const int width = edge_width();
  double* left = edges_[passes_ % 2][0].data();
  double* right = edges_[passes_ % 2][1].data();
  const std::array<int, 3> fields = edge_fields();
  for (int a = 0; a < plan_.n_local; ++a)
    for (std::size_t i = 0; i < n_edge_fields(); ++i)
      for (int component = 0; component < 3; ++component) {
        const double* x = field(a, fields[i]) + component * plan_.stride;
        left = std::copy_n(x, width, left);
        right = std::copy_n(x + range_.columns - width, width, right);
      }
}

void SolidChunk::take_halo(const SolidChunk& left, const SolidChunk& right) noexcept {
  const int width = edge_width();
  const double* from_left = left.edges_[passes_ % 2][1].data();
  const double* from_right = right.edges_[passes_ % 2][0].data();
  const std::array<int, 3> fields = edge_fields();
  for (int a = 0; a < plan_.n_local; ++a)
    for (std::size_t i = 0; i < n_edge_fields(); ++i)
      for (int component = 0; component < 3; ++component) {
        double* x = field(a, fields[i]) + component * plan_.stride;
        std::copy_n(from_left, width, x - width);
        std::copy_n(from_right, width, x + range_.columns);
        from_left += width;
        from_right += width;
      }
}

}  // namespace rondo::dynamics
