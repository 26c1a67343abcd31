// SPDX-License-Identifier: BSD-3-Clause
/// Whole steps (spin, both dampings, ledger; free and in rolling contact) by every operator, in ns
/// per degree of freedom and step, and relative to limits of the machine measured with each
/// repetition. It also verifies: a ledger that does not close stops it.
///
/// Names: step/MESH/MOTION/DAMPING/OPERATOR/THREADS. The time is that of a batch of steps. With
/// RONDO_BENCH_HUGE=1 in the environment, the disk of 4·10⁷ degrees of freedom is included (6 GB).
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "problem.hpp"

using namespace rondo;
using bench::Steps;
using bench::Variant;

namespace {

struct Mesh {
  std::string name;
  mesh::Disk disk;
};

Mesh smooth(int radial, int circumferential) {
  mesh::Disk disk;
  disk.radial = radial;
  disk.circumferential = circumferential;
  return {fmt::format("smooth-{}x{}", radial, circumferential), disk};
}

/// `layers` in total over the thickness; the grooves of cases/ledge-treaded.toml, equally deep in
/// layers and in metres. Three quarters of a pitch are land, one is groove.
Mesh treaded(int pitches, int columns, int layers) {
  mesh::Disk disk;
  mesh::Tread tread;
  tread.pitches = pitches;
  tread.depth = 0.02;
  tread.groove_columns = columns / 4;
  tread.land_columns = columns - tread.groove_columns;
  tread.layers = std::max(1, layers * 2 / 15);
  disk.radial = layers - tread.layers;
  disk.tread = tread;
  return {fmt::format("treaded-{}x{}", pitches, columns), disk};
}

bool huge_too() {
  const char* asked = std::getenv("RONDO_BENCH_HUGE");
  return asked && std::string_view(asked) == "1";
}

/// Sizes from 480 to 10⁷ degrees of freedom; treads with 60 pitches, then with many.
std::vector<Mesh> meshes() {
  std::vector<Mesh> all{smooth(4, 60),       smooth(5, 75),        smooth(12, 180),
                        smooth(26, 390),     smooth(82, 1230),     smooth(260, 3900),
                        smooth(577, 8655),   treaded(60, 4, 11),   treaded(60, 8, 22),
                        treaded(60, 24, 66), treaded(60, 80, 220), treaded(98, 4, 26),
                        treaded(308, 4, 82), treaded(975, 4, 260)};
  if (huge_too()) all.push_back(smooth(1155, 17320));
  return all;
}

/// The mesh requested last, which all its operators and repetitions share.
bench::Problem& problem(const Mesh& mesh) {
  static std::string name;
  static std::unique_ptr<bench::Problem> kept;
  if (name != mesh.name) {
    kept.reset();
    kept = std::make_unique<bench::Problem>(mesh.disk);
    name = mesh.name;
  }
  return *kept;
}

/// Best bandwidth of the arrays of a step, measured each time because the machine may be shared.
double bandwidth(const bench::Streams& streams, int threads) {
  static std::unique_ptr<bench::StreamArrays> kept;
  if (!kept || kept->streams() != streams || kept->threads() != threads) {
    kept.reset();
    kept = std::make_unique<bench::StreamArrays>(streams, threads);
  }
  return kept->bandwidth(0.05);
}

/// Best value so far, because it does not depend on the mesh.
double peak(int threads) {
  static std::map<int, double> best;
  return best[threads] = std::max(best[threads], bench::peak_flops(threads));
}

/// Steps per call. `cyclic` benefits from many, the others make single steps anyway; fewer on large
/// meshes, where one step takes long.
std::size_t batch(Steps steps, std::size_t dofs) {
  return steps == Steps::cyclic || dofs < 1'000'000 ? 64 : 8;
}

void count(benchmark::State& state, const bench::Work& work, double dof_steps, int threads) {
  using benchmark::Counter;
  constexpr auto rate = Counter::kIsIterationInvariantRate;
  const double dofs = static_cast<double>(work.streams.length);
  const double bytes = work.streams.bytes() / dofs;
  const double stream = bandwidth(work.streams, threads), flops = peak(threads);
  state.counters["dofs"] = dofs;
  state.counters["ns_per_dof_step"] = Counter(dof_steps * 1e-9, rate | Counter::kInvert);
  state.counters["bytes_per_dof"] = bytes;
  state.counters["flops_per_dof"] = work.flops;
  state.counters["GB_per_s"] = Counter(dof_steps * bytes * 1e-9, rate);
  state.counters["GFLOP_per_s"] = Counter(dof_steps * work.flops * 1e-9, rate);
  state.counters["stream_GB_per_s"] = stream * 1e-9;
  state.counters["peak_GFLOP_per_s"] = flops * 1e-9;
  state.counters["share_of_stream"] = Counter(dof_steps * bytes / stream, rate);
  state.counters["share_of_peak"] = Counter(dof_steps * work.flops / flops, rate);
}

/// [s]
struct BatchTime {
  double median = 0.0;
  double best = 0.0;
};

/// Median of as many batches as take 0.2 s, at least two, so that batches interrupted by another
/// process do not count. (The library would determine the number by a first trial, which on a
/// shared machine may be a hundred times too slow, and use the mean.)
BatchTime time_of_batch(dynamics::Integrator& integrator, std::span<dynamics::StepReport> reports) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> times;
  double all = 0.0;
  while (times.size() < 2 || all < 0.2) {
    const auto begin = Clock::now();
    integrator.advance(reports);
    times.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    all += times.back();
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return {*middle, *std::min_element(times.begin(), times.end())};
}

void step(benchmark::State& state, const Mesh& mesh, Steps steps, const Variant& variant) {
  bench::Problem& p = problem(mesh);
  const auto integrator = p.integrator(steps, variant);
  std::vector<dynamics::StepReport> reports(batch(steps, p.n_dofs()));
  integrator->advance(reports);  // touches the memory and starts contact
  BatchTime time;
  for (auto _ : state) {
    time = time_of_batch(*integrator, reports);
    state.SetIterationTime(time.median);
  }
  const dynamics::StepReport& last = reports.back();
  if (!(last.balance.relative < 1e-12))
    state.SkipWithError(
        fmt::format("the ledger does not close: {:.2g}", last.balance.relative).c_str());
  if (variant.rolling != (last.contact.nodes > 0)) state.SkipWithError("contact is not as asked");
  const auto dof_steps = static_cast<double>(p.n_dofs() * reports.size());
  count(state, p.work(steps, variant), dof_steps, variant.threads);
  state.counters["best_ns_per_dof_step"] = 1e9 * time.best / dof_steps;
}

double smallest(const std::vector<double>& x) {
  return *std::min_element(x.begin(), x.end());
}
double largest(const std::vector<double>& x) {
  return *std::max_element(x.begin(), x.end());
}

void add(const Mesh& mesh, Steps steps, const Variant& variant) {
  const std::string name =
      fmt::format("step/{}/{}/{}/{}/{}", mesh.name, variant.rolling ? "rolling" : "free_spin",
                  variant.beta ? "beta" : "no_beta", bench::name_of(steps), variant.threads);
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& s) { step(s, mesh, steps, variant); })
      ->UseManualTime()
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond)
      ->ComputeStatistics("min", smallest)
      ->ComputeStatistics("max", largest);
}

/// Assembled matrices of the disk of 4·10⁷ degrees of freedom would take 16 GB. The sums of the
/// reference step run node by node and are not accurate enough for a million nodes.
bool fits(const Mesh& mesh, Steps steps) {
  const std::size_t nodes = mesh::n_disk_nodes(mesh.disk);
  if (steps == Steps::reference) return nodes < 1'000'000;
  return steps == Steps::cyclic || nodes < 10'000'000;
}

}  // namespace

int main(int argc, char** argv) {
  for (const Mesh& mesh : meshes())
    for (const bool rolling : {false, true})
      for (const bool beta : {true, false})
        for (const Steps steps : bench::all_steps)
          for (const int threads : {1, 2})
            if (fits(mesh, steps)) add(mesh, steps, {rolling, beta, threads});
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
