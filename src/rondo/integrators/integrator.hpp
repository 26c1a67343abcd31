// SPDX-License-Identifier: BSD-3-Clause
/// @file  The integrators of a body on its mesh. The general one is the readable reference; two
/// operators do the same step fused: `cyclic` on meshes of equal sectors, `sparse` on any mesh.
#pragma once
#include <memory>

#include "rondo/model/integrator.hpp"

namespace rondo::dynamics {

/// The integrator of the fastest step that can do the model (model/steps/step_table.hpp). The model
/// must outlive it. @pre there is one
/// @param start at t = 0 (start.hpp). @throws InputError (RONDO_DISPATCH), std::bad_alloc
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(const Model& model, const State& start);

}  // namespace rondo::dynamics
