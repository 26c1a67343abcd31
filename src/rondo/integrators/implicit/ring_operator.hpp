// SPDX-License-Identifier: BSD-3-Clause
/// @file  Implicit elements of whole layers of a disk: polar components, rows round the ring.
#pragma once
#include <memory>

#include "rondo/integrators/implicit/implicit_operator.hpp"
#include "rondo/integrators/implicit/ring_terms.hpp"

namespace rondo::dynamics {

/// Rows of one local node each, over the sectors. @param nodes (n) every sector's, ascending
[[nodiscard]] NodeSet ring_nodes(const Model& model, std::span<const int> nodes);

/// Operator of the nodes by parallel cyclic reduction (circulant.hpp). @param spin s of A [rad/s]
[[nodiscard]] std::unique_ptr<ImplicitOperator> ring_operator(const Model& model,
                                                              const NodeSet& nodes, double spin,
                                                              RingProduct product);

}  // namespace rondo::dynamics
