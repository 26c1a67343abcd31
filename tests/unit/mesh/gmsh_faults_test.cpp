// SPDX-License-Identifier: BSD-3-Clause
/// Each fault of a mesh is named with the numbers of its file, its place and what to do.
#include <gtest/gtest.h>

#include <cmath>

#include "rondo/core/error.hpp"
#include "rondo/mesh/gmsh_reader.hpp"
#include "support/msh_files.hpp"

namespace gmsh_faults_test {

using namespace rondo;
using mesh::MeshRequest;
using test::Msh;
using test::squares;
using test::TemporaryFile;

namespace {

using Words = std::vector<std::string>;

std::string refusal_of(const std::string& text, MeshRequest request) {
  const TemporaryFile file(text);
  request.file = file.path();
  try {
    static_cast<void>(mesh::read_gmsh(request));
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) {
      EXPECT_EQ(fault.file, file.path());
      EXPECT_FALSE(fault.allowed.empty()) << fault.message;
    }
    return error.what();
  }
  return "taken";
}

void expect_refused(const std::string& text, const Words& words, const MeshRequest& request = {}) {
  const std::string said = refusal_of(text, request);
  for (const std::string& word : words)
    EXPECT_NE(said.find(word), std::string::npos) << "not there: " << word << "\nsaid: " << said;
}

void expect_refused(const Msh& msh, const Words& words, const MeshRequest& request = {}) {
  expect_refused(msh.text(), words, request);
}

constexpr std::size_t first_square = 6;

}  // namespace

// Cells ---------------------------------------------------------------------------------------

TEST(GmshFaults, InvertedCell) {
  Msh msh = squares();
  msh.elements[first_square + 1] = "3 2 3 1 2 6 7 3";
  expect_refused(msh, {"1 cells are inverted", "element 8 at (1.5, 0.5)"});
}

TEST(GmshFaults, InvertedSurface) {
  Msh msh = squares();
  msh.elements[first_square + 1] = "3 2 3 17 2 6 7 3";
  expect_refused(msh, {"1 cells are inverted", "ReverseMesh Surface{17}"});
}

TEST(GmshFaults, PlacesAreThoseOfTheFile) {
  Msh msh = squares();
  msh.elements[first_square + 1] = "3 2 3 1 2 6 7 3";
  expect_refused(msh, {"at (1.5, 0.5)"}, {.scale = 0.001});
}

TEST(GmshFaults, CellsWithoutArea) {
  Msh msh = squares();
  msh.elements.push_back("2 2 3 1 1 2 3");
  msh.elements.push_back("3 2 3 1 1 2 4 3");
  expect_refused(msh, {"2 cells have no area", "element 11 at (1.5, 0)", "element 10 at (1, 0)"});
}

TEST(GmshFaults, CellsThatAreNotConvex) {
  Msh msh = squares();
  msh.nodes[6] = "1.2 0.1 0";  // node 7, the upper corner between the second and the third square
  expect_refused(msh, {"1 cells are not convex", "element 8", "180 degrees"});
}

TEST(GmshFaults, OneNodeAtTwoCorners) {
  Msh msh = squares();
  msh.elements[first_square] = "3 2 3 1 1 2 2 5";
  expect_refused(msh, {"1 cells have one node at two corners", "element 7"});
}

TEST(GmshFaults, CellTwice) {
  Msh msh = squares();
  msh.elements.push_back("3 2 3 1 6 5 1 2");
  expect_refused(msh, {"1 cells are there twice", "element 10 at (0.5, 0.5)", "of element 7"});
}

TEST(GmshFaults, ThreeCellsOnAnEdge) {
  Msh msh = squares();
  msh.nodes.push_back("1.5 0.8 0");
  msh.elements.push_back("2 2 3 1 2 9 6");
  expect_refused(msh, {"1 edges have more than one cell on one side", "the one at (1, 0.5)",
                       "of elements 10, 7, 8"});
}

TEST(GmshFaults, FoldedMesh) {
  Msh msh = squares();
  msh.nodes.push_back("0.5 0.5 0");
  msh.elements.push_back("2 2 3 1 1 2 9");  // over the first square, on the same side of its foot
  expect_refused(msh, {"folded", "the one at (0.5, 0) of elements"});
}

TEST(GmshFaults, NodeInsideAtThePlaceOfAnother) {
  Msh msh;  // four triangles about node 5, and a fifth one of its own with a corner there
  msh.nodes = {"0 0 0",     "1 0 0",     "1 1 0",     "0 1 0",
               "0.5 0.5 0", "0.5 0.5 0", "0.4 0.7 0", "0.3 0.5 0"};
  msh.elements = {"2 2 0 1 1 2 5", "2 2 0 1 2 3 5", "2 2 0 1 3 4 5", "2 2 0 1 4 1 5",
                  "2 2 0 1 6 7 8"};
  expect_refused(msh, {"1 nodes inside the mesh lie where another node is",
                       "node 5 and node 6 at (0.5, 0.5)", "Coherence Mesh"});
}

