// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/dynamics/model.hpp"

namespace rondo::dynamics {

State::State(const Model& model) : u(model.n_nodes()), v(model.n_nodes()), v_next(model.n_nodes()) {
  if (model.contact) active.reserve(2 * model.contact->nodes.size());
}

}  // namespace rondo::dynamics
