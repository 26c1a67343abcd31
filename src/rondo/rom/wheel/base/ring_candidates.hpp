// SPDX-License-Identifier: BSD-3-Clause
/// @file  The contact nodes of a ring among the candidates of the ground.
#pragma once
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/model/model.hpp"
#include "rondo/rom/wheel/base/ring.hpp"

namespace rondo::rom {

/// (N C) The candidate that each contact node is, sector after sector.
template <int D>
[[nodiscard]] std::vector<std::size_t> candidates_of(const SectorRing<D>& ring,
                                                     const dynamics::ContactModel& contact) {
  const std::size_t sectors = at(ring.n_sectors());
  const std::vector<int> place =
      dynamics::places_among(contact.nodes, sectors * at(ring.stiffness.nodes_per_sector));
  std::vector<std::size_t> candidates;
  for (std::size_t j = 0; j < sectors; ++j)
    for (const int row : ring.contact) {
      const std::size_t node = ring.stiffness.node(at(row), j);
      RONDO_DEMAND(place[node] >= 0, node);
      candidates.push_back(at(place[node]));
    }
  return candidates;
}

/// (C) The length, or the area, that a contact node of a sector stands for [m], [m²].
template <int D>
[[nodiscard]] std::vector<double> tributaries_of(const SectorRing<D>& ring,
                                                 const dynamics::ContactModel& contact) {
  const std::vector<std::size_t> candidates = candidates_of(ring, contact);
  std::vector<double> tributaries;
  for (std::size_t c = 0; c < ring.contact.size(); ++c)
    tributaries.push_back(contact.tributary[candidates[c]]);
  return tributaries;
}

}  // namespace rondo::rom