TEST(GmshFaults, ManyOfAKindAreCounted) {
  Msh msh = squares();
  for (int k = 0; k < 30; ++k) msh.elements.push_back("2 2 3 1 1 2 3");
  expect_refused(msh, {"30 cells have no area", "element 10 ", "element 14 ", " and 25 more"});
  EXPECT_EQ(refusal_of(msh.text(), {}).find("element 15 "), std::string::npos);
}

TEST(GmshFaults, SeveralKindsAtOnce) {
  Msh msh = squares();
  msh.elements[first_square + 1] = "3 2 3 1 2 6 7 3";
  msh.elements.push_back("2 2 3 1 1 2 3");
  expect_refused(msh, {"inverted", "no area", "no physical curve of this name"},
                 {.contact = "tread"});
}

// Nodes ---------------------------------------------------------------------------------------

TEST(GmshFaults, NotPlane) {
  Msh msh = squares();
  msh.nodes[2] = "2 0 0.25";
  expect_refused(msh, {"not plane", "1 nodes are off z = 0", "node 3 at (2, 0) with z = 0.25"});
}

TEST(GmshFaults, NodesNowhere) {
  Msh msh = squares();
  msh.nodes[2] = "nan 0 0";
  msh.nodes[5] = "1 1e300 0";
  expect_refused(msh, {"2 nodes are nowhere", "node 3 at (nan, 0)", "node 6 at (1, 1e+300)"});
}

TEST(GmshFaults, NodesThatAreMissing) {
  Msh msh = squares();
  msh.elements[first_square] = "3 2 3 1 1 2 99 5";
  expect_refused(msh, {"cannot be read", "99"});
}

// Elements ------------------------------------------------------------------------------------

TEST(GmshFaults, SecondOrder) {
  Msh msh = squares();
  msh.nodes.insert(msh.nodes.end(), {"0.5 0 0", "0.5 0.5 0", "0 0.5 0"});
  msh.elements.push_back("9 2 3 1 1 2 5 9 10 11");
  expect_refused(
      msh, {"1 elements of type \"Triangle 6\"", "element 10 at (0, 0)", "Mesh.ElementOrder = 1"});
}

TEST(GmshFaults, Volumes) {
  Msh msh = squares();
  msh.nodes.push_back("0 0 1");
  msh.elements.push_back("4 2 9 9 1 2 5 9");
  expect_refused(msh, {"volume elements", "1 elements of type \"Tetrahedron 4\"", "element 10"});
}

TEST(GmshFaults, NoCells) {
  Msh msh = squares();
  msh.elements.resize(first_square);
  expect_refused(msh, {"no triangles and no quadrilaterals",
                       "every surface of the body must be in a physical surface",
                       "Physical Surface(\"body\")"});
}

// Physical groups -----------------------------------------------------------------------------

TEST(GmshFaults, MissingGroups) {
  expect_refused(
      squares(),
      {"clamped = \"rim\": there is no physical curve of this name", "contact = \"fooot\"",
       "curves \"foot\", \"top\"; surfaces \"block\"", "did you mean \"foot\"?",
       "curve = \"liner\"", "surface = \"blok\": there is no physical surface",
       "did you mean \"block\"?", "in the .geo: Physical Curve(\"rim\") = {1, 2};",
       "Physical Surface(\"blok\")"},
      {.clamped = {"rim"}, .contact = "fooot", .curves = {"liner"}, .surfaces = {"blok"}});
}

TEST(GmshFaults, GroupOfAnotherDimension) {
  Msh msh = squares();
  msh.names.push_back("0 4 \"corner\"");
  msh.elements.push_back("15 2 4 1 1");
  expect_refused(msh,
                 {"contact = \"block\": this is a physical surface, not a curve",
                  "clamped = \"corner\": this is a physical point, not a curve",
                  "surface = \"foot\": this is a physical curve, not a surface"},
                 {.clamped = {"corner"}, .contact = "block", .surfaces = {"foot"}});
}

TEST(GmshFaults, GroupWithoutElements) {
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 2 \"foot\"\n$EndPhysicalNames\n"
      "$Entities\n0 1 1 0\n1 0 0 0 1 0 0 1 2 0\n1 0 0 0 1 1 0 0 0\n$EndEntities\n"
      "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"
      "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n";
  expect_refused(text, {"contact = \"foot\": this physical curve has no elements"},
                 {.contact = "foot"});
}

TEST(GmshFaults, ContactInsideTheBody) {
  Msh msh = squares();
  msh.names.push_back("1 8 \"seam\"");
  msh.elements.push_back("1 2 8 8 2 6");
  const Words words{"1 lines of the physical curve \"seam\" are not on the boundary",
                    "line 10 from (1, 0)"};
  expect_refused(msh, words, {.contact = "seam"});
  expect_refused(msh, words, {.curves = {"seam"}});
  EXPECT_EQ(refusal_of(msh.text(), {.clamped = {"seam"}}), "taken");
}

