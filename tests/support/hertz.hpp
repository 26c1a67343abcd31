// SPDX-License-Identifier: BSD-3-Clause
/// @file  V14: frictionless line contact of a disk under a given load, compared with Hertz (K. L.
/// Johnson, Contact Mechanics, 1985, 4.2): a² = 4PR/(πE*), p0² = PE*/(πR), E* = E/(1-ν²).
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <numbers>

#include "rondo/mesh/disk.hpp"
#include "rondo/statics/crush.hpp"

namespace rondo::test {

inline constexpr double radius = 0.3, load = 2000.0;  // m, N/m
inline const fem::Material compressible{5.0e6, 0.3, 1100.0, fem::Plane::strain};
/// A material like rubber; by B-bar.
inline const fem::Material nearly_incompressible{5.0e6, 0.49, 1100.0, fem::Plane::strain,
                                                 fem::Integration::b_bar};

struct Hertz {
  double half_width, pressure;  ///< [m], [Pa]
};

inline Hertz hertz(const fem::Material& m) {
  const double modulus = m.youngs_modulus / (1.0 - m.poissons_ratio * m.poissons_ratio);
  return {std::sqrt(4.0 * load * radius / (std::numbers::pi * modulus)),
          std::sqrt(load * modulus / (std::numbers::pi * radius))};
}

struct HertzFit {
  double half_width = 0.0, pressure = 0.0;  ///< of p² = p0² (1 - x²/a²) by least squares [m], [Pa]
  double misfit = 0.0;                      ///< root mean square deviation of p²/p0² from the fit
};

class HertzDisk {
 public:
  HertzDisk(double inner_radius, int radial, int columns, const fem::Material& rubber) {
    mesh::Disk disk;
    disk.outer_radius = radius;
    disk.inner_radius = inner_radius;
    disk.radial = radial;
    disk.circumferential = columns;
    disk.grading = 2.0;
    mesh_ = mesh::make_disk(disk);
    model_ = statics::make_crush_model(mesh_.coordinates, mesh_.boundary, 0.0);
    body_ = std::make_unique<statics::Condensation>(fem::assemble_stiffness(mesh_, {&rubber, 1}),
                                                    fem::free_nodes(mesh_), model_.nodes);
  }

  /// The state under the load, by secants on the depth; without friction the path does not matter.
  statics::CrushState loaded() {
    double before = 5e-4, depth = 8e-4;
    double force_before = force(press(before)), found = 0.0;
    statics::CrushState state;
    for (int i = 0; i < 20; ++i) {
      state = press(depth);
      found = force(state);
      if (std::abs(found - load) < 1e-9 * load) break;
      const double next = depth + (load - found) * (depth - before) / (found - force_before);
      before = depth;
      force_before = found;
      depth = next;
    }
    EXPECT_NEAR(found, load, 1e-9 * load);
    return state;
  }

  /// Uses reference positions: pressure is force over reference length. A small-strain model does
  /// not distinguish reference and deformed lengths (they differ by the strain, 1 %).
  [[nodiscard]] HertzFit fit(const statics::CrushState& state) const {
    std::vector<double> x, p;
    for (std::size_t k = 0; k < state.force.size(); ++k) {
      if (state.force[k].x <= 0.0) continue;
      const auto node = static_cast<std::size_t>(model_.nodes[k]);
      x.push_back(mesh_.coordinates[node].x);
      p.push_back(state.force[k].x / mesh_.tributary[k]);
    }
    const auto n = static_cast<Eigen::Index>(x.size());
    Eigen::MatrixXd a(n, 2);
    a.col(0).setOnes();
    a.col(1) = -Eigen::Map<Eigen::ArrayXd>(x.data(), n).square().matrix();
    const Eigen::VectorXd b = Eigen::Map<Eigen::ArrayXd>(p.data(), n).square().matrix();
    const Eigen::Vector2d c = a.householderQr().solve(b);
    return {std::sqrt(c[0] / c[1]), std::sqrt(c[0]),
            (a * c - b).norm() / (c[0] * std::sqrt(static_cast<double>(n)))};
  }

 private:
  statics::CrushState press(double depth) {
    statics::append_within(model_, 2.0 * depth, *body_);
    statics::CrushState state = statics::start_crush(model_, mesh_.n_nodes());
    const auto report = statics::bring_to(model_, depth, 0.0, *body_, state);
    EXPECT_TRUE(report.converged);
    EXPECT_LT(report.residual, 1e-10);
    return state;
  }
  static double force(const statics::CrushState& state) {
    double sum = 0.0;
    for (const Vec2 r : state.force) sum += r.x;
    return sum;
  }

  mesh::Mesh mesh_;
  statics::CrushModel model_;
  std::unique_ptr<statics::Condensation> body_;
};

struct Deviation {
  double half_width = 0.0, pressure = 0.0;  ///< relative to Hertz
  double misfit = 0.0;
};

/// For a disk of `columns` columns, a/h = columns / 160, and `radial` layers graded with p = 2.
inline Deviation deviation_from_hertz(double inner_radius, int radial, int columns,
                                      const fem::Material& rubber = compressible) {
  HertzDisk disk(inner_radius, radial, columns, rubber);
  const Hertz exact = hertz(rubber);
  const HertzFit f = disk.fit(disk.loaded());
  const Deviation d{f.half_width / exact.half_width - 1.0, f.pressure / exact.pressure - 1.0,
                    f.misfit};
  const auto record = [&](const char* what, double value) {
    testing::Test::RecordProperty(
        fmt::format("{}_{}x{}_{}_{}{}", what, radial, columns, 1000.0 * inner_radius,
                    rubber.poissons_ratio,
                    rubber.integration == fem::Integration::b_bar ? "_b_bar" : ""),
        fmt::format("{:.3e}", value));
  };
  record("half_width", d.half_width);
  record("pressure", d.pressure);
  record("misfit", d.misfit);
  return d;
}

}  // namespace rondo::test
