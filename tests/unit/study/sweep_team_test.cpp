// SPDX-License-Identifier: BSD-3-Clause
/// Pieces of work that processes take as they come.
#include "rondo/study/sweep/sweep_team.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <set>
#include <stdexcept>
#include <thread>

#include "rondo/core/error.hpp"

namespace sweep_team_test {

using namespace rondo;
using namespace rondo::study;

namespace {

using State = Piece::State;

TeamWork work_of(std::size_t count, std::function<std::string(std::size_t)> work) {
  return {count,
          [work = std::move(work)](std::size_t k, const std::atomic<bool>&) { return work(k); },
          {}};
}

}  // namespace

TEST(LocalTeam, DoesEachPieceOnceHoweverManyWork) {
  for (const int workers : {1, 2, 5, 40}) {
    LocalTeam team(workers, nullptr);
    const std::vector<Piece> pieces =
        team.each(work_of(20, [](std::size_t k) { return std::string(k * 1000, 'x'); }));
    ASSERT_EQ(pieces.size(), 20U);
    for (std::size_t k = 0; k < 20; ++k) {
      EXPECT_EQ(pieces[k].state, State::done);
      EXPECT_EQ(pieces[k].text.size(), k * 1000);
      EXPECT_LT(pieces[k].worker, workers);
    }
  }
  LocalTeam team(2, nullptr);
  EXPECT_TRUE(team.each(work_of(0, [](std::size_t) { return ""; })).empty());
}

TEST(LocalTeam, WorkersKeepWhatTheyBuild) {
  LocalTeam team(2, nullptr);
  int mine = 0;
  const std::vector<Piece> pieces =
      team.each(work_of(10, [&](std::size_t) { return std::to_string(++mine); }));
  int first = 0;
  for (const Piece& piece : pieces) first += piece.text == "1" ? 1 : 0;
  EXPECT_LE(first, 2);
  EXPECT_EQ(mine, 0);  // in this process
}

TEST(LocalTeam, AnExceptionIsOnePiecesFailure) {
  LocalTeam team(2, nullptr);
  const std::vector<Piece> pieces = team.each(work_of(5, [](std::size_t k) -> std::string {
    if (k == 0) throw InputError(Fault{"f", 0, 0, "", "", "wrong", ""});
    if (k == 1) throw FileError("file", "full");
    if (k == 2) throw std::bad_alloc();
    if (k == 3) throw std::runtime_error("odd");
    return "fine";
  }));
  const std::vector<int> codes{exit_input, exit_files, exit_files, exit_numerical};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(pieces[k].state, State::failed);
    EXPECT_EQ(pieces[k].code, codes[k]);
  }
  EXPECT_NE(pieces[1].text.find("full"), std::string::npos);
  EXPECT_EQ(pieces[4].text, "fine");
}

/// It takes only its own piece with it: what it had done before is done again.
TEST(LocalTeam, AKilledWorkerLosesOnePiece) {
  for (const int workers : {1, 3}) {
    LocalTeam team(workers, nullptr);
    const std::vector<Piece> pieces = team.each(work_of(12, [](std::size_t k) {
      if (k == 5) kill(getpid(), SIGKILL);
      return std::to_string(k);
    }));
    for (std::size_t k = 0; k < 12; ++k) {
      if (k == 5) continue;
      EXPECT_EQ(pieces[k].state, State::done) << k;
      EXPECT_EQ(pieces[k].text, std::to_string(k));
    }
    EXPECT_EQ(pieces[5].state, State::failed);
    EXPECT_EQ(pieces[5].code, exit_files);
    EXPECT_NE(pieces[5].text.find("killed by signal 9"), std::string::npos) << pieces[5].text;
  }
}

TEST(LocalTeam, AllWorkersKilledIsNoEndlessLoop) {
  LocalTeam team(2, nullptr);
  const std::vector<Piece> pieces = team.each(work_of(6, [](std::size_t) -> std::string {
    kill(getpid(), SIGKILL);
    return "";
  }));
  for (const Piece& piece : pieces) EXPECT_EQ(piece.state, State::failed);
}

TEST(LocalTeam, AStopLeavesWhatIsNotInHand) {
  std::atomic<bool> stop{false};
  LocalTeam team(2, &stop);
  TeamWork work;
  work.count = 50;
  work.work = [](std::size_t, const std::atomic<bool>& told) -> std::string {
    for (int k = 0; k < 3000 && !told.load(); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return told.load() ? "told" : "not told";
  };
  work.watch = [&](std::size_t) { stop = true; };
  const std::vector<Piece> pieces = team.each(work);
  int told = 0, missing = 0;
  for (const Piece& piece : pieces) {
    told += piece.state == State::done && piece.text == "told" ? 1 : 0;
    missing += piece.state == State::missing ? 1 : 0;
  }
  EXPECT_GE(told, 1);
  EXPECT_LE(told, 2);
  EXPECT_EQ(told + missing, 50);
}

TEST(LocalTeam, CountsWhatHasEnded) {
  LocalTeam team(2, nullptr);
  std::size_t last = 0;
  TeamWork work = work_of(7, [](std::size_t) { return ""; });
  work.watch = [&](std::size_t ended) {
    EXPECT_GE(ended, last);
    last = ended;
  };
  static_cast<void>(team.each(work));
  EXPECT_EQ(last, 7U);
}

TEST(TeamPieces, WholeOnesOfAPartAreTaken) {
  const std::vector<std::pair<std::size_t, Piece>> two{{3, {State::done, "three", 0, 1}},
                                                       {1, {State::failed, "one", 4, 0}}};
  const std::string text = packed(two);
  std::vector<Piece> pieces(5);
  unpack(text, pieces);
  EXPECT_EQ(pieces[3].text, "three");
  EXPECT_EQ(pieces[3].worker, 1);
  EXPECT_EQ(pieces[1].code, 4);
  EXPECT_EQ(pieces[0].state, State::missing);
  std::vector<Piece> part(5);
  unpack(text.substr(0, text.size() - 1), part);
  EXPECT_EQ(part[3].text, "three");
  EXPECT_EQ(part[1].state, State::missing);
}

}  // namespace sweep_team_test
