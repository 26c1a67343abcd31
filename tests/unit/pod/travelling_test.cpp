// SPDX-License-Identifier: BSD-3-Clause
/// What the rectified frame is for: a pattern that stands in space and travels round the disk has
/// one mode there, and in the turning frame the spectrum of its Fourier amplitudes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/mesh/disk.hpp"
#include "rondo/pod/rectify.hpp"
#include "support/matrices.hpp"

namespace travelling_test {

using namespace rondo;
using namespace rondo::pod;
using namespace rondo::pod::test;

namespace {

constexpr int n_sectors = 60;
constexpr double turn = 2.0 * std::numbers::pi;

/// Not symmetric, with all harmonics: a bump such as a contact makes.
double bump(double phi) {
  const double sharp = std::exp(3.0 * (std::cos(phi) - 1.0));
  return sharp * (1.0 + 0.4 * std::sin(2.0 * phi));
}

/// σ_k = amplitudes of the discrete Fourier transform of real numbers on the sectors, falling.
Eigen::VectorXd amplitudes(const std::vector<double>& profile) {
  const auto n = static_cast<Index>(profile.size());
  Eigen::VectorXd out(n);
  for (Index k = 0; k < n; ++k) {
    std::complex<double> sum = 0.0;
    for (Index s = 0; s < n; ++s)
      sum += profile[static_cast<std::size_t>(s)] *
             std::polar(1.0, -turn * static_cast<double>(k * s % n) / static_cast<double>(n));
    out[k] = std::abs(sum);
  }
  std::sort(out.data(), out.data() + n, std::greater<>());
  return out;
}

double sector_angle(int s) {
  return turn * s / n_sectors;
}

/// Snapshots of fields on rings, ring after ring, x and y of each point below one another.
Eigen::MatrixXd snapshots(const std::vector<std::vector<Vec2>>& fields) {
  Eigen::MatrixXd a(static_cast<Index>(2 * fields[0].size()), static_cast<Index>(fields.size()));
  for (Index j = 0; j < a.cols(); ++j)
    for (Index k = 0; k < a.rows() / 2; ++k) {
      const Vec2 v = fields[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
      a(2 * k, j) = v.x;
      a(2 * k + 1, j) = v.y;
    }
  return a;
}

/// Five rings of a smooth disk of 4 x 60, the pattern weaker inwards; seen from the turning frame
/// at n equal angles of a whole turn. @param pattern polar components at an angle in space
struct Travelling {
  std::vector<double> angles;
  std::vector<std::vector<Vec2>> fields;
};
Travelling travelling(const std::function<Vec2(double)>& pattern, Components components, int n) {
  mesh::Disk disk;
  disk.radial = 4;
  disk.circumferential = n_sectors;
  const std::size_t rings = node_rings(mesh::make_disk(disk)).n_rings();
  Travelling out;
  for (int j = 0; j < n; ++j) {
    const double theta = turn * j / n;
    std::vector<Vec2> field;
    for (std::size_t ring = 0; ring < rings; ++ring)
      for (int s = 0; s < n_sectors; ++s) {
        const double phi = sector_angle(s);
        const Vec2 polar = (1.0 / (1.0 + static_cast<double>(ring))) * pattern(phi + theta);
        field.push_back(components == Components::cartesian ? rotation(phi) * polar : polar);
      }
    out.angles.push_back(theta);
    out.fields.push_back(field);
  }
  return out;
}

Travelling rectified(Travelling t, Components components) {
  Rectifier rectifier(n_sectors, t.fields[0].size() / n_sectors, components, Shift::fourier);
  for (std::size_t j = 0; j < t.fields.size(); ++j) rectifier.apply(t.angles[j], t.fields[j]);
  return t;
}

}  // namespace

TEST(Travelling, ScalarProfileHasItsFourierAmplitudesForSingularValues) {
  // One ring, N snapshots: the matrix is circulant.
  std::vector<double> profile;
  for (int s = 0; s < n_sectors; ++s) profile.push_back(bump(sector_angle(s)));
  Eigen::MatrixXd a(n_sectors, n_sectors);
  for (int j = 0; j < n_sectors; ++j)
    for (int s = 0; s < n_sectors; ++s)
      a(s, j) = profile[static_cast<std::size_t>((s + j) % n_sectors)];
  for (const Method method : {Method::direct, Method::tsqr})
    EXPECT_LT(relative_difference(decompose_dense(a, method).sigma, amplitudes(profile)), 1e-14);
}

TEST(Travelling, ScalarsHaveOneModeInTheRectifiedFrame) {
  const auto pattern = [](double phi) { return Vec2{bump(phi), 0.3 * bump(phi + 0.7)}; };
  const Travelling seen = travelling(pattern, Components::scalars, n_sectors);
  const Decomposition turning = decompose_dense(snapshots(seen.fields), Method::direct);
  const Decomposition moved =
      decompose_dense(snapshots(rectified(seen, Components::scalars).fields), Method::direct);
  EXPECT_GT(turning.sigma[10], 1e-3 * turning.sigma[0]);
  EXPECT_LT(moved.sigma[1], 1e-12 * moved.sigma[0]);
  EXPECT_NEAR(moved.energy, turning.energy, 1e-13 * turning.energy);  // an isometry
  // The moved bump is the one of the first snapshot.
  EXPECT_EQ(moved.modes.cols(), 1);
}

TEST(Travelling, VectorsHaveOneModeInTheRectifiedFrame) {
  // In polar components the matrix is two circulants, one below the other, on each of five rings:
  // σ_k² = (|p_k|² + |q_k|²) Σ weights².
  const auto pattern = [](double phi) { return Vec2{bump(phi), -0.5 * bump(1.3 - phi)}; };
  const Travelling seen = travelling(pattern, Components::cartesian, n_sectors);
  const Decomposition turning = decompose_dense(snapshots(seen.fields), Method::direct);
  const Decomposition moved =
      decompose_dense(snapshots(rectified(seen, Components::cartesian).fields), Method::direct);
  EXPECT_GT(turning.sigma[10], 1e-3 * turning.sigma[0]);
  EXPECT_LT(moved.sigma[1], 1e-12 * moved.sigma[0]);

  std::vector<double> p, q;
  double weights = 0.0;
  for (int s = 0; s < n_sectors; ++s) {
    p.push_back(pattern(sector_angle(s)).x);
    q.push_back(pattern(sector_angle(s)).y);
  }
  for (int ring = 0; ring < 5; ++ring) weights += 1.0 / ((1.0 + ring) * (1.0 + ring));
  Eigen::VectorXd expected(n_sectors);
  for (Index k = 0; k < n_sectors; ++k) {
    std::complex<double> pk = 0.0, qk = 0.0;
    for (int s = 0; s < n_sectors; ++s) {
      const auto w = std::polar(1.0, -turn * static_cast<double>(k * s % n_sectors) / n_sectors);
      pk += p[static_cast<std::size_t>(s)] * w;
      qk += q[static_cast<std::size_t>(s)] * w;
    }
    expected[k] = std::sqrt((std::norm(pk) + std::norm(qk)) * weights);
  }
  std::sort(expected.data(), expected.data() + n_sectors, std::greater<>());
  EXPECT_LT(relative_difference(turning.sigma.head(n_sectors), expected), 1e-12);
}

TEST(Travelling, AnglesBetweenTheSectors) {
  // 97 snapshots a turn on 60 sectors: exact for harmonics below half the sectors.
  const auto pattern = [](double phi) {
    return Vec2{1.0 + std::cos(phi) + std::sin(29.0 * phi), std::cos(12.0 * phi + 0.4)};
  };
  const Travelling seen = travelling(pattern, Components::cartesian, 97);
  const Decomposition moved =
      decompose_dense(snapshots(rectified(seen, Components::cartesian).fields), Method::direct);
  EXPECT_LT(moved.sigma[1], 1e-13 * moved.sigma[0]);
}

TEST(Travelling, ThreeComponentsHaveOneModeInTheRectifiedFrame) {
  // As VectorsHaveOneMode..., with a third circulant: that of the axial component.
  const auto plane = [](double phi) { return Vec2{bump(phi), -0.5 * bump(1.3 - phi)}; };
  const auto axial = [](double phi) { return 0.8 * bump(phi - 0.4); };
  Travelling seen = travelling(plane, Components::cartesian, n_sectors);
  const std::size_t points = seen.fields[0].size();
  const auto with_axial = [&](const Travelling& of, bool rectify) {
    Rectifier rectifier(n_sectors, points / n_sectors, Components::cartesian, Shift::fourier);
    const auto rows = static_cast<Index>(points);
    Eigen::MatrixXd all(3 * rows, n_sectors);
    all.topRows(2 * rows) = snapshots(of.fields);
    for (int j = 0; j < n_sectors; ++j) {
      std::vector<double> w;
      for (std::size_t k = 0; k < points; ++k)
        w.push_back(axial(sector_angle(static_cast<int>(k % n_sectors)) +
                          of.angles[static_cast<std::size_t>(j)]) /
                    (1.0 + static_cast<double>(k / n_sectors)));
      if (rectify) rectifier.apply(of.angles[static_cast<std::size_t>(j)], std::span<double>(w));
      all.col(j).tail(rows) = Eigen::Map<const Eigen::VectorXd>(w.data(), rows);
    }
    return decompose_dense(all, Method::direct);
  };
  const Decomposition turning = with_axial(seen, false);
  const Decomposition moved = with_axial(rectified(seen, Components::cartesian), true);
  EXPECT_GT(turning.sigma[10], 1e-3 * turning.sigma[0]);
  EXPECT_LT(moved.sigma[1], 1e-12 * moved.sigma[0]);
  EXPECT_EQ(moved.modes.cols(), 1);
  EXPECT_NEAR(moved.energy, turning.energy, 1e-13 * turning.energy);

  std::vector<double> p, q, w;
  double weights = 0.0;
  for (int s = 0; s < n_sectors; ++s) {
    p.push_back(plane(sector_angle(s)).x);
    q.push_back(plane(sector_angle(s)).y);
    w.push_back(axial(sector_angle(s)));
  }
  for (std::size_t ring = 0; ring < points / n_sectors; ++ring)
    weights += 1.0 / ((1.0 + static_cast<double>(ring)) * (1.0 + static_cast<double>(ring)));
  double energy = 0.0;
  for (const auto* part : {&p, &q, &w})
    for (const double value : *part) energy += n_sectors * weights * value * value;
  EXPECT_NEAR(turning.energy, energy, 1e-12 * energy);
}

}  // namespace travelling_test
