// SPDX-License-Identifier: BSD-3-Clause
#include "scanner.hpp"

namespace rondo::reader {
namespace {

constexpr std::string_view space = " \t\r\n\v\f";

}  // namespace

std::string quoted(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string all(1, '"');
  all.append(text.substr(0, most)).append(text.size() > most ? "...\"" : "\"");
  return all;
}

void Scanner::fail(const std::string& message) const {
  const auto before = text_.substr(0, at_);
  if (binary_) throw "byte " + std::to_string(at_) + ": " + message;
  throw "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ": " +
      message;
}

void Scanner::fail_cut() const {
  throw "the file is cut: there is no $End" + name_;
}

void Scanner::fail_at_number(std::string_view found) const {
  fail("$" + name_ + " has " + quoted(found) +
       " where a number should be (numbers are written like 12, -0.5 and 1e-3)");
}

void Scanner::skip_space() {
  at_ = std::min(text_.find_first_not_of(space, at_), text_.size());
}

void Scanner::demand_one_line(const char* what) {
  const std::string_view record = text_.substr(record_, at_ - record_);
  const std::size_t end = record.find('\n');
  const std::size_t next = std::min(text_.find_first_not_of(" \t\r", at_), text_.size());
  if (end == std::string_view::npos && (next == text_.size() || text_[next] == '\n')) return;
  at_ = record_;
  fail("a line of $" + name_ + " has too " + (end == std::string_view::npos ? "many" : "few") +
       " numbers for " + what + ": " +
       quoted(text_.substr(record_, text_.find_first_of("\r\n", record_) - record_)));
}

bool Scanner::next_section() {
  skip_space();
  while (at_ < text_.size() && text_[at_] != '$') {
    end_line();
    skip_space();
  }
  if (at_ == text_.size()) return false;
  const std::size_t end = std::min(text_.find_first_of(space, at_), text_.size());
  name_ = text_.substr(at_ + 1, end - at_ - 1);
  at_ = end;
  what_ = nullptr;
  return true;
}

void Scanner::skip_section() {
  if (name_.starts_with("End")) return;
  const std::size_t end = text_.find("$End" + name_, at_);
  if (end == std::string_view::npos) fail_cut();
  at_ = end + name_.size() + 4;
}

void Scanner::end_line() {
  const std::size_t end = text_.find('\n', at_);
  at_ = end == std::string_view::npos ? text_.size() : end + 1;
}

void Scanner::end_section() {
  skip_space();
  if (at_ == text_.size()) fail_cut();
  const std::string end = "$End" + name_;
  if (!text_.substr(at_).starts_with(end))
    fail("$" + name_ + " says " + std::to_string(said_) + " " + (what_ ? what_ : "things") +
         ", and goes on after them" +
         (binary_ ? std::string()
                  : " with " + quoted(text_.substr(at_, text_.find('\n', at_) - at_))));
  at_ += end.size();
}

std::string_view Scanner::word() {
  skip_space();
  if (at_ == text_.size()) fail_cut();
  if (text_[at_] == '$')
    fail(what_ ? "$" + name_ + " says " + std::to_string(said_) + " " + what_ +
                     ", and ends after " + std::to_string(found_)
               : "$" + name_ + " ends early");
  const std::size_t end = std::min(text_.find_first_of(space, at_), text_.size());
  const std::string_view found = text_.substr(at_, end - at_);
  at_ = end;
  return found;
}

std::string_view Scanner::rest_of_line() {
  const std::size_t start = at_;
  end_line();
  return text_.substr(start, at_ - start);
}

}  // namespace rondo::reader
