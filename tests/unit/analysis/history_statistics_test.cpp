// SPDX-License-Identifier: BSD-3-Clause
/// Columns of a history: means by time, and what a damaged one says.
#include "rondo/analysis/figures/history_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rondo/core/build_id.hpp"
#include "rondo/core/error.hpp"

namespace rondo::study::history_statistics_test {
namespace {

TEST(BuildId, IsTheProgramsOwn) {
  const std::string id = build_id();
  EXPECT_GE(id.size(), 16U);
  EXPECT_EQ(id.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(id, build_id());
}

TEST(HistoryStatistics, MeansAndDeviationsAreByTimeNotByRow) {
  const Columns h{{"time_s", {1.0, 2.0, 5.0}}, {"y", {100.0, 1.0, 3.0}}};
  const Intervals all = intervals(h, "y", 0.0, "h.csv"), later = intervals(h, "y", 1.0, "h.csv");
  EXPECT_DOUBLE_EQ(mean(all), 22.0);
  EXPECT_DOUBLE_EQ(mean(later), 2.5);
  EXPECT_DOUBLE_EQ(deviation(later), std::sqrt(0.75));
}

TEST(HistoryStatistics, MissingColumnsAndTimesAreNamed) {
  const Columns h{{"time_s", {1.0}}, {"y", {1.0}}};
  const auto message = [&](const char* column, double from) -> std::string {
    try {
      static_cast<void>(intervals(h, column, from, "some/history.csv"));
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("z", 0.0).find("some/history.csv"), std::string::npos);
  EXPECT_NE(message("z", 0.0).find("no column z"), std::string::npos);
  EXPECT_NE(message("y", 1.0).find("no rows after 1 s"), std::string::npos);
  const Columns empty{{"y", {}}};
  EXPECT_THROW(static_cast<void>(column(empty, "y", "h.csv")), FileError);
}

TEST(HistoryStatistics, TimesThatDoNotRiseAreRefused) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& time : {std::vector{0.1, 0.3, 0.2},
                                          {0.1, 0.1, 0.2},
                                          {-0.1, 0.1, 0.2},
                                          {0.1, nan, 0.2},
                                          {0.1, 0.2, infinity}}) {
    const Columns h{{"time_s", time}, {"y", {1.0, 2.0, 3.0}}};
    EXPECT_THROW(static_cast<void>(intervals(h, "y", 0.0, "h.csv")), FileError) << time[1];
  }
}

}  // namespace
}  // namespace rondo::study::history_statistics_test
