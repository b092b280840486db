// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "channels/clock_domain.h"

#include <gtest/gtest.h>

#include <new>
#include <set>
#include <utility>

#include "base/errors.h"
#include "timing/bench.h"

namespace sheaf::test {
namespace {

struct Bench : testing::Test {
  ClockDomain domain{"domain", one_nanosecond()};
};

TEST_F(Bench, ThrowsWhatAnAgentThrewAndNothingElse) {
  Actor actor(domain);
  actor.at(7, [] { throw Error(ExitCode::kUsage, "place: problem; remedy"); });
  actor.at(8, [] {});
  try {
    domain.run();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_STREQ(error.what(), "place: problem; remedy");
  }
  EXPECT_EQ(actor.wakes, (std::vector<Cycles>{7}));
}

TEST_F(Bench, LetsLackOfMemoryBeToldApart) {
  Actor actor(domain);
  actor.at(7, [] { throw std::bad_alloc(); });
  EXPECT_THROW(domain.run(), std::bad_alloc);
}

TEST_F(Bench, WakesAgentsInOrderOfTimeThenRank) {
  std::vector<int> order;
  Actor first(domain);
  Actor second(domain);
  second.at(3, [&] { order.push_back(2); });
  first.at(3, [&] { order.push_back(1); });
  second.at(2, [&] { order.push_back(0); });
  sc_core::sc_start();
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2}));
}

TEST_F(Bench, RunsDryWhenNobodyHasAnythingToDo) {
  Actor actor(domain);
  actor.at(7, [] {});
  sc_core::sc_start();
  EXPECT_TRUE(domain.ran_dry());
  EXPECT_EQ(domain.now(), 7U);
}

TEST_F(Bench, LeavesTheKernelAtTheTimeOfTheLastEvent) {
  Actor actor(domain);
  actor.at(123, [] {});
  sc_core::sc_start();
  EXPECT_EQ(sc_core::sc_time_stamp(), sc_core::sc_time(123, sc_core::SC_NS));
}

TEST_F(Bench, RefusesAWakeUpWhereTimeHasEnded) {
  Actor actor(domain);
  actor.at(Calendar::kEndOfTime - 1, [&] { actor.at(Calendar::kEndOfTime, [] {}); });
  EXPECT_THROW(domain.run(), Error);
  EXPECT_EQ(actor.wakes, (std::vector<Cycles>{Calendar::kEndOfTime - 1}));
}

TEST(SlowClock, ItsLastCycleIsSaidAndReadAlike) {
  ClockDomain domain("domain", sc_core::sc_time(1.0, sc_core::SC_MS));
  Cycles cycle = 0;
  const auto refused = [&] {
    try {
      EXPECT_EQ(domain.cycle_at_kernel_offset(domain.offset(cycle)), cycle);
      return false;
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("clock.frequency")) << error.what();
      return true;
    }
  };
  cycle = 18'446'744'072;  // 2^64 ps are 18,446,744,073.7 ms
  EXPECT_FALSE(refused());
  for (cycle = 18'446'744'073; cycle < 18'446'744'080; ++cycle) EXPECT_TRUE(refused()) << cycle;
}

TEST_F(Bench, StopsBeforeItsEnd) {
  Actor actor(domain);
  actor.at(9, [] {});
  actor.at(10, [] {});
  domain.set_end(10);
  sc_core::sc_start();
  EXPECT_FALSE(domain.ran_dry());
  EXPECT_EQ(actor.wakes, (std::vector<Cycles>{9}));
}

