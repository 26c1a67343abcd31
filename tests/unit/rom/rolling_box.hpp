// SPDX-License-Identifier: BSD-3-Clause
/// @file  Reduced wheels in three dimensions, for their tests.
#pragma once
#include <vector>

#include "rondo/fem/contact_mass.hpp"
#include "rondo/rom/make_wheel_model.hpp"
#include "rondo/rom/solid/solid_wheel.hpp"
#include "rondo/rom/solid_wheel_run.hpp"
#include "support/solid_wheel.hpp"

namespace rondo::rom::rolling_box {

/// The box wheel of docs/wheel3d.md in fewer sectors, whose contact nodes have no mass.
struct BoxWheel {
  mesh::Mesh mesh;
  dynamics::Model model;
  SolidRing ring;

  explicit BoxWheel(int around = 120, int axial = 4)
      : mesh(mesh::make_wheel(test::box_wheel(2, axial, around))),
        model(test::cornering_model(mesh, {})),
        ring(make_solid_ring(model.solid->sector, mass_moved(), model.reference, model.solid->axial,
                             model.contact->nodes)) {}

 private:
  const std::vector<double>& mass_moved() {
    model.mass = fem::move_contact_mass(mesh, model.mass, mesh.boundary).mass;
    return model.mass;
  }
};

/// A wheel that comes down and rolls at an angle.
struct RollingBox {
  static constexpr double dt = 1e-3;
  WheelViscosity loss;
  double spin_rate;  ///< [rad/s²]
  BoxWheel box;
  WheelModel model;

  explicit RollingBox(const WheelViscosity& loss = {{}, 2e-5}, double spin_rate = 0.0)
      : loss(loss), spin_rate(spin_rate) {
    const KnownSpins spins{33.0, 33.0, spin_rate != 0.0};
    model = make_solid_model(box.ring, solid_modes(box.ring, {.wanted = 10}), spins, loss);
  }
  [[nodiscard]] SolidWheel wheel() const {
    return {box.ring,
            model,
            *box.model.contact,
            {{.dt = dt, .mass_damping = 200.0, .stiffness_damping = loss.stiffness_damping}}};
  }
  [[nodiscard]] SolidMotion motion(int n) const {
    const auto height = [](int k) { return k < 20 ? 0.3 - 5e-4 * k : 0.29; };
    const auto angle = [&](double t) { return -33.0 * t + 0.5 * spin_rate * t * t; };
    SolidMotion m;
    m.plane.angle = angle(dt * n);
    m.plane.angle_next = angle(dt * (n + 1));
    m.plane.spin_next = -33.0 + spin_rate * dt * (n + 1);
    m.plane.spin_rate = spin_rate;
    m.plane.center = {10.0 * dt * n, height(n)};
    m.plane.center_next = {10.0 * dt * (n + 1), height(n + 1)};
    m.lateral = 0.2 * dt * n;
    m.lateral_next = 0.2 * dt * (n + 1);
    return m;
  }
  [[nodiscard]] SolidMotion start() const {
    SolidMotion m = motion(-1);
    m.plane.spin_rate = 0.0;
    return m;
  }
};

}  // namespace rondo::rom::rolling_box
