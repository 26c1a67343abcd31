// SPDX-License-Identifier: BSD-3-Clause
/// Steps of free bodies with contact between them and with the ground, in ns per degree of freedom
/// and step: `bench_bodies [LAYERS [ROUNDS [THREADS [CASE [ALONE]]]]]`. The step of a run and the
/// reference step alternate, and the smallest time of a batch of 8 steps counts, because the
/// machine may do other work. CASE: 1, 2 or 3, 0: all of them. ALONE: "readable" or "taken", only
/// that step, for profiles.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/integrators/general/general_integrator.hpp"
#include "rondo/integrators/integrator.hpp"
#include "support/blocks.hpp"
#include "support/thrown_disk.hpp"

using namespace rondo;

namespace {

/// One disk, or two side by side, with different velocities.
struct Bodies {
  dynamics::Model model;
  std::vector<Vec2> velocity;
};

constexpr double outer = 0.3;
constexpr int steps = 8;  ///< number timed together

void add_disk(mesh::Mesh& all, int layers, Vec2 center) {
  const mesh::Mesh one = test::free_disk({.outer_radius = outer,
                                          .inner_radius = 0.2,
                                          .radial = layers,
                                          .circumferential = 15 * layers,
                                          .grading = 1.0,
                                          .tread = {}});
  const int first = static_cast<int>(all.n_nodes());
  for (const Vec2 x : one.coordinates) all.coordinates.push_back(center + x);
  for (mesh::Cell cell : one.cells) {
    for (int& node : cell) node += node < 0 ? 0 : first;
    all.cells.push_back(cell);
  }
  for (const int node : one.boundary) all.boundary.push_back(first + node);
  all.tributary.insert(all.tributary.end(), one.tributary.begin(), one.tributary.end());
  for (const mesh::Edge& e : one.contact_edges)
    all.contact_edges.push_back({first + e[0], first + e[1]});
}

/// Rubber; the time step follows from the element bound, because Lanczos would take minutes.
Bodies bodies(const mesh::Mesh& mesh, int threads) {
  const fem::Material rubber{1.0e6, 0.4, 1100.0, fem::Plane::strain};
  const std::span materials(&rubber, 1);
  Bodies b;
  dynamics::Model& m = b.model;
  m.reference = mesh.coordinates;
  m.mass = fem::lumped_mass(mesh, materials);
  m.free = fem::free_nodes(mesh);
  m.stiffness = fem::assemble_stiffness(mesh, materials);
  dynamics::find_free_bodies(mesh, m);
  m.dt = 0.8 * dynamics::critical_step_of(std::sqrt(fem::element_eigenvalue_bound(mesh, materials)),
                                          {0.0, 0.0});
  m.threads = threads;
  b.velocity.resize(mesh.n_nodes());
  return b;
}

/// They touch obliquely, as in cases/two-disks.toml. @param gap between them            [m]
Bodies two_disks(int layers, double gap, int threads) {
  mesh::Mesh mesh;
  add_disk(mesh, layers, {-outer - 0.5 * gap, 0.0});
  add_disk(mesh, layers, {outer + 0.5 * gap, 0.01});
  Bodies b = bodies(mesh, threads);
  for (std::size_t k = 0; k < b.velocity.size(); ++k)
    b.velocity[k] = b.model.free_body[k] == 0 ? Vec2{1.0, 0.6} : Vec2{-1.0, -0.6};
  test::add_surfaces(b.model, mesh, {0.5, 0.0});
  return b;
}

/// A disk thrown onto flat ground.
Bodies disk_on_ground(int layers, int threads) {
  mesh::Mesh mesh;
  add_disk(mesh, layers, {0.0, outer + 1e-5});
  Bodies b = bodies(mesh, threads);
  b.model.motion.gravity = dynamics::Table(9.81);
  for (Vec2& v : b.velocity) v = {1.0, -1.0};
  test::add_ground(b.model, mesh, {}, {0.5, 0.0});
  return b;
}

/// One run of a line, and the smallest time of its batches.
class Run {
 public:
  Run(Bodies bodies, bool readable) : bodies_(std::move(bodies)), reports_(steps) {
    const dynamics::Model& model = bodies_.model;
    const dynamics::State start =
        dynamics::start(model, std::vector<Vec2>(model.n_nodes()), bodies_.velocity);
    if (readable)
      integrator_ = std::make_unique<dynamics::GeneralIntegrator>(model, start);
    else
      integrator_ = dynamics::make_integrator(model, start);
  }

  /// 64 steps in short batches, because longer ones are hardly ever undisturbed.
  void round() {
    using Clock = std::chrono::steady_clock;
    for (int batch = 0; batch < 64 / steps; ++batch) {
      const auto begin = Clock::now();
      integrator_->advance(reports_);
      best_ = std::min(best_, std::chrono::duration<double>(Clock::now() - begin).count());
      contacts_ = std::max(contacts_, reports_.back().contact.nodes);
    }
    if (!(reports_.back().balance.relative < 1e-3)) {
      fmt::print(stderr, "the ledger does not close: {:.2g}\n", reports_.back().balance.relative);
      std::exit(1);
    }
  }
  [[nodiscard]] double dofs() const { return 2.0 * static_cast<double>(bodies_.model.free.size()); }
  [[nodiscard]] double ns() const { return 1e9 * best_ / (steps * dofs()); }
  [[nodiscard]] int contacts() const { return contacts_; }

 private:
  Bodies bodies_;
  std::unique_ptr<dynamics::Integrator> integrator_;
  std::vector<dynamics::StepReport> reports_;
  double best_ = 1e9;  ///< [s]
  int contacts_ = 0;
};

struct Wish {
  int layers = 57, rounds = 5, threads = 1, line = 0;
  std::string_view alone;
};

void compare(std::string_view what, const Bodies& bodies, const Wish& wish) {
  std::vector<std::unique_ptr<Run>> runs;
  for (const bool readable : {true, false})
    if (wish.alone.empty() || readable == (wish.alone == "readable"))
      runs.push_back(std::make_unique<Run>(bodies, readable));
  for (int i = 0; i < wish.rounds; ++i)
    for (const auto& run : runs) run->round();
  fmt::print("| {} | {:.0f} | {} |", what, runs[0]->dofs(), runs[0]->contacts());
  for (const auto& run : runs) fmt::print(" {:.2f} |", run->ns());
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, int otherwise) {
    return argc > i ? std::atoi(argv[i]) : otherwise;
  };
  const Wish wish{argument(1, 57), argument(2, 5), argument(3, 1), argument(4, 0),
                  argc > 5 ? argv[5] : ""};
  fmt::print(
      "| bodies | dofs | contacts | readable (ns) | step (ns) |\n"
      "| --- | --- | --- | --- | --- |\n");
  const auto wanted = [&](int line) { return wish.line == 0 || wish.line == line; };
  const int layers = wish.layers, threads = wish.threads;
  if (wanted(1)) compare("two disks that collide", two_disks(layers, 1e-5, threads), wish);
  if (wanted(2)) compare("two disks apart", two_disks(layers, 0.1, threads), wish);
  if (wanted(3)) compare("a disk on ground", disk_on_ground(layers * 7 / 5, threads), wish);
}
