// SPDX-License-Identifier: BSD-3-Clause
/// @file  Coupled contact problems as JSON files: what was hard to solve can be looked at, and
/// solved again. Numbers have 17 significant digits, so they are read back bit by bit.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondo/contact/coupled/coupled.hpp"

namespace rondo::contact {

struct ProblemFile {
  CoupledProblem problem;
  std::string about;          ///< where the problem is from
  std::vector<Vec2> impulse;  ///< (nc) found then
  std::vector<Vec2> start;    ///< (nc) warm start
  CoupledResult result;       ///< how the solver ended then
};

/// Problems that took long, until somebody takes them: the first few.
class DifficultProblems {
 public:
  /// Keeps it where it took more than so many iterations; 0: never. @param start warm start
  void look_at(const CoupledProblem& problem, std::span<const Vec2> impulse,
               std::span<const Vec2> start, const CoupledResult& result, int above) {
    constexpr std::size_t most = 16;
    if (above == 0 || result.iterations <= above || kept_.size() == most) return;
    kept_.push_back(
        {problem, "", {impulse.begin(), impulse.end()}, {start.begin(), start.end()}, result});
  }
  [[nodiscard]] std::vector<ProblemFile> take() { return std::exchange(kept_, {}); }

 private:
  std::vector<ProblemFile> kept_;
};

/// @throws FileError where it cannot be written
void write_problem(const std::filesystem::path& path, const ProblemFile& file);

/// @throws FileError where it cannot be read, is not such a file, or its arrays do not fit together
ProblemFile read_problem(const std::filesystem::path& path);

}  // namespace rondo::contact
