// SPDX-License-Identifier: BSD-3-Clause
/// Single parts of a step: the stiffness products and the search for contacts; and limits of the
/// machine, passes over arrays and multiply-adds. Shares are relative to the limits measured with
/// each repetition. It also verifies: a product that is not K u stops it.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "problem.hpp"
#include "rondo/fem/stiffness_product.hpp"

using namespace rondo;
using benchmark::Counter;

namespace {

constexpr auto rate = Counter::kIsIterationInvariantRate;

mesh::Disk smooth(int radial) {
  mesh::Disk disk;
  disk.radial = radial;
  disk.circumferential = 15 * radial;
  return disk;
}

bench::Problem& problem(int radial) {
  static int known = 0;
  static std::unique_ptr<bench::Problem> kept;
  if (known != radial) {
    kept.reset();
    kept = std::make_unique<bench::Problem>(smooth(radial));
    known = radial;
  }
  return *kept;
}

/// One product reads its matrix and u and writes K u.
void count_product(benchmark::State& state, bench::Streams streams, double flops, int threads) {
  const double stream = bench::StreamArrays(streams, threads).bandwidth(0.05);
  // Arrays in place would be read and written, but u is only read and K u only written.
  const double bytes = 8.0 * static_cast<double>(2 * streams.length + streams.read_only);
  const double dofs = static_cast<double>(streams.length), peak = bench::peak_flops(threads);
  state.counters["dofs"] = dofs;
  state.counters["ns_per_dof"] = Counter(dofs * 1e-9, rate | Counter::kInvert);
  state.counters["GB_per_s"] = Counter(bytes * 1e-9, rate);
  state.counters["GFLOP_per_s"] = Counter(dofs * flops * 1e-9, rate);
  state.counters["stream_GB_per_s"] = stream * 1e-9;
  state.counters["peak_GFLOP_per_s"] = peak * 1e-9;
  state.counters["share_of_stream"] = Counter(bytes / stream, rate);
  state.counters["share_of_peak"] = Counter(dofs * flops / peak, rate);
}

/// A smooth field, zero at the clamped nodes.
std::vector<Vec2> field(const dynamics::Model& model) {
  std::vector<Vec2> u(model.n_nodes());
  for (const int node : model.free) {
    const auto k = static_cast<std::size_t>(node);
    const Vec2 x = model.reference[k];
    u[k] = 1e-3 * Vec2{std::sin(30.0 * x.x + x.y), std::cos(20.0 * x.y)};
  }
  return u;
}

/// Largest difference from the reference product of one sector, over the largest entry.
double error_of(const dynamics::Model& model, const std::vector<Vec2>& u,
                const std::vector<Vec2>& product) {
  std::vector<Vec2> expected(model.n_nodes());
  fem::apply(*model.sector, u, expected);
  double error = 0.0, scale = 0.0;
  for (const int node : model.free) {
    const auto k = static_cast<std::size_t>(node);
    error = std::max(error, norm(product[k] - expected[k]));
    scale = std::max(scale, norm(expected[k]));
  }
  return error / scale;
}

void verify(benchmark::State& state, double error) {
  if (!(error < 1e-9)) state.SkipWithError("the product is not K u");
}

double product_flops(bench::Problem& p) {
  const fem::SectorStiffness& sector = *p.model().sector;
  return 4.0 * static_cast<double>(sector.entries.size()) / static_cast<double>(sector.n_local());
}

bench::Streams product_streams(bench::Problem& p, bench::Steps steps) {
  return p.work(steps, {.beta = false}).streams;
}

void product_sparse(benchmark::State& state) {
  bench::Problem& p = problem(static_cast<int>(state.range(0)));
  const auto threads = static_cast<int>(state.range(1));
  const std::vector<Vec2> u = field(p.model());
  std::vector<Vec2> out(u.size());
  const fem::BlockCsr& k = p.blocks();
  for (auto _ : state) {
    fem::apply(k, u, out, threads);
    benchmark::ClobberMemory();
  }
  verify(state, error_of(p.model(), u, out));
  count_product(state, product_streams(p, bench::Steps::sparse), product_flops(p), threads);
}

void product_eigen(benchmark::State& state) {
  bench::Problem& p = problem(static_cast<int>(state.range(0)));
  const auto threads = static_cast<int>(state.range(1));
  const std::vector<Vec2> u = field(p.model());
  const std::vector<int>& free = p.model().free;
  Eigen::VectorXd x(2 * free.size()), y(2 * free.size());
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Vec2 of_node = u[static_cast<std::size_t>(free[i])];
    x.segment<2>(static_cast<Eigen::Index>(2 * i)) << of_node.x, of_node.y;
  }
  const bench::CsrMatrix& k = p.csr();
  for (auto _ : state) {
    bench::multiply(k, x, y, threads);
    benchmark::ClobberMemory();
  }
  std::vector<Vec2> out(u.size());
  for (std::size_t i = 0; i < free.size(); ++i)
    out[static_cast<std::size_t>(free[i])] = {y[static_cast<Eigen::Index>(2 * i)],
                                              y[static_cast<Eigen::Index>(2 * i + 1)]};
  verify(state, error_of(p.model(), u, out));
  count_product(state, product_streams(p, bench::Steps::eigen), product_flops(p), threads);
}

/// All candidates of a rolling disk, few of which are in contact.
void contact_search(benchmark::State& state) {
  bench::Problem& p = problem(static_cast<int>(state.range(0)));
  const auto integrator = p.integrator(bench::Steps::cyclic, {.rolling = true});
  const dynamics::Model& model = p.model();
  const Vec2 center = model.motion.center(0.0);
  int touching = 0;
  for (auto _ : state) {
    touching = 0;
    for (const int node : model.contact->nodes)
      touching +=
          model.contact->ground.touches(center + model.reference[static_cast<std::size_t>(node)])
              .count;
    benchmark::DoNotOptimize(touching);
  }
  if (touching == 0) state.SkipWithError("nothing touches");
  const auto candidates = static_cast<double>(model.contact->nodes.size());
  state.counters["candidates"] = candidates;
  state.counters["touching"] = touching;
  state.counters["ns_per_candidate"] = Counter(candidates * 1e-9, rate | Counter::kInvert);
}

/// `range(0)` numbers per array, `range(1)` arrays in place.
void stream(benchmark::State& state) {
  const auto threads = static_cast<int>(state.range(2));
  bench::StreamArrays arrays(
      {static_cast<std::size_t>(state.range(0)), static_cast<int>(state.range(1)), 0}, threads);
  double best = 0.0;
  for (auto _ : state) best = std::max(best, arrays.bandwidth(0.02));
  state.counters["stream_GB_per_s"] = best * 1e-9;
}

void multiply_adds(benchmark::State& state) {
  double best = 0.0;
  for (auto _ : state) best = std::max(best, bench::peak_flops(static_cast<int>(state.range(0))));
  state.counters["peak_GFLOP_per_s"] = best * 1e-9;
  state.SetLabel(bench::peak_level());
}

}  // namespace

BENCHMARK(product_sparse)->ArgsProduct({{12, 26, 82, 260, 577}, {1, 2}})->UseRealTime();
BENCHMARK(product_eigen)->ArgsProduct({{12, 26, 82, 260, 577}, {1, 2}})->UseRealTime();
BENCHMARK(contact_search)->ArgsProduct({{12, 26, 82, 260, 577}});
BENCHMARK(stream)
    ->ArgsProduct({{4320, 20280, 201720, 2028000, 9987870, 40009200}, {2, 3}, {1, 2}})
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK(multiply_adds)->Arg(1)->Arg(2)->UseRealTime()->Iterations(1);
