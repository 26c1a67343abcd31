// SPDX-License-Identifier: BSD-3-Clause
/// @file  Coupled contact problems as JSON files: what was hard to solve can be looked at, and
/// solved again. Numbers have 17 significant digits, so they are read back bit by bit.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "rondo/contact/coupled/coupled.hpp"

namespace rondo::contact {

struct ProblemFile {
  CoupledProblem problem;
  std::string about;          ///< where the problem is from
  std::vector<Vec2> impulse;  ///< (nc) found then
  std::vector<Vec2> start;    ///< (nc) warm start
  CoupledResult result;       ///< of then
};

/// @throws FileError where it cannot be written
void write_problem(const std::filesystem::path& path, const ProblemFile& file);

/// @throws FileError where it cannot be read, is not such a file, or its arrays do not fit together
ProblemFile read_problem(const std::filesystem::path& path);

}  // namespace rondo::contact
