// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/mesh_files.hpp"
#include "rondo/io/results_impl.hpp"
#include "rondo/io/xdmf.hpp"

namespace rondo::io {
namespace {

ResultsCounts counts_of(const ResultsLayout& layout) noexcept {
  const mesh::Mesh& m = *layout.mesh;
  const bool contact = layout.contact && !m.boundary.empty();
  return {m.n_nodes(),       m.boundary.size(), layout.n_snapshots,
          layout.components, contact,           layout.stress};
}

/// Of results.h5: what describes the datasets, and an entry for each row.
std::size_t index_bytes(const ResultsCounts& c) noexcept {
  constexpr std::size_t datasets = 21, description = 4096;
  return datasets * (description + c.times * h5::File::bytes_of_entry);
}

XdmfSeries series_of(const mesh::Mesh& mesh, const ResultsCounts& c) {
  XdmfSeries s;
  s.data_file = "results.h5";
  s.topology = topology_of(mesh);
  s.reference = "/mesh/coordinates";
  s.position = "/fields/position";
  s.n_nodes = c.nodes;
  s.n_times = c.times;
  s.fields.push_back({"displacement", "Vector", "/fields/displacement", 3, 0, 3});
  s.fields.push_back({"velocity", "Vector", "/fields/velocity", 3, 0, 3});
  if (c.contact) s.fields.push_back({"contact_force", "Vector", "/fields/contact_force", 3, 0, 3});
  if (!c.stress) return s;
  s.fields.push_back({"von_mises", "Scalar", "/fields/von_mises"});
  const std::string stress = "/fields/cauchy_stress";
  s.fields.push_back({"cauchy_stress", "Tensor6", stress, 6, 0, 6});
  // Alone as well: ParaView's XDMF 3 readers take the six numbers for xx, yy, zz, xy, yz, xz.
  s.fields.push_back({"stress_xx", "Scalar", stress, 6, 0, 1});
  s.fields.push_back({"stress_xy", "Scalar", stress, 6, 1, 1});
  s.fields.push_back({"stress_yy", "Scalar", stress, 6, 3, 1});
  s.fields.push_back({"stress_zz", "Scalar", stress, 6, 5, 1});
  return s;
}

/// R σ R^T as xx, xy, xz, yy, yz, zz; r = e^{iθ}.
std::array<float, 6> turned_tensor(const NodalStress& stress, Complex r) noexcept {
  const NodalStress s = fem::turned(stress, r);
  return {static_cast<float>(s[0]), static_cast<float>(s[3]), 0.0F, static_cast<float>(s[1]), 0.0F,
          static_cast<float>(s[2])};
}

using Space = std::array<double, 3>;

/// Of a plane field, z is 0.
Space in_space(std::span<const double> a) noexcept {
  return {a[0], a[1], a.size() > 2 ? a[2] : 0.0};
}

Space turned(Complex r, const Space& a) noexcept {
  const Vec2 plane = r * Vec2{a[0], a[1]};
  return {plane.x, plane.y, a[2]};
}

Space sum(const Space& a, const Space& b) noexcept {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

std::array<float, 3> rounded(const Space& a) noexcept {
  return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
}

constexpr const char* results_name = "results.h5";
constexpr const char* new_name = "results.h5.new";  // until it is whole

}  // namespace

Results::Impl::Impl(const std::filesystem::path& folder, const ResultsLayout& layout)
    : c(counts_of(layout)),
      directory(folder),
      unfinished{folder / new_name},
      coordinates(layout.mesh->coordinates),
      boundary(layout.mesh->boundary),
      tributary(layout.mesh->tributary),
      free_body(layout.free_body.begin(), layout.free_body.end()),
      vectors(c.nodes),
      forces(c.contact ? c.nodes : 0),
      tensors(c.stress ? c.nodes : 0),
      scalars(c.stress ? c.nodes : 0),
      traction(c.contact ? c.candidates * c.components : 0),
      words(layout.words),
      series(layout.series),
      series_rows(layout.series.size()) {
  RONDO_DEMAND(c.nodes > 0 && layout.mass.size() == c.nodes, c.nodes, layout.mass.size());
  RONDO_DEMAND(tributary.size() == c.candidates, tributary.size(), c.candidates);
  demand_room(directory / results_name, bytes(layout));
  file = h5::File::create(unfinished.path, index_bytes(c));
  file.call_it(directory / results_name);
  file.set_attribute("/", "format", "rondo results 1");
  file.set_attribute("/", "analysis", words.analysis);
  write_mesh(file, *layout.mesh, layout.mass);
  if (!free_body.empty())
    file.write("/mesh/free_body", {c.nodes}, view(free_body),
               {"1",
                "number of the free body of each node, in the order of their first nodes: such "
                "a node moves in the fixed frame; -1: in the turning frame"});
  if (c.times > 0) {
    create_frame();
    create_snapshots();
    create_fields();
    create_series();
    reserve();
  }
}

void Results::Impl::go_on(std::size_t kept) {
  RONDO_DEMAND(kept <= c.times, kept, c.times);
  const h5::File before = h5::File::open(directory / results_name);
  for (h5::Dataset* dataset : all_rows())
    if (*dataset) dataset->copy_rows(before, kept);
  written = kept;
}

/// From here on the file is there, and at any moment whole.
void Results::Impl::publish(const mesh::Mesh& mesh) {
  file.flush();
  replace_file(unfinished.path, directory / results_name);
  begin_xdmf(mesh);
}

/// With the grids of the snapshots that are there.
void Results::Impl::begin_xdmf(const mesh::Mesh& mesh) {
  std::vector<double> times = d.time ? d.time.read<double>() : std::vector<double>();
  times.resize(written);
  xdmf = std::make_unique<Xdmf>(directory / "fields.xdmf", series_of(mesh, c), std::move(times));
}

std::vector<h5::Dataset*> Results::Impl::all_rows() {
  std::vector<h5::Dataset*> all = {&d.time,
                                   &d.time_velocity,
                                   &d.angle,
                                   &d.angle_velocity,
                                   &d.center,
                                   &d.displacement,
                                   &d.velocity,
                                   &d.force,
                                   &d.traction,
                                   &d.position,
                                   &d.field_displacement,
                                   &d.field_velocity,
                                   &d.field_force,
                                   &d.von_mises,
                                   &d.stress};
  for (h5::Dataset& dataset : series_rows) all.push_back(&dataset);
  return all;
}

void Results::Impl::resize(std::size_t rows) {
  for (h5::Dataset* dataset : all_rows())
    if (*dataset) dataset->resize(rows);
}

/// Room for all snapshots, in parts: what a run stopped early gives back then lies at the end of
/// the file, which becomes shorter.
void Results::Impl::reserve() {
  constexpr std::size_t parts = 64;
  const std::size_t part = (c.times + parts - 1) / parts;
  for (std::size_t rows = part; rows < c.times; rows += part) resize(rows);
  resize(c.times);
  const std::vector<double> never(c.times, std::numeric_limits<double>::quiet_NaN());
  d.time.write(view(never));
}

void Results::Impl::check(const Snapshot& s) const {
  RONDO_DEMAND(file && written < c.times, written, c.times);
  RONDO_DEMAND(s.displacement.size() == c.nodes && s.velocity.size() == c.nodes,
               s.displacement.size(), s.velocity.size(), c.nodes);
  const std::size_t nb = c.contact ? c.candidates : 0;
  RONDO_DEMAND(!c.contact || (s.contact_force.size() == nb && s.contact_force_fixed.size() == nb),
               s.contact_force.size(), s.contact_force_fixed.size(), nb);
  RONDO_DEMAND(!c.stress || s.stress.size() == c.nodes, s.stress.size(), c.nodes);
  const int last = free_body.empty() ? -1 : *std::max_element(free_body.begin(), free_body.end());
  RONDO_DEMAND(!c.stress || static_cast<int>(s.body_rotation.size()) > last, s.body_rotation.size(),
               last);
}

void Results::Impl::write_fields(const Snapshot& s) {
  const Complex turn = rotation(s.angle);
  const auto to_fixed = [&](std::size_t i, const Space& a) {
    return is_free(i) ? a : turned(turn, a);
  };
  for (std::size_t i = 0; i < c.nodes; ++i) {
    const Space reference{coordinates[i].x, coordinates[i].y, 0.0};
    const Space center = is_free(i) ? Space{} : Space{s.center.x, s.center.y, 0.0};
    vectors[i] = rounded(sum(center, to_fixed(i, sum(reference, in_space(s.displacement[i])))));
  }
  row(d.position, vectors);
  for (std::size_t i = 0; i < c.nodes; ++i)
    vectors[i] = rounded(to_fixed(i, in_space(s.displacement[i])));
  row(d.field_displacement, vectors);
  for (std::size_t i = 0; i < c.nodes; ++i)
    vectors[i] = rounded(to_fixed(i, in_space(s.velocity[i])));
  row(d.field_velocity, vectors);
  if (c.stress) write_stress(s);
  if (c.contact) write_contact(s);
}

void Results::Impl::write_stress(const Snapshot& s) {
  const Complex turn = rotation(s.angle);
  for (std::size_t i = 0; i < c.nodes; ++i) {
    scalars[i] = static_cast<float>(fem::von_mises(s.stress[i]));
    tensors[i] = turned_tensor(
        s.stress[i], is_free(i) ? s.body_rotation[static_cast<std::size_t>(free_body[i])] : turn);
  }
  row(d.von_mises, scalars);
  row(d.stress, tensors);
}

void Results::Impl::write_contact(const Snapshot& s) {
  for (std::size_t k = 0; k < c.candidates; ++k) {
    forces[static_cast<std::size_t>(boundary[k])] = rounded(in_space(s.contact_force_fixed[k]));
    for (std::size_t i = k * c.components; i < (k + 1) * c.components; ++i)
      traction[i] = s.contact_force.values[i] / tributary[k];
  }
  row(d.field_force, forces);
  d.force.write_row(written, s.contact_force.values);
  row(d.traction, traction);
}

void Results::Impl::write_series(std::span<const double> values) {
  std::size_t at = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    RONDO_DEMAND(at + series[k].components <= values.size(), at, values.size());
    series_rows[k].write_row(written, values.subspan(at, series[k].components));
    at += series[k].components;
  }
}

/// The time comes last: where it is a number, the snapshot is complete.
void Results::Impl::write_snapshot(const Snapshot& s) {
  check(s);
  write_fields(s);
  write_series(s.series);
  d.displacement.write_row(written, s.displacement.values);
  d.velocity.write_row(written, s.velocity.values);
  d.center.write_row(written, std::span<const Vec2>(&s.center, 1));
  row(d.angle, s.angle);
  row(d.angle_velocity, s.angle_velocity);
  row(d.time_velocity, s.time_velocity);
  row(d.time, s.time);
  ++written;
  xdmf->add(s.time);
}

void Results::Impl::close() {
  if (!file) return;
  resize(written);
  d = {};
  series_rows.clear();
  file.close();
  xdmf->close();
}

Results::Results(const std::filesystem::path& directory, const ResultsLayout& layout) {
  RONDO_DEMAND(layout.mesh != nullptr, layout.n_snapshots);
  impl_ = std::make_unique<Impl>(directory, layout);
  impl_->publish(*layout.mesh);
}

Results::Results(const std::filesystem::path& directory, const ResultsLayout& layout,
                 std::size_t kept) {
  RONDO_DEMAND(layout.mesh != nullptr, layout.n_snapshots);
  impl_ = std::make_unique<Impl>(directory, layout);
  impl_->go_on(kept);
  impl_->publish(*layout.mesh);
}

Results::~Results() {
  try {
    close();
  } catch (const std::exception&) {  // reported where close() is called
  }
}

void Results::write(const Snapshot& snapshot) {
  impl_->write_snapshot(snapshot);
}
void Results::close() {
  impl_->close();
}
void Results::sync() const {
  for (const char* name : {results_name, "fields.xdmf"}) sync_file(impl_->directory / name);
}
std::size_t Results::written() const noexcept {
  return impl_->written;
}

std::size_t Results::bytes(const ResultsLayout& layout) noexcept {
  const ResultsCounts c = counts_of(layout);
  constexpr std::size_t real = 8, single = 4;
  const std::size_t node =
      2 * c.components * real + (9U + (c.contact ? 3U : 0U) + (c.stress ? 7U : 0U)) * single;
  const std::size_t candidate = c.contact ? 2 * c.components * real : 0;
  std::size_t frame = 6 * real;
  for (const Series& s : layout.series) frame += s.components * real;
  return index_bytes(c) + mesh_bytes(*layout.mesh) + layout.free_body.size() * sizeof(int) +
         c.times * (frame + c.nodes * node + c.candidates * candidate);
}

}  // namespace rondo::io
