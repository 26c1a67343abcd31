// SPDX-License-Identifier: BSD-3-Clause
/// Modes from fields: what the POD of fields, each also turned by any number of sectors, must be.
#include "rondo/rom/wheel/pod_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "rolling_wheel.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace pod_modes_test {
using namespace rolling_wheel;
using Eigen::Index;

const Disk& small_disk() {
  static const Disk d(4, 30);
  return d;
}

/// Re w e^{ikφ_j} factor φ on all nodes, moved round by sectors.
std::vector<Vec2> field_of(const Ring& ring, const RingHarmonic& h, Index mode,
                           std::complex<double> factor, int moved = 0) {
  std::vector<Vec2> field(small_disk().built.mesh.n_nodes());
  for (int j = 0; j < ring.n_sectors(); ++j) {
    const int at_sector = (j + moved) % ring.n_sectors();
    const auto wave = std::polar(1.0, 2.0 * pi * h.k * j / ring.n_sectors());
    for (Index a = 0; a < ring.n_rows(); a += 2) {
      const Vec2 own{(h.weight() * factor * wave * h.shapes(a, mode)).real(),
                     (h.weight() * factor * wave * h.shapes(a + 1, mode)).real()};
      field[ring.stiffness.node(at(a / 2), at(at_sector))] =
          ring.stiffness.turn[at(at_sector)] * own;
    }
  }
  return field;
}

TEST(PodModes, FieldsOfEigenmodesGiveTheseModes) {
  const Ring ring = small_disk().ring();
  const auto modes = ring_modes(ring, {.wanted = 21});
  FieldHarmonics sum(ring);
  double all = 0.0;
  for (const RingHarmonic& h : modes)
    for (Index m = 0; m < h.squares.size(); ++m) {
      const double size = 1.0 + 0.1 * h.k + 0.01 * static_cast<double>(m);
      const std::complex<double> factor =
          h.k == 0 ? size : std::polar(size, 0.3 * static_cast<double>(m + h.k));
      sum.add(field_of(ring, h, m, factor));
      all += ring.n_sectors() * h.weight() * size * size;
    }
  EXPECT_NEAR(sum.energy() / all, 1.0, 1e-12);
  const PodModes found = sum.modes(1000);
  EXPECT_EQ(count_modes(found.harmonics), count_modes(modes)) << "round-off is no mode";
  EXPECT_LT(found.left, 1e-12);
  ASSERT_EQ(found.harmonics.size(), modes.size());
  for (std::size_t h = 0; h < modes.size(); ++h) {
    const RingHarmonic& a = modes[h];
    const RingHarmonic& b = found.harmonics[h];
    EXPECT_EQ(a.k, b.k);
    ASSERT_EQ(a.squares.size(), b.squares.size()) << a.k;
    EXPECT_LT((a.squares - b.squares).cwiseQuotient(a.squares).norm(), 1e-9) << a.k;
    for (Index m = 0; m < a.squares.size(); ++m) {  // but for a factor of modulus 1
      const std::complex<double> factor =
          a.contact.col(m).dot(b.contact.col(m)) / a.contact.col(m).squaredNorm();
      EXPECT_NEAR(std::abs(factor), 1.0, 1e-9) << a.k << " " << m;
      EXPECT_LT((b.shapes.col(m) - factor * a.shapes.col(m)).norm(), 1e-8 * a.shapes.norm());
    }
  }
}

TEST(PodModes, TheModesOfMostEnergyAreTaken) {
  const Ring ring = small_disk().ring();
  const auto modes = ring_modes(ring, {.wanted = 21});
  FieldHarmonics sum(ring);
  sum.add(field_of(ring, modes[2], 0, 3.0));
  sum.add(field_of(ring, modes[0], 0, 2.0));
  sum.add(field_of(ring, modes[1], 0, 1.0));
  const PodModes found = sum.modes(2);
  ASSERT_EQ(found.harmonics.size(), 1U);
  EXPECT_EQ(found.harmonics[0].k, 2);
  EXPECT_NEAR(found.left, (4.0 + 2.0) / (18.0 + 4.0 + 2.0), 1e-12);
  EXPECT_EQ(count_modes(sum.modes(3).harmonics), 3);
  EXPECT_EQ(count_modes(sum.modes(4).harmonics), 5) << "two real numbers of a harmonic";
}

TEST(PodModes, AFieldThatIsTurnedIsTheSame) {
  const Ring ring = small_disk().ring();
  const auto modes = ring_modes(ring, {.wanted = 21});
  FieldHarmonics one(ring), other(ring);
  for (const int moved : {0, 7}) {
    FieldHarmonics& sum = moved == 0 ? one : other;
    for (std::size_t h = 0; h < 3; ++h)
      sum.add(field_of(ring, modes[h], 0, {1.0 + static_cast<double>(h), 0.0}, moved));
  }
  const PodModes a = one.modes(3), b = other.modes(3);
  ASSERT_EQ(a.harmonics.size(), b.harmonics.size());
  EXPECT_NEAR(a.left, b.left, 1e-12);
  for (std::size_t h = 0; h < a.harmonics.size(); ++h)
    EXPECT_LT((a.harmonics[h].squares - b.harmonics[h].squares).norm(),
              1e-9 * a.harmonics[h].squares.norm());
}

/// Any shapes will do: contact nodes follow statically, and the residual has what is missing.
TEST(PodModes, ShapesOfAnyKindLeaveTheComplianceOfTheRing) {
  const Ring ring = small_disk().ring();
  std::vector<Vec2> field(small_disk().built.mesh.n_nodes());
  for (std::size_t i = 0; i < field.size(); ++i)
    field[i] = {std::sin(1.7 * static_cast<double>(i)), std::cos(0.3 * static_cast<double>(i * i))};
  FieldHarmonics sum(ring);
  sum.add(field);
  const PodModes found = sum.modes(12);
  const double spin = 20.0;
  const RingResidual all = ring_residual(ring, {}, spin * spin, ResidualForm::convected),
                     left =
                         ring_residual(ring, found.harmonics, spin * spin, ResidualForm::convected);
  ASSERT_TRUE(left.made_static.empty());
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(ring.n_contact(), ring.n_contact());
  for (const RingHarmonic& h : found.harmonics) {
    const Eigen::MatrixXcd follow = stiffness_of(ring, h.k) * h.shapes;
    for (const int a : ring.contact)
      EXPECT_LT(follow.middleRows(Index{2} * a, 2).norm(), 1e-9 * follow.norm()) << h.k;
    const double across = h.k * spin;
    Eigen::MatrixXcd z = std::complex<double>(0.0, 2.0 * across * spin) * h.coriolis;
    z.diagonal() += (h.squares.array() - spin * spin - across * across).matrix();
    modes += h.weight() / ring.n_sectors() * (h.contact * z.inverse() * h.contact.adjoint()).real();
  }
  EXPECT_LT((all.block(0) - left.block(0) - modes).norm(), 1e-9 * all.block(0).norm());
  EXPECT_GT(modes.norm(), 0.001 * all.block(0).norm()) << "the modes are no part of it";
}

}  // namespace pod_modes_test
}  // namespace rondo::rom
