// SPDX-License-Identifier: BSD-3-Clause
#include "job_progress.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "print.hpp"

namespace rondo::app {
namespace {

int terminal_width(std::FILE* out) {
  winsize size{};
  return ioctl(fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// 42 s, 3 min 20 s, 1 h 05 min
std::string readable_time(double seconds) {
  const auto s = static_cast<long long>(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

std::string indented(const std::string& message) {
  std::string text;
  for (const char c : message) {
    text += c;
    if (c == '\n') text += "    ";
  }
  return text;
}

}  // namespace

std::string ended_line(std::size_t ended, std::size_t total, const std::string& name,
                       const study::JobOutcome& outcome) {
  const std::size_t digits = fmt::formatted_size("{}", total);
  std::string text = fmt::format("{:{}} of {}  {}: ", ended, digits, total, name);
  const bool started = outcome.wall_s > 0.0;
  if (outcome.status == study::JobStatus::done) {
    text += fmt::format("done in {:.1f} s", outcome.wall_s);
  } else {
    text += outcome.status == study::JobStatus::failed ? "failed" : "interrupted";
    if (started) text += fmt::format(" after {:.1f} s", outcome.wall_s);
  }
  if (!outcome.message.empty()) text += ": " + indented(outcome.message);
  return text;
}

std::string bar_line(double share, double seconds, const std::vector<std::string>& running,
                     int width) {
  constexpr int bar = 20;
  const auto filled = static_cast<std::size_t>(share * bar);
  std::string text = fmt::format("[{:<{}}] {:3.0f} %  {}", std::string(filled, '#'), bar,
                                 100.0 * share, readable_time(seconds));
  if (share > 0.0 && share < 1.0)
    text += fmt::format(", {} left", readable_time(seconds * (1.0 - share) / share));
  if (!running.empty()) text += fmt::format("  {}", fmt::join(running, ", "));
  // The last column stays free: some terminals go to the next line once it is written.
  return fmt::format("{:.{}}", text, std::max(width - 1, 1));
}

JobProgress::JobProgress(std::span<const study::Job> jobs, std::FILE* out)
    : out_(out), terminal_(isatty(fileno(out)) != 0) {
  for (const study::Job& job : jobs) names_.push_back(job.name);
}

JobProgress::~JobProgress() {
  if (open_) print(out_, "\n");
}

void JobProgress::ended(std::size_t job, const study::JobOutcome& outcome) {
  ++ended_;
  if (terminal_ && outcome.status != study::JobStatus::failed) return;
  print(out_, fmt::format("{}{}\n", open_ ? "\r\033[K" : "",
                          ended_line(ended_, names_.size(), names_[job], outcome)));
  open_ = false;
}

void JobProgress::draw(const study::JobsProgress& progress) {
  if (!terminal_) return;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
  std::vector<std::string> running;
  for (const std::size_t job : progress.running) running.push_back(names_[job]);
  const std::string bar = bar_line(progress.share, seconds.count(), running, terminal_width(out_));
  print(out_, fmt::format("\r{}\033[K", bar));
  open_ = true;
}

}  // namespace rondo::app
