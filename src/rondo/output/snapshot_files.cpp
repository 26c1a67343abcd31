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

io::Csv contact_file(const std::filesystem::path& directory, const RecordPlan& plan,
                     const Checkpoint* from) {
  const std::filesystem::path file = directory / "contact.csv";
  std::vector<ColumnLabel> labels = labels_of(contact_columns());
  for (ColumnLabel& label : labels_of(plan.contact_columns)) labels.push_back(std::move(label));
  const std::vector<std::string> names = names_of(labels);
  return from ? io::Csv(file, names, from->files.contact_bytes) : io::Csv(file, names);
}

}  // namespace

SnapshotFiles::SnapshotFiles(const std::filesystem::path& directory, const RecordPlan& plan,
                             const Checkpoint* from)
    : mesh_(*plan.results.mesh),
      ground_(plan.ground),
      model_(plan.model),
      contact_(plan.results.contact),
      further_columns_(plan.contact_columns),
      results_(directory, plan.results, from ? std::optional(from->files.snapshots) : std::nullopt),
      contact_csv_(contact_file(directory, plan, from)) {
  if (plan.results.stress) stress_.emplace(mesh_, plan.materials);
  const std::size_t nb = contact_ ? mesh_.boundary.size() : 0;
  if (model_) elastic_.resize(mesh_.n_nodes());
  if (model_) rotations_.resize(model_->free_bodies.size());
  force_.resize(nb);
  force_fixed_.resize(nb);
  on_ground_.resize(nb);
  slip_.resize(nb);
  sticks_.resize(nb);
  rows_.reserve((contact_columns().size() + further_columns_.size()) * nb);
}

/// A node held by two facets gives the sum of both.
void SnapshotFiles::collect_contact(const Snapshot& snapshot) {
  std::fill(force_.begin(), force_.end(), Vec2{});
  std::fill(force_fixed_.begin(), force_fixed_.end(), Vec2{});
  std::fill(on_ground_.begin(), on_ground_.end(), char{0});
  for (const ContactForce& c : snapshot.contacts) {
    force_[c.candidate] += c.force;
    force_fixed_[c.candidate] += c.force_fixed;
    if (c.on_ground) on_ground_[c.candidate] = 1;
    slip_[c.candidate] = c.slip;
    sticks_[c.candidate] = c.sticks ? 1 : 0;
  }
}

Vec2 SnapshotFiles::position(const Snapshot& s, std::size_t node) const {
  const Vec2 arm = mesh_.coordinates[node] + s.u[node];
  if (model_ && in_fixed_frame(*model_, node)) return arm;
  return s.center + rotation(s.angle) * arm;
}

void SnapshotFiles::write_contact_rows(const Snapshot& snapshot) {
  rows_.clear();
  for (std::size_t k = 0; k < force_.size(); ++k) {
    if (force_[k].x <= 0.0) continue;
    ContactRecord r;
    r.time = snapshot.time;
    r.node = mesh_.boundary[k];
    r.position = position(snapshot, static_cast<std::size_t>(r.node));
    r.abscissa = on_ground_[k] && ground_ ? ground_->abscissa(r.position)
                                          : std::numeric_limits<double>::quiet_NaN();
    r.traction = force_[k] / mesh_.tributary[k];
    r.slip = slip_[k];
    r.sticks = sticks_[k] != 0;
    append_values(contact_columns(), r, rows_);
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
    write_contact_rows(snapshot);
  }
  if (stress_) s.stress = (*stress_)(elastic(snapshot));
  for (std::size_t b = 0; b < rotations_.size(); ++b) rotations_[b] = snapshot.poses[b].rotation;
  s.body_rotation = rotations_;
  s.series = snapshot.series;
  results_.write(s);
}

void SnapshotFiles::sync() const {
  results_.sync();
  io::sync_file(contact_csv_.path());
}

void SnapshotFiles::close() {
  contact_csv_.close();
  results_.close();
}

}  // namespace rondo::study
