// SPDX-License-Identifier: BSD-3-Clause
/// @file  Length, in three dimensions area, of the boundary that contact candidates stand for once
/// the body is deformed: what contact lengths and pressures of all results are over.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/field.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

class DeformedBoundary {
 public:
  /// The mesh must outlive it. The contact boundary is the curve, in three dimensions the surface,
  /// that gives the candidates their tributaries; where none is, contact_edges alone count.
  explicit DeformedBoundary(const Mesh& mesh);

  /// Tributary length or area of a candidate as the body is displaced, in whatever frame.
  /// Undisplaced it is mesh.tributary to the last bit.
  /// @param candidate place in mesh.boundary
  /// @param u (n) displacement, with three components in three dimensions [m]
  /// @return [m], in three dimensions [m²]; >= 0
  [[nodiscard]] double extent(std::size_t candidate, FieldView u) const noexcept;

 private:
  /// A corner of a face of the contact surface, or an end of an edge, at a candidate.
  struct Share {
    Face nodes{};  ///< of an edge the first two count
    std::size_t corner = 0;
    double undeformed = 0.0;
  };
  using Shares = std::vector<std::vector<Share>>;  ///< by candidate

  [[nodiscard]] Shares shares_of(std::span<const Edge> edges) const;
  [[nodiscard]] Shares shares_of(std::span<const Face> faces) const;
  [[nodiscard]] Shares collect(std::span<const Face> nodes, std::size_t corners) const;
  [[nodiscard]] Shares find() const;
  [[nodiscard]] bool makes_tributaries(const Shares& shares) const;
  [[nodiscard]] double now(const Share& share, FieldView u) const noexcept;

  const Mesh& mesh_;
  std::vector<Share> shares_;       ///< candidate after candidate
  std::vector<std::size_t> first_;  ///< (nb + 1) in shares_
};

}  // namespace rondo::mesh
