// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/nodal_dilatation.hpp"

#include <map>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::fem {
namespace {

constexpr NodalDilatation::Corners none{-1, -1, -1};

bool same_elasticity(const Material& a, const Material& b) noexcept {
  return a.youngs_modulus == b.youngs_modulus && a.poissons_ratio == b.poissons_ratio &&
         a.plane == b.plane && a.integration == b.integration && a.rubber == b.rubber;
}

/// (materials) index of the first equal material: regions of the same rubber count as one.
std::vector<int> kinds_of(std::span<const Material> materials) {
  std::vector<int> kinds;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    std::size_t first = 0;
    while (!same_elasticity(materials[first], materials[k])) ++first;
    kinds.push_back(static_cast<int>(first));
  }
  return kinds;
}

/// Sums of a patch while triangles are added to it.
struct Draft {
  double bulk = 0.0, area = 0.0;
  std::map<int, Vec2> volume;  ///< by node: ∂(V θ)/∂u [m]
  std::vector<int> cells;
};

}  // namespace

NodalDilatation::NodalDilatation(const mesh::Mesh& mesh, std::span<const Material> materials) {
  const std::vector<int> kinds = kinds_of(materials);
  std::map<std::pair<int, int>, int> place;  // patch of a node and a kind
  std::vector<Draft> drafts;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const mesh::Cell& cell = mesh.cells[e];
    const double bulk = element_law(material_of(mesh, materials, e)).mean_bulk;
    corners_.push_back(none);
    if (mesh::n_corners(cell) != 3 || bulk == 0.0) continue;
    const int kind = kinds[mesh.region.empty() ? 0 : static_cast<std::size_t>(mesh.region[e])];
    std::array<Vec2, 3> x;
    for (std::size_t a = 0; a < 3; ++a) x[a] = mesh.coordinates[static_cast<std::size_t>(cell[a])];
    const double area = 0.5 * cross(x[1] - x[0], x[2] - x[0]);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto [at, added] = place.try_emplace({cell[a], kind}, static_cast<int>(drafts.size()));
      if (added) drafts.push_back({bulk, 0.0, {}, {}});
      corners_[e][a] = at->second;
      Draft& draft = drafts[static_cast<std::size_t>(at->second)];
      draft.area += area / 3.0;
      draft.cells.push_back(static_cast<int>(e));
      for (std::size_t b = 0; b < 3; ++b)  // A/3 ∇N_b, ∇N_b = turn90(opposite edge) / 2A
        draft.volume[cell[b]] += turn90(x[(b + 2) % 3] - x[(b + 1) % 3]) / 6.0;
    }
  }
  if (drafts.empty()) corners_.clear();
  for (const Draft& draft : drafts) {
    RONDO_DEMAND(draft.area > 0.0, draft.area);
    Patch patch{draft.bulk, draft.area, terms_.size(), 0, cells_.size(), 0};
    for (const auto& [node, gradient] : draft.volume)
      terms_.push_back({node, gradient / draft.area});
    cells_.insert(cells_.end(), draft.cells.begin(), draft.cells.end());
    patch.last = terms_.size();
    patch.last_cell = cells_.size();
    patches_.push_back(patch);
  }
}

}  // namespace rondo::fem
