// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_team.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "rondo/core/error.hpp"
#include "rondo/study/sweep/shared_numbers.hpp"

namespace rondo::study {
namespace {

constexpr std::size_t nothing = std::numeric_limits<std::size_t>::max();

struct Header {
  std::uint64_t piece = 0, length = 0;
  std::int32_t state = 0, code = 0, worker = 0, none = 0;
};

void append(std::string& text, const Header& header, const std::string& said) {
  text.append(reinterpret_cast<const char*>(&header), sizeof header);
  text += said;
}

/// Distributes the pieces that are not yet done to processes.
class Round {
 public:
  Round(const TeamWork& work, std::vector<Piece>& pieces, int workers)
      : work_(work), pieces_(pieces), shared_(static_cast<std::size_t>(workers) + 2) {
    for (std::size_t k = 0; k < pieces.size(); ++k)
      if (pieces[k].state == Piece::State::missing) todo_.push_back(k);
    workers_ = static_cast<int>(std::min(static_cast<std::size_t>(workers), todo_.size()));
    for (int w = 0; w < workers_; ++w) in_hand(w) = nothing;
  }

  /// Returns false if a worker was stopped.
  bool run(const std::atomic<bool>* stop) {
    if (stop && stop->load()) return false;
    const std::size_t before = pieces_.size() - todo_.size();
    const std::vector<WorkerOutcome> outcomes = run_workers(
        workers_, [this](int w, const std::atomic<bool>& told) { return take_turns(w, told); },
        stop,
        [&] {
          if (work_.watch) work_.watch(before + ended().load());
        });
    for (std::size_t w = 0; w < outcomes.size(); ++w) settle(static_cast<int>(w), outcomes[w]);
    return !(stop && stop->load());
  }

 private:
  std::atomic<std::size_t>& next() { return shared_[0]; }
  std::atomic<std::size_t>& ended() { return shared_[1]; }
  std::atomic<std::size_t>& in_hand(int worker) {
    return shared_[static_cast<std::size_t>(worker) + 2];
  }

  /// Runs in the worker's process.
  std::string take_turns(int worker, const std::atomic<bool>& stop) {
    std::vector<std::pair<std::size_t, Piece>> mine;
    while (!stop.load()) {
      const std::size_t turn = next().fetch_add(1);
      if (turn >= todo_.size()) break;
      in_hand(worker) = todo_[turn];
      mine.emplace_back(todo_[turn], do_piece(work_, todo_[turn], stop, worker));
      in_hand(worker) = nothing;
      ended().fetch_add(1);
    }
    return packed(mine);
  }

  void settle(int worker, const WorkerOutcome& outcome) {
    if (outcome.code == exit_done) return unpack(outcome.text, pieces_);
    const std::size_t piece = in_hand(worker);
    if (piece == nothing) return;
    pieces_[piece] = {Piece::State::failed, "its process was " + outcome.text, outcome.code,
                      worker};
  }

  const TeamWork& work_;
  std::vector<Piece>& pieces_;
  std::vector<std::size_t> todo_;
  int workers_ = 1;
  SharedNumbers<std::size_t> shared_;  ///< next turn, pieces ended, current piece of each worker
};

}  // namespace

Piece do_piece(const TeamWork& work, std::size_t piece, const std::atomic<bool>& stop, int worker) {
  try {
    return {Piece::State::done, work.work(piece, stop), exit_done, worker};
  } catch (const std::exception& error) {
    const WorkerOutcome failed = failed_by(error);
    return {Piece::State::failed, failed.text, failed.code, worker};
  }
}

void demand_done(const Piece& piece) {
  if (piece.state != Piece::State::failed) return;
  if (piece.code == exit_input) throw InputError(Fault{"", 0, 0, "", "", piece.text, ""});
  if (piece.code == exit_files) throw FileError("sweep", piece.text);
  throw std::runtime_error(piece.text);
}

std::string packed(const std::vector<std::pair<std::size_t, Piece>>& pieces) {
  std::string text;
  for (const auto& [number, piece] : pieces) {
    Header header;
    header.piece = number;
    header.length = piece.text.size();
    header.state = static_cast<std::int32_t>(piece.state);
    header.code = piece.code;
    header.worker = piece.worker;
    append(text, header, piece.text);
  }
  return text;
}

void unpack(const std::string& text, std::vector<Piece>& pieces) {
  std::size_t at = 0;
  while (text.size() - at >= sizeof(Header)) {
    Header header;
    std::memcpy(&header, text.data() + at, sizeof header);
    at += sizeof header;
    if (text.size() - at < header.length) return;
    pieces[header.piece] = {static_cast<Piece::State>(header.state), text.substr(at, header.length),
                            header.code, header.worker};
    at += header.length;
  }
}

std::vector<Piece> LocalTeam::each(const TeamWork& work) {
  std::vector<Piece> pieces(work.count);
  const auto missing = [&] {
    return std::ranges::count(pieces, Piece::State::missing, &Piece::state);
  };
  while (missing() > 0) {  // repeats pieces that a killed worker had done but not reported
    const auto before = missing();
    if (!Round(work, pieces, workers_).run(stop_)) return pieces;
    if (missing() < before) continue;
    for (Piece& piece : pieces)
      if (piece.state == Piece::State::missing)
        piece = {Piece::State::failed, "its process ended without a report", exit_numerical, 0};
  }
  return pieces;
}

}  // namespace rondo::study
