// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/contact_statistics.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/keep_larger.hpp"

namespace rondo::study {

void ContactStatistics::add(const dynamics::ContactReport& r) noexcept {
  RONDO_ASSERT(r.nodes >= 0 && !(r.penetration < 0.0), r.nodes, r.penetration);
  free_velocity = std::max(free_velocity, r.free_velocity);
  const double relative = r.residual / free_velocity;
  if (r.residual != 0.0) residual = keep_larger(residual, relative);
  penetration = std::max(penetration, r.penetration);
  contact_steps += r.nodes > 0 ? 1 : 0;
  nodes_max = std::max(nodes_max, r.nodes);
  pairs += r.pairs;
  pairs_not_converged += r.pairs_not_converged;
  clusters += r.clusters;
  clusters_not_converged += r.clusters_not_converged;
  cluster_largest = std::max(cluster_largest, r.cluster_largest);
  cluster_iterations = std::max(cluster_iterations, r.cluster_iterations);
  extensions += r.extensions;
  extensions_max = std::max(extensions_max, r.extensions);
  between_bodies = std::max(between_bodies, r.between_bodies);
}

}  // namespace rondo::study