TEST_F(Bench, ServesMoreAgentsThanOneCalendarHolds) {
  std::vector<std::unique_ptr<Actor>> actors;
  std::vector<int> order;
  for (int i = 0; i < 200; ++i) {
    actors.push_back(std::make_unique<Actor>(domain));
    actors.back()->at(5, [&order, i] { order.push_back(i); });
  }
  sc_core::sc_start();
  ASSERT_EQ(order.size(), 200U);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

/// A SystemC process that shares the kernel with the domain.
struct Foreign : sc_core::sc_module {
  Foreign(const sc_core::sc_module_name& name, std::function<void()> action)
      : sc_module(name), action_(std::move(action)) {
    SC_HAS_PROCESS(Foreign);
    SC_METHOD(act);
  }
  void act() {
    if (sc_core::sc_time_stamp() == sc_core::SC_ZERO_TIME) {
      next_trigger(5, sc_core::SC_NS);
      return;
    }
    action_();
  }
  std::function<void()> action_;
};

TEST_F(Bench, LetsAForeignProcessActInItsPlaceInTime) {
  std::vector<int> order;
  Actor actor(domain);
  Foreign foreign("foreign", [&] { order.push_back(50); });
  actor.at(4, [&] { order.push_back(4); });
  actor.at(6, [&] { order.push_back(6); });
  sc_core::sc_start();
  EXPECT_EQ(order, (std::vector<int>{4, 50, 6}));
}

/// Observes the cycles it is given.
struct Watcher : CycleObserver {
  Watcher(std::set<Cycles> cycles, std::function<void(Cycles)> action)
      : wanted(std::move(cycles)), act(std::move(action)) {}
  Cycles next_observed(Cycles cycle) override {
    const auto it = wanted.lower_bound(cycle);
    return it == wanted.end() ? kNever : *it;
  }
  void observe(Cycles cycle) override { act(cycle); }
  [[nodiscard]] bool wants_kernel_time() const override { return kernel_time; }

  std::set<Cycles> wanted;
  std::function<void(Cycles)> act;
  bool kernel_time = false;
};

struct Observed : Bench {
  Observed() {
    for (const Cycles cycle : {4, 6, 9}) {
      actor.at(cycle, [this, cycle] {
        done = cycle;
        horizons.push_back(domain.horizon());
        domain.happened(cycle);
      });
    }
  }
  Actor actor{domain};
  Cycles done = 0;
  std::vector<Cycles> horizons;
  std::vector<std::pair<Cycles, Cycles>> seen;  ///< cycle, done
};

TEST_F(Observed, CycleShowsWhatHappenedInItAndNothingLater) {
  Watcher watcher({4, 5, 8}, [this](Cycles cycle) { seen.emplace_back(cycle, done); });
  domain.observe(watcher);
  sc_core::sc_start();
  EXPECT_EQ(seen, (std::vector<std::pair<Cycles, Cycles>>{{4, 4}, {5, 4}, {8, 6}}));
}

TEST_F(Observed, CycleIsNotRunPast) {
  Watcher watcher({4, 7}, [](Cycles /*cycle*/) {});
  domain.observe(watcher);
  sc_core::sc_start();
  ASSERT_EQ(horizons.size(), 3U);
  EXPECT_EQ(horizons[0], 5U);
  EXPECT_EQ(horizons[1], 8U);
  EXPECT_GE(horizons[2], Calendar::kEndOfTime - 1);  // nothing else is to come
}

TEST_F(Observed, RunEndsWithTheLastThingThatHappens) {
  Watcher watcher({8, 9, 10, 20}, [this](Cycles cycle) { seen.emplace_back(cycle, done); });
  domain.observe(watcher);
  sc_core::sc_start();
  EXPECT_EQ(seen, (std::vector<std::pair<Cycles, Cycles>>{{8, 6}, {9, 9}}));
  EXPECT_TRUE(domain.ran_dry());
}

TEST_F(Observed, CycleIsTheKernelsTimeForWhoWantsIt) {
  std::vector<sc_core::sc_time> times;
  Watcher watcher({2, 4, 5, 8},
                  [&](Cycles /*cycle*/) { times.push_back(sc_core::sc_time_stamp()); });
  watcher.kernel_time = true;
  domain.observe(watcher);
  sc_core::sc_start();
  std::vector<sc_core::sc_time> expected;
  for (const double ns : {2, 4, 5, 8}) expected.emplace_back(ns, sc_core::SC_NS);
  EXPECT_EQ(times, expected);
}

}  // namespace
}  // namespace sheaf::test
