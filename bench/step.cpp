// SPDX-License-Identifier: BSD-3-Clause
/// Whole steps (spin, damping, ledger; with and without rolling contact) in ns per degree of
/// freedom and step. It verifies too: a ledger that does not close stops it.
#include <benchmark/benchmark.h>

#include "support/models.hpp"

using namespace rondo;

namespace {

void step(benchmark::State& bench, bool contact) {
  auto c =
      test::rolling_disk(static_cast<int>(bench.range(0)), 15 * static_cast<int>(bench.range(0)));
  c.motion.height = dynamics::Table(0.2995);
  auto b = test::build(c);
  b.model.threads = static_cast<int>(bench.range(1));
  if (contact) test::add_ground(b, {}, {0.3, 0.0});
  dynamics::State state = test::start_at_rest(b.model);
  dynamics::Ledger ledger;
  for (auto _ : bench) benchmark::DoNotOptimize(advance(b.model, state, ledger));
  if (!(ledger.last().relative < 1e-12)) bench.SkipWithError("the ledger does not close");
  const double dofs = 2.0 * static_cast<double>(b.model.free.size());
  bench.counters["dofs"] = dofs;
  bench.counters["per_dof_step"] = benchmark::Counter(
      dofs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void free_spin(benchmark::State& bench) {
  step(bench, false);
}
void rolling(benchmark::State& bench) {
  step(bench, true);
}

}  // namespace

BENCHMARK(free_spin)->ArgsProduct({{12, 26, 82, 260}, {1, 2}})->UseRealTime();
BENCHMARK(rolling)->ArgsProduct({{12, 26, 82}, {1}})->UseRealTime();
