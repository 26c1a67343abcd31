// SPDX-License-Identifier: BSD-3-Clause
/// @file  Implicit elements in the fused steps (implicit/implicit_elements.hpp).
#pragma once
#include <memory>

#include "rondo/integrators/fused/tail/step_tail.hpp"
#include "rondo/integrators/implicit/implicit_elements.hpp"

namespace rondo::dynamics {

/// @param fields of the nodes, which outlive it
/// @param implicit A of these nodes at the spin of t = 0
[[nodiscard]] std::unique_ptr<StepTail> implicit_tail(const Model& model, NodeSet nodes,
                                                      std::unique_ptr<ImplicitOperator> implicit,
                                                      NodeFields& fields);

}  // namespace rondo::dynamics
