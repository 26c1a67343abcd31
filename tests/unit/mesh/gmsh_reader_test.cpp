// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/mesh/gmsh_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "rondo/core/error.hpp"
#include "rondo/mesh/mesh_check.hpp"
#include "support/msh_files.hpp"

namespace gmsh_reader_test {

using namespace rondo;
using namespace rondo::mesh;
using test::Msh;
using test::squares;
using test::TemporaryFile;

namespace {

/// Gmsh divides a curve by an integral along it that it takes to about this.
constexpr double division = 1e-9;

const std::filesystem::path meshes = RONDO_TEST_MESHES, cases = RONDO_CASE_MESHES;

Mesh read(const std::filesystem::path& file, const std::string& contact = "",
          const std::vector<std::string>& clamped = {}) {
  ReadMesh got = read_gmsh({.file = file, .clamped = clamped, .contact = contact});
  for (const std::string& warning : got.warnings) ADD_FAILURE() << warning;
  return std::move(got.mesh);
}

ReadMesh read_text(const Msh& msh, MeshRequest request = {}) {
  const TemporaryFile file(msh.text());
  request.file = file.path();
  return read_gmsh(request);
}

Vec2 at(const Mesh& m, int node) {
  return m.coordinates[static_cast<std::size_t>(node)];
}

double total(const std::vector<double>& lengths) {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

const Curve& curve(const Mesh& m, const std::string& name) {
  const auto found = std::ranges::find(m.curves, name, &Curve::name);
  if (found == m.curves.end()) throw std::runtime_error("no curve " + name);
  return *found;
}

/// Text files have 16 digits, so that the last of a coordinate may differ.
void expect_same(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.n_nodes(), b.n_nodes());
  for (std::size_t k = 0; k < a.n_nodes(); ++k)
    EXPECT_LE(norm(a.coordinates[k] - b.coordinates[k]), 4e-16 * norm(a.coordinates[k]));
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.clamped, b.clamped);
  EXPECT_EQ(a.boundary, b.boundary);
  EXPECT_EQ(a.contact_edges, b.contact_edges);
  EXPECT_EQ(a.region, b.region);
  EXPECT_EQ(a.region_names, b.region_names);
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t k = 0; k < a.curves.size(); ++k) {
    EXPECT_EQ(a.curves[k].name, b.curves[k].name);
    EXPECT_EQ(a.curves[k].edges, b.curves[k].edges);
  }
}

}  // namespace

TEST(ReadGmsh, TheFourFormsGiveTheSameMesh) {
  const auto take = [](const char* name) {
    return read_gmsh({.file = meshes / name,
                      .clamped = {"6"},
                      .contact = "skin",
                      .curves = {"top"},
                      .surfaces = {"right"}});
  };
  const ReadMesh first = take("mixed-22.msh");
  EXPECT_EQ(first.mesh.n_nodes(), 28U);
  EXPECT_EQ(first.mesh.cells.size(), 27U);
  EXPECT_EQ(first.mesh.curves.size(), 5U);
  for (const char* name : {"mixed-22-binary.msh", "mixed-41.msh", "mixed-41-binary.msh"}) {
    SCOPED_TRACE(name);
    const ReadMesh other = take(name);
    expect_same(first.mesh, other.mesh);
    EXPECT_EQ(first.warnings, other.warnings);
  }
}

TEST(ReadGmsh, CellsAndRegions) {
  const Mesh m = read_gmsh({.file = meshes / "mixed-41.msh"}).mesh;
  EXPECT_EQ(m.region_names, (std::vector<std::string>{"left", "right"}));
  double area[2] = {0.0, 0.0};
  for (std::size_t e = 0; e < m.cells.size(); ++e) {
    const Cell& c = m.cells[e];
    EXPECT_EQ(n_corners(c), m.region[e] == 0 ? 4 : 3);
    for (int a = 2; a < n_corners(c); ++a)
      area[m.region[e]] += 0.5 * cross(at(m, c[static_cast<std::size_t>(a - 1)]) - at(m, c[0]),
                                       at(m, c[static_cast<std::size_t>(a)]) - at(m, c[0]));
  }
  EXPECT_NEAR(area[0], 1.0, 1e-14);  // 20 additions of rounded products
  EXPECT_NEAR(area[1], 1.0, 1e-14);
  EXPECT_EQ(m.n_sectors, 0);
  EXPECT_TRUE(m.clamped.empty() && m.boundary.empty() && m.contact_edges.empty());
  EXPECT_EQ(find_bodies(m).count, 1);
}