TEST(GmshFaults, CurveThatIsNoEdgeOfACell) {
  Msh msh = squares();
  msh.names.push_back("1 8 \"axis\"");
  msh.elements.push_back("1 2 8 8 1 6");
  for (const MeshRequest& request :
       {MeshRequest{.clamped = {"axis"}}, MeshRequest{.contact = "axis"}})
    expect_refused(
        msh,
        {"1 lines of the physical curve \"axis\" are no edge of a cell", "line 10 from (0, 0)"},
        request);
}

TEST(GmshFaults, AllCandidatesClamped) {
  expect_refused(squares(), {"all nodes of the contact curve \"top\" are clamped"},
                 {.clamped = {"top"}, .contact = "top"});
}

TEST(GmshFaults, CellInTwoSurfaces) {
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
      "$PhysicalNames\n2\n2 1 \"tyre\"\n2 2 \"belt\"\n$EndPhysicalNames\n"
      "$Entities\n0 0 1 0\n5 0 0 0 1 1 0 2 1 2 0\n$EndEntities\n"
      "$Nodes\n1 3 1 3\n2 5 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"
      "$Elements\n1 1 1 1\n2 5 2 1\n1 1 2 3\n$EndElements\n";
  const Words words{"more than one physical surface", "surface 5 is in \"tyre\" and \"belt\""};
  expect_refused(text, words);
  // MSH 2.2 has the cell once for each.
  Msh msh = squares();
  msh.names.push_back("2 9 \"all\"");
  msh.elements.push_back("3 2 9 5 3 4 8 7");
  msh.elements[first_square + 2] = "3 2 3 5 3 4 8 7";
  expect_refused(msh, {"more than one physical surface", "surface 5 is in \"block\" and \"all\""});
  EXPECT_EQ(refusal_of(msh.text(), {}).find("twice"), std::string::npos);
}

TEST(GmshFaults, CurvesThatShareAnElementaryTag) {
  Msh msh = squares();  // the library would put all six lines into both curves
  for (std::size_t k = 3; k < first_square; ++k) msh.elements[k].replace(2, 5, "2 2 1");
  expect_refused(msh, {"have the same elementary tag", "curve 1", "MSH 4.1"});
}

// Files ---------------------------------------------------------------------------------------

TEST(GmshFaults, NotAMesh) {
  expect_refused("", {"is empty", "MSH 2.2 or 4.1"});
  expect_refused("Point(1) = {0, 0, 0};\n", {"no Gmsh mesh", "$MeshFormat"});
  expect_refused("x $MeshFormat\n4.1 0 8\n", {"no Gmsh mesh"});
  expect_refused("$MeshFormat\n4.0 0 8\n$EndMeshFormat\n", {"format \"4.0\", which is not read"});
  expect_refused("$MeshFormat\n", {"format \"\""});
}

TEST(GmshFaults, NoScriptIsRun) {
  const TemporaryFile trace("");
  std::filesystem::remove(trace.path());
  const std::string script = "SystemCall \"touch " + trace.path().string() + "\";\n";
  expect_refused(script, {"no Gmsh mesh"});
  expect_refused("$Comments\n" + script, {"no Gmsh mesh"});
  EXPECT_NE(refusal_of(squares().text() + script, {}), "");
  EXPECT_FALSE(std::filesystem::exists(trace.path()));
}

TEST(GmshFaults, CutAnywhere) {
  const std::string text = squares().text();
  const std::size_t end = text.find("$EndElements");
  for (std::size_t n = text.find("$Nodes") + 7; n < end; n += 61)
    EXPECT_NE(refusal_of(text.substr(0, n), {}), "taken") << n;
  expect_refused(text.substr(0, end - 2), {"the file is cut: there is no $EndElements"});
}

TEST(GmshFaults, AbsurdCounts) {
  for (const std::string count : {"1000000000000", "2147483647", "-1"})
    for (const std::string section : {"$Nodes\n8\n", "$Elements\n9\n"}) {
      std::string text = squares().text();
      const std::size_t at = text.find(section);
      text.replace(at + section.size() - 2, 1, count);
      const std::string said = refusal_of(text, {});
      EXPECT_TRUE(said.find("cannot be read") != std::string::npos ||
                  said.find("no triangles") != std::string::npos)  // taken for a count of none
          << said;
    }
}

TEST(GmshFaults, FilesThatCannotBeOpened) {
  EXPECT_THROW(static_cast<void>(mesh::read_gmsh({.file = "/no/such.msh"})), FileError);
  EXPECT_THROW(static_cast<void>(mesh::read_gmsh({.file = "/"})), FileError);
  EXPECT_THROW(static_cast<void>(mesh::read_gmsh({.file = "/dev/zero"})), FileError);
}

TEST(GmshFaults, ScaleOfNoUse) {
  for (const double scale : {0.0, -1.0, std::nan(""), HUGE_VAL})
    expect_refused(squares(), {"scale = ", "> 0"}, {.scale = scale});
}

}  // namespace gmsh_faults_test
