// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/region_sizes.hpp"

#include <array>
#include <numeric>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/element.hpp"
#include "rondo/fem/solid/corners.hpp"
#include "rondo/fem/solid/hexahedron.hpp"

namespace rondo::fem {
namespace {

double sum(std::span<const double> shares) {
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

double size_of(const mesh::Mesh& mesh, std::size_t element) {
  if (mesh.is_solid()) return sum(hexahedron_volumes(corners_of(mesh, element)));
  const mesh::Cell& cell = mesh.cells[element];
  std::array<Vec2, 4> x;
  const auto n = static_cast<std::size_t>(mesh::n_corners(cell));
  for (std::size_t a = 0; a < n; ++a) x[a] = mesh.coordinates[at(cell[a])];
  return sum(element_masses({x.data(), n}, 1.0));
}

}  // namespace

std::vector<double> region_sizes(const mesh::Mesh& mesh, std::size_t n_regions) {
  std::vector<double> sizes(n_regions, 0.0);
  for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
    const std::size_t region = mesh.region.empty() ? 0 : static_cast<std::size_t>(mesh.region[e]);
    RONDO_DEMAND(region < n_regions, region, n_regions);
    sizes[region] += size_of(mesh, e);
  }
  return sizes;
}

}  // namespace rondo::fem
