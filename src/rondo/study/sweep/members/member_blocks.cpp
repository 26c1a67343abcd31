// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/members/member_blocks.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rondo::study {
namespace {

/// Members per block, such that there are at most about a thousand blocks.
std::size_t block_of(std::size_t count) {
  constexpr std::size_t blocks = 4000;
  return 1 + count / blocks;
}

}  // namespace

bool each_member(const MemberWork& members, Team& team) {
  const std::size_t block = block_of(members.count);
  const auto last_of = [&](std::size_t b) { return std::min(members.count, (b + 1) * block); };
  TeamWork work;
  work.count = (members.count + block - 1) / block;
  work.work = [&](std::size_t b, const std::atomic<bool>& stop) {
    nlohmann::json done = nlohmann::json::array();
    for (std::size_t k = b * block; k < last_of(b) && !stop.load(); ++k)
      done.push_back(members.work(k));
    const std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(done);
    return std::string(bytes.begin(), bytes.end());
  };
  if (members.watch)
    work.watch = [&](std::size_t ended) { members.watch(std::min(members.count, ended * block)); };
  std::vector<Piece> pieces = team.each(work);
  for (std::size_t b = 0; b < pieces.size(); ++b) {
    if (pieces[b].state == Piece::State::missing) return false;
    demand_done(pieces[b]);
    nlohmann::json done = nlohmann::json::from_cbor(std::exchange(pieces[b].text, {}));
    if (done.size() < last_of(b) - b * block) return false;
    for (std::size_t k = 0; k < done.size(); ++k) members.take(b * block + k, std::move(done[k]));
  }
  return true;
}

}  // namespace rondo::study
