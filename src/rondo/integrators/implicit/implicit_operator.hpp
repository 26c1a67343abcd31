// SPDX-License-Identifier: BSD-3-Clause
/// @file  The matrices of implicit elements (docs/theory.md, 3.9): A = M (1 + Δt α/2 + iΔt s) +
/// (Δt²/4 + Δt β/2) K_I at one spin s, and K_I.
#pragma once
#include <memory>
#include <span>

#include "rondo/integrators/implicit/node_fields.hpp"

namespace rondo::dynamics {

struct Model;

class ImplicitOperator {
 public:
  virtual ~ImplicitOperator() = default;
  ImplicitOperator() = default;
  ImplicitOperator(const ImplicitOperator&) = delete;
  ImplicitOperator& operator=(const ImplicitOperator&) = delete;

  /// A⁻¹ b; b in, x out.
  virtual void solve(PlaneField& x) noexcept = 0;
  /// K_I v                                                                              [N/m]
  virtual void product(const PlaneField& v, PlaneField& out) noexcept = 0;
};

/// Nodes as they are, Cartesian components.
[[nodiscard]] NodeSet node_set(const Model& model, std::span<const int> nodes);
/// Spin at which A is factored: that of t = 0                                          [rad/s]
[[nodiscard]] double factored_spin(const Model& model) noexcept;

/// Assembled, of the nodes in `nodes`, Cartesian components
/// @param spin s of A                                                                  [rad/s]
[[nodiscard]] std::unique_ptr<ImplicitOperator> assembled_operator(const Model& model,
                                                                   const NodeSet& nodes,
                                                                   double spin);

}  // namespace rondo::dynamics
