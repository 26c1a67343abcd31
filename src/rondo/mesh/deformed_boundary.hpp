// SPDX-License-Identifier: BSD-3-Clause
/// @file  Tributary length (in three dimensions area) of the contact candidates on the deformed
/// body. The contact lengths, footprints and pressures in all results are computed with it.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/field.hpp"
#include "rondo/mesh/footprint.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

class DeformedBoundary {
 public:
  /// The mesh must outlive the object. The contact boundary is the curve (in three dimensions the
  /// surface) that gives the candidates their tributaries; without one, it is contact_edges alone.
  explicit DeformedBoundary(const Mesh& mesh);

  /// Tributary length or area of a candidate on the body displaced by u, in any frame. Without
  /// displacement it equals mesh.tributary bit for bit.
  /// @param candidate index in mesh.boundary
  /// @param u (n) displacement, with three components in three dimensions [m]
  /// @return [m], in three dimensions [m²]; >= 0
  [[nodiscard]] double extent(std::size_t candidate, FieldView u) const noexcept;

  /// Widens a footprint by what a candidate stands for: itself and half of each edge beside it.
  /// @pre the mesh is one in three dimensions. @param u (n) displacement in the frame of the
  /// coordinates [m]
  void widen(std::size_t candidate, FieldView u, Footprint& footprint) const noexcept;

 private:
  /// A corner of a face of the contact surface, or an end of an edge, that is a candidate.
  struct Share {
    Face nodes{};  ///< for an edge, only the first two are used
    std::size_t corner = 0;
    double undeformed = 0.0;
  };
  using Shares = std::vector<std::vector<Share>>;  ///< by candidate

  [[nodiscard]] Shares shares_of(std::span<const Edge> edges) const;
  [[nodiscard]] Shares shares_of(std::span<const Face> faces) const;
  [[nodiscard]] Shares collect(std::span<const Face> nodes, std::size_t corners) const;
  [[nodiscard]] Shares find() const;
  [[nodiscard]] bool makes_tributaries(const Shares& shares) const;
  [[nodiscard]] Vec3 place(int node, FieldView u) const noexcept;
  [[nodiscard]] double now(const Share& share, FieldView u) const noexcept;

  const Mesh& mesh_;
  std::vector<Share> shares_;       ///< candidate after candidate
  std::vector<std::size_t> first_;  ///< (nb + 1) in shares_
};

}  // namespace rondo::mesh
