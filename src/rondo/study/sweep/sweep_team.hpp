// SPDX-License-Identifier: BSD-3-Clause
/// @file  Teams that do the pieces of work of a sweep: processes of this machine, or ranks of an
/// MPI job (apps/rondo/sweep/mpi_team.hpp).
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "rondo/study/sweep/worker_processes.hpp"

namespace rondo::study {

/// The result of a piece of work.
struct Piece {
  enum class State { missing, done, failed };  ///< missing: a stop was requested before its turn
  State state = State::missing;
  std::string text;  ///< result of the work; for a failure, the reason
  int code = exit_done;
  int worker = 0;  ///< the worker that did it
};

struct TeamWork {
  std::size_t count = 0;  ///< number of pieces
  /// Workers take pieces in the order of their numbers and call this for each; a worker keeps what
  /// it has built between its pieces. An exception makes the piece a failure.
  std::function<std::string(std::size_t piece, const std::atomic<bool>& stop)> work;
  /// Where leads() is true: called from time to time with the number of ended pieces; may be empty.
  std::function<void(std::size_t ended)> watch;
};

class Team {
 public:
  Team() = default;
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  virtual ~Team() = default;
  /// Whether it writes the files of the whole sweep; true for only one member of the team.
  [[nodiscard]] virtual bool leads() const = 0;
  [[nodiscard]] virtual int rank() const { return 0; }
  [[nodiscard]] virtual int workers() const = 0;
  /// Limits the number of workers at once, if the team decides about it. @param workers at least 1
  virtual void limit_workers(int workers) = 0;
  /// All members of the team call it with the same pieces, and receive the same results.
  [[nodiscard]] virtual std::vector<Piece> each(const TeamWork& work) = 0;
  /// Must be called from time to time in a long piece, so that others need not wait; may be empty.
  [[nodiscard]] virtual std::function<void()> tick() { return {}; }
  /// Called by a member that cannot continue. Returns true if all have failed for the same reason,
  /// false after some seconds: then others wait for this one.
  [[nodiscard]] virtual bool have_all_failed() { return true; }
  /// Ends the processes of all.
  virtual void abort(int /*code*/) {}
  /// Sends the leader's text to all.
  [[nodiscard]] virtual std::string from_leader(std::string text) = 0;
};

/// Does the piece in the worker; an exception becomes a failure.
[[nodiscard]] Piece do_piece(const TeamWork& work, std::size_t piece, const std::atomic<bool>& stop,
                             int worker);

/// @throws InputError, FileError, std::runtime_error: the reason why the piece failed
void demand_done(const Piece& piece);

/// Converts pieces with their numbers to a text that can be sent; unpack() reverses it.
[[nodiscard]] std::string packed(const std::vector<std::pair<std::size_t, Piece>>& pieces);
/// @pre text was made by packed(), or is the beginning of such a text: complete pieces are read
void unpack(const std::string& text, std::vector<Piece>& pieces);

/// Processes forked on this machine. If a worker is killed, the others continue: its current piece
/// has failed, and pieces that it had done but not reported are repeated.
class LocalTeam : public Team {
 public:
  /// @param workers at least 1 @param stop set: no new piece starts, and running ones are told
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
