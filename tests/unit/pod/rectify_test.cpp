// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/rectify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/mesh/disk.hpp"

namespace rectify_test {

using namespace rondo;
using namespace rondo::pod;

namespace {

using Field = std::vector<Vec2>;
constexpr double turn = 2.0 * std::numbers::pi;
const fem::Material rubber{2.0e7, 0.3, 1100.0, fem::Plane::strain};

mesh::Mesh smooth(int columns) {
  mesh::Disk disk;
  disk.radial = 4;
  disk.circumferential = columns;
  return mesh::make_disk(disk);
}

mesh::Mesh treaded(int pitches) {
  mesh::Disk disk;
  disk.radial = 3;
  disk.grading = 1.5;
  disk.tread = mesh::Tread{
      .pitches = pitches, .depth = 0.02, .land_columns = 3, .groove_columns = 2, .layers = 2};
  return mesh::make_disk(disk);
}

std::vector<mesh::Mesh> meshes() {
  return {smooth(60), smooth(31), treaded(12), treaded(9)};
}

Field random_field(std::size_t n, unsigned seed = 1) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Field field(n);
  for (Vec2& v : field) v = {normal(engine), normal(engine)};
  return field;
}

const std::vector<double> angles{0.0, 0.3, -2.5, 3.14, 77.7, -1e4 + 0.123};

Field on_rings(const Rings& rings, const Field& field) {
  Field out;
  for (const int p : rings.point) out.push_back(field[static_cast<std::size_t>(p)]);
  return out;
}

Field off_rings(const Rings& rings, const Field& values) {
  Field out(values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    out[static_cast<std::size_t>(rings.point[k])] = values[k];
  return out;
}

/// T(θ) of a field in the numbering of the mesh.
Field moved(const Rings& rings, const Field& field, double theta, Shift shift = Shift::fourier,
            Components components = Components::cartesian) {
  Rectifier rectifier(rings.n_sectors, rings.n_rings(), components, shift);
  Field values = on_rings(rings, field);
  rectifier.apply(theta, values);
  return off_rings(rings, values);
}

/// Σ w a·b
double product(const Field& a, const Field& b, const std::vector<double>& weights) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += weights[k] * dot(a[k], b[k]);
  return sum;
}

double largest(const Field& a) {
  double most = 0.0;
  for (const Vec2 v : a) most = std::max(most, norm(v));
  return most;
}

double distance(const Field& a, const Field& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, norm(a[k] - b[k]));
  return most;
}

Field stiffness_times(const fem::BlockCsr& k, const Field& u) {
  Field out(u.size());
  for (std::size_t row = 0; row < k.n_rows(); ++row)
    for (auto b = k.row_start[row]; b < k.row_start[row + 1]; ++b) {
      const auto& v = k.values[static_cast<std::size_t>(b)];
      const Vec2 x = u[static_cast<std::size_t>(k.column[static_cast<std::size_t>(b)])];
      out[row] += {v[0] * x.x + v[2] * x.y, v[1] * x.x + v[3] * x.y};
    }
  return out;
}

/// The highest harmonic of an even number of sectors, alternating in polar components, taken away.
Field without_nyquist(const Rings& rings, const Field& field) {
  const auto n = static_cast<std::size_t>(rings.n_sectors);
  if (n % 2 == 1) return field;
  Field values = on_rings(rings, field);
  for (std::size_t first = 0; first < values.size(); first += n) {
    Vec2 mean;
    const auto frame = [&](std::size_t s) {
      return (s % 2 == 0 ? 1.0 : -1.0) * rotation(turn * static_cast<double>(s) / double(n));
    };
    for (std::size_t s = 0; s < n; ++s)
      mean += (1.0 / static_cast<double>(n)) * (conj(frame(s)) * values[first + s]);
    for (std::size_t s = 0; s < n; ++s) values[first + s] -= frame(s) * mean;
  }
  return off_rings(rings, values);
}

/// The node one sector on, counter-clockwise.
std::vector<std::size_t> next_sector(const mesh::Mesh& m) {
  std::vector<std::size_t> next(m.n_nodes());
  for (std::size_t a = 0; a < next.size(); ++a)
    for (std::size_t b = 0; b < next.size(); ++b)
      if (m.sector_node[a] == m.sector_node[b] && m.sector[b] == (m.sector[a] + 1) % m.n_sectors)
        next[a] = b;
  return next;
}

}  // namespace

TEST(Rings, NodesOfARingHaveOneRadiusAndEqualAngles) {
  for (const mesh::Mesh& m : meshes()) {
    const Rings rings = node_rings(m);
    ASSERT_EQ(rings.point.size(), m.n_nodes());
    EXPECT_EQ(std::set<int>(rings.point.begin(), rings.point.end()).size(), m.n_nodes());
    const Complex step = rotation(turn / m.n_sectors);
    const auto n = static_cast<std::size_t>(m.n_sectors);
    for (std::size_t k = 0; k < rings.point.size(); ++k) {
      const auto here = static_cast<std::size_t>(rings.point[k]);
      const std::size_t on = k % n + 1 < n ? k + 1 : k + 1 - n;
      const auto next = static_cast<std::size_t>(rings.point[on]);
      EXPECT_LT(norm(m.coordinates[next] - step * m.coordinates[here]), 1e-15);
    }
  }
}

