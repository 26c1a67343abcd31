// SPDX-License-Identifier: BSD-3-Clause
/// Cost of a step of rubber in ns per degree of freedom and step, for the whole step with spin and
/// ledger: `bench_rubber [ROUNDS [THREADS]]`. Disks spin freely. The smallest time of a batch of 64
/// steps counts, because the machine may do other work.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "problem.hpp"

using namespace rondo;

namespace {

struct Size {
  int radial, circumferential;
};
constexpr Size sizes[] = {{26, 385}, {82, 1220}, {260, 3850}};  // 2e4, 2e5, 2e6

struct Row {
  const char* name;
  fem::Rubber rubber;
};

std::vector<Row> rows() {
  fem::Rubber neo_hooke;
  neo_hooke.c10 = 1.0e6;
  neo_hooke.bulk_modulus = 8.0e7;
  fem::Rubber one = neo_hooke, three = neo_hooke, mooney = neo_hooke, ogden = neo_hooke;
  one.branches = {{0.3, 1.0e-3}};
  three.branches = {{0.3, 1.0e-3}, {0.2, 1.0e-2}, {0.2, 0.1}};
  mooney.law = fem::RubberLaw::mooney_rivlin;
  mooney.c01 = 0.3e6;
  ogden.law = fem::RubberLaw::ogden;
  ogden.terms = {{1.2e6, 1.3}, {0.2e6, 5.0}};
  return {{"neo-Hooke", neo_hooke},
          {"with one branch", one},
          {"with three", three},
          {"Mooney-Rivlin", mooney},
          {"Ogden, two terms", ogden}};
}

double measure(Size size, const fem::Rubber& rubber, int rounds, int threads) {
  mesh::Disk disk;
  disk.radial = size.radial;
  disk.circumferential = size.circumferential;
  bench::Problem problem(disk);
  bench::Variant variant{.beta = false, .threads = threads};
  variant.rubber = rubber;
  const auto integrator = problem.integrator(bench::Steps::sparse, variant);
  std::vector<dynamics::StepReport> reports(64);
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < rounds; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    integrator->advance(reports);
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  if (!(reports.back().balance.relative < 1e-12)) {
    fmt::print(stderr, "the ledger does not close: {:.2g}\n", reports.back().balance.relative);
    std::exit(1);
  }
  return 1e9 * best / (64.0 * static_cast<double>(problem.n_dofs()));
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 8;
  const int threads = argc > 2 ? std::max(1, std::atoi(argv[2])) : 1;
  fmt::print("{:20}", "degrees of freedom");
  for (const Size& size : sizes) fmt::print("{:>10}", 2L * size.radial * size.circumferential);
  fmt::print("\n");
  for (const Row& row : rows()) {
    fmt::print("{:20}", row.name);
    for (const Size& size : sizes) {
      fmt::print("{:10.1f}", measure(size, row.rubber, rounds, threads));
      std::fflush(stdout);
    }
    fmt::print("\n");
  }
}
