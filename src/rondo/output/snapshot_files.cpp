// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/snapshot_files.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "rondo/io/files.hpp"
#include "rondo/model/corotated.hpp"
#include "rondo/output/columns.hpp"

namespace rondo::study {
namespace {

constexpr const char* contact_name = "contact.csv";

io::Csv contact_file(const std::filesystem::path& directory, const RecordPlan& plan,
                     const Checkpoint* from) {
  const std::filesystem::path file = directory / contact_name;
  const bool solid = plan.results.mesh->is_solid();
  std::vector<ColumnLabel> labels = labels_of(solid ? solid_contact_columns() : contact_columns());
  for (ColumnLabel& label : labels_of(plan.contact_columns)) labels.push_back(std::move(label));
  const std::vector<std::string> names = names_of(labels);
  return from ? io::Csv(file, names, from->files.table(contact_name)) : io::Csv(file, names);
}

}  // namespace

SnapshotFiles::SnapshotFiles(const std::filesystem::path& directory, const RecordPlan& plan,
                             const Checkpoint* from)
    : mesh_(*plan.results.mesh),
      boundary_(mesh_),
      ground_(plan.ground),
      model_(plan.model),
      contact_(plan.results.contact),
      further_columns_(plan.contact_columns),
      results_(directory, plan.results,
               from ? std::optional(from->files.snapshots.count) : std::nullopt),
      contact_csv_(contact_file(directory, plan, from)) {
  if (plan.results.stress && !mesh_.is_solid()) stress_.emplace(mesh_, plan.materials);
  if (plan.results.stress && mesh_.is_solid()) solid_stress_.emplace(mesh_, plan.materials);
  camber_ = plan.results.camber;
  const std::size_t nb = contact_ ? mesh_.boundary.size() : 0;
  if (model_) elastic_.resize(mesh_.n_nodes());
  if (model_) rotations_.resize(model_->free_bodies.size());
  force_.resize(nb);
  force_fixed_.resize(nb);
  extent_ = mesh_.tributary;
  extent_.resize(nb);
  on_ground_.resize(nb);
  slip_.resize(nb);
  sticks_.resize(nb);
  lateral_.resize(nb);
  fixed_axial_.resize(nb);
  rows_.reserve((columns().size() + further_columns_.size()) * nb);
}

/// A node held by two facets gives the sum of both, and sticks where both that press it do.
void SnapshotFiles::collect_contact(const Snapshot& snapshot) {
  std::fill(force_.begin(), force_.end(), Vec2{});
  std::fill(force_fixed_.begin(), force_fixed_.end(), Vec2{});
  std::fill(on_ground_.begin(), on_ground_.end(), char{0});
  std::fill(sticks_.begin(), sticks_.end(), char{1});
  std::fill(lateral_.begin(), lateral_.end(), 0.0);
  std::fill(fixed_axial_.begin(), fixed_axial_.end(), 0.0);
  for (const ContactForce& c : snapshot.contacts) {
    force_[c.candidate] += c.force;
    force_fixed_[c.candidate] += c.force_fixed;
    if (c.on_ground) on_ground_[c.candidate] = 1;
    slip_[c.candidate] = c.slip;
    if (c.force != Vec2{} && !c.sticks) sticks_[c.candidate] = 0;
    lateral_[c.candidate] += c.lateral;
    fixed_axial_[c.candidate] += c.fixed_axial;
    extent_[c.candidate] = boundary_.extent(c.candidate, snapshot.u, snapshot.axial_u);
  }
}

Vec2 SnapshotFiles::position(const Snapshot& s, std::size_t node) const {
  const Vec2 arm = mesh_.coordinates[node] + s.u[node];
  if (model_ && in_fixed_frame(*model_, node)) return arm;
  return s.center + rotation(s.angle) * arm;
}

/// Along t1, n and t2.
Vec3 SnapshotFiles::place_on_ground(const Snapshot& s, std::size_t node) const {
  const dynamics::GroundAxes axes(camber_);
  const Vec3 arm = rotation(s.angle) *
                   Vec3(mesh_.coordinates[node] + s.u[node], mesh_.axial[node] + s.axial_u[node]);
  return {s.center + axes.plane(arm), s.lateral + axes.lateral(arm)};
}

void SnapshotFiles::write_contact_rows(const Snapshot& snapshot) {
  rows_.clear();
  for (std::size_t k = 0; k < force_.size(); ++k) {
    if (force_[k].x <= 0.0) continue;
    ContactRecord r;
    r.time = snapshot.time;
    r.node = mesh_.boundary[k];
    r.position = position(snapshot, static_cast<std::size_t>(r.node));
    if (mesh_.is_solid()) {
      const Vec3 place = place_on_ground(snapshot, static_cast<std::size_t>(r.node));
      r.position = place.plane();
      r.lateral = place.z;
      r.shear_lateral = lateral_[k] / extent_[k];
    }
    r.abscissa = on_ground_[k] && ground_ ? ground_->abscissa(r.position)
                                          : std::numeric_limits<double>::quiet_NaN();
    r.traction = force_[k] / extent_[k];
    r.extent = extent_[k];
    r.slip = slip_[k];
    r.sticks = sticks_[k] != 0;
    append_values(columns(), r, rows_);
    append_values(further_columns_, r, rows_);
  }
  contact_csv_.rows(rows_);
}

/// What a body's stress is of.
std::span<const Vec2> SnapshotFiles::elastic(const Snapshot& snapshot) {
  if (elastic_.empty()) return snapshot.u;
  dynamics::elastic_displacements(*model_, snapshot.u, snapshot.poses, elastic_);
  return elastic_;
}

namespace {

void interleave_fields(std::span<const Vec2> plane, std::span<const double> axial,
                       std::vector<double>& out) {
  out.resize(3 * plane.size());
  for (std::size_t i = 0; i < plane.size(); ++i) {
    out[3 * i] = plane[i].x;
    out[3 * i + 1] = plane[i].y;
    out[3 * i + 2] = axial[i];
  }
}

}  // namespace

/// Fields of three components, and their stress.
void SnapshotFiles::interleave(const Snapshot& snapshot, io::Snapshot& s) {
  interleave_fields(snapshot.u, snapshot.axial_u, u_);
  interleave_fields(snapshot.v, snapshot.axial_v, v_);
  s.lateral = snapshot.lateral;
  s.displacement = {u_, 3};
  s.velocity = {v_, 3};
  if (contact_) {
    interleave_fields(force_, lateral_, spatial_);
    interleave_fields(force_fixed_, fixed_axial_, spatial_fixed_);
    s.contact_force = {spatial_, 3};
    s.contact_force_fixed = {spatial_fixed_, 3};
  }
  if (solid_stress_) s.solid_stress = (*solid_stress_)(snapshot.u, snapshot.axial_u);
}

void SnapshotFiles::write(const Snapshot& snapshot) {
  io::Snapshot s;
  s.time = snapshot.time;
  s.time_velocity = snapshot.time_velocity;
  s.angle = snapshot.angle;
  s.angle_velocity = snapshot.angle_velocity;
  s.center = snapshot.center;
  s.displacement = snapshot.u;
  s.velocity = snapshot.v;
  if (contact_) {
    collect_contact(snapshot);
    s.contact_force = force_;
    s.contact_force_fixed = force_fixed_;
    s.contact_extent = extent_;
    write_contact_rows(snapshot);
  }
  if (stress_) s.stress = (*stress_)(elastic(snapshot));
  if (mesh_.is_solid()) interleave(snapshot, s);
  for (std::size_t b = 0; b < rotations_.size(); ++b) rotations_[b] = snapshot.poses[b].rotation;
  s.body_rotation = rotations_;
  s.series = snapshot.series;
  results_.write(s);
}

void SnapshotFiles::sync() const {
  results_.sync();
  io::sync_file(contact_csv_.path());
}

void SnapshotFiles::add_to(KeptFiles& files) const {
  files.tables[contact_name] = contact_csv_.place();
  files.snapshots = results_.place();
}

void SnapshotFiles::close() {
  contact_csv_.close();
  results_.close();
}

}  // namespace rondo::study
