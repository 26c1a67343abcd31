// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace rondo::fuzz {
namespace fs = std::filesystem;

void check(bool holds, std::string_view what) {
  if (holds) return;
  fmt::print(stderr, "FINDING: {}\n", what);
  std::abort();
}

bool is_finite(Vec2 v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

void check_said(const std::exception& error) {
  constexpr std::size_t some_words = 10;
  check(std::string_view(error.what()).size() >= some_words, "an error that says nothing");
}

namespace {

struct Scratch {
  fs::path path = fs::temp_directory_path() / fmt::format("rondo-fuzz-{}", getpid());
  Scratch() { fs::create_directories(path); }
  ~Scratch() {
    std::error_code error;
    fs::remove_all(path, error);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

}  // namespace

const fs::path& scratch_folder() {
  static const Scratch scratch;
  return scratch.path;
}

void put(const fs::path& file, std::string_view text) {
  std::ofstream out(file, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  check(!out.fail(), "the input cannot be put into a file: no fault of the program");
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

namespace {

constexpr std::string_view mark = "=== ";

/// Where the next line begins that is a mark; the size of the text: none does.
std::size_t find_mark(std::string_view text) {
  if (text.starts_with(mark)) return 0;
  const std::size_t at = text.find("\n=== ");
  return at == std::string_view::npos ? text.size() : at + 1;
}

}  // namespace

bool next_part(std::string_view& text, Part& part) {
  text.remove_prefix(find_mark(text));
  if (text.empty()) return false;
  text.remove_prefix(mark.size());
  const std::size_t end = std::min(text.find('\n'), text.size());
  part.name = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  part.text = text.substr(0, find_mark(text));
  text.remove_prefix(part.text.size());
  return true;
}

std::uint32_t hash(std::string_view bytes) noexcept {
  std::uint32_t h = 2166136261U;  // FNV-1a
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 16777619U;
  return h;
}

}  // namespace rondo::fuzz