TEST(ReadGmsh, CurvesHaveTheBodyOnTheLeft) {
  const Mesh m = read_gmsh({.file = meshes / "mixed-41.msh"}).mesh;
  for (const auto& [name, along] : std::vector<std::pair<std::string, Vec2>>{
           {"foot", {1, 0}}, {"top", {-1, 0}}, {"6", {0, -1}}})
    for (const Edge& edge : curve(m, name).edges)
      EXPECT_GT(dot(at(m, edge[1]) - at(m, edge[0]), along), 0.3) << name;
  EXPECT_EQ(curve(m, "seam").edges.size(), 3U) << "between two surfaces: kept";
  EXPECT_EQ(curve(m, "skin").edges.size(), 9U) << "in two curves: in both";
}

TEST(ReadGmsh, CandidatesInOrder) {
  const Mesh m = read_gmsh({.file = meshes / "mixed-41.msh", .contact = "skin"}).mesh;
  ASSERT_EQ(m.boundary.size(), 10U);
  EXPECT_EQ(at(m, m.boundary.front()), (Vec2{0, 0}));
  EXPECT_EQ(at(m, m.boundary.back()), (Vec2{2, 1}));
  ASSERT_EQ(m.contact_edges.size(), 9U);
  for (std::size_t k = 0; k < 9; ++k)
    EXPECT_EQ(m.contact_edges[k], (Edge{m.boundary[k], m.boundary[k + 1]}));
  EXPECT_NEAR(m.tributary.front(), 1.0 / 6.0, division);
  EXPECT_NEAR(m.tributary[4], 1.0 / 3.0, division);
  EXPECT_NEAR(total(m.tributary), 3.0, 1e-14);  // the corners are exact
}

TEST(ReadGmsh, ClosedCurve) {
  const Mesh m = read(cases / "disk-solid.msh", "tread");
  ASSERT_EQ(m.boundary.size(), 60U);
  EXPECT_EQ(m.contact_edges.size(), 60U);
  EXPECT_EQ(m.boundary.front(), *std::ranges::min_element(m.boundary));
  EXPECT_EQ(m.contact_edges.back(), (Edge{m.boundary.back(), m.boundary.front()}));
  for (const double length : m.tributary)  // chords of 6 degrees
    EXPECT_NEAR(length, 0.6 * std::sin(std::numbers::pi / 60), division);
}

TEST(ReadGmsh, ClampedNodesAreNoCandidates) {
  const ReadMesh got =
      read_gmsh({.file = meshes / "mixed-41.msh", .clamped = {"6"}, .contact = "foot"});
  const Mesh& m = got.mesh;
  EXPECT_EQ(m.clamped.size(), 4U);
  EXPECT_TRUE(std::ranges::is_sorted(m.clamped));
  for (const int node : m.clamped) EXPECT_EQ(at(m, node).x, 0.0);
  EXPECT_EQ(m.boundary.size(), 6U);
  EXPECT_EQ(m.contact_edges.size(), 5U);
  EXPECT_NEAR(m.tributary.front(), 1.0 / 3.0, division)
      << "with its half of the edge to the corner";
  ASSERT_EQ(got.warnings.size(), 2U);
  EXPECT_NE(got.warnings[1].find("1 nodes of the contact curve \"foot\" are clamped"),
            std::string::npos);
  EXPECT_NE(got.warnings[1].find("(0, 0)"), std::string::npos);
}

TEST(ReadGmsh, ScaleOfLengths) {
  const Mesh m = read_text(squares(), {.scale = 0.001, .contact = "top"}).mesh;
  EXPECT_EQ(at(m, 7), (Vec2{0.003, 0.001}));
  EXPECT_NEAR(total(m.tributary), 0.003, 1e-18);
}

TEST(ReadGmsh, AllCellsClockwiseAreTurned) {
  Msh msh = squares();
  for (int k = 0; k < 3; ++k)
    msh.elements[static_cast<std::size_t>(6 + k)] =
        fmt::format("3 2 3 1 {} {} {} {}", k + 1, k + 5, k + 6, k + 2);
  const ReadMesh got = read_text(msh, {.contact = "foot"});
  EXPECT_EQ(check_cells(got.mesh).count(), 0U);
  EXPECT_EQ(got.mesh.contact_edges.front(), (Edge{0, 1}));
  ASSERT_EQ(got.warnings.size(), 1U);
  EXPECT_NE(got.warnings[0].find("clockwise"), std::string::npos);
}

TEST(ReadGmsh, AnyHeightWillDo) {
  Msh msh = squares();
  for (std::string& node : msh.nodes) node.back() = '7';
  EXPECT_EQ(read_text(msh).mesh.cells.size(), 3U);
}

