// SPDX-License-Identifier: BSD-3-Clause
/// @file  V16 by steady rolling: the disk of carter.hpp under its load, at tractions from braking
/// to driving, without integration in time.
#pragma once
#include <array>

#include "support/carter.hpp"
#include "support/steady_body.hpp"

namespace rondo::test {

inline DiskCase carter_case(int radial, int columns) {
  DiskCase c;
  c.disk = {.outer_radius = CarterDisk::radius,
            .inner_radius = 0.2,
            .radial = radial,
            .circumferential = columns,
            .grading = 2.0,
            .tread = {}};
  c.material = {5.0e6, 0.49, 1100.0, fem::Plane::strain, fem::Integration::b_bar};
  c.alpha = 100.0;
  c.beta = 1.0e-6;
  c.motion.angular_velocity = dynamics::Table(CarterDisk::speed / CarterDisk::radius);
  return c;
}

class SteadyCarter {
 public:
  SteadyCarter(int radial, int columns, statics::SlipDifference slip, SteadyBounds bounds = {})
      : body_(carter_case(radial, columns), 1, true), window_(body_.window(slip)), bounds_(bounds) {
    load_ = solved(window_, drive_, bounds_).forces.normal;
    rolling_ = at(0.0);
  }

  /// Solution at a traction Q/(μP), under the load that belongs to the depth of V16.
  [[nodiscard]] statics::RollingSolution at(double share) {
    statics::RollingDrive d = drive_;
    d.load = load_;
    d.traction = share * CarterDisk::friction * load_;
    return solved(window_, d, bounds_);
  }
  /// Solution at a creep beyond free rolling.
  [[nodiscard]] statics::RollingSolution at_creep(double creep) {
    statics::RollingDrive d = drive_;
    d.load = load_;
    d.speed = rolling_.speed * (2.0 - creep) / (2.0 + creep);
    return solved(window_, d, bounds_);
  }

  /// Speed of free rolling minus this speed, over their mean, at the same angular velocity.
  [[nodiscard]] double creep(const statics::RollingSolution& s) const {
    return 2.0 * (rolling_.speed - s.speed) / (rolling_.speed + s.speed);
  }
  /// Q, P and the unused friction, as for a run.
  [[nodiscard]] CarterMeans means(const statics::RollingSolution& s) const {
    CarterMeans m;
    m.load = {s.forces.heading, s.forces.normal};
    std::vector<CarterSample> samples;
    const Vec2 node = body_.mesh.coordinates[body_.sector.node(body_.sector.n_local() - 1, 0)];
    for (std::size_t j = 0; j < window_.pairs().size(); ++j) {
      const auto row = static_cast<Eigen::Index>(2 * j);
      if (!(s.force[row] > 0.0)) continue;
      const double x = (window_.frame(window_.pairs()[j].sample) * node).x;
      samples.push_back({x, {s.force[row], -s.force[row + 1]}});
    }
    add_spared_shear(samples, m);
    return m;
  }

 private:
  SteadyBody body_;
  statics::RollingWindow<2> window_;
  SteadyBounds bounds_;
  statics::RollingDrive drive_{.height = CarterDisk::radius - CarterDisk::depth,
                               .speed = CarterDisk::speed,
                               .friction = CarterDisk::friction,
                               .load = {},
                               .traction = {},
                               .torque = {}};
  double load_ = 0.0;
  statics::RollingSolution rolling_;
};

/// @param bound of creep over μa/R and of c/a. @param place of the stick zone over a
inline void expect_carter(SteadyCarter& disk, double bound, double place) {
  for (const double size : {0.2, 0.4, 0.6, 0.8, 0.9, 0.95})
    for (const double share : {-size, size}) {
      const statics::RollingSolution s = disk.at(share);
      const CarterMeans m = disk.means(s);
      const double a = m.half_width(), stick = carter_stick(share);
      EXPECT_NEAR(m.share(), share, 1e-9);
      EXPECT_NEAR(disk.creep(s) / m.scale(), carter_creep(share), bound) << share;
      EXPECT_NEAR(m.stick / a, stick, bound) << share;
      EXPECT_NEAR(m.ahead / a, 1.0 - stick, place) << share;
      EXPECT_LT(m.largest, 1.0 + 1e-9) << share;
      testing::Test::RecordProperty(
          fmt::format("{:+}", share),
          fmt::format("creep {:+.4f}, c/a {:.4f}, ahead {:.4f}", disk.creep(s) / m.scale(),
                      m.stick / a, m.ahead / a));
    }
}

}  // namespace rondo::test
