// SPDX-License-Identifier: BSD-3-Clause
/// The lines that `rondo` prints while jobs run, on a terminal and elsewhere.
#include "job_progress.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <functional>

using namespace rondo;
using study::JobStatus;

namespace {

std::vector<study::Job> three_jobs() {
  std::vector<study::Job> jobs(3);
  jobs[0].name = "smooth";
  jobs[1].name = "tread";
  jobs[2].name = "a-job-with-a-name-that-is-rather-long-for-a-line";
  return jobs;
}

/// What reaches the other side of a terminal of `columns` columns.
std::string on_terminal(unsigned short columns,
                        const std::function<void(app::JobProgress&)>& body) {
  int master = -1, slave = -1;
  winsize size{};
  size.ws_col = columns;
  if (openpty(&master, &slave, nullptr, nullptr, &size) != 0) return "no terminal";
  std::FILE* out = fdopen(slave, "w");
  {
    const std::vector<study::Job> jobs = three_jobs();
    app::JobProgress progress(jobs, out);
    body(progress);
  }
  std::fclose(out);
  // The kernel hands over what was written in pieces, when it comes to it; then there is no more.
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; (n = read(master, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(n));
  ::close(master);
  return text;
}

std::string in_file(const std::function<void(app::JobProgress&)>& body) {
  std::FILE* out = std::tmpfile();
  {
    const std::vector<study::Job> jobs = three_jobs();
    app::JobProgress progress(jobs, out);
    body(progress);
  }
  std::rewind(out);
  std::array<char, 4096> buffer{};
  const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), out);
  std::fclose(out);
  return {buffer.data(), n};
}

void one_of_each(app::JobProgress& progress) {
  const std::array<std::size_t, 2> running{0, 2};
  progress.draw({0.25, 0, running});
  progress.ended(0, {JobStatus::done, 0, "", 1.42});
  progress.ended(1, {JobStatus::failed, 3, "step 5: not finite", 0.5});
  progress.draw({0.5, 2, running});
  progress.ended(2, {JobStatus::interrupted, 130, "not started", 0.0});
}

}  // namespace

TEST(JobProgress, LineOfAnEnd) {
  EXPECT_EQ(app::ended_line(3, 33, "turn-smooth", {JobStatus::done, 0, "", 1.42}),
            " 3 of 33  turn-smooth: done in 1.4 s");
  EXPECT_EQ(app::ended_line(3, 9, "x", {JobStatus::done, 3, "as printed, it grows", 2.0}),
            "3 of 9  x: done in 2.0 s: as printed, it grows");
  EXPECT_EQ(app::ended_line(12, 33, "x", {JobStatus::failed, 2, "a\nb", 0.25}),
            "12 of 33  x: failed after 0.2 s: a\n    b");
  EXPECT_EQ(app::ended_line(1, 2, "x", {JobStatus::interrupted, 130, "not started", 0.0}),
            "1 of 2  x: interrupted: not started");
}

TEST(JobProgress, BarSaysTimeGoneAndLeft) {
  EXPECT_EQ(app::bar_line(0.25, 20.0, {"smooth", "tread"}, 80),
            "[#####               ]  25 %  20 s, 1 min 00 s left  smooth, tread");
  EXPECT_EQ(app::bar_line(0.0, 0.2, {"smooth"}, 80), "[                    ]   0 %  0 s  smooth");
  EXPECT_EQ(app::bar_line(1.0, 7300.0, {}, 80), "[####################] 100 %  2 h 01 min");
}

TEST(JobProgress, BarIsShorterThanTheTerminal) {
  const std::string line = app::bar_line(0.25, 20.0, {std::string(200, 'x')}, 72);
  EXPECT_EQ(line.size(), 71U);
  EXPECT_EQ(line.substr(0, 6), "[#####");
  EXPECT_EQ(app::bar_line(0.25, 20.0, {}, 10).size(), 9U);
}

TEST(JobProgress, ElsewhereALineEachAndNoBar) {
  EXPECT_EQ(in_file(one_of_each),
            "1 of 3  smooth: done in 1.4 s\n"
            "2 of 3  tread: failed after 0.5 s: step 5: not finite\n"
            "3 of 3  a-job-with-a-name-that-is-rather-long-for-a-line: interrupted: not started\n");
}

TEST(JobProgress, OnATerminalOneBarAndFailuresAboveIt) {
  const std::string text = on_terminal(60, one_of_each);
  const std::string failure =
      "\033[K\r\033[K2 of 3  tread: failed after 0.5 s: step 5: not finite\r\n";
  const std::size_t between = text.find(failure);
  ASSERT_NE(between, text.npos) << text;
  const std::string end = "\033[K\r\n";
  ASSERT_TRUE(text.ends_with(end)) << text;
  const std::size_t second = between + failure.size();
  const std::string first_bar = text.substr(0, between);
  const std::string second_bar = text.substr(second, text.size() - end.size() - second);
  EXPECT_EQ(first_bar.size(), 60U) << "a return, 59 columns: " << first_bar;
  EXPECT_EQ(second_bar.size(), 60U) << second_bar;
  EXPECT_TRUE(first_bar.starts_with("\r[#####               ]  25 %  ")) << first_bar;
  EXPECT_TRUE(second_bar.starts_with("\r[##########          ]  50 %  ")) << second_bar;
  EXPECT_NE(first_bar.find(" left  smooth, a-j"), text.npos) << first_bar;
}

TEST(JobProgress, UnknownWidthIsEighty) {
  const std::string text = on_terminal(0, [](app::JobProgress& progress) {
    const std::array<std::size_t, 3> running{2, 1, 2};  // too long, whatever the times say
    progress.draw({0.25, 0, running});
  });
  EXPECT_EQ(text.size(), std::string("\r").size() + 79 + std::string("\033[K\r\n").size());
}
