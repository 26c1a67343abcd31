// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/mpi_team.hpp"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace rondo::app {
namespace {

/// A number in the memory of rank 0 that each rank can read and increment atomically.
class Counter {
 public:
  explicit Counter(int rank) {
    MPI_Win_allocate(rank == 0 ? sizeof(long long) : 0, sizeof(long long), MPI_INFO_NULL,
                     MPI_COMM_WORLD, &memory_, &window_);
    if (rank == 0) *memory_ = 0;
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Win_lock_all(0, window_);
  }
  ~Counter() {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  /// Increments the number by `by` and returns the previous one.
  std::size_t add(long long by) {
    long long before = 0;
    MPI_Fetch_and_op(&by, &before, MPI_LONG_LONG, 0, 0, MPI_SUM, window_);
    MPI_Win_flush(0, window_);
    return static_cast<std::size_t>(before);
  }

 private:
  long long* memory_ = nullptr;
  MPI_Win window_ = MPI_WIN_NULL;
};

void look_after_messages() {
  int found = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, MPI_STATUS_IGNORE);
}

/// Sends a text of one rank to all; a text longer than an int can count is sent in parts.
std::string broadcast(std::string text, int from, int rank) {
  auto size = static_cast<unsigned long long>(text.size());
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, from, MPI_COMM_WORLD);
  if (rank != from) text.resize(static_cast<std::size_t>(size));
  constexpr std::size_t part = 1U << 30U;
  for (std::size_t at = 0; at < text.size(); at += part)
    MPI_Bcast(text.data() + at, static_cast<int>(std::min(part, text.size() - at)), MPI_BYTE, from,
              MPI_COMM_WORLD);
  return text;
}

class MpiTeam : public study::Team {
 public:
  explicit MpiTeam(const std::atomic<bool>& stop) : stop_(stop) {
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm_dup(MPI_COMM_WORLD, &failed_);
  }
  ~MpiTeam() override {
    MPI_Comm_free(&failed_);
    MPI_Finalize();
  }

  /// A barrier with a time limit.
  [[nodiscard]] bool have_all_failed() override {
    constexpr auto patience = std::chrono::seconds(5);
    MPI_Request barrier = MPI_REQUEST_NULL;
    MPI_Ibarrier(failed_, &barrier);
    const auto begin = std::chrono::steady_clock::now();
    int all = 0;
    while (all == 0 && std::chrono::steady_clock::now() - begin < patience)
      MPI_Test(&barrier, &all, MPI_STATUS_IGNORE);
    return all != 0;
  }
  void abort(int code) override { MPI_Abort(MPI_COMM_WORLD, code); }

  [[nodiscard]] bool leads() const override { return rank_ == 0; }
  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int workers() const override { return size_; }
  void limit_workers(int) override {}  // mpirun has decided
  [[nodiscard]] std::function<void()> tick() override {
    return [this] {
      look_after_messages();
      if (watch_) watch_();
    };
  }
  [[nodiscard]] std::string from_leader(std::string text) override {
    return broadcast(std::move(text), 0, rank_);
  }

  [[nodiscard]] std::vector<study::Piece> each(const study::TeamWork& work) override {
    std::vector<std::pair<std::size_t, study::Piece>> mine;
    {
      Counter turn(rank_), ended(rank_);
      if (work.watch && leads()) watch_ = [&] { work.watch(ended.add(0)); };
      while (!stop_.load()) {
        const std::size_t piece = turn.add(1);
        if (piece >= work.count) break;
        mine.emplace_back(piece, study::do_piece(work, piece, stop_, rank_));
        ended.add(1);
        if (watch_) watch_();
      }
      MPI_Barrier(MPI_COMM_WORLD);  // the counters must exist until all are finished
      if (watch_) watch_();
      watch_ = nullptr;
    }
    return gather(study::packed(mine), work.count);
  }

 private:
  [[nodiscard]] std::vector<study::Piece> gather(const std::string& mine, std::size_t count) const {
    std::vector<study::Piece> pieces(count);
    for (int rank = 0; rank < size_; ++rank)
      study::unpack(broadcast(rank == rank_ ? mine : std::string(), rank, rank_), pieces);
    return pieces;
  }

  const std::atomic<bool>& stop_;
  int rank_ = 0, size_ = 1;
  MPI_Comm failed_ = MPI_COMM_NULL;  ///< used only by have_all_failed()
  std::function<void()> watch_;      ///< of the current work; only the leader's
};

}  // namespace

bool is_started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

std::unique_ptr<study::Team> make_mpi_team(const std::atomic<bool>& stop) {
  return std::make_unique<MpiTeam>(stop);
}

}  // namespace rondo::app
