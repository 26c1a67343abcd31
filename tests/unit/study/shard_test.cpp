// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/shards/shard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "rondo/core/error.hpp"

namespace rondo::study::shard_test {
namespace {

/// `bodies` one after the other, of 1, 2, ... members.
std::vector<PlannedMember> members_of_bodies(std::size_t bodies) {
  std::vector<PlannedMember> members;
  for (std::size_t b = 0; b < bodies; ++b)
    for (std::size_t k = 0; k <= b; ++k) {
      PlannedMember& member = members.emplace_back();
      member.body = std::to_string(b);
      member.finds_modes = true;
      if (k > 0) member.modes_of = members.size() - 1 - k;
    }
  return members;
}

TEST(Shards, HaveTheSameNumberOfMembersButForOne) {
  for (const std::size_t bodies : {1U, 2U, 5U, 9U})
    for (std::size_t n = 1; n < 60; n += 3) {
      const std::vector<PlannedMember> members = members_of_bodies(bodies);
      std::vector<std::size_t> size(n, 0);
      for (const std::size_t shard : divide(members, n)) ++size.at(shard - 1);
      const auto [least, most] = std::ranges::minmax(size);
      EXPECT_LE(most - least, 1U) << bodies << " bodies, " << n << " shards";
    }
}

TEST(Shards, SplitNoMoreBodiesThanThereAreCuts) {
  const std::vector<PlannedMember> members = members_of_bodies(9);
  for (std::size_t n = 1; n < 20; ++n) {
    const std::vector<std::size_t> shard = divide(members, n);
    std::set<std::pair<std::string, std::size_t>> pieces;
    for (std::size_t m = 0; m < members.size(); ++m) pieces.emplace(members[m].body, shard[m]);
    EXPECT_LE(pieces.size(), 9 + n - 1) << n;
  }
}

TEST(Shards, DealOutWhatTakesLonger) {
  std::vector<PlannedMember> one(6), each(6);
  for (std::size_t m = 0; m < 6; ++m) each[m].body = std::to_string(m);
  const std::vector<std::size_t> dealt{1, 2, 1, 2, 1, 2};
  EXPECT_EQ(divide(one, 2), dealt);
  EXPECT_EQ(divide(each, 2), dealt);
}

TEST(Shards, AreLentTheFirstOfTheirBodies) {
  for (const std::size_t n : {1U, 2U, 7U, 40U}) {
    std::vector<std::size_t> owners(members_of_bodies(6).size(), 0);
    for (std::size_t i = 1; i <= n; ++i) {
      std::vector<PlannedMember> members = members_of_bodies(6);
      choose_members(members, {i, n});
      for (std::size_t m = 0; m < members.size(); ++m) {
        owners[m] += members[m].part == Part::own ? 1 : 0;
        const bool needed = std::ranges::any_of(members, [&](const PlannedMember& other) {
          return other.part == Part::own && other.modes_of == m;
        });
        EXPECT_EQ(members[m].part == Part::lent, needed && members[m].part != Part::own);
      }
    }
    EXPECT_EQ(owners, std::vector<std::size_t>(owners.size(), 1));
  }
}

TEST(Shards, NamesOfFolders) {
  Shard shard;
  EXPECT_EQ(folder_name({3, 16}), "0003-of-0016");
  EXPECT_EQ(folder_name({3, 12345}), "00003-of-12345");
  EXPECT_TRUE(shard_of_folder("0003-of-0016", shard));
  EXPECT_EQ(text_of(shard), "3/16");
  for (const char* name :
       {"3-of-16", "0003-of-0002", "0000-of-0016", "0003-of-0016.1.tmp", "a-of-b"})
    EXPECT_FALSE(shard_of_folder(name, shard)) << name;
  for (const char* text : {"", "/", "0/4", "5/4", "a/b", "+1/4", "1/4 ", "1/18446744073709551616"})
    EXPECT_THROW(static_cast<void>(shard_of(text)), InputError) << text;
}

}  // namespace
}  // namespace rondo::study::shard_test
