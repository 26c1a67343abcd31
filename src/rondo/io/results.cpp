// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/solid/solid_stress.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/io/mesh_files.hpp"

namespace rondo::io {
namespace {

template <class Counts>
XdmfSeries series_of(const mesh::Mesh& mesh, const Counts& c) {
  XdmfSeries s;
  s.data_file = "results.h5";
  s.topology = topology_of(mesh);
  s.reference = "/mesh/coordinates";
  s.dimensions = c.solid ? 3 : 2;
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
  // Shown alone too, as ParaView's XDMF 3 readers take the six numbers for xx, yy, zz, xy, yz, xz.
  s.fields.push_back({"stress_xx", "Scalar", stress, 6, 0, 1});
  s.fields.push_back({"stress_xy", "Scalar", stress, 6, 1, 1});
  s.fields.push_back({"stress_yy", "Scalar", stress, 6, 3, 1});
  s.fields.push_back({"stress_zz", "Scalar", stress, 6, 5, 1});
  if (!c.solid) return s;
  s.fields.push_back({"stress_xz", "Scalar", stress, 6, 2, 1});
  s.fields.push_back({"stress_yz", "Scalar", stress, 6, 4, 1});
  return s;
}

/// R σ R^T as xx, xy, xz, yy, yz, zz; r = e^{iθ}.
std::array<float, 6> turned_tensor(const fem::Stress& stress, Complex r) noexcept {
  const fem::Stress s = fem::turned(stress, r);
  return {static_cast<float>(s[0]), static_cast<float>(s[3]), 0.0F, static_cast<float>(s[1]), 0.0F,
          static_cast<float>(s[2])};
}

/// Turns a stress with all six components.
std::array<float, 6> turned_tensor(const fem::SolidStress& stress, Complex r) noexcept {
  const fem::SolidStress s = fem::turned(stress, r);
  return {static_cast<float>(s[0]), static_cast<float>(s[3]), static_cast<float>(s[5]),
          static_cast<float>(s[1]), static_cast<float>(s[4]), static_cast<float>(s[2])};
}

/// A plane vector has the component 0 along z.
Vec3 in_space(std::span<const double> a) noexcept {
  return {a[0], a[1], a.size() > 2 ? a[2] : 0.0};
}

std::array<float, 3> rounded(Vec3 a) noexcept {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

constexpr const char* results_name = "results.h5";
constexpr const char* new_name = "results.h5.new";  // until it is complete

}  // namespace

Results::Counts Results::counts_of(const ResultsLayout& layout) noexcept {
  RONDO_DEMAND(layout.mesh != nullptr, layout.n_snapshots);
  const mesh::Mesh& m = *layout.mesh;
  const bool contact = layout.contact && !m.boundary.empty();
  return {m.n_nodes(), m.boundary.size(), layout.n_snapshots, layout.components,
          contact,     layout.stress,     m.is_solid()};
}

/// Size of the index of results.h5: the descriptions of the datasets, and an entry for each row.
std::size_t Results::index_bytes(const Counts& c) noexcept {
  constexpr std::size_t description = 4096;
  const std::size_t datasets = c.solid ? 25 : 24;
  return datasets * (description + c.times * h5::File::bytes_of_entry);
}

Results::Results(const std::filesystem::path& directory, const ResultsLayout& layout,
                 std::optional<std::size_t> kept)
    : c_(counts_of(layout)),
      directory_(directory),
      unfinished_{directory / new_name},
      coordinates_(layout.mesh->coordinates),
      axial_(layout.mesh->axial),
      ground_(layout.camber),
      boundary_(layout.mesh->boundary),
      tributary_(layout.mesh->tributary),
      free_body_(layout.free_body.begin(), layout.free_body.end()),
      vectors_(c_.nodes),
      forces_(c_.contact ? c_.nodes : 0),
      tensors_(c_.stress ? c_.nodes : 0),
      scalars_(c_.stress ? c_.nodes : 0),
      of_candidates_(c_.contact ? c_.candidates * c_.components : 0),
      words_(layout.words),
      series_(layout.series),
      series_rows_(layout.series.size()) {
  RONDO_DEMAND(c_.nodes > 0 && layout.mass.size() == c_.nodes, c_.nodes, layout.mass.size());
  RONDO_DEMAND(tributary_.size() == c_.candidates, tributary_.size(), c_.candidates);
  RONDO_DEMAND(kept.value_or(0) <= c_.times, c_.times);
  demand_room(directory_ / results_name, bytes(layout));
  file_ = h5::File::create(unfinished_.path, index_bytes(c_));
  file_.call_it(directory_ / results_name);
  file_.set_attribute("/", "format", "rondo results 1");
  file_.set_attribute("/", "analysis", words_.analysis);
  write_mesh(file_, *layout.mesh, layout.mass);
  if (c_.times > 0) write_vtk_cells(file_, *layout.mesh);
  if (!layout.mass_dynamic.empty())
    file_.write("/mesh/mass_dynamic", {c_.nodes}, layout.mass_dynamic,
                {"kg/m", "mass of each node with which it moves: 0 at contact nodes"});
  for (const Constants& c : layout.constants)
    file_.write(c.path, {c.values.size()}, std::span<const double>(c.values), {c.unit, c.meaning});
  if (!free_body_.empty())
    file_.write("/mesh/free_body", {c_.nodes}, free_body_,
                {"1",
                 "number of the free body of each node, in the order of their first nodes: such "
                 "a node moves in the fixed frame; -1: in the co-rotating frame"});
  if (c_.times > 0) {
    create_frame();
    create_snapshots();
    create_contact();
    create_fields();
    create_series();
    reserve();
  }
  if (kept) {
    const h5::File before = h5::File::open(directory_ / results_name);
    for (h5::Dataset* dataset : all_rows_) dataset->copy_rows(before, *kept);
    written_ = *kept;
  }
  // From here on the file exists and is complete at any moment.
  file_.flush();
  replace_file(unfinished_.path, directory_ / results_name);
  begin_shown(*layout.mesh);
}

/// Labels shown fields with the texts of their datasets, in the order shown in fields.vtkhdf.
XdmfSeries Results::labelled(XdmfSeries series) const {
  const auto label_of = [&](const std::string& dataset) {
    const h5::Label label = file_.dataset(dataset).label();
    return ShownLabel{label.units, label.description};
  };
  for (XdmfField& f : series.fields) {
    f.label = label_of(f.dataset);
    std::string& text = f.label.description;
    const std::size_t order = text.rfind(": ");
    if (f.type == "Tensor6") text.replace(order, text.npos, ": xx, yy, zz, xy, yz, xz");
    if (f.components < f.width)
      text.replace(order, text.npos, ": " + f.name.substr(f.name.size() - 2));
  }
  series.position_label = label_of(series.position);
  series.time_label = {words_.time_unit, "of each step: /frame/time of " + series.data_file};
  return series;
}

/// Starts the files for ParaView with the grids of the existing snapshots.
void Results::begin_shown(const mesh::Mesh& mesh) {
  std::vector<double> times = d_.time ? d_.time.read<double>() : std::vector<double>();
  times.resize(written_);
  if (c_.times > 0)
    vtkhdf_ = std::make_unique<Vtkhdf>(directory_ / "fields.vtkhdf", labelled(series_of(mesh, c_)),
                                       times);
  xdmf_ = std::make_unique<Xdmf>(directory_ / "fields.xdmf", series_of(mesh, c_), std::move(times));
}

void Results::resize(std::size_t rows) {
  for (h5::Dataset* dataset : all_rows_) dataset->resize(rows);
}

/// Reserves space for all snapshots in portions: the space that a run stopped early gives back is
/// then at the end of the file, which becomes shorter.
void Results::reserve() {
  constexpr std::size_t parts = 64;
  const std::size_t part = (c_.times + parts - 1) / parts;
  for (std::size_t rows = part; rows < c_.times; rows += part) resize(rows);
  resize(c_.times);
  const std::vector<double> never(c_.times, std::numeric_limits<double>::quiet_NaN());
  d_.time.write(std::span<const double>(never));
}

void Results::check(const Snapshot& s, const SnapshotFields& fields) const {
  RONDO_DEMAND(file_ && written_ < c_.times, written_, c_.times);
  for (const Field* field : {&s.u, &s.v})
    RONDO_DEMAND(field->size() == c_.nodes && field->components() == c_.components, field->size(),
                 field->components(), c_.nodes);
  const std::size_t nb = c_.contact ? c_.candidates : 0;
  RONDO_DEMAND(
      !c_.contact || (fields.contact_force.size() == nb && fields.contact_force_fixed.size() == nb),
      fields.contact_force.size(), fields.contact_force_fixed.size(), nb);
  RONDO_DEMAND(fields.contact_extent.empty() || fields.contact_extent.size() == nb,
               fields.contact_extent.size(), nb);
  const std::size_t stresses = c_.solid ? fields.solid_stress.size() : fields.stress.size();
  RONDO_DEMAND(!c_.stress || stresses == c_.nodes, stresses, c_.nodes);
  const int last =
      free_body_.empty() ? -1 : *std::max_element(free_body_.begin(), free_body_.end());
  RONDO_DEMAND(!c_.stress || static_cast<int>(s.poses.size()) > last, s.poses.size(), last);
}

void Results::write_fields(const Snapshot& s) {
  const FieldView u = s.u, v = s.v;
  d_.displacement.write_row(written_, u.values);
  d_.velocity.write_row(written_, v.values);
  const Complex turn = rotation(s.angle);
  const auto to_fixed = [&](std::size_t i, Vec3 a) { return is_free(i) ? a : turn * a; };
  const Vec3 middle = ground_.to_wheel(s.center);
  for (std::size_t i = 0; i < c_.nodes; ++i) {
    const Vec3 reference{coordinates_[i], c_.solid ? axial_[i] : 0.0};
    const Vec3 center = is_free(i) ? Vec3{} : middle;
    vectors_[i] = rounded(center + to_fixed(i, reference + in_space(u[i])));
  }
  row(d_.position, vectors_);
  for (std::size_t i = 0; i < c_.nodes; ++i) vectors_[i] = rounded(to_fixed(i, in_space(u[i])));
  row(d_.field_displacement, vectors_);
  for (std::size_t i = 0; i < c_.nodes; ++i) vectors_[i] = rounded(to_fixed(i, in_space(v[i])));
  row(d_.field_velocity, vectors_);
}

void Results::write_stress(const Snapshot& s, const SnapshotFields& fields) {
  const Complex turn = rotation(s.angle);
  const auto write = [&](const auto& stress) {
    for (std::size_t i = 0; i < c_.nodes; ++i) {
      scalars_[i] = static_cast<float>(fem::von_mises(stress[i]));
      tensors_[i] =
          turned_tensor(stress[i], is_free(i) ? s.poses[at(free_body_[i])].rotation : turn);
    }
  };
  if (c_.solid)
    write(fields.solid_stress);
  else
    write(fields.stress);
  row(d_.von_mises, scalars_);
  row(d_.stress, tensors_);
}

void Results::write_contact(const SnapshotFields& fields) {
  const std::span<const double> extent =
      fields.contact_extent.empty() ? std::span<const double>(tributary_) : fields.contact_extent;
  const auto put = [&](std::size_t k, Vec3 a) {
    const std::array numbers{a.x, a.y, a.z};
    std::copy_n(numbers.begin(), c_.components, &of_candidates_[k * c_.components]);
  };
  for (std::size_t k = 0; k < c_.candidates; ++k) {
    forces_[at(boundary_[k])] = rounded(fields.contact_force_fixed[k]);
    put(k, fields.contact_force[k]);
  }
  row(d_.field_force, forces_);
  row(d_.force, of_candidates_);
  for (std::size_t k = 0; k < c_.candidates; ++k) put(k, fields.contact_force[k] / extent[k]);
  row(d_.traction, of_candidates_);
}

void Results::write_series(std::span<const double> values) {
  std::size_t at = 0;
  for (std::size_t k = 0; k < series_.size(); ++k) {
    RONDO_DEMAND(at + series_[k].components <= values.size(), at, values.size());
    series_rows_[k].write_row(written_, values.subspan(at, series_[k].components));
    at += series_[k].components;
  }
}

/// The time is written last: if it is a number, the snapshot is complete.
void Results::write(const Snapshot& s, const SnapshotFields& fields) {
  check(s, fields);
  write_fields(s);
  if (c_.stress) write_stress(s, fields);
  if (c_.contact) write_contact(fields);
  write_series(s.series);
  const Vec2 center = s.center.plane();
  d_.center.write_row(written_, std::span(&center, 1));
  if (c_.solid) row(d_.lateral, s.center.z);
  row(d_.angle, s.angle);
  row(d_.angle_velocity, s.angle_velocity);
  row(d_.time_velocity, s.time_velocity);
  row(d_.time, s.time);
  ++written_;
  if (xdmf_) xdmf_->add(s.time);
  if (vtkhdf_) vtkhdf_->add(s.time);
}

KeptSnapshots Results::place() const {
  if (!file_) return at_end_;
  KeptSnapshots kept{.count = written_, .hashes = {}};
  for (const h5::Dataset* dataset : all_rows_)
    kept.hashes[dataset->name()] = dataset->hash_of_written();
  return kept;
}

void Results::close() {
  if (!file_) return;
  at_end_ = place();
  resize(written_);
  all_rows_.clear();
  d_ = {};
  series_rows_.clear();
  file_.close();
  if (xdmf_) xdmf_->close();
  if (vtkhdf_) vtkhdf_->close();
}

Results::~Results() {
  try {
    close();
  } catch (const std::exception&) {  // reported if close() is called
  }
}

void Results::sync() const {
  sync_file(directory_ / results_name);
  if (xdmf_) sync_file(directory_ / "fields.xdmf");
  if (vtkhdf_) vtkhdf_->sync();
}

std::size_t Results::bytes(const ResultsLayout& layout) noexcept {
  const Counts c = counts_of(layout);
  constexpr std::size_t real = 8, single = 4;
  const std::size_t fields =
      2 * c.components * real + (9U + (c.contact ? 3U : 0U) + (c.stress ? 7U : 0U)) * single;
  const std::size_t candidate = c.contact ? 2 * c.components * real : 0;
  std::size_t frame = (c.solid ? 7 : 6) * real;
  for (const Series& s : layout.series) frame += s.components * real;
  std::size_t constants = 0;
  for (const Constants& c : layout.constants) constants += c.values.size() * real;
  const std::size_t shown = c.times > 0 ? vtk_cells_bytes(*layout.mesh) : 0;
  return index_bytes(c) + mesh_bytes(*layout.mesh) + shown + layout.free_body.size() * sizeof(int) +
         constants + c.times * (frame + c.nodes * fields + c.candidates * candidate);
}

}  // namespace rondo::io
