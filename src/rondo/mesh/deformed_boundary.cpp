// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/deformed_boundary.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/solid/face.hpp"

namespace rondo::mesh {
namespace {

constexpr double round_off = 1e-12;  ///< relative, for a sum of a few shares

}  // namespace

DeformedBoundary::DeformedBoundary(const Mesh& mesh) : mesh_(mesh) {
  first_.push_back(0);
  for (const std::vector<Share>& of : find()) {
    shares_.insert(shares_.end(), of.begin(), of.end());
    first_.push_back(shares_.size());
  }
}

DeformedBoundary::Shares DeformedBoundary::shares_of(std::span<const Edge> edges) const {
  std::vector<Face> nodes;
  for (const Edge& edge : edges) nodes.push_back({edge[0], edge[1], -1, -1});
  return collect(nodes, 2);
}

DeformedBoundary::Shares DeformedBoundary::shares_of(std::span<const Face> faces) const {
  return collect(faces, 4);
}

DeformedBoundary::Shares DeformedBoundary::collect(std::span<const Face> nodes,
                                                   std::size_t corners) const {
  std::vector<int> candidate(mesh_.n_nodes(), -1);
  for (std::size_t k = 0; k < mesh_.boundary.size(); ++k)
    candidate[at(mesh_.boundary[k])] = static_cast<int>(k);
  const Field still(mesh_.n_nodes(), mesh_.is_solid() ? 3 : 2);
  Shares shares(mesh_.boundary.size());
  for (const Face& of : nodes)
    for (std::size_t i = 0; i < corners; ++i) {
      const int k = candidate[at(of[i])];
      if (k < 0) continue;
      Share share{of, i, 0.0};
      share.undeformed = now(share, still);
      shares[at(k)].push_back(share);
    }
  return shares;
}

/// Examines the curves and surfaces of the mesh. For contact_edges, edges at a clamped node are
/// left out.
DeformedBoundary::Shares DeformedBoundary::find() const {
  for (const Surface& surface : mesh_.surfaces)
    if (Shares shares = shares_of(surface.faces); makes_tributaries(shares)) return shares;
  if (mesh_.is_solid()) return Shares(mesh_.boundary.size());
  Shares shares = shares_of(mesh_.contact_edges);
  if (makes_tributaries(shares)) return shares;
  for (const Curve& curve : mesh_.curves)
    if (Shares whole = shares_of(curve.edges); makes_tributaries(whole)) return whole;
  return shares;
}

bool DeformedBoundary::makes_tributaries(const Shares& shares) const {
  for (std::size_t k = 0; k < shares.size(); ++k) {
    double sum = 0.0;
    for (const Share& share : shares[k]) sum += share.undeformed;
    if (std::abs(sum - mesh_.tributary[k]) > round_off * mesh_.tributary[k]) return false;
  }
  return true;
}

Vec3 DeformedBoundary::place(int node, FieldView u) const noexcept {
  const std::size_t k = at(node);
  const Vec2 plane = mesh_.coordinates[k] + Vec2{u[k][0], u[k][1]};
  return mesh_.is_solid() ? Vec3(plane, mesh_.axial[k] + u[k][2]) : Vec3(plane);
}

/// Half of the present length of an edge, or the share of a face.
double DeformedBoundary::now(const Share& share, FieldView u) const noexcept {
  if (!mesh_.is_solid())
    return 0.5 * norm((place(share.nodes[1], u) - place(share.nodes[0], u)).plane());
  std::array<Vec3, 4> x;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = place(share.nodes[i], u);
  return norm(face_shares(x)[share.corner]);
}

double DeformedBoundary::extent(std::size_t candidate, FieldView u) const noexcept {
  RONDO_ASSERT(candidate < mesh_.boundary.size() && u.size() == mesh_.n_nodes(), candidate,
               u.size());
  double change = 0.0;
  for (std::size_t s = first_[candidate]; s < first_[candidate + 1]; ++s)
    change += now(shares_[s], u) - shares_[s].undeformed;
  return std::max(0.0, mesh_.tributary[candidate] + change);
}

void DeformedBoundary::widen(std::size_t candidate, FieldView u,
                             Footprint& footprint) const noexcept {
  RONDO_ASSERT(mesh_.is_solid() && candidate < mesh_.boundary.size() && u.size() == mesh_.n_nodes(),
               candidate, u.size());
  const Vec3 own = place(mesh_.boundary[candidate], u);
  footprint.include(own);
  for (std::size_t s = first_[candidate]; s < first_[candidate + 1]; ++s)
    for (const std::size_t beside : {1U, 3U}) {
      const int other = shares_[s].nodes[(shares_[s].corner + beside) % 4];
      footprint.include(0.5 * (own + place(other, u)));
    }
}

}  // namespace rondo::mesh
