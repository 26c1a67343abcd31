// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/cyclic_integrator.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/integrators/fused/tail/implicit_tail.hpp"
#include "rondo/integrators/fused/tail/massless_tail.hpp"
#include "rondo/integrators/implicit/ring_operator.hpp"

namespace rondo::dynamics {

/// Some rows round the ring, over all chunks, in polar components.
class CyclicIntegrator::Rows final : public NodeFields {
 public:
  Rows(CyclicIntegrator& of, const NodeSet& nodes) : of_(of), row_size_(nodes.row_size) {
    const fem::SectorStiffness& k = *of.model_.sector;
    RONDO_DEMAND(nodes.sectors == k.n_sectors && row_size_ >= static_cast<std::size_t>(k.n_sectors),
                 nodes.sectors, row_size_, k.n_sectors);
    for (std::size_t i = 0; i < nodes.size(); i += row_size_) {
      const auto found = std::find(k.nodes.begin(), k.nodes.end(), nodes.node[i]);
      RONDO_ASSERT(found != k.nodes.end(), nodes.node[i]);
      rows_.push_back(static_cast<int>(found - k.nodes.begin()));
    }
  }

  void read_displacement(PlaneField& u) const noexcept override {
    copy_out(CyclicChunk::RowField::u, u);
  }
  void read_velocity(PlaneField& v) const noexcept override {
    copy_out(CyclicChunk::RowField::v, v);
  }
  void read_force(PlaneField& force) const noexcept override {
    copy_out(CyclicChunk::RowField::force, force);
  }
  void write(const PlaneField& u, const PlaneField& v) noexcept override {
    RONDO_ASSERT(u.size() == rows_.size() * row_size_ && v.size() == u.size(), u.size(), v.size());
    for (CyclicChunk& chunk : of_.chunks_)
      for (std::size_t a = 0; a < rows_.size(); ++a) {
        const std::size_t at = a * row_size_;
        chunk.copy_in(rows_[a], CyclicChunk::RowField::u, u.x.data() + at, u.y.data() + at);
        chunk.copy_in(rows_[a], CyclicChunk::RowField::v, v.x.data() + at, v.y.data() + at);
      }
  }

 private:
  void copy_out(CyclicChunk::RowField which, PlaneField& to) const noexcept {
    for (const CyclicChunk& chunk : of_.chunks_)
      for (std::size_t a = 0; a < rows_.size(); ++a)
        chunk.copy_out(rows_[a], which, to.x.data() + a * row_size_, to.y.data() + a * row_size_);
  }

  CyclicIntegrator& of_;
  std::size_t row_size_;
  std::vector<int> rows_;  ///< rows of the sector's stiffness
};

CyclicIntegrator::~CyclicIntegrator() = default;

CyclicIntegrator::CyclicIntegrator(const Model& model, const State& start,
                                   const kernels::Table& table, const CyclicTuning& tuning)
    : RingIntegrator(model, start, table, make_cyclic_plan(model, tuning)) {
  add_tails(table);
}

/// The nodes in rows, and these rows.
NodesInStep CyclicIntegrator::rows_of(std::span<const int> nodes) {
  NodeSet set = ring_nodes(model_, nodes);
  rows_.push_back(std::make_unique<Rows>(*this, set));
  return {std::move(set), rows_.back().get()};
}

/// The ring follows what is around it: implicit elements first.
void CyclicIntegrator::add_tails(const kernels::Table& table) {
  if (model_.implicit) {
    NodesInStep rows = rows_of(model_.implicit->nodes);
    auto implicit = ring_operator(model_, rows.nodes, factored_spin(model_), table.ring_product);
    add_tail(implicit_tail(model_, std::move(rows.nodes), std::move(implicit), *rows.fields));
  }
  if (!has_massless_contact(model_)) return;
  add_tail(massless_tail(model_, rows_of(massless_nodes(model_)), rows_of(sectors_around(model_)),
                         table.ring_product));
  for (CyclicChunk& chunk : chunks_) chunk.show_rows();
}

void CyclicIntegrator::make_steps(const Batch& batch, Share share) noexcept {
  make_passes(batch, share,
              [&](std::size_t c, std::span<const StepContext> steps, PartialStep* parts) {
                chunks_[c].pass(steps, parts, n_parts_, c == holder_ ? corners_within() : nullptr);
              });
}

void CyclicIntegrator::go_on(const kernels::WheelWay& way, long long /*step*/,
                             Share share) noexcept {
  const std::size_t n = chunks_.size();
  for (std::size_t c = share.first(n); c < share.last(n); ++c) chunks_[c].go_on(way);
}

void CyclicIntegrator::show_changes(Share share) noexcept {
  const std::size_t n = chunks_.size();
  for (std::size_t c = share.first(n); c < share.last(n); ++c) chunks_[c].show_rows();
}

/// All in one chunk, and out of what its neighbours advance of it.
bool CyclicIntegrator::hold_within(std::span<const int> candidates) noexcept {
  RONDO_ASSERT(!candidates.empty(), plan_.place.size());
  const auto sector = [&](int candidate) { return plan_.place[at(candidate)].sector; };
  holder_ = chunk_of(sector(candidates.front()));
  if (plan_.cut.halo == Halo::ring) return true;
  const CyclicChunkRange& chunk = plan_.cut.chunks[holder_];
  const int shared = plan_.cut.halo == Halo::wide ? halo_columns : 0;
  return std::all_of(candidates.begin(), candidates.end(), [&](int candidate) {
    const int column = sector(candidate) - chunk.first;
    return column >= shared && column < chunk.columns - shared;
  });
}

CandidateMotion CyclicIntegrator::motion_of(std::size_t candidate) const noexcept {
  const CyclicPlace place = plan_.place[candidate];
  return chunks_[chunk_of(place.sector)].motion_of(place);
}

void CyclicIntegrator::move(std::size_t candidate, Vec3 v, Vec3 u) noexcept {
  const CyclicPlace place = plan_.place[candidate];
  chunks_[chunk_of(place.sector)].move(place, v.plane(), u.plane());
}

}  // namespace rondo::dynamics
