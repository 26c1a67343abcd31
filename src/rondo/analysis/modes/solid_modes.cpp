// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/memory.hpp"
#include "rondo/analysis/build/tyre/wheel_at_rest.hpp"
#include "rondo/analysis/modes/modes_solver.hpp"
#include "rondo/analysis/modes/standing_wheel.hpp"
#include "rondo/modal/residual.hpp"

namespace rondo::study {
namespace {

/// The case with its wheel in equilibrium at a spin. With inflation.spin all spins share one state.
Case with_state_at(const Case& c, double spin) {
  Case other = c;
  if (c.inflation && !c.inflation->spin) other.inflation->spin = std::abs(spin);
  return other;
}

struct WheelAt {
  mesh::Mesh mesh;
  fem::SolidSector sector;
  std::vector<fem::ViscousPart<fem::SolidSector>> viscous;
};

WheelAt wheel_at(const Case& c, double spin) {
  const Case of = with_state_at(c, spin);
  WheelAt wheel{build_mesh(of), {}, {}};
  std::vector<fem::Material> materials = materials_of(of, wheel.mesh);
  WheelAtRest rest = wheel_at_rest(of, wheel.mesh, materials, fem::ViscousBy::branches);
  wheel.sector = std::move(rest.sector);
  wheel.viscous = std::move(rest.viscous);
  return wheel;
}

/// About the equilibrium at each spin, if the wheel is inflated.
class SolidModes final : public ModesSolver {
 public:
  SolidModes(const Case& c, const ModesBody& body, bool standing)
      : case_(c),
        body_(body),
        damping_{c.damping.mass, c.damping.stiffness},
        follows_spin_(c.inflation && !c.inflation->spin),
        spin_(std::abs(c.motion.angular_velocity.at(0.0))),
        wheel_{body.mesh, body.sector, body.viscous} {
    if (!standing) return;
    take(0.0);
    standing_ = standing_wheel(c, wheel_.mesh, body.mass, wheel_.sector);
    const std::size_t nodes = wheel_.mesh.n_nodes(), held = standing_->held.size();
    demand_memory(c, nodes, mesh_memory(nodes) + 3 * nodes * held * sizeof(double));
  }

  [[nodiscard]] SolvedModes modes(double angular_velocity, int count) override {
    take(angular_velocity);
    const double spin = -angular_velocity;
    const modal::CyclicBody<3> wheel = cyclic();
    SolvedModes s;
    if (standing_) {
      const std::span<const modal::HeldDirection<3>> held = standing_->held;
      s.found = modal::held_modes(wheel, held, count);
      for (const modal::Mode& mode : s.found.modes)
        s.residuals.push_back(modal::residual(wheel, held, mode));
    } else {
      s.found = modal::cyclic_modes(wheel, spin, count);
      for (const modal::Mode& mode : s.found.modes)
        s.residuals.push_back(modal::residual(wheel, spin, mode));
    }
    for (const modal::Mode& mode : s.found.modes)
      s.damping_ratios.push_back(modal::damping_ratio(body_.mass, spin, mode, damping_));
    take_branches<fem::SolidSector>(wheel_.viscous, body_.mass, spin, damping_, s);
    return s;
  }

  /// Takes the state of the case for all n.
  [[nodiscard]] std::vector<modal::CriticalSpeed> critical(int last) override {
    if (standing_) return {};
    take(case_.motion.angular_velocity.at(0.0));
    return modal::critical_speeds(cyclic(), nullptr, last);
  }
  [[nodiscard]] std::optional<Standing> standing() const override {
    if (!standing_) return std::nullopt;
    return standing_->figures;
  }

 private:
  void take(double spin) {
    if (!follows_spin_ || std::abs(spin) == spin_) return;
    wheel_ = wheel_at(case_, spin);
    spin_ = std::abs(spin);
  }
  [[nodiscard]] modal::CyclicBody<3> cyclic() const {
    return {wheel_.sector, body_.mass, wheel_.mesh.coordinates};
  }

  const Case& case_;
  const ModesBody& body_;
  modal::Damping damping_;
  bool follows_spin_;
  double spin_;  ///< of the state of the wheel, if it follows the spin [rad/s]
  WheelAt wheel_;
  std::optional<StandingWheel> standing_;
};

}  // namespace

std::unique_ptr<ModesSolver> solid_modes(const Case& c, const ModesBody& body, bool standing) {
  return std::make_unique<SolidModes>(c, body, standing);
}

}  // namespace rondo::study
