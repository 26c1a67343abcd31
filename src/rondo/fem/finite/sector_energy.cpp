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

Vec3 in_sector(Vec2 place) noexcept {
  return {place.x, 0.0, place.y};
}

/// Corners of what a polygon of the section sweeps: of this side, then of the next.
template <std::size_t N>
std::array<Vec3, 2 * N> swept(const std::array<int, N>& nodes, std::span<const Vec3> x,
                              Complex turn) noexcept {
  std::array<Vec3, 2 * N> corners;
  for (std::size_t a = 0; a < N; ++a) {
    corners[a] = x[at(nodes[a])];
    corners[N + a] = turn * corners[a];
  }
  return corners;
}

/// Corners of a face in their order around it, of a line of the section.
FaceCorners face_of(const std::array<int, 2>& line, std::span<const Vec3> x,
                    Complex turn) noexcept {
  const std::array<Vec3, 4> c = swept(line, x, turn);
  return {c[0], c[1], c[3], c[2]};
}

/// Of a face, with its corners in the order of swept().
Energy<4> by_sides(const Energy<4>& of) {
  constexpr std::array<Index, 4> to{0, 1, 3, 2};
  Energy<4> out;
  out.value = of.value;
  for (Index a = 0; a < 4; ++a) {
    const Index i = 3 * to[at(a)];
    out.force.segment<3>(i) = of.force.segment<3>(3 * a);
    for (Index b = 0; b < 4; ++b)
      out.stiffness.block<3, 3>(i, 3 * to[at(b)]) = of.stiffness.block<3, 3>(3 * a, 3 * b);
  }
  return out;
}

}  // namespace

/// Forces and, where they are wanted, blocks of a sector.
class SectorEnergy::Sum {
 public:
  Sum(std::size_t nodes, bool with_stiffness)
      : force(Eigen::VectorXd::Zero(static_cast<Index>(3 * nodes))), wanted(with_stiffness) {}

  Eigen::VectorXd force;
  std::vector<Eigen::Triplet<double>> here, next;
  bool wanted;
};

/// Adds an energy of the corners of swept(): the forces of the other side act on this one, too.
template <int Corners, class Local>
void SectorEnergy::add(const Local& local, const std::array<int, Corners / 2>& nodes, double share,
                       Sum& sum) const {
  constexpr Index half = Corners / 2;
  Eigen::Matrix3d turn;  // R: from the frame of the next sector to this one's
  turn << turn_.re, -turn_.im, 0.0, turn_.im, turn_.re, 0.0, 0.0, 0.0, 1.0;
  const auto node = [&](Index a) { return Index{3} * nodes[at(a % half)]; };
  for (Index a = 0; a < Corners; ++a) {
    const Eigen::Vector3d f = share * local.force.template segment<3>(3 * a);
    sum.force.segment<3>(node(a)) += a < half ? f : Eigen::Vector3d(turn.transpose() * f);
    for (Index b = 0; b < Corners && sum.wanted; ++b) {
      if (a >= half && b < half) continue;  // the transpose of `next`
      Eigen::Matrix3d k = share * local.stiffness.template block<3, 3>(3 * a, 3 * b);
      if (a >= half) k = turn.transpose() * k;
      if (b >= half) k = k * turn;
      auto& to = (a < half) == (b < half) ? sum.here : sum.next;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          to.emplace_back(static_cast<int>(node(a)) + i, static_cast<int>(node(b)) + j, k(i, j));
    }
  }
}

SectorEnergy::SectorEnergy(SweptSection section)
    : section_(std::move(section)), turn_(rotation(2.0 * std::numbers::pi / section_.n_sectors)) {
  RONDO_DEMAND(section_.n_sectors >= 3 && section_.held.size() == 3 * section_.place.size(),
               section_.n_sectors, section_.held.size(), section_.place.size());
  check();
  std::vector<Vec3> x;
  for (const Vec2 p : section_.place) x.push_back(in_sector(p));
  for (SweptQuad& quad : section_.quads) {
    const auto corners = swept(quad.corner, x, turn_);
    if (smallest_jacobian(corners) < 0.0) std::swap(quad.corner[1], quad.corner[3]);
    RONDO_DEMAND(smallest_jacobian(swept(quad.corner, x, turn_)) > 0.0, quad.corner[0]);
    points_.push_back(hexahedron_points(swept(quad.corner, x, turn_)));
  }
  for (auto& edge : section_.liner) edge = outwards(edge);
  for (const Cords& cords : section_.cords) {
    Layer& layer = layers_.emplace_back();
    for (const auto& line : cords.lines) {
      const FaceCorners face = face_of(line, x, turn_);
      std::array<double, 4> angle{}, spacing{};
      const std::array<Vec3, 4> places = face_points(face);
      for (std::size_t q = 0; q < 4; ++q) {
        angle[q] = cords.angle;
        spacing[q] = cords.spacing;
        if (cords.spacing_radius)
          spacing[q] *= std::hypot(places[q].x, places[q].y) / *cords.spacing_radius;
      }
      layer.reference.push_back(face);
      layer.points.push_back(cord_points(face, angle, spacing));
    }
  }
  make_mass();
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
  std::vector<Vec3> x;
  for (const Vec2 p : section_.place) x.push_back(in_sector(p));
  mass_.assign(n_nodes(), 0.0);
  for (const SweptQuad& quad : section_.quads) {
    const std::array<double, 8> volumes = hexahedron_volumes(swept(quad.corner, x, turn_));
    for (std::size_t a = 0; a < 8; ++a)
      mass_[at(quad.corner[a % 4])] += section_.densities[at(quad.rubber)] * volumes[a];
  }
  for (std::size_t l = 0; l < layers_.size(); ++l)
    for (std::size_t e = 0; e < layers_[l].points.size(); ++e)
      for (const CordPoint& p : layers_[l].points[e])
        for (const int node : section_.cords[l].lines[e])
          mass_[at(node)] += 0.5 * p.length * section_.cords[l].excess_mass;
}

