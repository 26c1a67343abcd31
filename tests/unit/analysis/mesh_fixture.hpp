// SPDX-License-Identifier: BSD-3-Clause
/// @file  Cases of two squares of quadrilaterals in a Gmsh file of their own.
#pragma once
#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <string>

#include "unit/case/case_fixture.hpp"

namespace rondo::study::test {

/// Two squares of side 1, n x n cells each, "left" from x = 0 and "right" from x = 1 + gap; y from
/// 0. Curves "foot" and "top" of both, "skin" all round both.
inline std::string two_squares(double gap, int n = 2) {
  const int line = n + 1, of_one = line * line;
  std::string nodes, elements;
  int count = 0;
  const auto add = [&](int type, int physical, const std::string& corners) {
    elements += fmt::format("{} {} 2 {} {} {}\n", ++count, type, physical, physical, corners);
  };
  for (int s = 0; s < 2; ++s) {
    const auto node = [&](int i, int j) { return s * of_one + j * line + i + 1; };
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        nodes +=
            fmt::format("{} {} {} 0\n", node(i, j), s * (1.0 + gap) + double(i) / n, double(j) / n);
    for (int k = 0; k < n; ++k)
      for (const auto& [curve, a, b] : {std::tuple{1, node(k, 0), node(k + 1, 0)},
                                        std::tuple{2, node(n - k, n), node(n - k - 1, n)},
                                        std::tuple{3, node(k, 0), node(k + 1, 0)},
                                        std::tuple{3, node(n - k, n), node(n - k - 1, n)},
                                        std::tuple{3, node(n, k), node(n, k + 1)},
                                        std::tuple{3, node(0, n - k), node(0, n - k - 1)}})
        add(1, curve, fmt::format("{} {}", a, b));
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        add(3, 4 + s,
            fmt::format("{} {} {} {}", node(i, j), node(i + 1, j), node(i + 1, j + 1),
                        node(i, j + 1)));
  }
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 \"foot\"\n1 2 \"top\"\n"
         "1 3 \"skin\"\n2 4 \"left\"\n2 5 \"right\"\n$EndPhysicalNames\n$Nodes\n" +
         fmt::format("{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n", 2 * of_one, nodes, count,
                     elements);
}

/// The same, each cell in two.
inline std::string two_squares_of_triangles(double gap) {
  const std::string quadrilaterals = two_squares(gap);
  std::istringstream lines(quadrilaterals.substr(quadrilaterals.find("$Elements")));
  std::string elements, line;
  int count = 0;
  std::getline(lines, line);
  std::getline(lines, line);
  while (std::getline(lines, line) && line[0] != '$') {
    int tag = 0, type = 0, tags = 0, physical = 0, a = 0, b = 0, c = 0, d = 0;
    std::istringstream(line) >> tag >> type >> tags >> physical >> physical >> a >> b >> c >> d;
    const auto add = [&](int of_type, const std::string& corners) {
      elements += fmt::format("{} {} 2 {} {} {}\n", ++count, of_type, physical, physical, corners);
    };
    if (type == 1) {
      add(1, fmt::format("{} {}", a, b));
    } else {
      add(2, fmt::format("{} {} {}", a, b, c));
      add(2, fmt::format("{} {} {}", a, c, d));
    }
  }
  return quadrilaterals.substr(0, quadrilaterals.find("$Elements")) +
         fmt::format("$Elements\n{}\n{}$EndElements\n", count, elements);
}

/// The mesh file beside the case, "squares.msh".
class MeshCaseFile {
 public:
  explicit MeshCaseFile(const std::string& text, double gap = 0.1) : case_(text) {
    std::ofstream(mesh(), std::ios::binary) << two_squares(gap);
  }
  [[nodiscard]] Case read(const std::vector<std::string>& settings = {}) const {
    return read_case(case_.path(), settings);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return case_.path(); }
  [[nodiscard]] std::filesystem::path mesh() const {
    return case_.path().parent_path() / "squares.msh";
  }

 private:
  CaseFile case_;
};

/// Lines are counted by tests, from 1.
inline const std::string squares = R"(schema = 1
[mesh]
file = "squares.msh"
contact = "skin"
[material]
youngs_modulus = 1e6
poissons_ratio = 0.3
density = 1000
[time]
end = 0.01
)";

}  // namespace rondo::study::test
