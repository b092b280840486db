// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/flow_control.h"

#include <gtest/gtest.h>

namespace sheaf {
namespace {

using Source = FlowControl::Source;

FlowControl flow_of(FlowPolicy policy, std::uint64_t credits) {
  FlowSpec spec;
  spec.control = policy;
  return {spec, WorstCase(1, 1, 1), credits};
}

TEST(FlowControl, ByCreditsAdmitsExactlyWhatFits) {
  FlowControl flow = flow_of(FlowPolicy::kCredits, 100);
  EXPECT_FALSE(flow.by_tile());
  EXPECT_TRUE(flow.admits(100));
  EXPECT_FALSE(flow.admits(101));
  flow.admit(16, 60, 0);
  EXPECT_TRUE(flow.admits(40));
  EXPECT_FALSE(flow.admits(41));
}

TEST(FlowControl, GivesReservationsBackAsRaysRetire) {
  FlowControl flow = flow_of(FlowPolicy::kCredits, 100);
  flow.admit(16, 60, 0);
  flow.replace(16, 10, 60, 25, 1);
  EXPECT_TRUE(flow.admits(75));
  EXPECT_FALSE(flow.admits(76));
  flow.replace(10, 0, 25, 0, 2);
  EXPECT_TRUE(flow.admits(100));
}

TEST(FlowControl, ByTileAdmitsWithoutALimit) {
  FlowControl flow = flow_of(FlowPolicy::kTile, 1);
  EXPECT_TRUE(flow.by_tile());
  flow.admit(1000, 1000, 0);
  EXPECT_TRUE(flow.admits(1000));
}

TEST(FlowControl, CountsTheRaysInTheLoopAndTheMostEver) {
  FlowControl flow = flow_of(FlowPolicy::kTile, 0);
  flow.admit(16, 0, 0);
  flow.replace(16, 20, 0, 0, 1);
  EXPECT_EQ(flow.live(), 20U);
  flow.replace(20, 3, 0, 0, 2);
  flow.admit(5, 0, 2);
  EXPECT_EQ(flow.live(), 8U);
  EXPECT_EQ(flow.max_live(), 20U);
}

TEST(FlowControl, IsQuietWhenEveryRayWaitsInACell) {
  FlowControl flow = flow_of(FlowPolicy::kTile, 0);
  EXPECT_TRUE(flow.is_quiet(0));
  flow.admit(16, 0, 0);
  EXPECT_FALSE(flow.is_quiet(1));
  flow.set_waiting(15, 0);
  EXPECT_FALSE(flow.is_quiet(1));
  flow.set_waiting(16, 0);
  EXPECT_TRUE(flow.is_quiet(1));
}

TEST(FlowControl, ShowsAChangeFromTheNextCycleOn) {
  FlowControl flow = flow_of(FlowPolicy::kTile, 0);
  flow.admit(16, 0, 3);
  flow.set_waiting(16, 7);
  flow.set_waiting_for_shader(1, 8);
  flow.set_waiting(15, 8);
  flow.set_source(Source::kExhausted, 8);
  EXPECT_TRUE(flow.is_quiet(8));
  EXPECT_FALSE(flow.waits_for_shader(8));
  EXPECT_EQ(flow.source(8), Source::kIssuing);
  EXPECT_TRUE(flow.is_quiet(9));
  EXPECT_TRUE(flow.waits_for_shader(9));
  EXPECT_EQ(flow.source(9), Source::kExhausted);
}

TEST(FlowControl, IsQuietWhenRaysWaitInCellsOfEitherCache) {
  FlowControl flow = flow_of(FlowPolicy::kTile, 0);
  flow.admit(16, 0, 0);
  flow.set_waiting(10, 0);
  EXPECT_FALSE(flow.waits_for_shader(1));
  flow.set_waiting_for_shader(5, 0);
  EXPECT_FALSE(flow.is_quiet(1));
  flow.set_waiting_for_shader(6, 0);
  EXPECT_TRUE(flow.is_quiet(1));
  EXPECT_TRUE(flow.waits_for_shader(1));
}

TEST(FlowControl, IsFinishedWhenTheSourceIsExhaustedAndNoRayLives) {
  FlowControl flow = flow_of(FlowPolicy::kTile, 0);
  EXPECT_FALSE(flow.finished());
  flow.admit(4, 0, 0);
  flow.set_source(Source::kExhausted, 1);
  EXPECT_FALSE(flow.finished(2));
  flow.replace(4, 0, 0, 0, 2);
  EXPECT_FALSE(flow.finished(2));
  EXPECT_TRUE(flow.finished(3));
  EXPECT_TRUE(flow.finished());
  flow.set_source(Source::kTileIssued, 3);
  EXPECT_FALSE(flow.finished());
}

/// Notes when it is woken.
struct Sleeper : Agent {
  Cycles wake(Cycles now) override {
    woken.push_back(now);
    return kNever;
  }
  std::vector<Cycles> woken;
};

/// The three units that flow control wakes, asleep in a clock domain.
struct Wakes {
  explicit Wakes(FlowControl& flow) : domain("domain", sc_core::sc_time(1, sc_core::SC_NS)) {
    source_inbox.bind(domain, domain.add(source));
    regrouper_inbox.bind(domain, domain.add(regrouper));
    film_inbox.bind(domain, domain.add(film));
    flow.bind_source(source_inbox);
    flow.bind_regrouper(regrouper_inbox);
    flow.bind_film(film_inbox);
  }
  ClockDomain domain;
  Sleeper source, regrouper, film;
  Inbox source_inbox, regrouper_inbox, film_inbox;
};

const std::vector<Cycles> kNotWoken;

TEST(FlowControl, WakesSourceAndRegrouperACycleAfterTheLoopFallsQuiet) {
  FlowControl flow = flow_of(FlowPolicy::kTile, 0);
  Wakes wakes(flow);
  flow.admit(16, 0, 0);
  flow.replace(8, 0, 0, 0, 5);
  flow.set_waiting(3, 6);
  flow.replace(8, 3, 0, 0, 7);
  sc_core::sc_start();
  EXPECT_EQ(wakes.source.woken, std::vector<Cycles>{8});
  EXPECT_EQ(wakes.regrouper.woken, std::vector<Cycles>{8});
  EXPECT_EQ(wakes.film.woken, kNotWoken);
}

TEST(FlowControl, ByCreditsWakesTheSourceWheneverRaysRetire) {
  FlowControl flow = flow_of(FlowPolicy::kCredits, 100);
  Wakes wakes(flow);
  flow.admit(16, 16, 0);
  flow.replace(8, 0, 8, 0, 5);
  sc_core::sc_start();
  EXPECT_EQ(wakes.source.woken, std::vector<Cycles>{6});
  EXPECT_EQ(wakes.regrouper.woken, kNotWoken);
}

TEST(FlowControl, WakesTheFilmWhenTheLastRayOfTheFrameRetires) {
  FlowControl flow = flow_of(FlowPolicy::kTile, 0);
  Wakes wakes(flow);
  flow.admit(1, 0, 0);
  flow.set_source(Source::kExhausted, 2);
  flow.replace(1, 0, 0, 0, 9);
  sc_core::sc_start();
  EXPECT_EQ(wakes.film.woken, std::vector<Cycles>{10});
}

}  // namespace
}  // namespace sheaf
