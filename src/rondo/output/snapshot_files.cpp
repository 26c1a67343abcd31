// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/snapshot_files.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/io/files.hpp"
#include "rondo/model/corotated.hpp"
#include "rondo/output/columns.hpp"

namespace rondo::study {
namespace {

constexpr const char* contact_name = "contact.csv";

io::Csv contact_file(const std::filesystem::path& directory, const RecordPlan& plan,
                     const Checkpoint* from) {
  const std::filesystem::path file = directory / contact_name;
  std::vector<ColumnLabel> labels = labels_of(contact_columns(plan.results.mesh->is_solid()));
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
  RONDO_DEMAND(!plan.results.stress || !plan.materials.empty(), plan.materials.size());
  if (plan.results.stress && !mesh_.is_solid()) stress_.emplace(mesh_, plan.materials);
  if (plan.results.stress && mesh_.is_solid()) solid_stress_.emplace(mesh_, plan.materials);
  RONDO_DEMAND(!contact_ || mesh_.tributary.size() == mesh_.boundary.size(), mesh_.tributary.size(),
               mesh_.boundary.size());
  in_ground_ = GroundFrame(plan.results.camber);
  const std::size_t nb = contact_ ? mesh_.boundary.size() : 0;
  if (model_) elastic_.resize(mesh_.n_nodes());
  force_.resize(nb);
  force_fixed_.resize(nb);
  extent_ = mesh_.tributary;
  extent_.resize(nb);
  on_ground_.resize(nb);
  slip_.resize(nb);
  power_.resize(nb);
  sticks_.resize(nb);
  rows_.reserve((columns().size() + further_columns_.size()) * nb);
}

/// A node that touches two facets has the sum of both, and sticks if both that press it stick.
void SnapshotFiles::collect_contact(const Snapshot& snapshot) {
  std::fill(on_ground_.begin(), on_ground_.end(), char{0});
  std::fill(sticks_.begin(), sticks_.end(), char{1});
  std::ranges::fill(force_, Vec3{});
  std::ranges::fill(force_fixed_, Vec3{});
  std::ranges::fill(power_, 0.0);
  for (const ContactForce& c : snapshot.contacts) {
    RONDO_ASSERT(c.candidate < force_.size(), c.candidate, force_.size());
    force_[c.candidate] += c.force;
    force_fixed_[c.candidate] += c.force_fixed;
    if (c.on_ground) on_ground_[c.candidate] = 1;
    slip_[c.candidate] = c.slip;
    power_[c.candidate] += c.power;
    if (c.force != Vec3{} && !c.sticks) sticks_[c.candidate] = 0;
    extent_[c.candidate] = boundary_.extent(c.candidate, snapshot.u);
  }
}

/// Position x, y in the plane; in three dimensions along (t1, n, t2).
Vec3 SnapshotFiles::position(const Snapshot& s, std::size_t node) const {
  if (mesh_.is_solid()) {
    const Vec3 arm = Vec3(mesh_.coordinates[node], mesh_.axial[node]) + s.u.space()[node];
    return s.center + in_ground_.from_wheel(rotation(s.angle) * arm);
  }
  const Vec2 arm = mesh_.coordinates[node] + s.u.plane()[node];
  if (model_ && in_fixed_frame(*model_, node)) return arm;
  return s.center.plane() + rotation(s.angle) * arm;
}

void SnapshotFiles::write_contact_rows(const Snapshot& snapshot) {
  rows_.clear();
  for (std::size_t k = 0; k < force_.size(); ++k) {
    if (force_[k].x <= 0.0) continue;
    RONDO_ASSERT(!(extent_[k] <= 0.0), k, extent_[k]);  // of the nodes in snapshot.contacts
    ContactRecord r;
    r.time = snapshot.time;
    r.node = mesh_.boundary[k];
    r.position = position(snapshot, static_cast<std::size_t>(r.node));
    r.abscissa = on_ground_[k] && ground_ ? ground_->abscissa(r.position.plane())
                                          : std::numeric_limits<double>::quiet_NaN();
    r.traction = force_[k] / extent_[k];
    r.extent = extent_[k];
    r.slip = slip_[k];
    r.power = power_[k] / extent_[k];
    r.sticks = sticks_[k] != 0;
    append_values(columns(), r, rows_);
    append_values(further_columns_, r, rows_);
  }
  RONDO_DEMAND(rows_.size() % (columns().size() + further_columns_.size()) == 0, rows_.size());
  contact_csv_.rows(rows_);
}

/// Displacements that cause stress: for free bodies in the frame of their mean rotation.
std::span<const Vec2> SnapshotFiles::elastic(const Snapshot& snapshot) {
  if (elastic_.empty()) return snapshot.u;
  RONDO_DEMAND(
      snapshot.poses.size() == model_->free_bodies.size() && snapshot.u.size() == elastic_.size(),
      snapshot.poses.size(), snapshot.u.size(), elastic_.size());
  dynamics::elastic_displacements(*model_, snapshot.u, snapshot.poses, elastic_);
  return elastic_;
}

void SnapshotFiles::write(const Snapshot& snapshot) {
  RONDO_DEMAND(snapshot.u.size() == mesh_.n_nodes(), snapshot.u.size(), mesh_.n_nodes());
  io::SnapshotFields fields;
  if (contact_) {
    collect_contact(snapshot);
    fields.contact_force = force_;
    fields.contact_force_fixed = force_fixed_;
    fields.contact_extent = extent_;
    write_contact_rows(snapshot);
  }
  if (stress_) fields.stress = (*stress_)(elastic(snapshot));
  if (solid_stress_) fields.solid_stress = (*solid_stress_)(snapshot.u);
  results_.write(snapshot, fields);
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
