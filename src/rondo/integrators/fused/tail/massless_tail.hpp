// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact nodes without mass in the fused steps (massless/ring_contact.hpp, ring_arc.hpp).
#pragma once
#include <memory>
#include <vector>

#include "rondo/integrators/fused/tail/step_tail.hpp"
#include "rondo/integrators/implicit/node_fields.hpp"
#include "rondo/integrators/implicit/ring_terms.hpp"

namespace rondo::dynamics {

/// Nodes of an integrator, and its fields of them: u_{n+1} and v_{n+1/2} before a step, u_{n+2} and
/// v_{n+3/2} after it.
struct NodesInStep {
  NodeSet nodes;
  NodeFields* fields;  ///< outlives the tail
};

/// @param ring the candidates; `around`: the nodes with mass beside them. Where the nodes are rows
/// round a ring of sectors (NodeSet::sectors) that RingArc fits, that makes the step.
/// @param product loop of the instruction set
[[nodiscard]] std::unique_ptr<StepTail> massless_tail(const Model& model, NodesInStep ring,
                                                      NodesInStep around, RingProduct product);

/// The nodes whose fields the tail wants: the candidates, ascending, and the nodes with mass that K
/// joins to them; sectors_around() takes a node of all sectors where it is one of these in any.
[[nodiscard]] std::vector<int> massless_nodes(const Model& model);
[[nodiscard]] std::vector<int> nodes_around(const Model& model);
[[nodiscard]] std::vector<int> sectors_around(const Model& model);

}  // namespace rondo::dynamics
