// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/modes/modes_solver.hpp"
#include "rondo/core/error.hpp"
#include "rondo/modal/residual.hpp"
#include "rondo/statics/stationary_spin.hpp"

namespace rondo::study {
namespace {

/// One mesh, several spins. The stress of a spin s, and so its stiffness, is s² that of a unit
/// spin.
class PlaneModes final : public ModesSolver {
 public:
  PlaneModes(const Case& c, const ModesBody& body)
      : body_(body), damping_{c.damping.mass, c.damping.stiffness} {
    assemble(0.0);
    if (c.stress_stiffening == StressStiffening::none || body.free > 0) return;
    const std::vector<int> free = fem::free_nodes(body.mesh);
    auto unit = body.cyclic()
                    ? statics::centrifugal_prestress(sector_, body.mass, body.mesh.coordinates, 1.0)
                    : statics::centrifugal_prestress(stiffness_, body.mass, body.mesh.coordinates,
                                                     free, 1.0);
    if (unit.status != statics::SpinStatus::solved)
      throw case_error(c, "material.stress_stiffening",
                       "the stress of the spin was not found: the stiffness is not positive "
                       "definite to round-off",
                       "\"none\", or a material and a mesh in SI units");
    unit_prestress_ = to_vector(unit.u.plane());
  }

  [[nodiscard]] SolvedModes modes(double angular_velocity, int count) override {
    const double spin = -angular_velocity;
    if (!unit_prestress_.empty()) assemble(spin);
    const auto solve = [&](const auto& body, auto&& modes_of) {
      SolvedModes s{modes_of(body, spin, count), {}, {}, 0};
      for (const modal::Mode& mode : s.found.modes) {
        s.residuals.push_back(modal::residual(body, spin, mode));
        s.damping_ratios.push_back(modal::damping_ratio(body_.mass, spin, mode, damping_));
      }
      return s;
    };
    if (body_.cyclic()) {
      SolvedModes s = solve(cyclic(), modal::cyclic_modes<2>);
      take_branches(viscous_parts<fem::SectorStiffness>(), spin, s);
      return s;
    }
    SolvedModes s = solve(modal::MeshBody{body_.mesh, stiffness_, body_.mass}, modal::mesh_modes);
    take_branches(viscous_parts<fem::BlockCsr>(), spin, s);
    return s;
  }

  [[nodiscard]] std::vector<modal::CriticalSpeed> critical(int last) override {
    if (!body_.cyclic()) return {};
    if (unit_prestress_.empty()) return modal::critical_speeds(cyclic(), nullptr, last);
    // The prestress of this spin is as large as the elastic stiffness: the difference is exact.
    const double spin = body_.largest_frequency;
    assemble(spin);
    fem::SectorStiffness unit = std::move(sector_);
    assemble(0.0);
    for (std::size_t e = 0; e < unit.entries.size(); ++e)
      for (std::size_t i = 0; i < 4; ++i)
        unit.entries[e].block[i] =
            (unit.entries[e].block[i] - sector_.entries[e].block[i]) / (spin * spin);
    return modal::critical_speeds(cyclic(), &unit, last);
  }

 private:
  /// None of rubber at finite strain, whose modes are those of slow strains.
  template <class Stiffness>
  [[nodiscard]] std::vector<fem::ViscousPart<Stiffness>> viscous_parts() const {
    if (fem::has_rubber(body_.materials)) return {};
    return fem::viscous_parts<Stiffness>(body_.mesh, body_.materials, fem::ViscousBy::branches);
  }
  template <class Stiffness>
  void take_branches(const std::vector<fem::ViscousPart<Stiffness>>& parts, double spin,
                     SolvedModes& s) const {
    study::take_branches<Stiffness>(parts, body_.mass, spin, damping_, s);
  }
  void assemble(double spin) {
    std::vector<Vec2> prestress;
    if (spin != 0.0)
      for (const Vec2 u : unit_prestress_) prestress.push_back(spin * spin * u);
    if (body_.cyclic())
      sector_ = fem::assemble_sector(body_.mesh, body_.materials, prestress);
    else
      stiffness_ = fem::assemble_stiffness(body_.mesh, body_.materials, prestress);
  }
  [[nodiscard]] modal::CyclicBody<2> cyclic() const {
    return {sector_, body_.mass, body_.mesh.coordinates};
  }

  const ModesBody& body_;
  modal::Damping damping_;
  std::vector<Vec2> unit_prestress_;  ///< (n) at 1 rad/s [m]; empty: no stiffening
  fem::SectorStiffness sector_;
  fem::BlockCsr stiffness_;
};

}  // namespace

std::unique_ptr<ModesSolver> plane_modes(const Case& c, const ModesBody& body) {
  return std::make_unique<PlaneModes>(c, body);
}

}  // namespace rondo::study
