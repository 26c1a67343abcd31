// SPDX-License-Identifier: BSD-3-Clause
/// @file  A directory for a test, removed at its end; a child process; a small run to write.
#pragma once
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/io/results.hpp"
#include "rondo/mesh/disk.hpp"

namespace rondo::io::test {

/// The points of a plane field.
inline Vec2 point_of(const FieldView& field, std::size_t i) {
  return {field[i][0], field[i][1]};
}
inline std::vector<Vec2> points_of(const FieldView& field) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < field.size(); ++i) points.push_back(point_of(field, i));
  return points;
}

/// Row `row` of a dataset.
template <class T>
std::vector<T> row_of(const h5::Dataset& dataset, std::size_t row) {
  const std::vector<T> all = dataset.read<T>();
  const std::size_t n = all.size() / dataset.shape()[0];
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(row * n);
  return {begin, begin + static_cast<std::ptrdiff_t>(n)};
}

class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "rondo-io-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw FileError(name, "cannot create");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void put_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Runs body in a child process, which ends there; its wait status.
template <class Body>
int in_child(Body&& body) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      body();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "child: %s\n", error.what());
      std::_Exit(1);
    }
    std::_Exit(0);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  return status;
}

inline bool went_well(int status) {
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// From here on a write beyond `bytes` of a file fails, as on a full disk. For child processes.
inline void limit_files(std::size_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) std::_Exit(2);
}

/// What body throws, as text; empty if it throws nothing.
template <class Error, class Body>
std::string error_of(Body&& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// XML: Every element is closed, in the right order, and nothing follows the last.
inline bool is_well_formed(const std::string& text) {
  std::vector<std::string> open;
  std::size_t at = text.find("?>");
  while ((at = text.find('<', at)) != std::string::npos) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = text.substr(at + 1, end - at - 1);
    at = end;
    if (tag.ends_with('/')) continue;
    const std::string name = tag.substr(0, tag.find(' '));
    if (!name.starts_with('/')) {
      open.push_back(name);
    } else if (open.empty() || name.substr(1) != open.back()) {
      return false;
    } else {
      open.pop_back();
    }
  }
  return open.empty() && text.ends_with("</Xdmf>\n");
}

/// A small disk with values that depend on the snapshot and the node in a way easy to check.
class SmallRun {
 public:
  explicit SmallRun(int columns = 8, int radial = 2) {
    mesh::Disk disk;
    disk.radial = radial;
    disk.circumferential = columns;
    mesh = mesh::make_disk(disk);
    mass.assign(n(), 0.0);
    for (std::size_t i = 0; i < n(); ++i) mass[i] = 1.0 + static_cast<double>(i);
  }
  [[nodiscard]] std::size_t n() const { return mesh.n_nodes(); }
  [[nodiscard]] std::size_t nb() const { return mesh.boundary.size(); }
  [[nodiscard]] ResultsLayout layout(std::size_t snapshots) const {
    return {&mesh, mass, snapshots, true, true};
  }
  [[nodiscard]] Snapshot snapshot(std::size_t k) const {
    const double t = static_cast<double>(k);
    Snapshot s;
    s.time = 0.1 * t;
    s.time_velocity = s.time - 0.05;
    s.angle = 0.7 * t;
    s.angle_velocity = s.angle - 0.35;
    s.center = {3.0 * t, 0.28, 0.0};
    s.u = s.v = Field(n(), 2);
    for (std::size_t i = 0; i < n(); ++i) {
      const double x = 1e-3 * static_cast<double>(i);
      s.u.plane()[i] = {x + t, x - t};
      s.v.plane()[i] = {2.0 * x, -t};
    }
    return s;
  }
  /// Of the k-th snapshot; valid until the next call.
  SnapshotFields fields(std::size_t k) {
    const double t = static_cast<double>(k);
    stress_.clear(), force_.clear(), fixed_.clear();
    for (std::size_t i = 0; i < n(); ++i) {
      const double x = 1e-3 * static_cast<double>(i);
      stress_.push_back({1e5 + t, 2e5 - x, 0.3e5, 4e4 + x});
    }
    for (std::size_t b = 0; b < nb(); ++b) {
      const double x = static_cast<double>(b);
      force_.push_back({100.0 + x, t, 0.0});
      fixed_.push_back({-t, 100.0 + x, 0.0});
    }
    return {.contact_force = force_, .contact_force_fixed = fixed_, .stress = stress_};
  }
  void write(std::size_t k, Results& results) { results.write(snapshot(k), fields(k)); }

  mesh::Mesh mesh;
  std::vector<double> mass;

 private:
  std::vector<Vec3> force_, fixed_;
  std::vector<fem::Stress> stress_;
};

}  // namespace rondo::io::test
