// SPDX-License-Identifier: BSD-3-Clause
/// Sums that have the same bits in any order.
#include "rondo/core/exact_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace rondo::exact_sums_test {
namespace {

/// Numbers of both signs and of many sizes.
std::vector<double> numbers(std::size_t n) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> size(-12.0, 3.0), sign(-1.0, 1.0);
  std::vector<double> x(n);
  for (double& value : x) value = std::copysign(std::pow(10.0, size(random)), sign(random));
  return x;
}

double sum_of(const std::vector<double>& x) {
  ExactSums sums(2);
  for (const double value : x) sums.add(1, value);
  sums.settle();
  EXPECT_EQ(sums.at(0), 0.0);
  return sums.at(1);
}

}  // namespace

TEST(ExactSums, DoNotDependOnTheOrder) {
  std::vector<double> x = numbers(20000);
  const double forth = sum_of(x);
  std::ranges::reverse(x);
  EXPECT_EQ(sum_of(x), forth);
  std::ranges::sort(x);
  EXPECT_EQ(sum_of(x), forth);
  long double exact = 0.0L;
  for (const double value : x) exact += static_cast<long double>(value);
  EXPECT_NEAR(forth, static_cast<double>(exact), 1e-15 * std::abs(forth) + 1e-18);
}

TEST(ExactSums, KeepWhatASumOfDoublesLoses) {
  EXPECT_EQ(sum_of({1e9, 1e-12, -1e9}), std::nearbyint(1e-12 * 0x1p100) * 0x1p-100);
  EXPECT_EQ(sum_of(std::vector<double>(1000, 0.1)), 1000 * 0.1) << "0.1 has no more than 100 bits";
  EXPECT_EQ(sum_of({0.3, -0.3}), 0.0);
}

TEST(ExactSums, CarryAsOftenAsOneLikes) {
  const std::vector<double> x = numbers(3000);
  ExactSums once(1), often(1);
  for (const double value : x) {
    once.add(0, value);
    often.add(0, value);
    often.settle();
  }
  once.settle();
  EXPECT_EQ(once.save(), often.save());
}

TEST(ExactSums, TakeNumbersOfManyThreadsAtOnce) {
  const std::vector<double> x = numbers(40000);
  ExactSums sums(1);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < x.size(); i += 4) sums.add(0, x[i]);
    });
  for (std::thread& thread : threads) thread.join();
  sums.settle();
  EXPECT_EQ(sums.at(0), sum_of(x));
}

TEST(ExactSums, GoOnFromWhatWasSaved) {
  const std::vector<double> x = numbers(100);
  ExactSums whole(1), first(1), second(1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    whole.add(0, x[i]);
    if (i < 40) first.add(0, x[i]);
  }
  first.settle();
  ASSERT_TRUE(second.is_saved(first.save()));
  second.restore(first.save());
  for (std::size_t i = 40; i < x.size(); ++i) second.add(0, x[i]);
  for (ExactSums* sums : {&whole, &second}) sums->settle();
  EXPECT_EQ(second.save(), whole.save());
  second.clear();
  EXPECT_EQ(second.save(), ExactSums(1).save());
  EXPECT_FALSE(ExactSums(2).is_saved(whole.save()));
  std::vector<double> broken = whole.save();
  broken[1] += 0.5;
  EXPECT_FALSE(whole.is_saved(broken));
  broken[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(whole.is_saved(broken));
}

TEST(ExactSums, SayThatTheyAreLost) {
  for (const double number :
       {1e10, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    ExactSums sums(1);
    sums.add(0, 1.0);
    sums.add(0, number);
    sums.settle();
    EXPECT_TRUE(sums.is_lost());
    EXPECT_TRUE(std::isnan(sums.at(0)));
    ExactSums again(1);
    again.restore(sums.save());
    EXPECT_TRUE(again.is_lost());
  }
}

}  // namespace rondo::exact_sums_test
