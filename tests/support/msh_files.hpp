// SPDX-License-Identifier: BSD-3-Clause
/// Small Gmsh files (MSH 2.2, text) for tests.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace rondo::test {

/// A file that exists as long as the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text, const std::string& ending = ".msh") {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            fmt::format("rondo-test-{}-{}{}", getpid(), count++, ending);
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

struct Msh {
  std::vector<std::string> names;     ///< dimension number "name"
  std::vector<std::string> nodes;     ///< x y z; tags from 1
  std::vector<std::string> elements;  ///< type 2 physical elementary node ...; tags from 1

  [[nodiscard]] std::string text() const {
    std::string all = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n";
    all += fmt::format("{}\n", names.size());
    for (const std::string& name : names) all += name + "\n";
    all += fmt::format("$EndPhysicalNames\n$Nodes\n{}\n", nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) all += fmt::format("{} {}\n", k + 1, nodes[k]);
    all += fmt::format("$EndNodes\n$Elements\n{}\n", elements.size());
    for (std::size_t k = 0; k < elements.size(); ++k)
      all += fmt::format("{} {}\n", k + 1, elements[k]);
    return all + "$EndElements\n";
  }
};

/// Three unit squares in a row, 0 <= x <= 3: nodes 1 to 4 below, 5 to 8 above. Elements 1 to 3 form
/// "foot" (curve 1), 4 to 6 "top" (curve 2), 7 to 9, the squares, "block" (surface 3).
inline Msh squares() {
  Msh msh;
  msh.names = {"1 1 \"foot\"", "1 2 \"top\"", "2 3 \"block\""};
  for (const int y : {0, 1})
    for (int x = 0; x < 4; ++x) msh.nodes.push_back(fmt::format("{} {} 0", x, y));
  for (int k = 1; k < 4; ++k) msh.elements.push_back(fmt::format("1 2 1 1 {} {}", k, k + 1));
  for (int k = 5; k < 8; ++k) msh.elements.push_back(fmt::format("1 2 2 2 {} {}", k, k + 1));
  for (int k = 1; k < 4; ++k)
    msh.elements.push_back(fmt::format("3 2 3 1 {} {} {} {}", k, k + 1, k + 5, k + 4));
  return msh;
}

}  // namespace rondo::test
