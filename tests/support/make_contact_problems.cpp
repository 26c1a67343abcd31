// SPDX-License-Identifier: BSD-3-Clause
/// Writes tests/contact_problems: coupled contact problems that are difficult in different ways.
///     make_contact_problems FOLDER
#include <fmt/format.h>

#include "rondo/contact/coupled/problem_file.hpp"
#include "support/contact_problems.hpp"

using namespace rondo;
using namespace rondo::contact;

namespace {

void write(const std::filesystem::path& folder, const std::string& name, const std::string& about,
           const CoupledProblem& problem) {
  ProblemFile file{.problem = problem, .about = about, .impulse = {}, .start = {}, .result = {}};
  file.start.resize(problem.size());
  file.impulse = file.start;
  std::vector<Status> status(problem.size());
  CoupledWorkspace work;
  file.result = solve_coupled(problem, {}, file.impulse, status, work);
  fmt::print("{:24} {:4} contacts {:6} iterations {:.1e}\n", name, problem.size(),
             file.result.iterations, file.result.residual);
  write_problem(folder / (name + ".json"), file);
}

/// Nodes whose impulses lie exactly on the edge of their cones, between sticking and slipping.
CoupledProblem borderline() {
  test::Scene scene = test::chain({.upper = 12, .lower = 12, .shear = 0.0, .noise = 0.0});
  CoupledProblem p = test::problem_of(scene);
  for (std::size_t j = 0; j < p.size(); ++j) {
    const Block& w = diagonal_block(p, j);
    const Vec2 edge{1.0, (j % 2 == 0 ? 1.0 : -1.0) * p.friction[j]};
    p.free[j] = -apply(w, edge);  // alone, it would stick with an impulse on the edge
  }
  return p;
}

/// Only one node moves.
CoupledProblem resting() {
  test::Scene scene = test::chain(
      {.upper = 30, .lower = 20, .both_ways = true, .press = 0.0, .shear = 0.0, .noise = 0.0});
  scene.velocity[14] = {1e-9, -1e-9};
  return test::problem_of(scene);
}

/// A corner of a body in a corner of another: two perpendicular segments constrain one node.
CoupledProblem corner(double friction) {
  test::Scene scene;
  const int p = scene.add_node(1.0, {-1.0, -0.8});
  const int a = scene.add_node(0.3, {0.1, 0.0}), b = scene.add_node(0.5, {}),
            c = scene.add_node(0.3, {0.0, 0.2});
  const SegmentTouch floor{.gap = -1e-3, .at = 0.95, .normal = {0.0, 1.0}};
  const SegmentTouch wall{.gap = -2e-3, .at = 0.05, .normal = {1.0, 0.0}};
  scene.add(node_rows(floor, 1.0, p, a, b), friction);
  scene.add(node_rows(wall, 1.0, p, b, c), friction);
  return test::problem_of(scene);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "make_contact_problems FOLDER\n");
    return 2;
  }
  const std::filesystem::path to = argv[1];
  const auto chain = [](const test::ChainShape& s) { return test::problem_of(test::chain(s)); };
  write(to, "chain-200", "200 nodes on segments, one way", chain({.upper = 200, .lower = 150}));
  write(to, "both-ways", "nodes of each body on segments of the other, one of them light",
        chain({.upper = 60, .lower = 45, .mass_ratio = 0.05, .both_ways = true}));
  write(to, "matching-meshes", "nodes face nodes, each on a segment of the other: nearly redundant",
        chain({.upper = 20, .lower = 20, .offset = 0.0, .both_ways = true, .friction = 1.0}));
  write(to, "high-friction", "both ways, friction 1.5",
        chain({.upper = 40, .lower = 55, .offset = 0.5, .both_ways = true, .friction = 1.5}));
  write(to, "turning", "both ways, responses turned by 0.05 rad: not symmetric",
        chain({.upper = 30, .lower = 30, .both_ways = true, .friction = 1.0, .turn = 0.05}));
  write(to, "restitution", "both ways, restitution 0.8",
        chain({.upper = 30, .lower = 41, .both_ways = true, .restitution = 0.8}));
  write(to, "redundant", "every contact three times",
        test::problem_of(test::repeated(test::chain({.upper = 20, .lower = 15}), 3)));
  write(to, "shallow-valleys", "every node of a chain on two facets that turn by 0.001 rad",
        test::problem_of(test::chain_in_valleys({.upper = 20, .lower = 15}, 1e-3)));
  write(to, "corner-in-corner", "one node on two segments at right angles", corner(0.5));
  write(to, "corner-in-corner-rough", "the same, friction 1.5", corner(1.5));
  write(to, "borderline", "free velocities for which each contact alone is on its cone's edge",
        borderline());
  write(to, "resting", "both ways, all velocities zero but one of 1e-9 m/s", resting());
  return 0;
}
