// SPDX-License-Identifier: BSD-3-Clause
/// A contact problem kept as a file, and its solution: at most so many iterations, impulses that
/// are numbers within the friction cone, a report that tells what was found.
#include <cmath>

#include "fuzz.hpp"
#include "mutate.hpp"
#include "rondo/contact/coupled/problem_file.hpp"
#include "rondo/contact/residual.hpp"

using namespace rondo;
using namespace rondo::contact;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  return fuzz::mutate_text(data, size, max, seed);
}

namespace {

void check_solution(const CoupledProblem& p, std::span<const Vec2> impulse,
                    const CoupledResult& result, const CoupledLimits& limits) {
  fuzz::check(result.iterations <= limits.most_iterations, "more iterations than allowed");
  fuzz::check(!result.converged || result.residual <= limits.tolerance,
              "converged to a residual above the tolerance");
  for (std::size_t j = 0; j < p.size(); ++j) {
    const Vec2 r = impulse[j];
    fuzz::check(fuzz::is_finite(r), "an impulse that is not finite");
    fuzz::check(r.x >= 0.0, "an impulse that pulls");
    // The bound is a product of two numbers: as many bits as a few roundings lose.
    fuzz::check(std::abs(r.y) <= p.friction[j] * r.x * (1.0 + 1e-12) + 1e-300,
                "an impulse outside the friction cone");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto file = fuzz::scratch_folder() / "problem.json";
  fuzz::put(file, fuzz::view(data, size));
  ProblemFile read;
  if (!fuzz::accepted([&] { read = read_problem(file); })) return 0;
  write_problem(file, read);
  const ProblemFile again = read_problem(file);
  fuzz::check(
      again.problem.free == read.problem.free && again.problem.blocks == read.problem.blocks,
      "another problem after writing");
  const CoupledLimits limits{.tolerance = 1e-12, .most_iterations = 300};
  std::vector<Vec2> impulse = read.start;
  std::vector<Status> status(read.problem.size());
  CoupledWorkspace work;
  const CoupledResult result = solve_coupled(read.problem, limits, impulse, status, work);
  check_solution(read.problem, impulse, result, limits);
  return 0;
}
