// SPDX-License-Identifier: BSD-3-Clause
/// Decompositions: seconds, GFlop/s and the peak memory of the process compared with the plan. The
/// memory is that of the whole process so far; one benchmark per run (--benchmark_filter) gives
/// that of one method. It also verifies: modes that are not orthonormal stop it.
#include <benchmark/benchmark.h>

#include <cmath>
#include <fstream>
#include <string>

#include "rondo/pod/decompose.hpp"
#include "rondo/pod/svd.hpp"

using namespace rondo::pod;

namespace {

/// Waves of decreasing amplitude, computed when they are read; nothing is stored.
class Waves final : public SnapshotMatrix {
 public:
  Waves(Index rows, Index columns) : rows_(rows), columns_(columns) {
    constexpr Index waves = 60;
    space_.resize(rows, waves);
    time_.resize(waves, columns);
    for (Index k = 0; k < waves; ++k) {
      const double wave = 1.0 + 0.7 * static_cast<double>(k);
      for (Index i = 0; i < rows; ++i) space_(i, k) = sine(wave * static_cast<double>(i + 1), rows);
      for (Index j = 0; j < columns; ++j)
        time_(k, j) = std::pow(0.7, static_cast<double>(k)) *
                      sine(wave * static_cast<double>(j + 1) + 0.3, columns);
    }
  }
  [[nodiscard]] Index rows() const noexcept override { return rows_; }
  [[nodiscard]] Index columns() const noexcept override { return columns_; }
  [[nodiscard]] Index row_grain() const noexcept override { return 1; }
  void read_columns(Index first, Eigen::Ref<Eigen::MatrixXd> out) override {
    multiply(space_, time_.middleCols(first, out.cols()), out);
  }
  void read_rows(Index first, Eigen::Ref<Eigen::MatrixXd> out) override {
    multiply(space_.middleRows(first, out.rows()), time_, out);
  }

 private:
  static double sine(double x, Index period) {
    return std::sin(6.283185307179586 * x / static_cast<double>(period));
  }
  Index rows_, columns_;
  Eigen::MatrixXd space_, time_;
};

/// VmHWM or VmRSS of this process [MB]
double process_memory(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == key + ":" && status >> word) return std::stod(word) / 1024.0;
  return 0.0;
}

void pod(benchmark::State& bench, Method method) {
  Waves source(bench.range(0), bench.range(1));
  DecomposeOptions options;
  options.method = method;
  options.modes = bench.range(2);
  options.memory = static_cast<std::size_t>(bench.range(3)) * 1'000'000;
  const DecomposePlan p = plan(source.rows(), source.columns(), source.row_grain(), options);
  const double before = process_memory("VmRSS");
  double orthonormal = 0.0;
  for (auto _ : bench) {
    const Decomposition d = decompose(source, options);
    orthonormal = orthonormality(d.modes);
  }
  if (!(orthonormal < 1e-13)) bench.SkipWithError("the modes are not orthonormal");
  bench.counters["flops"] =
      benchmark::Counter(p.flops, benchmark::Counter::kIsIterationInvariantRate);
  bench.counters["plan_MB"] = static_cast<double>(p.memory) / 1e6;
  bench.counters["source_MB"] = before * 1.048576;
  bench.counters["peak_MB"] = process_memory("VmHWM") * 1.048576;
}

}  // namespace

// Arguments: rows, columns, modes, memory allowed [MB]
BENCHMARK_CAPTURE(pod, direct, Method::direct)
    ->Args({4680, 600, -1, 2000})
    ->Args({4680, 600, 50, 2000})
    ->Unit(benchmark::kSecond)
    ->Iterations(3);
BENCHMARK_CAPTURE(pod, tsqr, Method::tsqr)
    ->Args({4680, 600, 50, 100})
    ->Args({200000, 1000, 50, 300})
    ->Unit(benchmark::kSecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(pod, incremental, Method::incremental)
    ->Args({200000, 1000, 50, 300})
    ->Unit(benchmark::kSecond)
    ->Iterations(1);