SectorState SectorEnergy::state(std::span<const Vec3> u, const SectorLoads& loads,
                                bool with_stiffness) const {
  RONDO_DEMAND(u.size() == n_nodes(), u.size(), n_nodes());
  SectorState out;
  Sum sum(n_nodes(), with_stiffness);
  out.least = 1e300;
  for (std::size_t e = 0; e < section_.quads.size(); ++e) {
    const SweptQuad& quad = section_.quads[e];
    const RubberEnergy local = rubber_hexahedron(points_[e], swept(quad.corner, u, turn_),
                                                 section_.rubbers[at(quad.rubber)]);
    if (local.least < out.least) {
      out.least = local.least;
      out.of_quad = e;
    }
    if (!(local.least > 0.0)) return out;
    out.energy += local.value;
    add<8>(local, quad.corner, 1.0, sum);
  }
  std::vector<Vec3> x;
  for (std::size_t a = 0; a < u.size(); ++a) x.push_back(in_sector(section_.place[a]) + u[a]);
  for (std::size_t l = 0; l < layers_.size(); ++l)
    for (std::size_t e = 0; e < layers_[l].points.size(); ++e) {
      const auto& line = section_.cords[l].lines[e];
      const Energy<4> local =
          cord_face(layers_[l].points[e], face_of(line, x, turn_), section_.cords[l].law);
      out.energy += local.value;
      add<4>(by_sides(local), line, 1.0, sum);
    }
  const Eigen::VectorXd inner = sum.force;
  for (const auto& edge : section_.liner) {
    const Energy<4> local = cone_volume(face_of(edge, x, turn_));
    out.volume += local.value;
    add<4>(by_sides(local), edge, -loads.pressure, sum);
  }
  for (const Cap& cap : section_.caps) {
    const Energy<2> local = cap_volume(x[at(cap.node)], turn_ * x[at(cap.node)], cap.outward);
    out.volume += local.value;
    add<2>(local, std::array<int, 1>{cap.node}, -loads.pressure, sum);
  }
  for (std::size_t a = 0; a < u.size(); ++a) {
    const double pull = loads.spin_squared * mass_[a];
    sum.force.segment<2>(static_cast<Index>(3 * a)) -= pull * Eigen::Vector2d(x[a].x, x[a].y);
  }
  out.load = (sum.force - inner).cwiseAbs().maxCoeff();
  out.force = std::move(sum.force);
  if (!with_stiffness) return out;
  const auto size = static_cast<Index>(3 * n_nodes());
  out.here.resize(size, size);
  out.next.resize(size, size);
  out.here.setFromTriplets(sum.here.begin(), sum.here.end());
  out.next.setFromTriplets(sum.next.begin(), sum.next.end());
  return out;
}

std::vector<SectorEnergy::CordPlace> SectorEnergy::cords(std::size_t layer,
                                                         std::span<const Vec3> u) const {
  std::vector<Vec3> x;
  for (std::size_t a = 0; a < u.size(); ++a) x.push_back(in_sector(section_.place[a]) + u[a]);
  const Cords& cords = section_.cords[layer];
  std::vector<CordPlace> out;
  for (std::size_t e = 0; e < cords.lines.size(); ++e) {
    const FaceCorners face = face_of(cords.lines[e], x, turn_);
    const std::array<Vec3, 4> before = face_points(layers_[layer].reference[e]),
                              now = face_points(face);
    for (std::size_t q = 0; q < 4; ++q) {
      CordPlace p{before[q], now[q], cords.angle, 0.0,
                  cord_state(layers_[layer].points[e][q], face, cords.law)};
      const FacePoint here = face_point(face, q);
      const Vec3 around = here.across / norm(here.across),
                 rest = here.along - dot(here.along, around) * around;
      p.angle_now = std::atan2(dot(p.state.along, rest) / norm(rest), dot(p.state.along, around));
      out.push_back(p);
    }
  }
  return out;
}

}  // namespace rondo::fem::finite
