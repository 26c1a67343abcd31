// SPDX-License-Identifier: BSD-3-Clause
/// Files that say more than they hold, or less, and files of other writers than Gmsh.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "rondo/core/error.hpp"
#include "rondo/mesh/gmsh_reader.hpp"
#include "support/msh_files.hpp"

namespace gmsh_contents_test {

using namespace rondo;
using mesh::MeshRequest;
using mesh::ReadMesh;
using test::Msh;
using test::squares;
using test::TemporaryFile;

namespace {

ReadMesh read(const std::string& text, MeshRequest request = {}) {
  const TemporaryFile file(text);
  request.file = file.path();
  return read_gmsh(request);
}

std::string refusal_of(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

void expect_refused(const std::string& text, const std::string& words) {
  const std::string said = refusal_of(text);
  EXPECT_NE(said.find(words), std::string::npos) << "not there: " << words << "\nsaid: " << said;
}

std::string with(std::string text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.replace(at, before.size(), after);
}

std::string everywhere(std::string text, const std::string& before, const std::string& after) {
  for (std::size_t at = 0; (at = text.find(before, at)) != std::string::npos; at += after.size())
    text.replace(at, before.size(), after);
  return text;
}

bool warns(const ReadMesh& read, const std::string& words) {
  return std::ranges::any_of(read.warnings, [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

/// squares() as MSH 4.1: "foot" (curve 1, group 1), "block" (surface 1, group 3).
const std::string head_41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n2\n1 1 \"foot\"\n2 3 \"block\"\n$EndPhysicalNames\n";
const std::string entities_41 =
    "$Entities\n0 1 1 0\n1 0 0 0 3 0 0 1 1 0\n1 0 0 0 3 1 0 1 3 0\n$EndEntities\n";
const std::string nodes_41 =
    "$Nodes\n1 8 1 8\n2 1 0 8\n1\n2\n3\n4\n5\n6\n7\n8\n"
    "0 0 0\n1 0 0\n2 0 0\n3 0 0\n0 1 0\n1 1 0\n2 1 0\n3 1 0\n$EndNodes\n";
const std::string elements_41 =
    "$Elements\n2 6 1 6\n1 1 1 3\n1 1 2\n2 2 3\n3 3 4\n"
    "2 1 3 3\n4 1 2 6 5\n5 2 3 7 6\n6 3 4 8 7\n$EndElements\n";
const std::string squares_41 = head_41 + entities_41 + nodes_41 + elements_41;

/// Two parts of a mesh, as gmsh -part 2 writes them: two squares are of part 1, one of part 2, with
/// a line between them that has the group of its surface.
const std::string parts_41 =
    head_41 + with(entities_41, "0 1 1 0", "0 1 1 0") +
    "$PartitionedEntities\n2\n0\n0 3 2 0\n"
    "2 1 1 1 1 0 0 0 2 0 0 1 1 0\n3 1 1 1 2 2 0 0 3 0 0 1 1 0\n"
    "4 2 1 2 1 2 2 0 0 2 1 0 1 3 0\n"
    "2 2 1 1 1 0 0 0 2 1 0 1 3 0\n3 2 1 1 2 2 0 0 3 1 0 1 3 0\n$EndPartitionedEntities\n" +
    nodes_41 +
    "$Elements\n5 7 1 7\n1 2 1 2\n1 1 2\n2 2 3\n1 3 1 1\n3 3 4\n1 4 1 1\n4 3 7\n"
    "2 2 3 2\n5 1 2 6 5\n6 2 3 7 6\n2 3 3 1\n7 3 4 8 7\n$EndElements\n";

}  // namespace

// Counts --------------------------------------------------------------------------------------

TEST(GmshContents, CountsOf22) {
  const std::string text = squares().text();
  ASSERT_EQ(read(text).mesh.cells.size(), 3U);
  expect_refused(with(text, "$Elements\n9", "$Elements\n8"),
                 "line 31: $Elements says 8 elements, and goes on after them with \"9 3 2 3 1");
  expect_refused(with(text, "$Elements\n9", "$Elements\n10"),
                 "$Elements says 10 elements, and ends after 9");
  expect_refused(with(text, "$Nodes\n8", "$Nodes\n7"),
                 "$Nodes says 7 nodes, and goes on after them with \"8 3 1 0\"");
  expect_refused(with(text, "$Nodes\n8", "$Nodes\n9"), "$Nodes says 9 nodes, and ends after 8");
  expect_refused(with(text, "$PhysicalNames\n3", "$PhysicalNames\n2"),
                 "$PhysicalNames says 2 names, and goes on after them with \"2 3");
  expect_refused(with(text, "$PhysicalNames\n3", "$PhysicalNames\n4"),
                 "$PhysicalNames says 4 names, and ends after 3");
}

TEST(GmshContents, CountsOf41) {
  ASSERT_EQ(read(squares_41).mesh.cells.size(), 3U);
  expect_refused(with(squares_41, "$Elements\n2 6", "$Elements\n1 6"),
                 "$Elements says 1 blocks, and goes on after them with \"2 1 3 3\"");
  expect_refused(with(squares_41, "$Elements\n2 6", "$Elements\n3 6"),
                 "$Elements says 3 blocks, and ends after 2");
  expect_refused(with(squares_41, "$Elements\n2 6", "$Elements\n2 5"),
                 "$Elements says 5 elements, and its 2 blocks have 6");
  expect_refused(with(squares_41, "2 1 3 3\n4", "2 1 3 2\n4"), "goes on after them with \"6 3 4");
  expect_refused(with(squares_41, "6 1 6", "6 1 5"), "$Elements says tags from 1 to 5, and has 6");
  expect_refused(with(squares_41, "$Nodes\n1 8", "$Nodes\n1 7"),
                 "$Nodes says 7 nodes, and its 1 blocks have 8");
  expect_refused(with(squares_41, "0 1 1 0", "0 1 0 0"), "goes on after them with \"1 0 0 0 3 1");
  expect_refused(with(squares_41, "0 1 1 0", "0 1 2 0"), "and ends after 2");
}

TEST(GmshContents, SectionsThatAreThereTwice) {
  const std::string text = squares().text();
  const auto section = [&](const std::string& name) {
    const std::size_t start = text.find("$" + name), end = text.find("$End" + name);
    return text.substr(start, end - start) + "$End" + name + "\n";
  };
  for (const std::string name : {"Nodes", "Elements", "PhysicalNames"})
    expect_refused(text + section(name), "$" + name + " is there twice");
}

TEST(GmshContents, NumbersThatAreThereTwice) {
  const std::string text = squares().text();
  expect_refused(with(text, "\n8 3 2 3 1", "\n7 3 2 3 1"), "two elements have the number 7");
  expect_refused(with(text, "\n4 3 0 0", "\n3 3 0 0"), "two nodes have the number 3");
  expect_refused(with(squares_41, "\n5 2 3 7 6", "\n4 2 3 7 6"), "two elements have the number 4");
}

TEST(GmshContents, LinesOfAnotherLength) {
  const std::string text = squares().text();
  expect_refused(with(text, "1 2 6 5\n", "1 2 6 5 5\n"),
                 "line 29: a line of $Elements has too many numbers");
  expect_refused(with(text, "1 2 6 5\n", "1 2 6\n"), "has too few numbers");
  expect_refused(with(text, "\n2 1 0 0", "\n2 1,0 0 0"), "has \"1,0\" where a number should be");
  expect_refused(with(text, "\n2 1 0 0", "\n2 1.0D0 0 0"),
                 "has \"1.0D0\" where a number should be");
}

TEST(GmshContents, CountsOfBinaryFiles) {
  std::string all = "$MeshFormat\n2.2 1 8\n";
  const auto put = [&](auto number) {
    all.append(std::bit_cast<std::array<char, sizeof number>>(number).data(), sizeof number);
  };
  put(1);
  all += "\n$EndMeshFormat\n$Nodes\n4\n";
  for (int k = 0; k < 4; ++k) {
    put(k + 1);
    for (const double x : {double(k == 1 || k == 2), double(k > 1), 0.0}) put(x);
  }
  const std::string head = all + "\n$EndNodes\n$Elements\n";
  all.clear();
  for (const int number : {2, 2, 2, 1, 0, 1, 1, 2, 3, 2, 0, 1, 1, 3, 4}) put(number);
  const std::string body = all + "\n$EndElements\n";
  EXPECT_EQ(read(head + "2\n" + body).mesh.cells.size(), 2U);
  expect_refused(head + "1\n" + body, "says 1 elements, and after 0 of them a block of 2");
  expect_refused(head + "3\n" + body, "cannot be read");
  expect_refused(with(head, "$Nodes\n4", "$Nodes\n3") + "2\n" + body, "says 3 nodes, and goes on");
}

// Physical groups -----------------------------------------------------------------------------

TEST(GmshContents, OneNameOfTwoGroupsIsOneGroup) {
  Msh msh = squares();
  msh.names[1] = "1 2 \"foot\"";  // as well as 1 1: the library would forget that "2" is one
  const ReadMesh got = read(msh.text(), {.contact = "foot"});
  EXPECT_EQ(got.mesh.boundary.size(), 8U);
  EXPECT_TRUE(warns(got, "2 physical curves have the name \"foot\" (numbers 1, 2)"));
}

TEST(GmshContents, TwoNamesOfOneGroup) {
  Msh msh = squares();
  msh.names[1] = "1 1 \"top\"";
  expect_refused(msh.text(), "the physical curve 1 has two names, \"foot\" and \"top\"");
  msh.names[1] = msh.names[0];
  EXPECT_EQ(refusal_of(msh.text()), "taken");
}

TEST(GmshContents, NamesWithoutQuotationMarks) {
  expect_refused(with(squares().text(), "\"foot\"", "foot"),
                 "the name of the physical curve 1, in the line before, is not in quotation marks");
}

TEST(GmshContents, SurfacesThatAreNotSaved) {
  const std::string text = with(with(squares_41, "0 1 1 0", "0 1 2 0"), "1 3 0\n$EndE",
                                "1 3 0\n2 3 0 0 4 1 0 0 0\n$EndE");
  EXPECT_TRUE(warns(read(text),
                    "1 of 2 surfaces of the geometry have no elements in the file and "
                    "are not part of the body: surface 2"));
}

TEST(GmshContents, GroupsTurnedRound) {
  for (const std::string& text : {everywhere(squares().text(), " 3 2 3 1 ", " 3 2 -3 1 "),
                                  with(squares_41, "3 1 0 1 3 0", "3 1 0 1 -3 0")}) {
    const ReadMesh got = read(text, {.surfaces = {"block"}});
    EXPECT_EQ(got.mesh.region_names, std::vector<std::string>{"block"});
  }
}

TEST(GmshContents, GroupsOfOneElementaryTag) {
  Msh msh = squares();
  msh.names.push_back("2 4 \"other\"");
  msh.elements.back().replace(4, 1, "4");
  expect_refused(msh.text(), "another elementary tag");
}

// Meshes in parts -----------------------------------------------------------------------------

TEST(GmshContents, AllPartsAreJoined) {
  const ReadMesh got = read(parts_41, {.contact = "foot", .surfaces = {"block"}});
  EXPECT_EQ(got.mesh.cells.size(), 3U);
  EXPECT_EQ(got.mesh.boundary.size(), 4U);
  EXPECT_EQ(got.mesh.curves.size(), 1U) << "not the line between the parts";
  EXPECT_TRUE(warns(got, "the mesh is in 2 parts"));
  EXPECT_EQ(got.warnings.size(), 1U);
}

TEST(GmshContents, OnePartOfTwo) {
  std::string text = with(parts_41, "$Elements\n5 7 1 7", "$Elements\n4 6 1 6");
  text = with(text, "2 3 3 1\n7 3 4 8 7\n", "");
  expect_refused(text, "was split into 2 parts, and the file has elements of part 1 alone");
}

TEST(GmshContents, GhostsAreLeftOut) {
  std::string text = with(parts_41, "$PartitionedEntities\n2\n0\n0 3 2 0",
                          "$PartitionedEntities\n2\n1\n4 1\n0 3 3 0");
  text =
      with(text, "$EndPartitionedEntities", "4 2 1 1 1 0 0 0 2 1 0 0 0\n$EndPartitionedEntities");
  text += "$GhostElements\n1\n7 2 1 1\n$EndGhostElements\n";
  const ReadMesh got = read(text, {.contact = "foot"});
  EXPECT_EQ(got.mesh.cells.size(), 3U);
  EXPECT_TRUE(warns(got, "copies of elements for other parts (gmsh -part_ghosts) are left out"));
}

TEST(GmshContents, PartsOf22) {
  Msh msh = squares();
  for (std::string& element : msh.elements)  // "type 4 physical elementary 1 1 nodes"
    element = element.substr(0, 2) + "4" + element.substr(3, 5) + "1 1 " + element.substr(8);
  expect_refused(msh.text(), "MSH 2.2 does not tell whether all of them are here");
}

// Other writers -------------------------------------------------------------------------------

TEST(GmshContents, OtherSpacing) {
  for (const std::string& text :
       {everywhere(squares().text(), "\n", "\r\n"), everywhere(squares_41, "\n", "\r\n"),
        everywhere(squares().text(), " ", "   "), everywhere(squares_41, " ", "  "),
        everywhere(squares_41, "\n", " \n")}) {
    const ReadMesh got = read(text, {.contact = "foot", .surfaces = {"block"}});
    EXPECT_EQ(got.mesh.cells.size(), 3U);
    EXPECT_EQ(got.mesh.boundary.size(), 4U);
    EXPECT_TRUE(got.warnings.empty());
  }
}

/// Elementary tags of 0, as of writers that know no geometry: one physical group a dimension.
TEST(GmshContents, WithoutGeometry) {
  Msh msh = squares();
  msh.elements.erase(msh.elements.begin() + 3, msh.elements.begin() + 6);
  for (std::string& element : msh.elements) element.replace(6, 1, "0");
  const ReadMesh got = read(msh.text(), {.contact = "foot", .surfaces = {"block"}});
  EXPECT_EQ(got.mesh.cells.size(), 3U);
  EXPECT_EQ(got.mesh.boundary.size(), 4U);
  for (std::string& element : msh.elements) element.replace(2, 5, "0");
  EXPECT_EQ(read(msh.text()).mesh.cells.size(), 3U) << "no tags at all";
}

TEST(GmshContents, WithoutNames) {
  std::string text = squares().text();
  const std::size_t start = text.find("$PhysicalNames"), end = text.find("$Nodes");
  text.erase(start, end - start);
  const ReadMesh got = read(text, {.contact = "1", .surfaces = {"3"}});
  EXPECT_EQ(got.mesh.boundary.size(), 4U);
}

TEST(GmshContents, NumbersWithGaps) {
  std::string text = everywhere(squares().text(), "\n8 3 1 0", "\n4000000 3 1 0");
  text = with(with(text, " 7 8\n", " 7 4000000\n"), "4 8 7\n", "4 4000000 7\n");
  const ReadMesh got = read(with(text, "\n9 3 2", "\n90000 3 2"), {.contact = "foot"});
  EXPECT_EQ(got.mesh.cells.size(), 3U);
  EXPECT_EQ(got.mesh.n_nodes(), 8U);
}

TEST(GmshContents, WithoutEntities) {
  expect_refused(head_41 + nodes_41 + elements_41,
                 "is on the surface 1, which no $Entities before it has");
  expect_refused(head_41 + nodes_41 + elements_41 + entities_41,
                 "which no $Entities before it has");
}

TEST(GmshContents, OtherSectionsDoNotMatter) {
  const std::string text = squares().text();
  EXPECT_EQ(
      read(text + "$NodeData\n1\n\"u\"\n1\n0\n3\n0\n1\n1\n1 0.5\n$EndNodeData\n").mesh.cells.size(),
      3U);
  expect_refused(text + "$Periodic\n3\n", "the file is cut: there is no $EndPeriodic");
}

}  // namespace gmsh_contents_test