TEST(Rings, ContactCandidates) {
  for (const mesh::Mesh& m : meshes()) {
    const Rings rings = boundary_rings(m);
    ASSERT_EQ(rings.point.size(), m.boundary.size());
    EXPECT_EQ(std::set<int>(rings.point.begin(), rings.point.end()).size(), m.boundary.size());
    const auto n = static_cast<std::size_t>(m.n_sectors);
    for (std::size_t k = 0; k < rings.point.size(); ++k) {
      const auto node = [&](std::size_t at) {
        return static_cast<std::size_t>(m.boundary[static_cast<std::size_t>(rings.point[at])]);
      };
      EXPECT_EQ(m.sector[node(k)], static_cast<int>(k % n));
      EXPECT_EQ(m.sector_node[node(k)], m.sector_node[node(k - k % n)]);
    }
  }
  EXPECT_EQ(boundary_rings(smooth(60)).n_rings(), 1U);
  EXPECT_EQ(boundary_rings(treaded(12)).n_rings(), 4U);  // both edges of three columns of land
}

TEST(Rectifier, TheInverseIsTheAdjoint) {
  for (const mesh::Mesh& m : meshes()) {
    const Rings rings = node_rings(m);
    const std::vector<double> mass = fem::lumped_mass(m, {&rubber, 1});
    const Field a = random_field(m.n_nodes()), b = random_field(m.n_nodes(), 2);
    for (const Shift shift : {Shift::fourier, Shift::pitch})
      for (const double theta : angles) {
        const Field ta = moved(rings, a, theta, shift);
        EXPECT_LT(distance(moved(rings, ta, -theta, shift), a), 1e-14);
        const double size = std::sqrt(product(a, a, mass) * product(b, b, mass));
        EXPECT_NEAR(product(ta, b, mass), product(a, moved(rings, b, -theta, shift), mass),
                    1e-14 * size);
        EXPECT_NEAR(product(ta, ta, mass), product(a, a, mass), 1e-14 * size);
      }
  }
}

namespace {

/// T(θ) of numbers on the rings of a smooth disk.
std::vector<double> moved_numbers(const Rings& rings, std::vector<double> values, double theta,
                                  Shift shift) {
  Rectifier rectifier(rings.n_sectors, rings.n_rings(), Components::cartesian, shift);
  rectifier.apply(theta, std::span<double>(values));
  return values;
}

}  // namespace

TEST(Rectifier, NumbersAreMovedAsEachOfTwoScalars) {
  for (const mesh::Mesh& m : meshes()) {
    const Rings rings = node_rings(m);
    const Field pair = random_field(m.n_nodes());
    std::vector<double> first;
    for (const Vec2& v : pair) first.push_back(v.x);
    for (const Shift shift : {Shift::fourier, Shift::pitch})
      for (const double theta : angles) {
        Field both = pair;
        Rectifier(rings.n_sectors, rings.n_rings(), Components::scalars, shift).apply(theta, both);
        const std::vector<double> alone = moved_numbers(rings, first, theta, shift);
        double before = 0.0, after = 0.0;
        for (std::size_t k = 0; k < alone.size(); ++k) {
          EXPECT_NEAR(alone[k], both[k].x, 2e-14);
          before += first[k] * first[k];
          after += alone[k] * alone[k];
        }
        EXPECT_NEAR(after, before, 1e-14 * before);  // on a ring all nodes have the same mass
      }
  }
}

TEST(Rectifier, NumbersOfARingHaveTheBitsOfTheWhole) {
  const Rings rings = node_rings(treaded(9));
  std::vector<double> values;
  for (const Vec2& v : random_field(rings.point.size())) values.push_back(v.y);
  const std::vector<double> whole = moved_numbers(rings, values, 0.7, Shift::fourier);
  const auto n = static_cast<std::size_t>(rings.n_sectors);
  for (std::size_t r = 0; r < rings.n_rings(); ++r) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(r * n);
    std::vector<double> ring(from, from + static_cast<std::ptrdiff_t>(n));
    Rectifier rectifier(rings.n_sectors, 1, Components::cartesian, Shift::fourier);
    rectifier.apply(0.7, std::span<double>(ring));
    for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(ring[k], whole[r * n + k]);
  }
}

