// SPDX-License-Identifier: BSD-3-Clause
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace rondo::app {
namespace {

/// Prints at once and ignores errors: a terminal that has been closed must not end a run.
void print(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

Progress::Progress(const char* unit) : unit_(unit), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (open_) print("\n");
}

void Progress::operator()(long long done, long long total) {
  const auto now = Clock::now();
  if (first_ < 0) {  // a resumed run does not begin at 0
    first_ = done;
    decade_ = static_cast<int>(10 * done / total);
  }
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const bool last = done == total;
  if (terminal_) {
    if (!last && now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    open_ = !last;
    draw_bar(done, total, seconds);
    return;
  }
  const int decade = static_cast<int>(10 * done / total);
  if (decade <= decade_) return;
  decade_ = decade;
  const double speed = static_cast<double>(done - first_) / seconds;
  const std::string left =
      last || !(speed > 0.0)
          ? ""
          : fmt::format(", {:.1f} s left", static_cast<double>(total - done) / speed);
  print(fmt::format("{:3d} %  {} {} of {}, {:.1f} s{}\n", 10 * decade, unit_, done, total, seconds,
                    left));
}

void Progress::draw_bar(long long done, long long total, double seconds) const {
  constexpr int width = 30;
  const double share = static_cast<double>(done) / static_cast<double>(total);
  const auto filled = static_cast<std::size_t>(share * width);
  const double speed = seconds > 0.0 ? static_cast<double>(done - first_) / seconds : 0.0;
  const double left = speed > 0.0 ? static_cast<double>(total - done) / speed : 0.0;
  print(fmt::format("\r[{:<{}}] {:3.0f} %  {:.0f} {}s/s  {:.1f} s left \033[K{}",
                    std::string(filled, '#'), width, 100.0 * share, speed, unit_, left,
                    done == total ? "\n" : ""));
}

}  // namespace rondo::app
