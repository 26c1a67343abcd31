// SPDX-License-Identifier: BSD-3-Clause
/// Damages Gmsh files and reads them: the outcome is a sound mesh or an InputError that says
/// something, never a crash or a hang of the program that reads.
///     mesh_reader_fuzz FOLDER [COUNT] [SEED]
/// Each file depends on SEED and its number alone. One that is taken wrongly stays in the temporary
/// folder that is named. Exit code 1: such a file was found; abort: a read did not come back.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/mesh/gmsh_reader.hpp"
#include "rondo/mesh/mesh_check.hpp"

namespace {

namespace fs = std::filesystem;
using namespace rondo;
using Random = std::mt19937_64;

constexpr std::array<const char*, 4> names{"mixed-22.msh", "mixed-22-binary.msh", "mixed-41.msh",
                                           "mixed-41-binary.msh"};
constexpr std::chrono::seconds longest{120};  // hangs only: the reader's own limit is 20 s of work

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t below(Random& random, std::size_t n) {
  return n == 0 ? 0 : random() % n;
}

// Damages -------------------------------------------------------------------------------------

void cut(std::string& text, Random& random) {
  text.resize(below(random, text.size()));
}

void flip_bits(std::string& text, Random& random) {
  for (std::size_t n = 1 + below(random, 8); n > 0; --n)
    text[below(random, text.size())] ^= static_cast<char>(1U << below(random, 8));
}

/// Some digits of a number in the text, or of the bytes that look like one, become an absurd count.
void absurd_number(std::string& text, Random& random) {
  constexpr std::array<const char*, 8> counts{"2147483647",   "4294967295", "18446744073709551615",
                                              "999999999999", "-1",         "0",
                                              "1e300",        "nan"};
  constexpr const char* digits = "0123456789";
  const std::size_t begin = text.find_first_of(digits, below(random, text.size()));
  if (begin == std::string::npos) return;
  const std::size_t end = std::min(text.find_first_not_of(digits, begin), text.size());
  text.replace(begin, end - begin, counts[below(random, counts.size())]);
}

/// A count at the head of a section: in text the numbers of its first line, in a binary file bytes.
void absurd_head(std::string& text, Random& random) {
  constexpr std::array<const char*, 3> sections{"$Nodes\n", "$Elements\n", "$Entities\n"};
  const std::string_view section = sections[below(random, sections.size())];
  const std::size_t at = text.find(section);
  if (at == std::string::npos) return;
  const std::size_t first = at + section.size() + 8 * below(random, 6);
  if (first + 8 > text.size()) return;
  const bool is_text = text.substr(at + section.size(), 8).find('\0') == std::string::npos;
  const std::uint64_t count = random() >> below(random, 64);
  if (is_text)
    text.replace(at + section.size(), 1 + below(random, 3), fmt::format("{} ", count));
  else
    for (std::size_t k = 0; k < 8; ++k) text[first + k] = static_cast<char>(count >> (8 * k));
}

void move_bytes(std::string& text, Random& random) {
  const std::size_t from = below(random, text.size());
  const std::string piece = text.substr(from, 1 + below(random, 60));
  if (random() % 2 == 0) text.erase(from, piece.size());
  text.insert(below(random, text.size()), piece);
}

void scribble(std::string& text, Random& random) {
  const std::size_t from = below(random, text.size());
  const std::size_t end = std::min(text.size(), from + 1 + below(random, 16));
  for (std::size_t k = from; k < end; ++k) text[k] = static_cast<char>(random());
}

constexpr std::array damages{cut, flip_bits, absurd_number, absurd_head, move_bytes, scribble};

std::string damaged(const std::vector<std::string>& sources, std::uint64_t seed, std::size_t k) {
  Random random(seed * 1'000'003 + k);
  std::string text = sources[k % sources.size()];
  damages[(k / sources.size()) % damages.size()](text, random);
  return text;
}

// Outcomes ------------------------------------------------------------------------------------

/// What is not right with a mesh that was taken; empty: nothing.
std::string fault_of(const mesh::Mesh& m) {
  const int n = static_cast<int>(m.n_nodes());
  const auto known = [&](int node) { return node >= 0 && node < n; };
  if (m.cells.empty()) return "no cells";
  for (const Vec2 x : m.coordinates)
    if (!std::isfinite(x.x) || !std::isfinite(x.y)) return "a node is nowhere";
  for (const mesh::Cell& cell : m.cells)
    for (int a = 0; a < mesh::n_corners(cell); ++a)
      if (!known(cell[static_cast<std::size_t>(a)])) return "a cell without its node";
  if (mesh::check_cells(m).count() > 0) return "a bad cell";
  if (m.boundary.size() != m.tributary.size()) return "contact nodes without length";
  for (const int node : m.boundary)
    if (!known(node)) return "a contact node is no node";
  for (const int node : m.clamped)
    if (!known(node)) return "a clamped node is none";
  if (!m.region.empty() && m.region.size() != m.cells.size()) return "cells without region";
  for (const mesh::Curve& curve : m.curves)
    for (const mesh::Edge& edge : curve.edges)
      if (!known(edge[0]) || !known(edge[1])) return "an edge without its node";
  return {};
}

struct Tally {
  std::size_t meshes = 0, refused = 0, ended = 0;
  std::vector<std::string> wrong;
};

/// A reader thread is busy since...; 0: it is not.
using Since = std::atomic<std::chrono::steady_clock::rep>;

void read_one(const fs::path& file, Tally& tally, std::mutex& guard) {
  std::string wrong;
  std::size_t mesh = 0, ended = 0;
  try {
    const mesh::MeshRequest request{
        .file = file, .clamped = {"foot"}, .contact = "top", .curves = {}, .surfaces = {"left"}};
    wrong = fault_of(mesh::read_gmsh(request).mesh);
    mesh = 1;
  } catch (const InputError& error) {
    const std::string_view said = error.what();
    ended = said.find("ended by") != std::string_view::npos ? 1 : 0;
    if (said.size() < 20) wrong = "nothing is said";
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  const std::lock_guard lock(guard);
  tally.meshes += mesh;
  tally.refused += 1 - mesh;
  tally.ended += ended;
  if (!wrong.empty()) tally.wrong.push_back(fmt::format("{}: {}", file.string(), wrong));
  if (wrong.empty()) fs::remove(file);
}

void watch(const std::vector<Since>& since, const std::atomic<bool>& done) {
  while (!done) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    for (const Since& start : since)
      if (start != 0 && now - std::chrono::steady_clock::duration(start) > longest) std::abort();
  }
}

Tally read_all(const std::vector<std::string>& sources, std::size_t count, std::uint64_t seed,
               const fs::path& folder) {
  Tally tally;
  std::mutex guard;
  std::atomic<std::size_t> next{0};
  std::atomic<bool> done{false};
  std::vector<Since> since(std::max(2U, std::thread::hardware_concurrency()));
  std::thread watcher([&] { watch(since, done); });
  std::vector<std::thread> readers;
  for (Since& start : since)
    readers.emplace_back([&] {
      for (std::size_t k = next++; k < count; k = next++) {
        const fs::path file = folder / fmt::format("{}.msh", k);
        std::ofstream(file, std::ios::binary) << damaged(sources, seed, k);
        start = std::chrono::steady_clock::now().time_since_epoch().count();
        read_one(file, tally, guard);
        start = 0;
      }
    });
  for (std::thread& reader : readers) reader.join();
  done = true;
  watcher.join();
  return tally;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::size_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 300;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  std::vector<std::string> sources;
  for (const char* name : names) sources.push_back(text_of(fs::path(argv[1]) / name));
  const fs::path folder = fs::temp_directory_path() / fmt::format("rondo-fuzz-{}", getpid());
  fs::create_directory(folder);
  const Tally tally = read_all(sources, count, seed, folder);
  fmt::print("{} files: {} meshes, {} refused, {} of them by the end of the reader's process\n",
             count, tally.meshes, tally.refused, tally.ended);
  for (const std::string& wrong : tally.wrong) fmt::print("WRONG {}\n", wrong);
  if (tally.wrong.empty()) fs::remove_all(folder);
  // Damages that all are harmless, or all are not, would show nothing.
  const bool both = tally.meshes > count / 50 && tally.refused > count / 5;
  if (!both) fmt::print("the damages are no good\n");
  return tally.wrong.empty() && both ? 0 : 1;
}