TEST(Rectifier, IsAGroup) {
  for (const mesh::Mesh& m : meshes()) {
    const Rings rings = node_rings(m);
    const Field a = random_field(m.n_nodes());
    for (const double first : angles)
      for (const double second : {0.7, -5.1}) {
        const Field twice = moved(rings, moved(rings, a, first), second);
        // The sum of the angles is rounded, at 1e4 rad to 1e-12, times the harmonics.
        const double tolerance = 1e-13 + 1e-14 * std::abs(first);
        EXPECT_LT(distance(twice, moved(rings, a, first + second)), tolerance);
      }
    EXPECT_LT(distance(moved(rings, a, turn), a), 1e-13);
    EXPECT_GT(distance(moved(rings, a, 0.3), a), 1.0);
  }
}

TEST(Rectifier, CommutesWithTheStiffness) {
  for (const mesh::Mesh& m : meshes()) {
    const Rings rings = node_rings(m);
    const fem::BlockCsr k = fem::assemble_stiffness(m, {&rubber, 1});
    const Field u = random_field(m.n_nodes());
    const Field ku = stiffness_times(k, u);
    for (const Shift shift : {Shift::fourier, Shift::pitch})
      for (const double theta : angles)
        EXPECT_LT(distance(moved(rings, ku, theta, shift),
                           stiffness_times(k, moved(rings, u, theta, shift))),
                  1e-13 * largest(ku));
  }
}

TEST(Rectifier, OneSectorIsAPermutationAndATurn) {
  for (const mesh::Mesh& m : meshes()) {
    const Rings rings = node_rings(m);
    const Field field = without_nyquist(rings, random_field(m.n_nodes()));
    const double pitch = turn / m.n_sectors;
    const std::vector<std::size_t> next = next_sector(m);
    Field expected(field.size());
    for (std::size_t k = 0; k < field.size(); ++k) expected[next[k]] = rotation(pitch) * field[k];
    EXPECT_LT(distance(moved(rings, field, pitch), expected), 1e-14);
    EXPECT_LT(distance(moved(rings, field, pitch, Shift::pitch), expected), 1e-14);
    // Contact components are moved only.
    for (std::size_t k = 0; k < field.size(); ++k) expected[next[k]] = field[k];
    EXPECT_EQ(distance(moved(rings, field, pitch, Shift::pitch, Components::scalars), expected),
              0.0);
  }
}

TEST(Rectifier, NyquistStays) {
  const mesh::Mesh m = smooth(60);
  const Rings rings = node_rings(m);
  Field alternating(m.n_nodes());
  for (std::size_t k = 0; k < alternating.size(); ++k)
    alternating[k] = m.sector[k] % 2 == 0 ? Vec2{1.0, -2.0} : Vec2{-1.0, 2.0};
  for (const double theta : angles)
    EXPECT_LT(distance(moved(rings, alternating, theta, Shift::fourier, Components::scalars),
                       alternating),
              1e-14);
}

TEST(Rectifier, PitchIsFourierAtWholeSectors) {
  for (const mesh::Mesh& m : meshes()) {
    const Rings rings = node_rings(m);
    const Field field = without_nyquist(rings, random_field(m.n_nodes()));
    const double pitch = turn / m.n_sectors;
    for (const int sectors : {-100, -1, 0, 1, 5, 44}) {
      const Field exact = moved(rings, field, sectors * pitch);
      for (const double off : {0.0, 0.49, -0.49})
        EXPECT_LT(distance(moved(rings, field, (sectors + off) * pitch, Shift::pitch), exact),
                  1e-12);
    }
  }
}

TEST(Rectifier, ATranslationInTheFixedFrameBecomesConstant) {
  const Vec2 d{0.3, -1.1};
  for (const mesh::Mesh& m : meshes()) {
    const Rings rings = node_rings(m);
    for (const double theta : angles) {
      const Field seen(m.n_nodes(), rotation(-theta) * d);  // u = R(-θ) d in the turning frame
      EXPECT_LT(distance(moved(rings, seen, theta), Field(m.n_nodes(), d)), 1e-13);
    }
  }
}

TEST(Rectifier, AWaveFixedInSpaceBecomesConstant) {
  // Any harmonic below half the sectors, both components, seen from the turning frame at angle θ.
  const mesh::Mesh m = treaded(9);
  const Rings rings = boundary_rings(m);
  const auto wave = [](double phi) {
    return Vec2{std::cos(4.0 * phi) - 0.3 * std::sin(phi), std::sin(3.0 * phi) + 0.5};
  };
  const double pitch = turn / 9.0;
  const auto seen = [&](double theta) {
    Field out;
    for (std::size_t ring = 0; ring < rings.n_rings(); ++ring)
      for (int s = 0; s < 9; ++s) out.push_back(wave(pitch * s + 0.1 * double(ring) + theta));
    return out;
  };
  for (const double theta : angles) {
    Rectifier rectifier(9, rings.n_rings(), Components::scalars, Shift::fourier);
    Field values = seen(theta);
    rectifier.apply(theta, values);
    EXPECT_LT(distance(values, seen(0.0)), 1e-14 + 1e-15 * std::abs(theta));
  }
}

}  // namespace rectify_test
