// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/sector_energy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/finite/enclosed_volume.hpp"
#include "rondo/fem/finite/face_points.hpp"
#include "rondo/fem/finite/rubber_hexahedron.hpp"

namespace rondo::fem::finite {
namespace {

using Eigen::Index;

/// A corner of an element of a sector: the node of the section on its first side, or on the second.
struct Corner {
  int node = 0;
  bool next = false;
};

/// The corners of a quadrilateral: first those on the first side, then those on the second.
std::array<Corner, 8> corners_of(const SweptQuad& quad) noexcept {
  std::array<Corner, 8> corners;
  for (std::size_t a = 0; a < 8; ++a) corners[a] = {quad.corner[a % 4], a >= 4};
  return corners;
}
/// The corners of a line have the order of FaceCorners.
std::array<Corner, 4> corners_of(const std::array<int, 2>& line) noexcept {
  return {Corner{line[0], false}, {line[1], false}, {line[1], true}, {line[0], true}};
}

/// Vectors of the section's nodes at the corners, in the frame of this sector.
template <std::size_t N>
std::array<Vec3, N> at_corners(const std::array<Corner, N>& corners, std::span<const Vec3> x,
                               Complex turn) noexcept {
  std::array<Vec3, N> v;
  for (std::size_t a = 0; a < N; ++a)
    v[a] = corners[a].next ? turn * x[at(corners[a].node)] : x[at(corners[a].node)];
  return v;
}

/// Forces and blocks of a sector as its elements add to them.
struct Sum {
  Eigen::VectorXd force;
  std::vector<Eigen::Triplet<double>> here, next;
  Eigen::Matrix3d turn;  ///< R: from the frame of the next sector to this one's

  /// The forces on the second side of the sector before act on this one's first side.
  template <std::size_t N>
  void add(const Energy<static_cast<int>(N)>& local, const std::array<Corner, N>& corners,
           double share) {
    for (std::size_t a = 0; a < N; ++a) {
      const Index row = Index{3} * corners[a].node;
      const auto from = static_cast<Index>(3 * a);
      const Eigen::Vector3d f = share * local.force.template segment<3>(from);
      force.segment<3>(row) += corners[a].next ? Eigen::Vector3d(turn.transpose() * f) : f;
      for (std::size_t b = 0; b < N; ++b) {
        if (corners[a].next && !corners[b].next) continue;  // the transpose of `next`
        Eigen::Matrix3d k =
            share * local.stiffness.template block<3, 3>(from, static_cast<Index>(3 * b));
        if (corners[a].next) k = turn.transpose() * k;
        if (corners[b].next) k = k * turn;
        add_block(corners[a].next == corners[b].next ? here : next, row, Index{3} * corners[b].node,
                  k);
      }
    }
  }
  static void add_block(std::vector<Eigen::Triplet<double>>& to, Index row, Index column,
                        const Eigen::Matrix3d& k) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        to.emplace_back(static_cast<int>(row) + i, static_cast<int>(column) + j, k(i, j));
  }
};

}  // namespace

SectorEnergy::SectorEnergy(SweptSection section)
    : section_(std::move(section)), turn_(rotation(2.0 * std::numbers::pi / section_.n_sectors)) {
  RONDO_DEMAND(section_.n_sectors >= 3 && section_.held.size() == 3 * section_.place.size(),
               section_.n_sectors, section_.held.size(), section_.place.size());
  check();
  for (const Vec2 p : section_.place) reference_.push_back({p.x, 0.0, p.y});
  for (SweptQuad& quad : section_.quads) {
    const auto swept = [&] { return at_corners(corners_of(quad), reference_, turn_); };
    if (smallest_jacobian(swept()) < 0.0) std::swap(quad.corner[1], quad.corner[3]);
    RONDO_DEMAND(smallest_jacobian(swept()) > 0.0, quad.corner[0]);
    points_.push_back(hexahedron_points(swept()));
  }
  for (auto& edge : section_.liner) edge = outwards(edge);
  for (const Cords& cords : section_.cords) layers_.push_back(points_of(cords));
  make_mass();
}

/// The points of a layer, four of each line.
std::vector<std::array<CordPoint, 4>> SectorEnergy::points_of(const Cords& cords) const {
  std::vector<std::array<CordPoint, 4>> points;
  for (const auto& line : cords.lines) {
    const FaceCorners face = at_corners(corners_of(line), reference_, turn_);
    std::array<double, 4> angle{}, spacing{};
    for (std::size_t q = 0; q < 4; ++q) {
      angle[q] = cords.angle;
      spacing[q] = cords.spacing;
      const double r = norm(face_point(face, q).place.plane());
      if (cords.spacing_radius) spacing[q] *= r / *cords.spacing_radius;
      if (!cords.lift) continue;
      const double cosine = cords.lift->cosine(cords.angle, r);
      RONDO_DEMAND(std::abs(cosine) <= 1.0, cosine, r);
      angle[q] = std::copysign(std::acos(cosine), cords.angle);
      spacing[q] *= r / cords.lift->radius * std::sin(angle[q]) / std::sin(cords.angle);
    }
    points.push_back(cord_points(face, angle, spacing));
  }
  return points;
}

