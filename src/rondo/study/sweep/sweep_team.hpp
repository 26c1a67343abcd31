// SPDX-License-Identifier: BSD-3-Clause
/// @file  Those who do a sweep's pieces of work as they come: processes of this machine, or ranks
/// of an MPI job (apps/rondo/sweep/mpi_team.hpp).
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "rondo/study/sweep/worker_processes.hpp"

namespace rondo::study {

/// What came of a piece of work.
struct Piece {
  enum class State { missing, done, failed };  ///< missing: a stop was asked for before its turn
  State state = State::missing;
  std::string text;  ///< what the work returned; of a failure, why
  int code = exit_done;
  int worker = 0;  ///< who did it
};

struct TeamWork {
  std::size_t count = 0;  ///< pieces
  /// Done by one worker after the other for the pieces they take, in the order of their numbers; a
  /// worker keeps what it has built between its pieces. An exception makes the piece a failure.
  std::function<std::string(std::size_t piece, const std::atomic<bool>& stop)> work;
  /// Called now and then where leads() with the number of pieces that have ended; may be empty.
  std::function<void(std::size_t ended)> watch;
};

class Team {
 public:
  Team() = default;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  virtual ~Team() = default;
  /// Writes what concerns the sweep as a whole; true of one only.
  [[nodiscard]] virtual bool leads() const = 0;
  [[nodiscard]] virtual int rank() const { return 0; }
  [[nodiscard]] virtual int workers() const = 0;
  /// No more than that many at once, if that is the team's to decide. @param workers at least 1
  virtual void limit_workers(int workers) = 0;
  /// All members of the team call it with the same pieces, and get the same back.
  [[nodiscard]] virtual std::vector<Piece> each(const TeamWork& work) = 0;
  /// To be called now and then within a long piece, so that others need not wait; may be empty.
  [[nodiscard]] virtual std::function<void()> tick() { return {}; }
  /// Called by who cannot go on. True: all have failed, by the same cause. False after some
  /// seconds: others wait for this one.
  [[nodiscard]] virtual bool have_all_failed() { return true; }
  /// Ends the processes of all.
  virtual void abort(int /*code*/) {}
  /// A text of the leader's, to all.
  [[nodiscard]] virtual std::string from_leader(std::string text) = 0;
};

/// The piece as the worker does it: what it throws becomes a failure.
[[nodiscard]] Piece do_piece(const TeamWork& work, std::size_t piece, const std::atomic<bool>& stop,
                             int worker);

/// @throws InputError, FileError, std::runtime_error: what made the piece fail
void demand_done(const Piece& piece);

/// Pieces with their numbers, to be sent, and back.
[[nodiscard]] std::string packed(const std::vector<std::pair<std::size_t, Piece>>& pieces);
/// @pre made by packed(), or a beginning of that, of which whole pieces are taken
void unpack(const std::string& text, std::vector<Piece>& pieces);

/// Processes of this machine that this one forks, so that a worker that is killed takes no other
/// with it: its piece has failed, what it had done and not told is done again.
class LocalTeam : public Team {
 public:
  /// @param workers at least 1 @param stop set: no new piece is taken, those in hand are told
  LocalTeam(int workers, const std::atomic<bool>* stop) : workers_(workers), stop_(stop) {}
  [[nodiscard]] bool leads() const override { return true; }
  [[nodiscard]] int workers() const override { return workers_; }
  void limit_workers(int workers) override { workers_ = std::min(workers_, workers); }
  [[nodiscard]] std::vector<Piece> each(const TeamWork& work) override;
  [[nodiscard]] std::string from_leader(std::string text) override { return text; }

 private:
  int workers_;
  const std::atomic<bool>* stop_;
};

}  // namespace rondo::study
