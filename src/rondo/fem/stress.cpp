// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/stress.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/index.hpp"
#include "rondo/fem/assembly.hpp"

namespace rondo::fem {

StressRecovery::StressRecovery(const mesh::Mesh& mesh, std::span<const Material> materials)
    : mesh_(mesh),
      dilatation_(mesh, materials),
      materials_(materials.begin(), materials.end()),
      nodal_(mesh.n_nodes()) {
  for (const Material& material : materials_) law_.push_back(stress_law(material));
  const std::vector<double> total = nodal_areas(mesh);
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    static_cast<void>(material_of(mesh, materials, e));  // checks that there is one
    const mesh::Cell& cell = mesh.cells[e];
    std::array<Vec2, 4> x;
    const auto n = static_cast<std::size_t>(mesh::n_corners(cell));
    for (std::size_t a = 0; a < n; ++a) x[a] = mesh.coordinates[at(cell[a])];
    std::array<double, 4> weight = element_masses({x.data(), n}, 1.0);
    for (std::size_t a = 0; a < n; ++a) weight[a] /= total[at(cell[a])];
    weight_.push_back(weight);
  }
}

std::span<const Stress> StressRecovery::operator()(std::span<const Vec2> u) {
  std::fill(nodal_.begin(), nodal_.end(), Stress{});
  const auto displacement = [u](int node) { return u[at(node)]; };
  for (std::size_t e = 0; e < mesh_.cells.size(); ++e) {
    const mesh::Cell& cell = mesh_.cells[e];
    const auto n = static_cast<std::size_t>(mesh::n_corners(cell));
    const StressLaw& law =
        law_[mesh_.region.empty() ? 0 : static_cast<std::size_t>(mesh_.region[e])];
    const auto stress = cell_stress(mesh_, e, law, dilatation_, displacement);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t k = 0; k < 4; ++k) nodal_[at(cell[a])][k] += weight_[e][a] * stress[a][k];
  }
  return nodal_;
}

Stress turned(const Stress& s, Complex r) noexcept {
  const double cc = r.re * r.re, ss = r.im * r.im, cs = r.re * r.im;
  return {cc * s[0] - 2.0 * cs * s[3] + ss * s[1], ss * s[0] + 2.0 * cs * s[3] + cc * s[1], s[2],
          cs * (s[0] - s[1]) + (cc - ss) * s[3]};
}

double von_mises(const Stress& s) noexcept {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * s[3] * s[3]);
}

}  // namespace rondo::fem
