// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/problem_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/core/index.hpp"

namespace rondo::contact {
namespace {

using nlohmann::json;
constexpr const char* format_name = "rondo contact problem 1";

std::string text(double x) {
  return fmt::format("{:.17g}", x);
}
std::string text(int x) {
  return fmt::format("{}", x);
}
std::string text(Vec2 v) {
  return fmt::format("[{:.17g}, {:.17g}]", v.x, v.y);
}
std::string text(const Block& b) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}, {:.17g}]", b[0], b[1], b[2], b[3]);
}

/// An array, one number, vector or block a line.
template <class T>
std::string array_text(const char* name, const std::vector<T>& values) {
  std::string out = fmt::format("  \"{}\": [", name);
  for (std::size_t i = 0; i < values.size(); ++i)
    out += fmt::format("{}\n    {}", i == 0 ? "" : ",", text(values[i]));
  return out + "\n  ],\n";
}

void read_into(const json& j, double& x) {
  x = j.get<double>();
}
/// -1, which is no place and no count, for all that is no int >= 0: json would convert it.
void read_into(const json& j, int& x) {
  const auto whole = j.is_number_integer() ? j.get<std::int64_t>() : -1;
  x = whole >= 0 && whole <= std::numeric_limits<int>::max() ? static_cast<int>(whole) : -1;
}
void read_into(const json& j, Vec2& v) {
  const auto pair = j.get<std::array<double, 2>>();
  v = {pair[0], pair[1]};
}
void read_into(const json& j, Block& b) {
  b = j.get<Block>();
}

template <class T>
void read_array(const json& file, const char* name, std::vector<T>& out) {
  for (const json& entry : file.at(name)) read_into(entry, out.emplace_back());
}

/// Products of three of them stay in range.
constexpr double largest = 1e80;

bool in_range(double x) noexcept {
  return std::abs(x) <= largest;
}
bool in_range(Vec2 v) noexcept {
  return in_range(v.x) && in_range(v.y);
}
bool in_range(const Block& b) noexcept {
  return std::ranges::all_of(b, [](double x) { return in_range(x); });
}

/// Empty where all numbers are what they can be, else what is not.
std::string bad_number(const ProblemFile& f) {
  const CoupledProblem& p = f.problem;
  const auto all_in_range = [](const auto& values) {
    return std::ranges::all_of(values, [](const auto& value) { return in_range(value); });
  };
  if (!all_in_range(p.free) || !all_in_range(p.bounce) || !all_in_range(p.friction) ||
      !all_in_range(p.mass) || !all_in_range(p.blocks) || !all_in_range(f.start) ||
      !all_in_range(f.impulse))
    return fmt::format("a number is larger than {:.0e}", largest);
  for (std::size_t j = 0; j < p.size(); ++j)
    if (p.friction[j] < 0.0) return fmt::format("contact {}: friction >= 0 does not hold", j);
  return f.result.iterations < 0 ? "iterations is no count" : "";
}

/// Empty where the arrays fit together, else what does not.
std::string misfit(const ProblemFile& f) {
  const CoupledProblem& p = f.problem;
  const std::size_t nc = p.size();
  if (p.bounce.size() != nc || p.friction.size() != nc || p.mass.size() != nc ||
      f.start.size() != nc || f.impulse.size() != nc)
    return fmt::format("free has {} contacts; bounce, friction, mass, start and impulse must too",
                       nc);
  if (p.row_start.size() != nc + 1 || p.row_start.front() != 0 ||
      p.row_start.back() != static_cast<int>(p.column.size()) || p.blocks.size() != p.column.size())
    return "row_start, column and blocks are not compressed rows of a matrix";
  if (const std::string bad = bad_number(f); !bad.empty()) return bad;
  for (std::size_t j = 0; j < nc; ++j) {
    bool diagonal = false;
    if (p.row_start[j + 1] < p.row_start[j] || p.row_start[j + 1] > p.row_start[nc])
      return fmt::format("row_start goes back at row {}", j);
    for (int k = p.row_start[j]; k < p.row_start[j + 1]; ++k) {
      const int l = p.column[at(k)];
      if (l < 0 || l >= static_cast<int>(nc)) return fmt::format("row {} has column {}", j, l);
      if (k > p.row_start[j] && l <= p.column[static_cast<std::size_t>(k) - 1])
        return fmt::format("the columns of row {} do not ascend", j);
      diagonal = diagonal || l == static_cast<int>(j);
    }
    if (!diagonal) return fmt::format("row {} has no diagonal block", j);
    const Block& w = diagonal_block(p, j);
    if (!(w[0] > p.friction[j] * std::abs(w[1]) && w[0] * w[3] > w[1] * w[2] && p.mass[j] > 0.0))
      return fmt::format("contact {}: W_nn > μ|W_nt|, det W > 0 and mass > 0 do not hold", j);
  }
  return {};
}

}  // namespace

void write_problem(const std::filesystem::path& path, const ProblemFile& f) {
  const CoupledProblem& p = f.problem;
  std::ofstream out(path, std::ios::binary);
  out << "{\n"
      << fmt::format("  \"format\": \"{}\",\n", format_name)
      << fmt::format("  \"about\": {},\n", json(f.about).dump())
      << fmt::format("  \"iterations\": {},\n", f.result.iterations)
      << fmt::format("  \"residual\": {},\n", json(f.result.residual).dump())
      << fmt::format("  \"converged\": {},\n", f.result.converged) << array_text("free", p.free)
      << array_text("bounce", p.bounce) << array_text("friction", p.friction)
      << array_text("mass", p.mass) << array_text("row_start", p.row_start)
      << array_text("column", p.column) << array_text("blocks", p.blocks)
      << array_text("start", f.start);
  std::string last = array_text("impulse", f.impulse);
  last.resize(last.size() - 2);  // no comma after it
  out << last << "\n}\n";
  out.flush();
  if (!out) throw FileError(path.string(), "cannot be written");
}

ProblemFile read_problem(const std::filesystem::path& path) {
  demand_regular_file(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path.string(), "cannot be opened");
  ProblemFile f;
  try {
    const json file = json::parse(in);
    if (file.at("format") != format_name)
      throw FileError(path.string(), fmt::format("format is {}, \"{}\" is read",
                                                 file.at("format").dump(), format_name));
    f.about = file.at("about").get<std::string>();
    read_into(file.at("iterations"), f.result.iterations);
    f.result.residual = file.at("residual").get<double>();
    f.result.converged = file.at("converged").get<bool>();
    CoupledProblem& p = f.problem;
    read_array(file, "free", p.free);
    read_array(file, "bounce", p.bounce);
    read_array(file, "friction", p.friction);
    read_array(file, "mass", p.mass);
    read_array(file, "row_start", p.row_start);
    read_array(file, "column", p.column);
    read_array(file, "blocks", p.blocks);
    read_array(file, "start", f.start);
    read_array(file, "impulse", f.impulse);
  } catch (const json::exception& e) {
    throw FileError(path.string(), fmt::format("is not a contact problem: {}", e.what()));
  }
  const std::string wrong = misfit(f);
  if (!wrong.empty()) throw FileError(path.string(), "is not a contact problem: " + wrong);
  return f;
}

}  // namespace rondo::contact