/// What the types do not say of a section.
void SectorEnergy::check() const {
  const std::size_t n = n_nodes();
  RONDO_DEMAND(section_.densities.size() == section_.rubbers.size(), section_.densities.size(),
               section_.rubbers.size());
  for (const Vec2 p : section_.place) RONDO_DEMAND(p.x > 0.0, p.x, p.y);
  for (const SweptQuad& quad : section_.quads)
    RONDO_DEMAND(at(quad.rubber) < section_.rubbers.size(), quad.rubber);
  for (const Cords& cords : section_.cords) {
    RONDO_DEMAND(cords.spacing > 0.0 && cords.law.stiffness > 0.0, cords.spacing,
                 cords.law.stiffness);
    RONDO_DEMAND(cords.excess_mass.empty() || cords.excess_mass.size() == cords.lines.size(),
                 cords.excess_mass.size(), cords.lines.size());
    std::vector<int> out(n), in(n);
    for (const auto& [from, to] : cords.lines) {
      ++out[at(from)];
      ++in[at(to)];
    }
    for (std::size_t a = 0; a < n; ++a) RONDO_DEMAND(out[a] <= 1 && in[a] <= 1, a, out[a], in[a]);
  }
  std::vector<int> edges(n);
  for (const auto& edge : section_.liner)
    for (const int a : edge) ++edges[at(a)];
  for (std::size_t a = 0; a < n; ++a) {
    const bool held = section_.held[3 * a] && section_.held[3 * a + 1] && section_.held[3 * a + 2];
    const bool capped =
        std::ranges::find(section_.caps, static_cast<int>(a), &Cap::node) != section_.caps.end();
    RONDO_DEMAND(edges[a] % 2 == 0 || held || capped, a, edges[a]);
  }
}

/// An edge of the liner in that direction in which its face looks away from the air: towards the
/// quadrilateral behind it. Where there is none, as it is.
std::array<int, 2> SectorEnergy::outwards(std::array<int, 2> edge) const {
  for (const SweptQuad& quad : section_.quads) {
    if (std::ranges::find(quad.corner, edge[0]) == quad.corner.end() ||
        std::ranges::find(quad.corner, edge[1]) == quad.corner.end())
      continue;
    Vec2 middle;
    for (const int c : quad.corner) middle += 0.25 * section_.place[at(c)];
    const Vec2 a = section_.place[at(edge[0])], b = section_.place[at(edge[1])];
    // ∂x/∂ξ × ∂x/∂η with ξ along the edge, η around (the direction t): (b - a) × t = (-Δz, ·, Δr)
    const Vec2 normal{-(b.y - a.y), b.x - a.x};
    if (dot(normal, middle - a) < 0.0) std::swap(edge[0], edge[1]);
    return edge;
  }
  return edge;
}

void SectorEnergy::make_mass() {
  mass_.assign(n_nodes(), 0.0);
  for (const SweptQuad& quad : section_.quads) {
    const std::array<double, 8> volumes =
        hexahedron_volumes(at_corners(corners_of(quad), reference_, turn_));
    for (std::size_t a = 0; a < 8; ++a)
      mass_[at(quad.corner[a % 4])] += section_.densities[at(quad.rubber)] * volumes[a];
  }
  for (std::size_t l = 0; l < layers_.size(); ++l)
    for (std::size_t e = 0; e < section_.cords[l].excess_mass.size(); ++e)
      for (const CordPoint& p : layers_[l][e])
        for (const int node : section_.cords[l].lines[e])
          mass_[at(node)] += 0.5 * p.length * section_.cords[l].excess_mass[e];
}

/// (n) Places of the nodes of the section.
std::vector<Vec3> SectorEnergy::places(std::span<const Vec3> u) const {
  RONDO_DEMAND(u.size() == n_nodes(), u.size(), n_nodes());
  std::vector<Vec3> x = reference_;
  for (std::size_t a = 0; a < u.size(); ++a) x[a] += u[a];
  return x;
}

