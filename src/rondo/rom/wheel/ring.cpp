// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/ring.hpp"

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

/// @param place_of X of a node of the body
template <int D, class PlaceOf>
SectorRing<D> ring_of(const fem::SectorBlocks<D>& stiffness, std::span<const double> mass,
                      std::span<const int> contact, PlaceOf&& place_of) {
  SectorRing<D> ring{stiffness, {}, {}, {}};
  std::vector<char> touches(at(stiffness.nodes_per_sector));
  for (const int node : contact) touches[at(node % stiffness.nodes_per_sector)] = 1;
  for (std::size_t a = 0; a < stiffness.n_local(); ++a) {
    const std::size_t node = stiffness.node(a, 0);
    ring.place.push_back(place_of(node));
    ring.mass.push_back(mass[node]);
    const bool contacts = touches[at(stiffness.nodes[a])] != 0;
    RONDO_DEMAND(contacts == (mass[node] == 0.0), a, mass[node]);
    if (contacts) ring.contact.push_back(static_cast<int>(a));
  }
  RONDO_DEMAND(ring.contact.size() * at(stiffness.n_sectors) == contact.size(), ring.contact.size(),
               stiffness.n_sectors, contact.size());
  return ring;
}

}  // namespace

Ring make_ring(const fem::SectorStiffness& stiffness, std::span<const double> mass,
               std::span<const Vec2> reference, std::span<const int> contact) {
  return ring_of(stiffness, mass, contact, [&](std::size_t node) { return reference[node]; });
}

SolidRing make_solid_ring(const fem::SolidSector& stiffness, std::span<const double> mass,
                          std::span<const Vec2> reference, std::span<const double> axial,
                          std::span<const int> contact) {
  return ring_of(stiffness, mass, contact,
                 [&](std::size_t node) { return Vec3(reference[node], axial[node]); });
}

template <int D>
std::vector<std::size_t> candidates_of(const SectorRing<D>& ring,
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

template <int D>
std::vector<double> tributaries_of(const SectorRing<D>& ring,
                                   const dynamics::ContactModel& contact) {
  const std::vector<std::size_t> candidates = candidates_of(ring, contact);
  std::vector<double> tributaries;
  for (std::size_t c = 0; c < ring.contact.size(); ++c)
    tributaries.push_back(contact.tributary[candidates[c]]);
  return tributaries;
}

template std::vector<std::size_t> candidates_of(const Ring&, const dynamics::ContactModel&);
template std::vector<std::size_t> candidates_of(const SolidRing&, const dynamics::ContactModel&);
template std::vector<double> tributaries_of(const Ring&, const dynamics::ContactModel&);
template std::vector<double> tributaries_of(const SolidRing&, const dynamics::ContactModel&);

}  // namespace rondo::rom
