// SPDX-License-Identifier: BSD-3-Clause
/// Steps for bench/instructions.py to count the instructions of: what is counted is all that
/// rondo_measured_steps does (callgrind's --toggle-collect).
///
///     one_step OPERATOR MOTION STEPS     cyclic|sparse, free_spin|rolling, more than 0
///     one_step compare                   do all operators of the benchmarks make the same steps?
///     one_step build                     compiler and flags of this build
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "problem.hpp"

using namespace rondo;

extern "C" [[gnu::noinline]] void rondo_measured_steps(dynamics::Integrator& integrator,
                                                       std::span<dynamics::StepReport> reports) {
  integrator.advance(reports);
}

namespace {

int measure(bench::Steps steps, bool rolling, std::size_t n_steps) {
  mesh::Disk disk;
  disk.radial = 12;
  disk.circumferential = 180;
  bench::Problem problem(disk);
  const auto integrator = problem.integrator(steps, {.rolling = rolling});
  std::vector<dynamics::StepReport> reports(n_steps);
  integrator->advance(reports);  // lazy loading and the like, contact there
  rondo_measured_steps(*integrator, reports);
  const dynamics::StepReport& last = reports.back();
  fmt::print("relative residual {:.3g}, nodes in contact {}\n", last.balance.relative,
             last.contact.nodes);
  return last.balance.relative < 1e-12 && rolling == (last.contact.nodes > 0) ? 0 : 1;
}

/// Largest difference of displacements and velocities over their largest, after rolling for long
/// enough that waves have crossed the disk several times.
double difference(const dynamics::State& a, const dynamics::State& b) {
  double u = 0.0, v = 0.0, largest_u = 0.0, largest_v = 0.0;
  for (std::size_t i = 0; i < a.u.size(); ++i) {
    u = std::max(u, norm(a.u[i] - b.u[i]));
    v = std::max(v, norm(a.v_next[i] - b.v_next[i]));
    largest_u = std::max(largest_u, norm(b.u[i]));
    largest_v = std::max(largest_v, norm(b.v_next[i]));
  }
  return std::max(u / largest_u, v / largest_v);
}

int compare() {
  mesh::Disk disk;
  disk.radial = 5;
  disk.circumferential = 75;
  bench::Problem problem(disk);
  const auto after_rolling = [&](bench::Steps steps, int threads) {
    const auto integrator = problem.integrator(steps, {.rolling = true, .threads = threads});
    std::vector<dynamics::StepReport> reports(300);
    dynamics::State state(problem.model());
    integrator->advance(reports, &state);
    return state;
  };
  const dynamics::State expected = after_rolling(bench::Steps::reference, 1);
  int differ = 0;
  for (const bench::Steps steps : bench::all_steps)
    for (const int threads : {1, 2}) {
      const double d = difference(after_rolling(steps, threads), expected);
      differ += d < 1e-10 ? 0 : 1;
      fmt::print("{} on {} threads differs from the reference by {:.3g}\n", name_of(steps), threads,
                 d);
    }
  return differ == 0 ? 0 : 1;
}

int refuse() {
  fmt::print(stderr,
             "usage: one_step cyclic|sparse free_spin|rolling STEPS\n"
             "       one_step compare\n"
             "       one_step build\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string_view> words(argv + 1, argv + argc);
  if (words.size() == 1 && words[0] == "build") {
    fmt::print("{}\n{}\n", RONDO_COMPILER, RONDO_FLAGS);
    return 0;
  }
  if (words.size() == 1 && words[0] == "compare") return compare();
  if (words.size() != 3) return refuse();
  const int n = std::atoi(argv[3]);
  if ((words[0] != "cyclic" && words[0] != "sparse") ||
      (words[1] != "free_spin" && words[1] != "rolling") || n <= 0)
    return refuse();
  return measure(words[0] == "cyclic" ? bench::Steps::cyclic : bench::Steps::sparse,
                 words[1] == "rolling", static_cast<std::size_t>(n));
}
