// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/problem_file.hpp"
#include "rondo/contact/coupled/coupled_residual.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <random>
#include <sstream>

#include "rondo/core/error.hpp"
#include "support/contact_oracles.hpp"

namespace problem_file_test {

using namespace rondo;
using namespace rondo::contact;

namespace {

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

std::vector<std::filesystem::path> kept_problems() {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::directory_iterator(RONDO_CONTACT_PROBLEMS))
    if (entry.path().extension() == ".json") out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

std::string content(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Row j is row order[j] of p.
CoupledProblem reordered(const CoupledProblem& p, const std::vector<std::size_t>& order) {
  std::vector<int> place(order.size());
  for (std::size_t j = 0; j < order.size(); ++j) place[order[j]] = static_cast<int>(j);
  CoupledProblem out;
  out.row_start = {0};
  for (const std::size_t j : order) {
    out.free.push_back(p.free[j]);
    out.bounce.push_back(p.bounce[j]);
    out.friction.push_back(p.friction[j]);
    out.mass.push_back(p.mass[j]);
    std::vector<std::pair<int, Block>> row;
    for (auto k = static_cast<std::size_t>(p.row_start[j]);
         k < static_cast<std::size_t>(p.row_start[j + 1]); ++k)
      row.emplace_back(place[static_cast<std::size_t>(p.column[k])], p.blocks[k]);
    std::sort(row.begin(), row.end());
    for (const auto& [column, block] : row) {
      out.column.push_back(column);
      out.blocks.push_back(block);
    }
    out.row_start.push_back(static_cast<int>(out.column.size()));
  }
  return out;
}

}  // namespace

TEST(ProblemFile, GivesBackEveryBit) {
  const CoupledProblem p = test::problem_of(
      test::chain({.upper = 9, .lower = 7, .both_ways = true, .restitution = 0.3, .turn = 0.01}));
  const test::Solved s = test::solved(p);
  ProblemFile file{p, "a \"chain\" at 1/3 s", s.impulse, std::vector<Vec2>(p.size()), s.result};
  file.start[2] = {1e-300, -4.9e-324};
  const auto path = scratch("problem.json");
  write_problem(path, file);
  const ProblemFile back = read_problem(path);
  EXPECT_EQ(back.about, file.about);
  EXPECT_EQ(back.problem.free, p.free);
  EXPECT_EQ(back.problem.bounce, p.bounce);
  EXPECT_EQ(back.problem.friction, p.friction);
  EXPECT_EQ(back.problem.mass, p.mass);
  EXPECT_EQ(back.problem.row_start, p.row_start);
  EXPECT_EQ(back.problem.column, p.column);
  EXPECT_EQ(back.problem.blocks, p.blocks);
  EXPECT_EQ(back.impulse, s.impulse);
  EXPECT_EQ(back.start, file.start);
  EXPECT_EQ(back.result.iterations, s.result.iterations);
  EXPECT_EQ(back.result.residual, s.result.residual);
  EXPECT_EQ(back.result.converged, s.result.converged);
}

TEST(ProblemFile, SaysWhatIsWrong) {
  const auto good = content(kept_problems().front());
  const auto message = [&](const std::string& from, const std::string& to) {
    const auto path = scratch("broken.json");
    std::string text = good;
    if (!from.empty()) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
    }
    std::ofstream(path) << text;
    try {
      static_cast<void>(read_problem(path));
    } catch (const FileError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(message("", ""), "");
  EXPECT_NE(message("problem 1", "problem 9").find("problem 9"), std::string::npos);
  EXPECT_NE(message("\"mass\"", "\"moss\"").find("mass"), std::string::npos);
  EXPECT_NE(message("\"column\": [\n    0,", "\"column\": [\n    99999,").find("has column 99999"),
            std::string::npos);
  EXPECT_NE(message("\"row_start\": [\n    0,", "\"row_start\": [\n    1,").find("rows"),
            std::string::npos);
  EXPECT_NE(message("\"friction\": [\n", "\"friction\": [\n    1e9,\n").find("friction"),
            std::string::npos);
  // Found by fuzzing (docs/reliability.md): numbers that no contact has.
  EXPECT_NE(message("\"friction\": [\n    ", "\"friction\": [\n    -").find("friction >= 0"),
            std::string::npos);
  EXPECT_NE(
      message("\"mass\": [\n    0.", "\"mass\": [\n    1" + std::string(81, '0')).find("1e+80"),
      std::string::npos);
  EXPECT_NE(message("\"row_start\": [\n    0,", "\"row_start\": [\n    1e300,").find("rows"),
            std::string::npos);
  EXPECT_NE(message("]", "").find("is not a contact problem"), std::string::npos);
  EXPECT_THROW(static_cast<void>(read_problem(scratch("no such file"))), FileError);
  EXPECT_THROW(write_problem(scratch("no such folder") / "x.json", {}), FileError);
}

TEST(KeptProblems, AllAreSolved) {
  const auto paths = kept_problems();
  ASSERT_GE(paths.size(), 12u);
  for (const auto& path : paths) {
    const ProblemFile file = read_problem(path);
    for (const auto& start : {std::vector<Vec2>(file.problem.size()), file.start, file.impulse}) {
      const test::Solved s = test::solved(file.problem, start);
      EXPECT_TRUE(s.result.converged) << path << ": " << file.about;
      EXPECT_LE(coupled_residual(file.problem, s.impulse), 1e-12) << path;
      EXPECT_EQ(s.result.residual, coupled_residual(file.problem, s.impulse)) << path;
    }
  }
}

/// In any order the law is met; and by the same velocities, where friction is below 1. Above, the
/// law has several solutions (next test), and the order tells which is found.
TEST(KeptProblems, TheOrderOfContactsDoesNotMatter) {
  std::mt19937 random(1);
  int unique = 0;
  for (const auto& path : kept_problems()) {
    const ProblemFile file = read_problem(path);
    const bool smooth =
        *std::max_element(file.problem.friction.begin(), file.problem.friction.end()) < 1.0;
    unique += smooth ? 1 : 0;
    const test::Solved first = test::solved(file.problem);
    double fastest = 0.0;
    for (const Vec2 w : file.problem.free) fastest = std::max(fastest, norm(w));
    std::vector<std::size_t> order(file.problem.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int i = 0; i < 5; ++i) {
      std::shuffle(order.begin(), order.end(), random);
      const test::Solved other = test::solved(reordered(file.problem, order));
      ASSERT_TRUE(other.result.converged) << path;
      EXPECT_LE(coupled_residual(reordered(file.problem, order), other.impulse), 1e-12) << path;
      if (!smooth) continue;
      double worst = 0.0;
      for (std::size_t j = 0; j < order.size(); ++j)
        worst = std::max(worst, norm(other.velocity[j] - first.velocity[order[j]]));
      // The residual leaves 1e-12 of impulses; by masses that differ up to 20 times, and the
      // conditioning of shallow valleys (1/0.001), that is up to 1e-8 of the velocities.
      EXPECT_LT(worst, 1e-8 * fastest) << path;
    }
  }
  EXPECT_GE(unique, 7);
}

TEST(KeptProblems, SmallOnesMatchTheEnumerationOfAllStatuses) {
  const std::filesystem::path folder = RONDO_CONTACT_PROBLEMS;
  std::vector<std::size_t> solutions;
  for (const char* name : {"corner-in-corner.json", "corner-in-corner-rough.json"}) {
    const CoupledProblem p = read_problem(folder / name).problem;
    std::vector<std::vector<Vec2>> distinct;
    for (const auto& w : test::enumerate(p, 1e-12)) {
      const auto same = [&](const auto& v) { return test::largest_difference(v, w) < 1e-9; };
      if (std::none_of(distinct.begin(), distinct.end(), same)) distinct.push_back(w);
    }
    for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{0, 1}, {1, 0}}) {
      const test::Solved s = test::solved(reordered(p, order));
      const std::vector<Vec2> w{s.velocity[order[0]], s.velocity[order[1]]};
      const auto same = [&](const auto& v) { return test::largest_difference(v, w) < 1e-9; };
      EXPECT_TRUE(std::any_of(distinct.begin(), distinct.end(), same)) << name;
    }
    solutions.push_back(distinct.size());
  }
  EXPECT_EQ(solutions[0], 1u);
  EXPECT_GE(solutions[1], 2u);
}

}  // namespace problem_file_test
