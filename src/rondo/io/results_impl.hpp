// SPDX-License-Identifier: BSD-3-Clause
/// @file  Inside of Results, for results.cpp and results_datasets.cpp alone.
#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rondo/io/files.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/results.hpp"
#include "rondo/io/xdmf.hpp"

namespace rondo::io {

struct ResultsCounts {
  std::size_t nodes, candidates, times, components;
  bool contact, stress;
};

template <class T>
std::span<const T> view(const std::vector<T>& values) {
  return values;
}

struct Results::Impl {
  Impl(const std::filesystem::path& directory, const ResultsLayout& layout);
  void go_on(std::size_t kept);
  void publish(const mesh::Mesh& mesh);
  void begin_xdmf(const mesh::Mesh& mesh);
  [[nodiscard]] std::vector<h5::Dataset*> all_rows();
  void create_frame();
  void create_snapshots();
  void create_fields();
  void create_series();
  void reserve();
  void resize(std::size_t rows);
  void check(const Snapshot& s) const;
  void write_fields(const Snapshot& s);
  void write_stress(const Snapshot& s);
  /// Of displacements and velocities, for descriptions.
  [[nodiscard]] std::string frame() const {
    return free_body.empty() ? "turning frame" : "turning frame, of free bodies fixed frame";
  }
  [[nodiscard]] bool is_free(std::size_t node) const {
    return !free_body.empty() && free_body[node] >= 0;
  }
  void write_contact(const Snapshot& s);
  void write_series(std::span<const double> values);
  void write_snapshot(const Snapshot& s);
  void close();

  template <class T>
  void row(h5::Dataset& dataset, const std::vector<T>& values) {
    dataset.write_row(written, view(values));
  }
  void row(h5::Dataset& dataset, double value) {
    dataset.write_row(written, std::span<const double>(&value, 1));
  }

  ResultsCounts c;
  std::filesystem::path directory;
  UnfinishedFile unfinished;  ///< results.h5 until it is whole
  std::vector<Vec2> coordinates;
  std::vector<int> boundary;
  std::vector<double> tributary;
  std::vector<int> free_body;
  std::size_t written = 0;
  std::vector<std::array<float, 3>> vectors, forces;
  std::vector<std::array<float, 6>> tensors;
  std::vector<float> scalars;
  std::vector<double> traction;
  h5::File file;
  struct {
    h5::Dataset time, time_velocity, angle, angle_velocity, center, displacement, velocity, force,
        traction, position, field_displacement, field_velocity, field_force, von_mises, stress;
  } d;
  ResultsWords words;
  std::vector<Series> series;
  std::vector<h5::Dataset> series_rows;  ///< one for each of them
  std::unique_ptr<Xdmf> xdmf;
};

}  // namespace rondo::io
