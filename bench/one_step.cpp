// SPDX-License-Identifier: BSD-3-Clause
/// Steps whose instructions bench/instructions.py counts: everything that rondo_measured_steps
/// executes (callgrind's --toggle-collect).
///
///     one_step OPERATOR MOTION MESH STEPS   cyclic|sparse, free_spin|rolling, ring|chunks|treaded
///     one_step compare   checks that all operators of the benchmarks make the same steps
///     one_step build     prints compiler and flags of this build
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

#include "problem.hpp"

using namespace rondo;

extern "C" [[gnu::noinline]] void rondo_measured_steps(dynamics::Integrator& integrator,
                                                       std::span<dynamics::StepReport> reports) {
  integrator.advance(reports);
}

namespace {

mesh::Disk smooth(int radial, int circumferential) {
  mesh::Disk disk;
  disk.radial = radial;
  disk.circumferential = circumferential;
  return disk;
}

/// One disk for each way in which the cyclic operator passes over a disk.
std::optional<mesh::Disk> disk_named(std::string_view name) {
  if (name == "ring") return smooth(12, 180);     // one chunk, fits into the cache: step by step
  if (name == "chunks") return smooth(14, 1600);  // two chunks, four steps per pass
  if (name != "treaded") return std::nullopt;     // sectors of several columns, no mirror symmetry
  mesh::Disk disk = smooth(9, 0);
  disk.tread = mesh::Tread{60, 0.02, 3, 1, 2};
  return disk;
}

struct Measured {
  bench::Steps steps;
  bool rolling;
  mesh::Disk disk;
  std::size_t n_steps;
};

int measure(const Measured& m) {
  bench::Problem problem(m.disk);
  const auto integrator = problem.integrator(m.steps, {.rolling = m.rolling});
  std::vector<dynamics::StepReport> reports(m.n_steps);
  integrator->advance(reports);  // for lazy loading and similar costs, and contact
  rondo_measured_steps(*integrator, reports);
  const dynamics::StepReport& last = reports.back();
  fmt::print("relative residual {:.3g}, nodes in contact {}\n", last.balance.relative,
             last.contact.nodes);
  return last.balance.relative < 1e-12 && m.rolling == (last.contact.nodes > 0) ? 0 : 1;
}

/// Largest difference of displacements and velocities relative to their maximum, after rolling for
/// so long that waves have crossed the disk several times.
double difference(const dynamics::State& a, const dynamics::State& b) {
  double u = 0.0, v = 0.0, largest_u = 0.0, largest_v = 0.0;
  for (std::size_t i = 0; i < a.u.size(); ++i) {
    u = std::max(u, norm(a.u.plane()[i] - b.u.plane()[i]));
    v = std::max(v, norm(a.v_next.plane()[i] - b.v_next.plane()[i]));
    largest_u = std::max(largest_u, norm(b.u.plane()[i]));
    largest_v = std::max(largest_v, norm(b.v_next.plane()[i]));
  }
  return std::max(u / largest_u, v / largest_v);
}

int compare() {
  bench::Problem problem(smooth(5, 75));
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
             "usage: one_step cyclic|sparse free_spin|rolling ring|chunks|treaded STEPS\n"
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
  if (words.size() != 4) return refuse();
  const std::optional<mesh::Disk> disk = disk_named(words[2]);
  const int n = std::atoi(argv[4]);
  if ((words[0] != "cyclic" && words[0] != "sparse") ||
      (words[1] != "free_spin" && words[1] != "rolling") || !disk || n <= 0)
    return refuse();
  return measure({words[0] == "cyclic" ? bench::Steps::cyclic : bench::Steps::sparse,
                  words[1] == "rolling", *disk, static_cast<std::size_t>(n)});
}
