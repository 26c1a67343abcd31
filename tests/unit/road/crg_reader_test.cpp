// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "rondo/road/surface.hpp"
#include "support/crg_files.hpp"

namespace crg_reader_test {

using namespace rondo;
using namespace rondo::road;
using test::CrgFolder;
using test::CrgParts;
using test::missing_height;

/// Heights that are exact in single precision and have seven digits in text: multiples of 2^-7.
double height_at(std::size_t i, std::size_t j) {
  return static_cast<double>((i * 37 + j * 101 + i * j) % 61) / 128.0 - 0.25;
}

CrgParts small_parts(const std::string& format, std::size_t n_u = 9, std::size_t n_v = 5) {
  CrgParts parts;
  parts.format = format;
  parts.road =
      "REFERENCE_LINE_START_U = 2.0\nREFERENCE_LINE_INCREMENT = 0.5\n"
      "LONG_SECTION_V_RIGHT = -0.5\nLONG_SECTION_V_INCREMENT = 0.25\n";
  parts.channels = test::numbered_sections(n_v);
  for (std::size_t i = 0; i < n_u; ++i) {
    parts.rows.emplace_back();
    for (std::size_t j = 0; j < n_v; ++j) parts.rows.back().push_back(height_at(i, j));
  }
  return parts;
}

void expect_small_road(const Road& road, std::size_t n_u = 9, std::size_t n_v = 5) {
  ASSERT_EQ(road.n_u(), n_u);
  ASSERT_EQ(road.n_v(), n_v);
  EXPECT_EQ(road.u_first, 2.0);
  EXPECT_EQ(road.u_step, 0.5);
  EXPECT_EQ(road.u_last(), 2.0 + 0.5 * static_cast<double>(n_u - 1));
  for (std::size_t j = 0; j < n_v; ++j) EXPECT_EQ(road.v[j], -0.5 + 0.25 * static_cast<double>(j));
  for (std::size_t i = 0; i < n_u; ++i)
    for (std::size_t j = 0; j < n_v; ++j)
      EXPECT_EQ(road.heights[i * n_v + j], height_at(i, j)) << i << " " << j;
}

TEST(CrgReader, EachFormatGivesTheDigitsOfTheFile) {
  const CrgFolder folder;
  for (const char* const format : {"LRFI", "LDFI", "KRBI", "KDBI"})
    for (const std::size_t n_v : {2U, 5U, 8U, 11U, 43U}) {  // rows of one record and of several
      SCOPED_TRACE(fmt::format("{} {}", format, n_v));
      const Road road = read_crg(folder.put("a.crg", crg_of(small_parts(format, 9, n_v))));
      expect_small_road(road, 9, n_v);
      EXPECT_EQ(road.format, format);
      EXPECT_TRUE(road.notes.empty());
    }
}

/// With the end of the line the number of rows is promised, and the same road comes out.
TEST(CrgReader, PromisedRowsAreRead) {
  const CrgFolder folder;
  for (const char* const format : {"LRFI", "LDFI", "KRBI", "KDBI"}) {
    CrgParts parts = small_parts(format);
    parts.road += "REFERENCE_LINE_END_U = 6.0\n";
    expect_small_road(read_crg(folder.put("a.crg", crg_of(parts))));
  }
}

/// Numbers that text and single precision round: to the digits that were written.
TEST(CrgReader, RoundedNumbersAreThoseOfTheFile) {
  const CrgFolder folder;
  CrgParts parts = small_parts("LRFI", 2, 2);
  parts.rows = {{0.12345678, -0.5}, {1.0 / 3.0, 0.1}};
  EXPECT_EQ(read_crg(folder.put("a.crg", crg_of(parts))).heights,
            (std::vector<double>{0.1234568, -0.5, 0.3333333, 0.1}));
  parts.format = "KRBI";
  EXPECT_EQ(read_crg(folder.put("b.crg", crg_of(parts))).heights[2],
            static_cast<double>(static_cast<float>(1.0 / 3.0)));
  parts.format = "KDBI";
  EXPECT_EQ(read_crg(folder.put("c.crg", crg_of(parts))).heights[2], 1.0 / 3.0);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

TEST(CrgReader, LineEndsCaseBlanksAndCommentsDoNotMatter) {
  const CrgFolder folder;
  const std::string text = crg_of(small_parts("LRFI"));
  expect_small_road(read_crg(folder.put("a.crg", replaced(text, "\n", "\r\n"))));
  std::string lower = text;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  expect_small_road(read_crg(folder.put("b.crg", lower)));
  std::string commented =
      replaced(text, "$ROAD_CRG\n", "$ROAD_CRG   ! M\xFCnchen \xDF\n* a comment of a line\n\n");
  commented = replaced(commented, " = 0.5\n", "\t=  +5.0D-01   ! half\n");
  commented = replaced(commented, "D:long section", "D:  Long   Section ");
  expect_small_road(read_crg(folder.put("c.crg", commented)));
  // Binary data after a header with both line ends.
  const CrgParts parts = small_parts("KRBI");
  expect_small_road(read_crg(
      folder.put("d.crg", replaced(crg_header(parts), "\n", "\r\n") + crg_binary_data(parts))));
  // Real files have exponents with the sign before the letter.
  expect_small_road(read_crg(folder.put("e.crg", replaced(text, " = 0.25\n", " = 0.25+e00\n"))));
}

TEST(CrgReader, NoFormatLineMeansSingleBinary) {
  const CrgFolder folder;
  const Road road =
      read_crg(folder.put("a.crg", replaced(crg_of(small_parts("KRBI")), "#:KRBI\n", "")));
  expect_small_road(road);
  EXPECT_EQ(road.format, "KRBI");
}

TEST(CrgReader, ExplicitPositionsInAnyOrder) {
  const CrgFolder folder;
  CrgParts parts;
  parts.road =
      "REFERENCE_LINE_INCREMENT = 2\nLONG_SECTION_V_RIGHT = -1.5\nLONG_SECTION_V_LEFT = 1.25\n";
  parts.channels = {"long section at v = 1.250,m", "long section at v = -1.500,m",
                    "long section at v =0.0,m"};
  parts.rows = {{3, 1, 2}, {6, 4, 5}};
  for (const char* const format : {"LRFI", "KDBI"}) {
    parts.format = format;
    const Road road = read_crg(folder.put("a.crg", crg_of(parts)));
    EXPECT_EQ(road.v, (std::vector<double>{-1.5, 0.0, 1.25}));
    EXPECT_EQ(road.heights, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  }
}

TEST(CrgReader, NumberedSectionsLieSymmetricallyOrFromOneBorder) {
  const CrgFolder folder;
  CrgParts parts = small_parts("LRFI", 2, 4);
  const auto v_with = [&](const std::string& keys) {
    parts.road = "REFERENCE_LINE_INCREMENT = 1\n" + keys;
    return read_crg(folder.put("a.crg", crg_of(parts))).v;
  };
  EXPECT_EQ(v_with("LONG_SECTION_V_INCREMENT = 0.5\n"),
            (std::vector<double>{-0.75, -0.25, 0.25, 0.75}));
  EXPECT_EQ(v_with("LONG_SECTION_V_INCREMENT = 0.5\nLONG_SECTION_V_LEFT = 1.5\n"),
            (std::vector<double>{0.0, 0.5, 1.0, 1.5}));
  EXPECT_EQ(v_with("LONG_SECTION_V_RIGHT = -3\nLONG_SECTION_V_LEFT = 3\n"),
            (std::vector<double>{-3, -1, 1, 3}));
}

/// OpenCRG: missing heights at the edges of a row only; the last valid one stands for them by
/// default.
TEST(CrgReader, MissingHeightsStayAndAreFilledByTheMode) {
  const CrgFolder folder;
  const double m = missing_height;
  for (const char* const format : {"LRFI", "LDFI", "KRBI", "KDBI"}) {
    SCOPED_TRACE(format);
    CrgParts parts = small_parts(format, 3, 4);
    parts.rows = {{m, 1, 2, m}, {m, m, 3, 4}, {5, 6, 7, 8}};
    const auto heights_with = [&](const std::string& blocks, const Edges& edges = {}) {
      parts.blocks = blocks;
      const Road road = read_crg(folder.put("a.crg", crg_of(parts)));
      EXPECT_TRUE(std::isnan(road.heights[0]) && std::isnan(road.heights[3]) &&
                  std::isnan(road.heights[5]));
      const Surface surface(road, edges);
      std::vector<double> whole;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) whole.push_back(surface.height_at(i, j));
      return whole;
    };
    EXPECT_EQ(heights_with(""), (std::vector<double>{1, 1, 2, 2, 3, 3, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(heights_with("$ROAD_CRG_MODS\nGRID_NAN_MODE = 2\nGRID_NAN_OFFSET = 0.5\n$\n"),
              (std::vector<double>{1.5, 1, 2, 2.5, 3.5, 3.5, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(heights_with("$ROAD_CRG_MODS\nGRID_NAN_MODE = 1\nGRID_NAN_OFFSET = 10\n$\n"),
              (std::vector<double>{10, 1, 2, 10, 10, 10, 3, 4, 5, 6, 7, 8}));
    // A block of modifiers without the mode: outside of the road, so the border rules.
    EXPECT_EQ(heights_with("$ROAD_CRG_MODS\n$\n"),
              (std::vector<double>{1, 1, 2, 2, 3, 3, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(heights_with("$ROAD_CRG_MODS\n$\n", {.v = Border::zero, .offset_v = -1}),
              (std::vector<double>{-1, 1, 2, -1, -1, -1, 3, 4, 5, 6, 7, 8}));
    EXPECT_TRUE(std::isnan(heights_with("$ROAD_CRG_MODS\n$\n", {.v = Border::none})[0]));
  }
}

/// z = grid + height of the line + banking v, where the line rises by the slope of the row times
/// the increment, and the first slope is not used.
TEST(CrgReader, SlopeAndBankingChannels) {
  const CrgFolder folder;
  CrgParts parts = small_parts("LDFI", 4, 3);
  parts.road =
      "REFERENCE_LINE_START_Z = 7\nREFERENCE_LINE_INCREMENT = 0.5\n"
      "LONG_SECTION_V_INCREMENT = 2\n";
  parts.channels = {"reference line phi,rad",     "reference line slope,m/m",
                    "reference line banking,m/m", "long section 1,m",
                    "long section 2,m",           "long section 3,m"};
  const double m = missing_height;
  parts.rows = {{m, m, 0.0, 0, 0, 0},
                {0.1, 0.5, 0.25, 1, 1, 1},
                {0.2, -0.25, 0.5, 0, 0, 0},
                {0.3, 1.0, -0.5, 0, 1, 0}};
  const Road road = read_crg(folder.put("a.crg", crg_of(parts)));
  EXPECT_EQ(road.line_height, (std::vector<double>{7.0, 7.25, 7.125, 7.625}));
  EXPECT_EQ(road.banking, (std::vector<double>{0.0, 0.25, 0.5, -0.5}));
  EXPECT_EQ(road.heading[3], 0.3);
  const Surface surface(road);
  EXPECT_EQ(surface.height_at(0, 0), 7.0);
  EXPECT_EQ(surface.height_at(1, 0), 7.25 + 1.0 - 2.0 * 0.25);
  EXPECT_EQ(surface.height_at(2, 2), 7.125 + 2.0 * 0.5);
  EXPECT_EQ(surface.height_at(3, 1), 7.625 + 1.0);
  // Halfway between the rows both line and banking are the means.
  EXPECT_NEAR(surface.bilinear(0.75, 2.0), 7.1875 + 0.5 + 2.0 * 0.375, 1e-15);
}

TEST(CrgReader, AHeightAtTheEndSpreadsTheErrorOfTheSlope) {
  const CrgFolder folder;
  CrgParts parts;
  parts.road =
      "REFERENCE_LINE_INCREMENT = 1\nLONG_SECTION_V_INCREMENT = 1\nREFERENCE_LINE_END_Z = 0.5\n";
  parts.channels = {"reference line slope,m/m", "long section 1,m", "long section 2,m"};
  parts.rows = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0}};
  const Road road = read_crg(folder.put("a.crg", crg_of(parts)));
  ASSERT_EQ(road.notes.size(), 1U);
  EXPECT_NE(road.notes[0].find("differs by 0.1 m"), std::string::npos) << road.notes[0];
  EXPECT_EQ(road.line_height.front(), 0.0);
  EXPECT_NEAR(road.line_height[1], 0.75 * 0.1 + 0.25 * 0.2, 1e-15);
  EXPECT_NEAR(road.line_height.back(), 0.5, 1e-15);
}

/// A plane road by constant slope and banking: the surfaces are exact.
TEST(CrgReader, APlaneRoadIsAPlane) {
  const CrgFolder folder;
  CrgParts parts = small_parts("LRFI", 9, 5);
  for (auto& row : parts.rows) std::ranges::fill(row, 0.5);
  parts.road +=
      "REFERENCE_LINE_START_S = 0.08\nREFERENCE_LINE_END_S = 0.08\n"
      "REFERENCE_LINE_START_B = -0.05\nREFERENCE_LINE_START_Z = 1\n";
  const Surface surface(read_crg(folder.put("a.crg", crg_of(parts))));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(2.0, 6.0), across(-0.5, 0.5);
  for (int k = 0; k < 200; ++k) {
    const double u = along(random), v = across(random);
    const double z = 1.5 + 0.08 * (u - 2.0) - 0.05 * v;
    EXPECT_NEAR(surface.bilinear(u, v), z, 1e-14);
    const SurfacePoint point = surface.at(u, v);
    EXPECT_NEAR(point.height, z, 1e-8);  // slopes of the patches have single precision
    EXPECT_NEAR(point.slope_u, 0.08, 2e-8);
    EXPECT_NEAR(point.slope_v, -0.05, 2e-8);
    EXPECT_NEAR(point.bend_uu, 0.0, 1e-6);
  }
}

TEST(CrgReader, ModifiersScaleAndShift) {
  const CrgFolder folder;
  CrgParts parts = small_parts("LRFI", 3, 3);
  parts.road =
      "REFERENCE_LINE_START_U = 10\nREFERENCE_LINE_INCREMENT = 1\nLONG_SECTION_V_INCREMENT = 1\n"
      "REFERENCE_LINE_START_S = 0.1\nREFERENCE_LINE_START_B = 0.2\n";
  parts.rows = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  parts.blocks =
      "$ROAD_CRG_MODS\nSCALE_Z_GRID = 2\nSCALE_SLOPE = 3\nSCALE_BANKING = 0.5\n"
      "SCALE_LENGTH = 4\nSCALE_WIDTH = 10\nREFLINE_OFFSET_Z = -1\nREFLINE_OFFSET_X = 5\n"
      "SCALE_CURVATURE = 0\n$\n";
  const Road road = read_crg(folder.put("a.crg", crg_of(parts)));
  EXPECT_EQ(road.u_first, 10.0);
  EXPECT_EQ(road.u_step, 4.0);
  EXPECT_EQ(road.v, (std::vector<double>{-10, 0, 10}));
  const Surface surface(road);
  // Twice the grid, thrice the slope over four times the length, half of the banking.
  EXPECT_NEAR(surface.height_at(2, 2), 18.0 + 0.3 * 8.0 + 0.1 * 10.0 - 1.0, 1e-14);
  // A reference point gets the height that is asked for.
  parts.blocks =
      "$ROAD_CRG_MODS\nREFPOINT_U_FRACTION = 0.75\nREFPOINT_V = 0.5\nREFPOINT_Z = 100\n$\n";
  const Surface shifted(read_crg(folder.put("b.crg", crg_of(parts))));
  EXPECT_NEAR(shifted.bilinear(11.5, 0.5), 100.0, 1e-12);
  EXPECT_NEAR(shifted.bilinear(10.0, -1.0) - shifted.bilinear(12.0, 1.0), 1.0 - 9.0 - 0.2 - 0.4,
              1e-12);
}

TEST(CrgReader, OptionsAreTheEdges) {
  const CrgFolder folder;
  CrgParts parts = small_parts("LRFI");
  EXPECT_EQ(read_crg(folder.put("a.crg", crg_of(parts))).edges.u, Border::keep);
  parts.blocks =
      "$ROAD_CRG_OPTS\nBORDER_MODE_U = 3\nBORDER_MODE_V = 1.0\nBORDER_OFFSET_V = 0.25\n"
      "REFLINE_CONTINUATION = 0\nBORDER_SMOOTH_UBEG = 0\nLOG_EVAL = 20\nLOG_EVAL = 20\n$\n";
  const Edges edges = read_crg(folder.put("b.crg", crg_of(parts))).edges;
  EXPECT_EQ(edges.u, Border::repeat);
  EXPECT_EQ(edges.v, Border::zero);
  EXPECT_EQ(edges.offset_u, 0.0);
  EXPECT_EQ(edges.offset_v, 0.25);
}

/// The first file that has a block of modifiers or options decides, even with an empty one.
TEST(CrgReader, ReferencesAreFollowed) {
  const CrgFolder folder;
  CrgParts parts = small_parts("KRBI");
  parts.blocks = "$ROAD_CRG_MODS\nSCALE_Z_GRID = 2\n$\n$ROAD_CRG_OPTS\nBORDER_MODE_U = 4\n$\n";
  folder.put("data/road.crg", crg_of(parts));
  const auto through = [&](const std::string& blocks) {
    return read_crg(folder.put("here/first.crg",
                               "$CT\n$\n$ROAD_CRG_FILE\n* in two lines\n  ../data/\n"
                               "road.crg ! here\n$\n" +
                                   blocks));
  };
  EXPECT_EQ(through("").heights[0], 2.0 * height_at(0, 0));
  EXPECT_EQ(through("").edges.u, Border::reflect);
  EXPECT_EQ(through("$ROAD_CRG_MODS\n$\n").heights[0], height_at(0, 0));
  EXPECT_EQ(through("$ROAD_CRG_MODS\n$\n").edges.u, Border::reflect);
  EXPECT_EQ(through("$ROAD_CRG_OPTS\nBORDER_MODE_V = 0\n$\n").edges.u, Border::keep);
  EXPECT_NE(through("").file.find("data/road.crg"), std::string::npos);
}

TEST(CrgReader, AChannelOfPositionsGivesTheRows) {
  const CrgFolder folder;
  CrgParts parts;
  parts.road = "REFERENCE_LINE_INCREMENT = 0.25\nLONG_SECTION_V_INCREMENT = 1\n";
  parts.channels = {"reference line u,m", "long section 1,m", "long section 2,m", "friction,1"};
  parts.rows = {{5.0, 1, 2, 0.9}, {5.25, 3, 4, 0.9}, {5.5, 5, 6, 0.9}};
  const Road road = read_crg(folder.put("a.crg", crg_of(parts)));
  EXPECT_EQ(road.u_first, 5.0);
  EXPECT_EQ(road.u_step, 0.25);
  EXPECT_EQ(road.heights, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(road.notes.size(), 1U);
  EXPECT_NE(road.notes[0].find("\"D:friction,1\""), std::string::npos);
}

}  // namespace crg_reader_test
