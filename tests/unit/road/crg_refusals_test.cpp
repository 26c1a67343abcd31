// SPDX-License-Identifier: BSD-3-Clause
/// Wrong and damaged road files are refused with file, place and what to do.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <functional>

#include "rondo/core/error.hpp"
#include "rondo/road/crg/crg_reader.hpp"
#include "support/crg_files.hpp"

namespace crg_refusals_test {

using namespace rondo;
using test::CrgFolder;
using test::CrgParts;
using test::missing_height;

CrgParts sound_parts(const std::string& format = "LRFI") {
  CrgParts parts;
  parts.format = format;
  parts.road =
      "REFERENCE_LINE_INCREMENT = 0.5\nREFERENCE_LINE_END_U = 1.0\n"
      "LONG_SECTION_V_INCREMENT = 0.25\n";
  parts.channels = test::numbered_sections(3);
  parts.rows = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  return parts;
}

/// What is said of a file; "" if it is read.
std::string said(const CrgFolder& folder, const std::string& text) {
  const auto file = folder.put("road.crg", text);
  try {
    static_cast<void>(road::read_crg(file));
  } catch (const InputError& error) {
    return error.what();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

void expect_said(const CrgFolder& folder, const std::string& text,
                 const std::vector<std::string>& parts) {
  const std::string message = said(folder, text);
  EXPECT_NE(message.find("road.crg"), std::string::npos)
      << "\"" << message << "\" " << parts.front();
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << message << "\nhas no: " << part;
}

std::string with(const std::function<void(CrgParts&)>& change, const std::string& format = "LRFI") {
  CrgParts parts = sound_parts(format);
  change(parts);
  return crg_of(parts);
}
std::string with_keys(const std::string& keys) {
  return with([&](CrgParts& p) { p.road += keys; });
}
std::string with_block(const std::string& block) {
  return with([&](CrgParts& p) { p.blocks = block; });
}
std::string with_channels(std::vector<std::string> channels) {
  return with([&](CrgParts& p) { p.channels = std::move(channels); });
}

TEST(CrgRefusals, TheSoundFileIsRead) {
  const CrgFolder folder;
  for (const char* const format : {"LRFI", "LDFI", "KRBI", "KDBI"})
    EXPECT_EQ(said(folder, crg_of(sound_parts(format))), "");
}

TEST(CrgRefusals, HeaderByLineAndKey) {
  const CrgFolder folder;
  expect_said(folder, "", {"ends in line 0 without a line that begins with $$"});
  expect_said(folder, with_keys("REFERENCE_LINE_INCREMNT = 1\n"),
              {":8:1: $ROAD_CRG REFERENCE_LINE_INCREMNT = 1", "REFERENCE_LINE_INCREMENT"});
  expect_said(folder, with_keys("REFERENCE_LINE_START_U 0\n"), {":8:1:", "is not KEY = value"});
  expect_said(folder, with_keys("REFERENCE_LINE_START_U = 0,5\n"),
              {":8:1:", "not a finite number"});
  expect_said(folder, with_keys("REFERENCE_LINE_START_U = 1e999\n"),
              {":8:1:", "not a finite number"});
  expect_said(folder, with_keys("REFERENCE_LINE_INCREMENT = 0.25\n"),
              {":8:1:", "line 5 gives the key another value"});
  expect_said(folder, with_keys(std::string(80, ' ') + "REFERENCE_LINE_START_U = 1\n"),
              {":8:1: $ROAD_CRG", "longer than 72 characters"});
  expect_said(folder, with_keys(std::string(5000, ' ')), {":8:1:", "longer than 4095"});
  expect_said(folder, with_block("$ROAD_CRG\n$\n"), {":9:1: $ROAD_CRG", "twice"});
  expect_said(folder, with_block("BORDER_MODE_U = 0\n"), {":9:1:", "outside of a block"});
  expect_said(folder, with_block("$ROAD_CRG_MODES\n$\n"),
              {":9:1: $ROAD_CRG_MODES", "no such block"});
  expect_said(folder, with([](CrgParts& p) { p.format = "KRFI"; }),
              {":10:1: $KD_DEFINITION #:", "LRFI"});
  expect_said(folder, "$CT\n$\n$$$$\n", {":3:1: $ROAD_CRG", "REFERENCE_LINE_INCREMENT"});
  expect_said(folder, "$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 1\n$\n$$\n", {":4:1: $KD_DEFINITION"});
}

TEST(CrgRefusals, RowsAndSections) {
  const CrgFolder folder;
  const auto road_keys = [&](const std::string& keys) {
    return with([&](CrgParts& p) { p.road = keys; });
  };
  expect_said(folder, road_keys("LONG_SECTION_V_INCREMENT = 1\n"),
              {"REFERENCE_LINE_INCREMENT", "missing"});
  expect_said(folder, road_keys("REFERENCE_LINE_INCREMENT = -1\nLONG_SECTION_V_INCREMENT = 1\n"),
              {":5:1:", "no distance of rows"});
  expect_said(folder, road_keys("REFERENCE_LINE_INCREMENT = 1\n"),
              {"LONG_SECTION_V_INCREMENT", "nothing says where they are"});
  expect_said(folder, with_keys("REFERENCE_LINE_START_U = 1\n"), {":6:1:", "no length"});
  expect_said(folder, with_keys("REFERENCE_LINE_START_U = 0.2\n"),
              {":6:1:", "1.6 increments long"});
  expect_said(folder, with_keys("LONG_SECTION_V_LEFT = 0.5\nLONG_SECTION_V_RIGHT = -0.5\n"),
              {":8:1: $ROAD_CRG LONG_SECTION_V_LEFT = 0.5", "v = 0 m"});
  expect_said(folder, with_channels({"long section 1,m", "long section 2,m", "long section 2,m"}),
              {":13:1: $KD_DEFINITION D:", "the number 3 of the 3 long sections"});
  expect_said(folder,
              with_channels({"long section 1,m", "long section 2,m", "long section at v = 1,m"}),
              {":13:1:", "in the other form"});
  expect_said(folder,
              with_channels({"long section at v = 0,m", "long section at v = 1,m",
                             "long section at v = 1.0000001,m"}),
              {":13:1:", "closer than 1e-6 m"});
  expect_said(folder, with_channels({"long section 1,mm", "long section 2,m", "long section 3,m"}),
              {":11:1:", "the unit"});
  expect_said(folder, with_channels({"long section 1.5,m", "long section 2,m", "long section 3,m"}),
              {":11:1:", "names no long section"});
  expect_said(folder, with_channels({"long section 1,m"}), {"1 long sections", "$ROAD_CRG_FILE"});
  expect_said(
      folder,
      with_channels({"reference line phi,rad", "reference line phi,rad", "long section 1,m"}),
      {":12:1:", "line 11 defines this channel too"});
  expect_said(folder,
              with_channels({"reference line slope,%", "long section 1,m", "long section 2,m"}),
              {":11:1:", "m/m"});
}

TEST(CrgRefusals, ModifiersAndOptionsThatAreNotDone) {
  const CrgFolder folder;
  const auto refused = [&](const std::string& block, const std::string& line,
                           const std::vector<std::string>& parts) {
    expect_said(folder, with_block("$" + block + "\n" + line + "\n$\n"), parts);
  };
  refused("ROAD_CRG_OPTS", "BORDER_MODE_U = 5",
          {":10:1: $ROAD_CRG_OPTS BORDER_MODE_U = 5", "0 to 4"});
  refused("ROAD_CRG_OPTS", "BORDER_MODE_V = 1.5", {":10:1:", "0 to 4"});
  refused("ROAD_CRG_OPTS", "BORDER_SMOOTH_UBEG = 2", {"BORDER_SMOOTH_UBEG = 2", "not done"});
  refused("ROAD_CRG_OPTS", "BORDER_SMOOTH_UEND = 2", {"BORDER_SMOOTH_UEND = 2", "not done"});
  refused("ROAD_CRG_OPTS", "REFLINE_CONTINUATION = 1", {"not followed", "BORDER_MODE_U = 3"});
  refused("ROAD_CRG_MODS", "SCALE_Z_GRID = 0", {"the factor 0"});
  refused("ROAD_CRG_MODS", "SCALE_LENGTH = -2", {"a factor > 0"});
  refused("ROAD_CRG_MODS", "SCALE_Z_GRID = 1e7", {"at most 1e+06"});
  refused("ROAD_CRG_MODS", "SCALE_Z = 2", {"SCALE_Z_GRID, or no line"});
  refused("ROAD_CRG_MODS", "GRID_NAN_MODE = 3", {"0 to 2"});
  refused("ROAD_CRG_MODS", "REFPOINT_X = 1\nREFLINE_OFFSET_Z = 1", {"REFPOINT_X in line 10"});
  refused("ROAD_CRG_MODS", "REFPOINT_U = 1\nREFPOINT_U_FRACTION = 1",
          {"REFPOINT_U_FRACTION gives"});
  refused("ROAD_CRG_MODS", "REFLINE_OFFSET_Z = 1e9", {"heights or banking are not in range"});
  refused("ROAD_CRG_MODS", "SCALE_LENGTH = 1e-6", {"in steps of 5e-07 m"});
}

TEST(CrgRefusals, TheReferenceLineMustAgreeWithItsEnd) {
  const CrgFolder folder;
  expect_said(folder, with_keys("REFERENCE_LINE_START_S = 0.1\nREFERENCE_LINE_END_S = 0.2\n"),
              {":9:1:", "REFERENCE_LINE_START_S is 0.1"});
  expect_said(folder, with_keys("REFERENCE_LINE_END_B = 0.2\n"),
              {":8:1:", "REFERENCE_LINE_START_B is 0"});
  expect_said(folder, with_keys("REFERENCE_LINE_START_B = 2\n"), {":8:1:", "at most 1"});
  expect_said(folder, with_keys("REFERENCE_LINE_START_S = 0.1\nREFERENCE_LINE_END_Z = 0.2\n"),
              {":9:1:", "leads to 0.1 m"});
  expect_said(folder, with([](CrgParts& p) {
                p.channels = {"reference line slope,m/m", "long section 1,m", "long section 2,m"};
              }),
              {"row 2 of the data", "slope of the reference line is 4"});
}

TEST(CrgRefusals, References) {
  const CrgFolder folder;
  folder.put("b.crg", "$ROAD_CRG_FILE\nroad.crg\n$\n");
  expect_said(folder, "$ROAD_CRG_FILE\nb.crg\n$\n", {"b.crg:1:1: $ROAD_CRG_FILE", "circle"});
  expect_said(folder, "$ROAD_CRG_FILE\nroad.crg\n$\n", {":1:1:", "circle"});
  expect_said(folder, "$ROAD_CRG_FILE\nno.crg\n$\n",
              {":2:1: $ROAD_CRG_FILE = no.crg", "there is no file"});
  expect_said(folder, "$ROAD_CRG_FILE\n $crgpath/no.crg\n$\n", {":2:1:", "environment variables"});
  expect_said(folder,
              "$ROAD_CRG_FILE\nStra\xDF"
              "e.crg\n$\n",
              {":2:1: $ROAD_CRG_FILE = Stra?e.crg", "ASCII"});
  expect_said(folder, "$ROAD_CRG_FILE\n$\n", {":1:1:", "names no file"});
  EXPECT_NE(said(folder, "$ROAD_CRG_FILE\n.\n$\n").find("is a directory"), std::string::npos);
}

TEST(CrgRefusals, TextDataByLine) {
  const CrgFolder folder;
  const std::string text = crg_of(sound_parts());
  const std::size_t data = text.find("$$$$\n") + 5;  // line 15 follows
  const auto changed = [&](std::size_t at, const std::string& by) {
    std::string other = text;
    return other.replace(data + at, by.size(), by);
  };
  expect_said(folder, changed(10, " 2.0,00000"), {"line 16", "characters 11 to 20, \"2.0,00000\""});
  expect_said(folder, changed(10, " 2e7      "), {"line 16", "below 1e5"});
  expect_said(folder, changed(10, "       inf"), {"line 16", "not a number"});
  expect_said(folder, changed(41, " *missing*"), {"row 2 of the data", "v = 0 m", "fill it"});
  expect_said(folder, text + " 0.0000000 0.0000000 0.0000000\n",
              {"line 19", "follow the last of 3 rows"});
  expect_said(folder, text.substr(0, data + 62), {"line 17", "after 2 of 3 rows"});
  expect_said(folder, text.substr(0, data + 70), {"line 18", "the file ends within a row"});
  expect_said(folder, text.substr(0, data + 82), {"line 18", "the file ends within a row"});
  expect_said(folder, text.substr(0, data + 82) + "\n", {"line 18", "2 numbers where 3 belong"});
  expect_said(folder, text.substr(0, data + 30) + " 0.0" + text.substr(data + 30),
              {"line 16", "more than 3 numbers"});
  const double m = missing_height;
  expect_said(folder, with([&](CrgParts& p) {
                p.rows[1] = {m, m, m};
              }),
              {"row 2 of the data", "all heights are missing"});
}

TEST(CrgRefusals, BinaryDataBySizeAndByte) {
  const CrgFolder folder;
  for (const char* const format : {"KRBI", "KDBI"}) {
    const std::string text = crg_of(sound_parts(format));
    const std::size_t data = text.find("$$$$\n") + 5;
    expect_said(folder, text.substr(0, text.size() - 60), {"too few: 3 rows of 3 numbers"});
    expect_said(folder, text + "abc", {"3 too many"});
    EXPECT_EQ(said(folder, text + "\n"), "");
    std::string wild = text;
    wild[data + (format[1] == 'R' ? 4 : 8)] = '\x7E';
    expect_said(folder, wild, {fmt::format("byte {}", data + (format[1] == 'R' ? 4 : 8))});
  }
  const CrgParts parts = sound_parts("KRBI");
  std::string no_end = crg_header(parts);
  no_end.erase(no_end.find("REFERENCE_LINE_END_U"), 27);
  expect_said(folder, no_end + crg_binary_data(parts).substr(1),
              {"79 bytes, no multiple of the 80"});
  EXPECT_EQ(said(folder, no_end + crg_binary_data(parts)), "");
}

/// 64 columns of numbers among whose bytes there are all pairs, CR LF too.
CrgParts parts_with_all_bytes() {
  CrgParts parts;
  parts.format = "KRBI";
  parts.road =
      "REFERENCE_LINE_INCREMENT = 0.5\nREFERENCE_LINE_END_U = 199.5\n"
      "LONG_SECTION_V_INCREMENT = 0.25\n";
  parts.channels = test::numbered_sections(64);
  for (std::uint32_t i = 0; i < 400; ++i) {
    parts.rows.emplace_back();
    for (std::uint32_t j = 0; j < 64; ++j) {
      const std::uint32_t bits = 0x3C000000U | (i * 64 + j) << 4U | (i + j) % 11U;
      parts.rows.back().push_back(static_cast<double>(std::bit_cast<float>(bits)));
    }
  }
  parts.rows[3][5] = static_cast<double>(std::bit_cast<float>(0x3C0D0A00U));
  return parts;
}

TEST(CrgRefusals, AConversionOfLineEndsIsSuspected) {
  const CrgFolder folder;
  const CrgParts parts = parts_with_all_bytes();
  const std::string data = crg_binary_data(parts);
  EXPECT_EQ(said(folder, crg_header(parts) + data), "");
  std::string eaten, grown;
  for (std::size_t k = 0; k < data.size(); ++k) {
    if (!(data[k] == '\r' && k + 1 < data.size() && data[k + 1] == '\n')) eaten += data[k];
    if (data[k] == '\n') grown += '\r';
    grown += data[k];
  }
  ASSERT_LT(eaten.size(), data.size());
  expect_said(folder, crg_header(parts) + eaten,
              {"too few", "has probably eaten bytes", "binary mode"});
  expect_said(folder, crg_header(parts) + grown,
              {"too many", "has probably added bytes", "binary mode"});
}

long peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/// A header that promises a billion rows of a thousand numbers costs nothing.
TEST(CrgRefusals, HugeCountsAskForNoMemory) {
  const CrgFolder folder;
  for (const char* const format : {"LRFI", "KDBI"}) {
    CrgParts parts = sound_parts(format);
    parts.road =
        "REFERENCE_LINE_INCREMENT = 0.001\nREFERENCE_LINE_END_U = 1e6\n"
        "LONG_SECTION_V_INCREMENT = 0.001\n";
    parts.channels = test::numbered_sections(1000);
    const long before = peak_kilobytes();
    const std::string message = said(folder, crg_of(parts));
    EXPECT_FALSE(message.empty());
    EXPECT_LT(peak_kilobytes() - before, 10'000) << message;
  }
  expect_said(folder, with_keys("REFERENCE_LINE_START_U = -1e308\n"), {"so far from u = 0"});
}

}  // namespace crg_refusals_test
