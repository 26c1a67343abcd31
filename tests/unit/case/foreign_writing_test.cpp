// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/numbers/foreign_writing.hpp"

#include <gtest/gtest.h>

namespace rondo::study::foreign_writing_test {
namespace {

TEST(ForeignWriting, OfAValueIsNamedWithWhatToWrite) {
  EXPECT_EQ(foreign_writing("0,3"), "it has a decimal comma: write 0.3");
  EXPECT_EQ(foreign_writing(" -1,25e-3 "), "it has a decimal comma: write -1.25e-3");
  EXPECT_EQ(foreign_writing("1.5D+03"),
            "it has an exponent with D, as Fortran writes it: write 1.5e+03");
  EXPECT_EQ(foreign_writing("2d7"), "it has an exponent with D, as Fortran writes it: write 2e7");
  EXPECT_EQ(foreign_writing("\u22120.3"), "it has the minus sign U+2212 where - is to stand");
  EXPECT_EQ(foreign_writing("\u201Cflat\u201D"),
            "it has the curly quotation mark U+201C where \" is to stand");
  EXPECT_EQ(foreign_writing("2\u00A0000"), "it has the space U+00A0 where a space is to stand");
}

TEST(ForeignWriting, WhatIsRightOrSomethingElseHasNoCause) {
  for (const char* text : {"", "-", "0.3", "1e3", "flat", "0,3,4", ",3", "3,", "1d", "d3", "1,2 3",
                           "bump.csv", "1e3d", "Stra\u00DFe"})
    EXPECT_EQ(foreign_writing(text), "") << text;
}

TEST(ForeignWriting, OfALineStringsAndCommentsAreNotLookedAt) {
  EXPECT_EQ(foreign_writing_in_line("friction = 0,3"), "it has a decimal comma: write 0.3");
  EXPECT_EQ(foreign_writing_in_line("height = [[0, 0.3], [1, 2d-1]]"),
            "it has an exponent with D, as Fortran writes it: write 2e-1");
  EXPECT_EQ(foreign_writing_in_line("title = \"a \u2013 b\\\" \u2212\" # \u2212"), "");
  EXPECT_EQ(foreign_writing_in_line("title = '\u2013' + \u2013"),
            "it has the dash U+2013 where - is to stand");
  EXPECT_EQ(foreign_writing_in_line("profile = [[0,3], [1,4]]"), "");
}

TEST(ForeignWriting, ACommaBetweenDigitsMayBeMeantAsAPoint) {
  EXPECT_NE(cause_in_items("[0, 0,3]"), "");
  EXPECT_EQ(cause_in_items("[0, 1, 2]"), "");
  EXPECT_TRUE(begins_with_foreign_minus("\u22121"));
  EXPECT_FALSE(begins_with_foreign_minus("-1"));
}

}  // namespace
}  // namespace rondo::study::foreign_writing_test