TEST(ReadGmsh, NodesOfNoCellAreDropped) {
  for (const bool by_41 : {false, true}) {
    Msh msh = squares();
    msh.nodes.insert(msh.nodes.begin() + 2, "9 9 0");
    for (std::string& element : msh.elements) {  // the tags from 3 on move by one
      std::string moved;
      const auto words = element.find(' ', element.find(' ', 4) + 1);
      moved = element.substr(0, words);
      for (std::size_t k = words; k < element.size(); k += 2) {
        const int tag = element[k + 1] - '0';
        moved += fmt::format(" {}", tag > 2 ? tag + 1 : tag);
      }
      element = moved;
    }
    if (by_41) msh.elements.push_back("15 2 9 9 3");  // a point keeps its node in the library
    const ReadMesh got = read_text(msh);
    EXPECT_EQ(got.mesh.n_nodes(), 8U);
    EXPECT_EQ(at(got.mesh, 2), (Vec2{2, 0}));
    ASSERT_EQ(got.warnings.size(), 1U);
    EXPECT_EQ(got.warnings[0], "1 of 9 nodes are in no cell and are left out");
  }
}

TEST(ReadGmsh, WithoutPhysicalGroups) {
  Msh msh = squares();
  msh.names.clear();
  for (std::string& element : msh.elements) element.replace(2, 3, "2 0");
  const Mesh m = read_text(msh).mesh;
  EXPECT_TRUE(m.region.empty() && m.region_names.empty() && m.curves.empty());
}

TEST(ReadGmsh, CellsInNoSurfaceAreARegionWithoutName) {
  Msh msh = squares();
  msh.elements[8].replace(2, 5, "2 0 2");
  const Mesh m = read_text(msh).mesh;
  EXPECT_EQ(m.region_names, (std::vector<std::string>{"block", ""}));
  EXPECT_EQ(m.region, (std::vector<int>{0, 0, 1}));
}

TEST(ReadGmsh, NodesAtOnePlaceOfTheBoundaryAreAWarning) {
  Msh msh = squares();  // the third square with nodes of its own where it meets the second
  msh.nodes.push_back("2 0 0");
  msh.nodes.push_back("2 1 0");
  msh.elements[2] = "1 2 1 1 9 4";
  msh.elements[5] = "1 2 2 2 10 8";
  msh.elements[8] = "3 2 3 1 9 4 8 10";
  const ReadMesh got = read_text(msh, {.contact = "foot"});
  EXPECT_EQ(find_bodies(got.mesh).count, 2);
  EXPECT_EQ(got.mesh.boundary.size(), 5U);
  ASSERT_EQ(got.warnings.size(), 1U);
  EXPECT_NE(got.warnings[0].find("2 nodes of the boundary lie where another node is: node 3 and "
                                 "node 9 at (2, 0), node 7 and node 10 at (2, 1)"),
            std::string::npos)
      << got.warnings[0];
  EXPECT_NE(got.warnings[0].find("Coherence Mesh"), std::string::npos);
}

TEST(ReadGmsh, LinesOfOtherCurvesThatAreNoEdgesAreLeftOut) {
  Msh msh = squares();
  msh.names.push_back("1 8 \"axis\"");
  msh.elements.push_back("1 2 8 8 1 6");
  const ReadMesh got = read_text(msh);
  EXPECT_EQ(got.mesh.curves.size(), 2U);
  ASSERT_EQ(got.warnings.size(), 1U);
  EXPECT_NE(got.warnings[0].find("\"axis\" are no edge of a cell: line 10 from (0, 0)"),
            std::string::npos)
      << got.warnings[0];
}

TEST(ReadGmsh, MeshesOfTheCases) {
  const Mesh block = read(cases / "block.msh", "foot", {"top"});
  EXPECT_EQ(block.cells.size(), 100U);
  EXPECT_EQ(block.boundary.size(), 11U);
  EXPECT_EQ(block.clamped.size(), 11U);
  const Mesh bar = read(cases / "bar.msh", "foot");
  EXPECT_EQ(bar.cells.size(), 100U);
  EXPECT_NEAR(total(bar.tributary), 0.1, 1e-15);
  const Mesh disks = read(cases / "two-disks.msh", "tread");
  EXPECT_EQ(find_bodies(disks).count, 2);
  EXPECT_EQ(disks.boundary.size(), 80U);
  EXPECT_EQ(disks.region_names, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(curve(disks, "left-tread").edges.size(), 40U);
  const Mesh tyre = read(cases / "tyre-section.msh", "tread", {"rim"});
  EXPECT_EQ(find_bodies(tyre).count, 1);
  EXPECT_EQ(tyre.region_names,
            (std::vector<std::string>{"sidewall", "carcass", "belt", "tread-rubber"}));
  EXPECT_EQ(tyre.contact_edges.size(), 320U);  // a block: 4 on top, 2 on each wall
  EXPECT_EQ(tyre.clamped.size(), 60U);
}

}  // namespace gmsh_reader_test