SectorState SectorEnergy::state(std::span<const Vec3> u, const SectorLoads& loads) const {
  const std::vector<Vec3> x = places(u);
  const auto size = static_cast<Index>(3 * n_nodes());
  Sum sum{Eigen::VectorXd::Zero(size), {}, {}, {}};
  sum.turn << turn_.re, -turn_.im, 0.0, turn_.im, turn_.re, 0.0, 0.0, 0.0, 1.0;
  SectorState out;
  out.least = 1e300;
  for (std::size_t e = 0; e < section_.quads.size(); ++e) {
    const auto corners = corners_of(section_.quads[e]);
    const RubberEnergy local = rubber_hexahedron(points_[e], at_corners(corners, u, turn_),
                                                 section_.rubbers[at(section_.quads[e].rubber)]);
    if (!(local.least >= out.least)) {
      out.least = local.least;
      out.of_quad = e;
    }
    if (!(local.least > 0.0)) return out;
    out.energy += local.value;
    sum.add(local, corners, 1.0);
  }
  for (std::size_t l = 0; l < layers_.size(); ++l)
    for (std::size_t e = 0; e < layers_[l].size(); ++e) {
      const auto corners = corners_of(section_.cords[l].lines[e]);
      const Energy<4> local =
          cord_face(layers_[l][e], at_corners(corners, x, turn_), section_.cords[l].law);
      out.energy += local.value;
      sum.add(local, corners, 1.0);
    }
  const Eigen::VectorXd inner = sum.force;
  for (const auto& edge : section_.liner) {
    const Energy<4> local = cone_volume(at_corners(corners_of(edge), x, turn_));
    out.volume += local.value;
    sum.add(local, corners_of(edge), -loads.pressure);
  }
  for (const Cap& cap : section_.caps) {
    const std::array<Corner, 2> corners{Corner{cap.node, false}, {cap.node, true}};
    const auto [here, next] = at_corners(corners, x, turn_);
    const Energy<2> local = cap_volume(here, next, cap.outward);
    out.volume += local.value;
    sum.add(local, corners, -loads.pressure);
  }
  for (std::size_t a = 0; a < u.size(); ++a) {
    const double pull = loads.spin_squared * mass_[a];
    sum.force.segment<2>(static_cast<Index>(3 * a)) -= pull * Eigen::Vector2d(x[a].x, x[a].y);
  }
  out.load = (sum.force - inner).cwiseAbs().maxCoeff();
  out.force = std::move(sum.force);
  out.here.resize(size, size);
  out.next.resize(size, size);
  out.here.setFromTriplets(sum.here.begin(), sum.here.end());
  out.next.setFromTriplets(sum.next.begin(), sum.next.end());
  return out;
}

SweptFaces SectorEnergy::faces(double pressure) const {
  SweptFaces faces;
  for (std::size_t l = 0; l < layers_.size(); ++l)
    faces.cords.push_back({section_.cords[l].law, section_.cords[l].lines, layers_[l]});
  faces.liner = section_.liner;
  faces.pressure = pressure;
  return faces;
}

SweptRubber SectorEnergy::rubber(std::span<const Vec3> u) const {
  RONDO_DEMAND(u.size() == n_nodes(), u.size(), n_nodes());
  SweptRubber rubber{{}, points_, {}, section_.rubbers, {u.begin(), u.end()}};
  for (const SweptQuad& quad : section_.quads) {
    rubber.corner.push_back(quad.corner);
    rubber.rubber.push_back(quad.rubber);
  }
  return rubber;
}

std::vector<SectorEnergy::CordPlace> SectorEnergy::cords(std::size_t layer,
                                                         std::span<const Vec3> u) const {
  const std::vector<Vec3> x = places(u);
  const Cords& cords = section_.cords.at(layer);
  std::vector<CordPlace> out;
  for (std::size_t e = 0; e < cords.lines.size(); ++e) {
    const FaceCorners face = at_corners(corners_of(cords.lines[e]), x, turn_);
    for (std::size_t q = 0; q < 4; ++q) {
      const FacePoint here = face_point(face, q);
      const CordState state = cord_state(layers_[layer][e][q], face, cords.law);
      const Vec3 around = here.across / norm(here.across),
                 rest = here.along - dot(here.along, around) * around;
      const double angle =
          std::atan2(dot(state.along, rest) / norm(rest), dot(state.along, around));
      out.push_back({here.place, angle, state});
    }
  }
  return out;
}

double SectorEnergy::largest_stretch(std::span<const Vec3> u) const {
  double largest = 0.0;
  for (std::size_t e = 0; e < section_.quads.size(); ++e)
    largest = std::max(
        largest,
        finite::largest_stretch(points_[e], at_corners(corners_of(section_.quads[e]), u, turn_)));
  return largest;
}

std::optional<double> SectorEnergy::cavity(std::span<const Vec3> u) const {
  std::vector<int> balance(n_nodes(), 0);  // of edges that leave and arrive
  for (const auto& [from, to] : section_.liner) {
    ++balance[at(from)];
    --balance[at(to)];
  }
  const auto first = std::ranges::find(balance, 1), last = std::ranges::find(balance, -1);
  const auto ends = static_cast<std::size_t>(std::ranges::count(balance, 0)) + 2;
  if (first == balance.end() || last == balance.end() || ends != n_nodes()) return std::nullopt;
  Curve closed = section_.liner;
  closed.push_back(
      {static_cast<int>(last - balance.begin()), static_cast<int>(first - balance.begin())});
  const std::vector<Vec3> x = places(u);
  double volume = 0.0;
  for (const auto& edge : closed)
    volume += cone_volume(at_corners(corners_of(edge), x, turn_)).value;
  return section_.n_sectors * volume;
}

}  // namespace rondo::fem::finite
