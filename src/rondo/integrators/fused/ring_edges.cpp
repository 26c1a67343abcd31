// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/ring_edges.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"

namespace rondo::dynamics {
namespace {

/// visit(x), x sector 0 of every component of the fields of every row.
template <class Visit>
void for_components(const ChunkFields& chunk, const EdgeFields& fields, std::size_t n,
                    Visit&& visit) noexcept {
  for (int row = 0; row < chunk.n_rows; ++row)
    for (std::size_t i = 0; i < n; ++i)
      for (int component = 0; component < chunk.components; ++component)
        visit(chunk.at(row, fields[i] + component));
}

}  // namespace

void wrap(const ChunkFields& chunk, int row, int field) noexcept {
  for (int component = 0; component < chunk.components; ++component) {
    double* x = chunk.at(row, field + component);
    x[-1] = x[chunk.columns - 1];
    x[chunk.columns] = x[0];
  }
}

RingEdges::RingEdges(Halo halo, std::size_t n_fields, int n_rows, int components)
    : width_(halo == Halo::wide ? halo_columns : 1), n_fields_(halo == Halo::wide ? n_fields : 1) {
  RONDO_DEMAND(halo != Halo::ring && n_rows > 0 && components > 0, n_rows, components);
  RONDO_DEMAND(n_fields >= 2 && n_fields <= EdgeFields{}.size(), n_fields);
  for (auto& parity : edges_)
    for (LargeArray& edge : parity)
      edge = LargeArray(static_cast<std::size_t>(n_rows * width_ * components) * n_fields_);
}

void RingEdges::give(const ChunkFields& chunk, const EdgeFields& fields,
                     std::size_t pass) noexcept {
  RONDO_ASSERT(width_ > 0 && chunk.columns >= width_, width_, chunk.columns);
  double* left = edges_[pass % 2][0].data();
  double* right = edges_[pass % 2][1].data();
  for_components(chunk, fields, n_fields_, [&](const double* x) {
    left = std::copy_n(x, width_, left);
    right = std::copy_n(x + chunk.columns - width_, width_, right);
  });
}

void RingEdges::take(const ChunkFields& chunk, const EdgeFields& fields, std::size_t pass,
                     const RingEdges& left, const RingEdges& right) const noexcept {
  RONDO_ASSERT(left.width_ == width_ && right.width_ == width_, width_, left.width_, right.width_);
  const double* from_left = left.edges_[pass % 2][1].data();
  const double* from_right = right.edges_[pass % 2][0].data();
  for_components(chunk, fields, n_fields_, [&](double* x) {
    std::copy_n(from_left, width_, x - width_);
    std::copy_n(from_right, width_, x + chunk.columns);
    from_left += width_;
    from_right += width_;
  });
}

}  // namespace rondo::dynamics
