// SPDX-License-Identifier: BSD-3-Clause
/// A material that rondo does not have, from another program, by installed headers alone: a body
/// that is a network of bars along the edges of its elements, each elastic in the Green strain of
/// its length, so in any rotation. A disk of them is bonded to a rim that turns, and meets the
/// ground.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <rondo/fem/assembly.hpp>
#include <rondo/integrators/integrator.hpp>
#include <rondo/integrators/start.hpp>
#include <rondo/mesh/disk.hpp>
#include <rondo/model/internal_force.hpp>
#include <rondo/model/model.hpp>
#include <span>
#include <utility>
#include <vector>

using rondo::Vec2;
namespace dynamics = rondo::dynamics;

struct Bar {
  std::size_t a, b;  ///< its nodes
  double length;     ///< of X                    [m]
  double stiffness;  ///< EA per metre of width   [N/m]
};

/// The material: energy, force and what a restart carries. Nothing is allocated once it is made.
class Bars final : public dynamics::InternalForce {
 public:
  Bars(const dynamics::Model& model, std::vector<Bar> bars, std::span<const Vec2> u0)
      : model_(model), bars_(std::move(bars)), force_(u0.size()), before_(u0.size()) {
    Bars::evaluate(u0);
  }

  /// e = (l² - L²) / 2L² of each bar, U = ½ Σ EA L e², and its derivative by the nodes' places.
  void evaluate(std::span<const Vec2> u) noexcept override {
    std::swap(force_, before_);
    energy_before_ = std::exchange(energy_, 0.0);
    std::fill(force_.begin(), force_.end(), Vec2{});
    for (const Bar& bar : bars_) {
      const Vec2 d = model_.reference[bar.b] + u[bar.b] - model_.reference[bar.a] - u[bar.a];
      const double strain = 0.5 * (dot(d, d) / (bar.length * bar.length) - 1.0);
      energy_ += 0.5 * bar.stiffness * bar.length * strain * strain;
      const Vec2 pull = bar.stiffness * strain / bar.length * d;
      force_[bar.a] -= pull;
      force_[bar.b] += pull;
    }
  }
  std::span<const Vec2> gradient() const noexcept override { return force_; }

  /// (9.7): ½ (U_n + U_{n+1}) - ¼ Δt v·(G_{n+1} - G_n), whatever the material.
  double half_step_energy(std::span<const Vec2>, std::span<const Vec2> v) const noexcept override {
    double energy = 0.5 * (energy_ + energy_before_);
    for (const int node : model_.free) {
      const auto k = static_cast<std::size_t>(node);
      energy -= 0.25 * model_.dt * dot(v[k], force_[k] - before_[k]);
    }
    return energy;
  }
  void damping(std::span<Vec2> out) noexcept override {
    const double rate = model_.stiffness_damping / model_.dt;
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = rate * (force_[k] - before_[k]);
  }
  void save(dynamics::SavedState& saved) const override {
    saved.gradient = force_;
    saved.energy = {energy_};
  }
  void restore(const dynamics::SavedState& saved) override {
    force_ = saved.gradient;
    energy_ = saved.energy.front();
  }

 private:
  const dynamics::Model& model_;
  std::vector<Bar> bars_;
  std::vector<Vec2> force_, before_;           ///< (n) dU/dx at u_{n+1}, u_n [N/m]
  double energy_ = 0.0, energy_before_ = 0.0;  ///< U there                    [J/m]
};

/// Edges and diagonals of all elements, each with half of what its element has to give.
std::vector<Bar> bars_of(const rondo::mesh::Mesh& mesh, double stiffness) {
  std::vector<Bar> bars;
  for (const rondo::mesh::Cell& cell : mesh.cells)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const auto a = static_cast<std::size_t>(cell[i]), b = static_cast<std::size_t>(cell[j]);
        bars.push_back({a, b, norm(mesh.coordinates[b] - mesh.coordinates[a]), 0.5 * stiffness});
      }
  return bars;
}

/// A third of √(m / Σ EA/L), whose √2-fold is below the critical step by Gershgorin's circles.
double step_for(const dynamics::Model& model, const std::vector<Bar>& bars) {
  std::vector<double> sum(model.n_nodes());
  for (const Bar& bar : bars)
    for (const std::size_t node : {bar.a, bar.b}) sum[node] += bar.stiffness / bar.length;
  double least = 1.0;
  for (const int node : model.free) {
    const auto k = static_cast<std::size_t>(node);
    least = std::min(least, std::sqrt(model.mass[k] / sum[k]));
  }
  return least / 3.0;
}

int main() {
  rondo::mesh::Disk disk;
  disk.radial = 6, disk.circumferential = 90;
  const rondo::mesh::Mesh mesh = rondo::mesh::make_disk(disk);
  const rondo::fem::Material rubber{2e7, 0.3, 1100.0, rondo::fem::Plane::strain};  // for its mass
  const std::vector<Bar> bars = bars_of(mesh, 2e5);

  dynamics::Model model;
  model.reference = mesh.coordinates;
  model.mass = rondo::fem::lumped_mass(mesh, {&rubber, 1});
  model.free = rondo::fem::free_nodes(mesh);
  model.internal_force = [&bars](const dynamics::Model& of, std::span<const Vec2> u0,
                                 std::span<const dynamics::Pose>) {
    return std::make_unique<Bars>(of, bars, u0);
  };
  model.mass_damping = 200.0;
  model.motion.angular_velocity = dynamics::Table(33.3);
  model.motion.speed = dynamics::Table(10.0);
  model.motion.height = dynamics::Table({{0.0, 0.3}, {0.01, 0.295}});
  model.contact =
      dynamics::ContactModel{rondo::contact::Ground({.profile = {{-10.0, 0.0}, {10.0, 0.0}}}),
                             {.friction = 0.3},
                             mesh.boundary,
                             mesh.tributary,
                             mesh.contact_edges};
  model.dt = step_for(model, bars);

  const std::vector<Vec2> zero(model.n_nodes());
  dynamics::State state = dynamics::start(model, zero, zero);
  const auto integrator = dynamics::make_integrator(model, state);
  std::vector<dynamics::StepReport> reports(static_cast<std::size_t>(0.05 / model.dt));
  integrator->advance(reports, &state);

  double force = 0.0;  // mean of the last tenth
  const std::size_t part = reports.size() / 10;
  for (std::size_t k = reports.size() - part; k < reports.size(); ++k)
    force += reports[k].contact.impulse.y / (model.dt * static_cast<double>(part));
  std::printf("%zu steps of %.3g s, F_y %.6g N/m, energy balance closes to %.1e\n", reports.size(),
              model.dt, force, reports.back().balance.relative);
  return reports.back().balance.relative < 1e-4 && force > 1e3 ? 0 : 1;
}
