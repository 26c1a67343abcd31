// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/base/ring.hpp"

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

Eigen::VectorXcd load_of(const SolidRing& ring) {
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(ring.n_rows());
  for (std::size_t a = 0; a < ring.load.size(); ++a)
    f.segment<3>(static_cast<Eigen::Index>(3 * a)) << ring.load[a].x, ring.load[a].y,
        ring.load[a].z;
  return f;
}

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

}  // namespace rondo::rom
