// SPDX-License-Identifier: BSD-3-Clause
#include "stream.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct Pointers {
  double *u, *v, *w;
  const double* read;
  std::size_t n, n_read;
};

/// Uses four sums, so that no addition waits for the previous one.
[[gnu::always_inline]] inline double sum_of(const double* x, std::size_t n) {
  const std::size_t quarter = n / 4;
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
#pragma omp simd reduction(+ : a, b, c, d)
  for (std::size_t i = 0; i < quarter; ++i) {
    a += x[i];
    b += x[i + quarter];
    c += x[i + 2 * quarter];
    d += x[i + 3 * quarter];
  }
  for (std::size_t i = 4 * quarter; i < n; ++i) a += x[i];
  return a + b + (c + d);
}

/// An oscillator at each index, whose amplitude stays constant over any number of passes. Read-only
/// arrays are read in blocks in between, as a step reads the rows of its matrix.
[[gnu::always_inline]] inline double pass(const Pointers& p) {
  constexpr std::size_t block = 512;
  constexpr double s = 1e-3, t = 1e-12;
  const std::size_t blocks = (p.n + block - 1) / block;
  double sum = 0.0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t begin = b * block, end = std::min(begin + block, p.n);
    if (p.w) {
#pragma omp simd
      for (std::size_t i = begin; i < end; ++i) {
        const double u = p.u[i] + s * p.v[i];
        p.v[i] -= s * u + t * (u - p.w[i]);
        p.u[i] = u;
        p.w[i] = u;
      }
    } else {
#pragma omp simd
      for (std::size_t i = begin; i < end; ++i) {
        p.u[i] += s * p.v[i];
        p.v[i] -= s * p.u[i];
      }
    }
    const std::size_t from = p.n_read * b / blocks, to = p.n_read * (b + 1) / blocks;
    sum += sum_of(p.read + from, to - from);
  }
  return sum;
}

constexpr int peak_sums = 12;  // two units of latency 4 need 8; all levels have 12

/// n times as many multiplications and additions as `peak_sums` registers of that width hold; each
/// waits only for the previous one in its own register element.
template <int Width, bool Fused>
[[gnu::always_inline]] inline double multiply_add(long n) {
  constexpr double x = 0.999999, y = 1e-6;
  double sum[peak_sums][Width];
  for (auto& s : sum)
    for (double& lane : s) lane = y;
  for (long i = 0; i < n; ++i)
#pragma GCC unroll 12
    for (auto& s : sum)
#pragma GCC unroll 8
      for (double& lane : s) lane = Fused ? __builtin_fma(lane, x, y) : lane * x + y;
  double total = 0.0;
  for (const auto& s : sum)
    for (const double lane : s) total += lane;
  return total;
}

#if defined(__x86_64__)
#if defined(__clang__)  // its vector width is set on the command line only
#define RONDO_AVX512 "avx512f"
#else
#define RONDO_AVX512 "avx512f,prefer-vector-width=512"
#endif
[[gnu::target(RONDO_AVX512)]] double pass_avx512(const Pointers& p) {
  return pass(p);
}
[[gnu::target("avx2")]] double pass_avx2(const Pointers& p) {
  return pass(p);
}
[[gnu::target(RONDO_AVX512)]] double multiply_add_avx512(long n) {
  return multiply_add<8, true>(n);
}
[[gnu::target("avx2,fma")]] double multiply_add_avx2(long n) {
  return multiply_add<4, true>(n);
}
#endif

double pass_baseline(const Pointers& p) {
  return pass(p);
}
double multiply_add_baseline(long n) {
  return multiply_add<2, false>(n);
}

struct Level {
  const char* name;
  double (*pass)(const Pointers&);
  double (*multiply_add)(long);
  int width;
};

Level best_level() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return {"avx512", pass_avx512, multiply_add_avx512, 8};
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return {"avx2", pass_avx2, multiply_add_avx2, 4};
#endif
  return {"baseline", pass_baseline, multiply_add_baseline, 2};
}

}  // namespace

StreamArrays::StreamArrays(const Streams& streams, int threads)
    : streams_(streams), threads_(threads), parts_(static_cast<std::size_t>(threads)) {
  RONDO_DEMAND(streams.in_place == 2 || streams.in_place == 3, streams.in_place);
  const auto n_parts = static_cast<std::size_t>(threads);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < n_parts; ++i) {
    const auto share = [&](std::size_t n) { return n * (i + 1) / n_parts - n * i / n_parts; };
    const std::size_t n = share(streams.length);
    parts_[i] = {std::vector<double>(n, 1.0), std::vector<double>(n, 0.5),
                 std::vector<double>(streams.in_place == 3 ? n : 0, 1.0),
                 std::vector<double>(share(streams.read_only), 1e-3)};
  }
}

double StreamArrays::run(long passes) {
  const auto one_pass = best_level().pass;
  double sum = 0.0;
  const auto begin = Clock::now();
#pragma omp parallel for schedule(static) num_threads(threads_) reduction(+ : sum)
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    const Pointers p{part.u.data(),    part.v.data(), part.w.empty() ? nullptr : part.w.data(),
                     part.read.data(), part.u.size(), part.read.size()};
    for (long k = 0; k < passes; ++k) sum += one_pass(p);
  }
  const double seconds = seconds_since(begin);
  sink_ += sum;
  return seconds;
}

double StreamArrays::bandwidth(double seconds) {
  const double bytes = streams_.bytes();
  const long passes = std::max(1L, std::lround(2e7 / bytes));  // some ms per measurement
  double best = 0.0;
  const auto begin = Clock::now();
  for (int done = 0; done < 3 || seconds_since(begin) < seconds; ++done)
    best = std::max(best, static_cast<double>(passes) * bytes / run(passes));
  RONDO_DEMAND(std::isfinite(sink_), sink_);
  return best;
}

double peak_flops(int threads) {
  const Level level = best_level();
  constexpr long rounds = 200'000;  // about a millisecond
  const double flops = 2.0 * peak_sums * level.width * static_cast<double>(rounds) * threads;
  double best = 0.0, sink = 0.0;
  for (int done = 0; done < 50; ++done) {
    const auto begin = Clock::now();
#pragma omp parallel for schedule(static) num_threads(threads) reduction(+ : sink)
    for (int thread = 0; thread < threads; ++thread) sink += level.multiply_add(rounds);
    best = std::max(best, flops / seconds_since(begin));
  }
  RONDO_DEMAND(std::isfinite(sink), sink);
  return best;
}

std::string peak_level() {
  return best_level().name;
}

}  // namespace rondo::bench
