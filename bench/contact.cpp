// SPDX-License-Identifier: BSD-3-Clause
/// Contact between bodies: the search for neighbours and the coupled solver, each alone. It also
/// verifies: a chain that does not reach 1e-12, or a search that misses a segment, stops it.
#include <benchmark/benchmark.h>

#include "rondo/contact/search.hpp"
#include "rondo/contact/segment.hpp"
#include "support/contact_problems.hpp"

using namespace rondo;
using benchmark::Counter;

namespace {

const auto per_item = Counter::kIsIterationInvariantRate | Counter::kInvert;

/// Boundary of a disk with n edges, as nodes and edges.
struct Ring {
  explicit Ring(int n) {
    for (int i = 0; i < n; ++i) {
      points.push_back(direction_at(2.0 * 3.141592653589793 * i / n));
      edges.push_back({i, (i + 1) % n});
    }
    length = norm(points[1] - points[0]);
  }
  std::vector<Vec2> points;
  std::vector<std::array<int, 2>> edges;
  double length;  ///< of an edge [m]
};

void contact_search_build(benchmark::State& state) {
  const Ring ring(static_cast<int>(state.range(0)));
  contact::SegmentGrid grid;
  for (auto _ : state) grid.build(ring.points, ring.edges, 0.5 * ring.length, ring.length);
  state.counters["ns_per_edge"] = Counter(1e-9 * static_cast<double>(state.range(0)), per_item);
}

/// The check of a step if nothing has moved by more than the skin.
void contact_search_check(benchmark::State& state) {
  const Ring ring(static_cast<int>(state.range(0)));
  contact::SegmentGrid grid;
  grid.build(ring.points, ring.edges, 0.5 * ring.length, ring.length);
  for (auto _ : state)
    benchmark::DoNotOptimize(grid.update(ring.points, ring.edges, 0.5 * ring.length, ring.length));
  state.counters["ns_per_edge"] = Counter(1e-9 * static_cast<double>(state.range(0)), per_item);
}

/// Nodes just inside the boundary: finds the cell of the grid and the segment that each touches.
void contact_search_query(benchmark::State& state) {
  const Ring ring(static_cast<int>(state.range(0)));
  const contact::Boundary boundary = contact::make_boundary(ring.edges, {});
  contact::SegmentGrid grid;
  grid.build(ring.points, ring.edges, 0.5 * ring.length, ring.length);
  std::vector<int> near;
  for (auto _ : state) {
    std::size_t touched = 0;
    for (const Vec2 x : ring.points) {
      grid.near((1.0 - 1e-3 * ring.length) * x, near);
      touched += contact::touch_boundary({.position = (1.0 - 1e-3 * ring.length) * x},
                                         {boundary, ring.points, near, 0.5 * ring.length})
                             .count > 0
                     ? 1
                     : 0;
    }
    if (touched != ring.points.size()) state.SkipWithError("a segment was missed");
  }
  state.counters["ns_per_node"] = Counter(1e-9 * static_cast<double>(state.range(0)), per_item);
}

/// Nodes of one chain on segments of another; with `both_ways` also in the opposite sense.
void contact_chain(benchmark::State& state, bool both_ways) {
  const int n = static_cast<int>(state.range(0));
  const contact::CoupledProblem p = test::problem_of(
      test::chain({.upper = n, .lower = 3 * n / 4, .offset = 0.37, .both_ways = both_ways}));
  contact::CoupledWorkspace work;
  std::vector<Vec2> impulse(p.size());
  std::vector<contact::Status> status(p.size());
  contact::CoupledResult result;
  for (auto _ : state) {
    std::fill(impulse.begin(), impulse.end(), Vec2{});
    result = contact::solve_coupled(p, {}, impulse, status, work);
  }
  if (!result.converged) state.SkipWithError("the law is not met to 1e-12");
  state.counters["contacts"] = static_cast<double>(p.size());
  state.counters["iterations"] = result.iterations;
  state.counters["ns_per_contact"] = Counter(1e-9 * static_cast<double>(p.size()), per_item);
}

BENCHMARK(contact_search_build)->RangeMultiplier(10)->Range(100, 100000);
BENCHMARK(contact_search_check)->RangeMultiplier(10)->Range(100, 100000);
BENCHMARK(contact_search_query)->RangeMultiplier(10)->Range(100, 100000);
BENCHMARK_CAPTURE(contact_chain, one_way, false)->Arg(10)->Arg(50)->Arg(200)->Arg(1000);
BENCHMARK_CAPTURE(contact_chain, both_ways, true)->Arg(10)->Arg(50)->Arg(200)->Arg(1000);

}  // namespace
