// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/solid/solid_stress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/fem/solid/corners.hpp"

namespace rondo::fem {

SolidStressRecovery::SolidStressRecovery(const mesh::Mesh& mesh,
                                         std::span<const Material> materials)
    : materials_(materials.begin(), materials.end()), nodal_(mesh.n_nodes()) {
  const auto n_sectors = static_cast<std::size_t>(mesh.n_sectors);
  RONDO_DEMAND(n_sectors >= 3 && mesh.hexahedra.size() % n_sectors == 0, mesh.n_sectors);
  nodes_per_sector_ = mesh.n_nodes() / n_sectors;
  for (std::size_t j = 0; j < n_sectors; ++j)
    turn_.push_back(rotation(2.0 * std::numbers::pi * static_cast<double>(j) / mesh.n_sectors));
  const auto number = [&](int node) { return static_cast<std::size_t>(node) % nodes_per_sector_; };
  std::vector<double> total(nodes_per_sector_, 0.0);
  for (std::size_t e = 0; e < mesh.hexahedra.size() / n_sectors; ++e) {
    const HexahedronCorners x = corners_of(mesh, e);
    elements_.push_back(
        {mesh.hexahedra[e], hexahedron_volumes(x), hexahedron_points(x),
         static_cast<std::size_t>(&material_of(mesh, materials, e) - materials.data())});
    for (std::size_t i = 0; i < 8; ++i)
      total[number(elements_[e].nodes[i])] += elements_[e].weight[i];
  }
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (std::size_t i = 0; i < 8; ++i)
      elements_[e].weight[i] /= total[number(elements_[e].nodes[i])];
}

std::span<const SolidStress> SolidStressRecovery::operator()(std::span<const Vec3> u) {
  RONDO_DEMAND(u.size() == nodal_.size(), u.size(), nodal_.size());
  std::fill(nodal_.begin(), nodal_.end(), SolidStress{});
  for (std::size_t j = 0; j < turn_.size(); ++j)
    for (const Element& element : elements_) {
      HexahedronCorners moved;
      std::array<std::size_t, 8> node;
      for (std::size_t i = 0; i < 8; ++i) {
        node[i] = static_cast<std::size_t>(element.nodes[i]) + j * nodes_per_sector_;
        if (node[i] >= nodal_.size()) node[i] -= nodal_.size();
        moved[i] = conj(turn_[j]) * u[node[i]];
      }
      const auto stress = hexahedron_stress(element.points, moved, materials_[element.material]);
      for (std::size_t i = 0; i < 8; ++i) {
        const SolidStress here = turned(stress[i], turn_[j]);
        for (std::size_t c = 0; c < 6; ++c) nodal_[node[i]][c] += element.weight[i] * here[c];
      }
    }
  return nodal_;
}

std::vector<SolidStress> solid_stress(const mesh::Mesh& mesh, std::span<const Material> materials,
                                      std::span<const Vec3> u) {
  SolidStressRecovery recovery(mesh, materials);
  const std::span<const SolidStress> found = recovery(u);
  return {found.begin(), found.end()};
}

SolidStress turned(const SolidStress& s, Complex r) noexcept {
  const auto& [xx, yy, zz, xy, yz, zx] = s;
  const double cc = r.re * r.re, ss = r.im * r.im, cs = r.re * r.im;
  return {cc * xx - 2.0 * cs * xy + ss * yy,
          ss * xx + 2.0 * cs * xy + cc * yy,
          zz,
          cs * (xx - yy) + (cc - ss) * xy,
          r.re * yz + r.im * zx,
          r.re * zx - r.im * yz};
}

double von_mises(const SolidStress& s) noexcept {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  const double shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * shear);
}

}  // namespace rondo::fem
