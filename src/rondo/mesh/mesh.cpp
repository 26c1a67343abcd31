// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/mesh.hpp"

namespace rondo::mesh {

std::vector<char> clamped_flags(const Mesh& mesh) {
  std::vector<char> flags(mesh.n_nodes(), 0);
  for (const int node : mesh.clamped) flags[static_cast<std::size_t>(node)] = 1;
  return flags;
}

}  // namespace rondo::mesh
