// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/simulation/memory_recorder.hpp"

#include <array>
#include <span>

namespace rondo::study {

std::size_t memory_of_snapshots(const RecordPlan& plan) noexcept {
  const io::ResultsLayout& layout = plan.results;
  if (!layout.mesh) return 0;
  const std::size_t candidates = layout.contact ? layout.mesh->boundary.size() : 0;
  return layout.n_snapshots * (2 * layout.mesh->n_nodes() + candidates) * layout.components *
         sizeof(double);
}

MemoryRecorder::MemoryRecorder(const RecordPlan& plan, bool keeps_snapshots)
    : columns_(plan.columns), keeps_(keeps_snapshots && plan.results.mesh != nullptr) {
  if (!keeps_) return;
  const io::ResultsLayout& layout = plan.results;
  kept_.nodes = layout.mesh->n_nodes();
  kept_.components = layout.components;
  kept_.candidates = layout.contact ? layout.mesh->boundary.size() : 0;
  const std::size_t n = layout.n_snapshots;
  for (std::vector<double>* field : {&kept_.displacement, &kept_.velocity})
    field->reserve(n * kept_.nodes * kept_.components);
  kept_.contact_force.reserve(n * kept_.candidates * kept_.components);
}

/// A node held by two facets gives the sum of both.
void MemoryRecorder::add_contact() {
  const std::size_t c = kept_.components, begin = kept_.contact_force.size();
  kept_.contact_force.resize(begin + kept_.candidates * c, 0.0);
  for (const ContactForce& f : next_.contacts) {
    double* at = kept_.contact_force.data() + begin + f.candidate * c;
    at[0] += f.force.x;
    at[1] += f.force.y;
    if (c == 3) at[2] += f.force.z;
  }
}

void MemoryRecorder::add_snapshot() {
  if (!keeps_) return;
  ++kept_.count;
  kept_.time.push_back(next_.time);
  kept_.time_velocity.push_back(next_.time_velocity);
  kept_.angle.push_back(next_.angle);
  kept_.angle_velocity.push_back(next_.angle_velocity);
  const auto add = [](FieldView field, std::vector<double>& to) {
    to.insert(to.end(), field.values.begin(), field.values.end());
  };
  const std::array center{next_.center.x, next_.center.y, next_.center.z};
  add(FieldView(std::span(center).first(kept_.components), kept_.components), kept_.center);
  add(next_.u, kept_.displacement);
  add(next_.v, kept_.velocity);
  if (kept_.candidates > 0) add_contact();
}

}  // namespace rondo::study
