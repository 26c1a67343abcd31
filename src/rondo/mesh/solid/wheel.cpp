// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/solid/wheel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::mesh {
namespace {

/// z of required axial lines: the side faces and the edges of the grooves, ascending.
std::vector<double> fixed_lines(const Wheel& wheel) {
  const double half = 0.5 * wheel.width, near = 1e-9 * wheel.width;
  std::vector<double> z{-half, half};
  for (const auto& [middle, width] : wheel.grooves)
    for (const double edge : {middle - 0.5 * width, middle + 0.5 * width})
      if (std::abs(edge) < half - near) z.push_back(edge);
  std::sort(z.begin(), z.end());
  const auto same = [&](double a, double b) { return b - a <= near; };
  z.erase(std::unique(z.begin(), z.end(), same), z.end());
  return z;
}

/// Numbers of elements between the fixed lines. Each further element is added where they are
/// widest: on both sides at once if the lines are symmetric, or in the middle if one is left.
std::vector<int> elements_between(const std::vector<double>& fixed, int axial) {
  const std::size_t parts = fixed.size() - 1;
  bool mirrored = true;
  for (std::size_t i = 0; i <= parts; ++i)
    mirrored = mirrored && std::abs(fixed[i] + fixed[parts - i]) <= 1e-9 * fixed.back();
  std::vector<int> n(parts, 1);
  int left = axial - static_cast<int>(parts);
  while (left > 0) {
    std::size_t widest = 0;
    double size = 0.0;
    for (std::size_t i = 0; i < parts; ++i) {
      const double element = (fixed[i + 1] - fixed[i]) / n[i];
      if (element > size * (1.0 + 1e-9)) widest = i, size = element;
    }
    const std::size_t twin = parts - 1 - widest;
    if (mirrored && left == 1 && parts % 2 == 1)
      widest = parts / 2;
    else if (mirrored && left > 1 && twin != widest)
      ++n[twin], --left;
    ++n[widest], --left;
  }
  return n;
}

/// Distance by which the crown lies below its middle.
double drop(const Wheel& wheel, double z) {
  if (!wheel.crown_radius) return 0.0;
  const double r = *wheel.crown_radius;
  return z * z / (r + std::sqrt(r * r - z * z));
}

/// Nodes layer after layer from the rim outwards, each layer across the width. The drop of the
/// crown grows from the rim to the base of the tread, so that the tread's depth is constant.
void add_nodes(const Wheel& wheel, const std::vector<double>& z, Mesh& mesh) {
  const std::vector<double> radii = layer_radii(wheel.disk);
  const double rim = radii.front(), base = radii[at(wheel.disk.radial)];
  for (const double r : radii)
    for (const double place : z) {
      const double part = r < base ? (r - rim) / (base - rim) : 1.0;
      mesh.coordinates.push_back({r - part * drop(wheel, place), place});
    }
}

void check(const Wheel& wheel) {
  const Disk& d = wheel.disk;
  RONDO_DEMAND(d.inner_radius > 0 && d.outer_radius > d.inner_radius, d.inner_radius,
               d.outer_radius);
  RONDO_DEMAND(d.radial >= 1 && d.grading >= 1, d.radial, d.grading);
  RONDO_DEMAND(wheel.width > 0 && wheel.axial >= least_axial(wheel), wheel.width, wheel.axial);
  RONDO_DEMAND(!wheel.crown_radius || *wheel.crown_radius >= 0.5 * wheel.width);
  RONDO_DEMAND(wheel.grooves.empty() || d.tread, wheel.grooves.size());
}

}  // namespace

int least_axial(const Wheel& wheel) {
  return static_cast<int>(fixed_lines(wheel).size()) - 1;
}

std::vector<double> axial_lines(const Wheel& wheel) {
  const std::vector<double> fixed = fixed_lines(wheel);
  const std::vector<int> n = elements_between(fixed, wheel.axial);
  std::vector<double> z{fixed.front()};
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double middle = 0.5 * (fixed[i] + fixed[i + 1]), width = fixed[i + 1] - fixed[i];
    for (int k = 1; k < n[i]; ++k)
      z.push_back(middle + width * (2 * k - n[i]) / (2.0 * n[i]));  // bitwise symmetric
    z.push_back(fixed[i + 1]);
  }
  return z;
}

Mesh make_section(const Wheel& wheel) {
  check(wheel);
  Mesh mesh;
  const std::vector<double> z = axial_lines(wheel);
  add_nodes(wheel, z, mesh);
  const int across = static_cast<int>(z.size());
  const int layers = static_cast<int>(mesh.n_nodes()) / across - 1;
  const auto node = [&](int layer, int line) { return layer * across + line; };
  Curve rim{"rim", {}}, tread{"tread", {}}, left{"left", {}}, right{"right", {}};
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j + 1 < across; ++j)
      mesh.cells.push_back({node(k, j), node(k + 1, j), node(k + 1, j + 1), node(k, j + 1)});
    left.edges.push_back({node(k, 0), node(k + 1, 0)});
    right.edges.push_back({node(k + 1, across - 1), node(k, across - 1)});
  }
  for (int j = 0; j + 1 < across; ++j) {
    rim.edges.push_back({node(0, j + 1), node(0, j)});
    tread.edges.push_back({node(layers, j), node(layers, j + 1)});
  }
  for (int j = 0; j < across; ++j) mesh.clamped.push_back(node(0, j));
  mesh.curves = {std::move(rim), std::move(tread), std::move(left), std::move(right)};
  for (int k = 1; k < layers; ++k) {
    Curve& line = mesh.curves.emplace_back(Curve{"layer-" + std::to_string(k), {}});
    for (int j = 0; j + 1 < across; ++j) line.edges.push_back({node(k, j), node(k, j + 1)});
  }
  return mesh;
}

Columns columns_of(const Wheel& wheel, const Mesh& section) {
  const Disk& d = wheel.disk;
  if (!d.tread) return {d.circumferential, 1, {}};
  const int land = d.tread->land_columns, all = land + d.tread->groove_columns;
  Columns columns{d.tread->pitches, all, {}};
  if (all == land && wheel.grooves.empty()) return columns;
  const std::vector<double> z = axial_lines(wheel);
  const auto in_groove = [&](std::size_t line) {
    const double middle = 0.5 * (z[line] + z[line + 1]);
    return std::ranges::any_of(wheel.grooves, [&](const std::array<double, 2>& g) {
      return std::abs(middle - g[0]) < 0.5 * g[1];
    });
  };
  const std::size_t across = z.size() - 1, base = static_cast<std::size_t>(d.radial);
  for (int c = 0; c < all; ++c)
    for (std::size_t e = 0; e < section.cells.size(); ++e)
      columns.kept.push_back(e / across < base || (c < land && !in_groove(e % across)) ? 1 : 0);
  return columns;
}

std::size_t n_wheel_nodes(const Wheel& wheel) noexcept {
  const Disk& d = wheel.disk;
  const std::size_t across = at(wheel.axial) + 1;
  if (!d.tread) return at(d.circumferential) * (at(d.radial) + 1) * across;
  const int columns = d.tread->land_columns + d.tread->groove_columns;
  const std::size_t tread_lines = at(std::min(d.tread->land_columns + 1, columns));
  return at(d.tread->pitches) * across *
         (at(columns) * (at(d.radial) + 1) + tread_lines * at(d.tread->layers));
}

}  // namespace rondo::mesh
