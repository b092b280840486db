// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "channels/timed_channel.h"
#include "timing/bench.h"

namespace sheaf::test {
namespace {

using Channel = TimedChannel<int>;

struct ChannelTest : testing::Test {
  ClockDomain domain{"domain", one_nanosecond()};
  Actor producer{domain};
  Actor consumer{domain};

  std::unique_ptr<Channel> make(const Channel::Spec& spec) {
    auto channel = std::make_unique<Channel>("channel", spec);
    channel->set_consumer(consumer.inbox());
    return channel;
  }
};

TEST_F(ChannelTest, ValueArrivesAfterTheLatencyAndNotBefore) {
  const auto channel = make({.capacity = 1, .latency = 4});
  channel->nb_write(7, 10);
  EXPECT_FALSE(channel->has_arrived(13));
  EXPECT_TRUE(channel->has_arrived(14));
  EXPECT_EQ(channel->read(14), 7);
}

TEST_F(ChannelTest, SecondValueOfACycleArrivesOneIntervalLater) {
  const auto channel = make({.capacity = 2, .latency = 4, .interval = 3});
  channel->nb_write(1, 10);
  channel->nb_write(2, 10);
  channel->read(14);
  EXPECT_FALSE(channel->has_arrived(16));
  EXPECT_TRUE(channel->has_arrived(17));
}

TEST_F(ChannelTest, IntervalZeroLetsAnyNumberArriveAtOnce) {
  const auto channel = make({.capacity = 2, .latency = 4, .interval = 0});
  channel->nb_write(1, 10);
  channel->nb_write(2, 10);
  channel->read(14);
  EXPECT_TRUE(channel->has_arrived(14));
}

TEST_F(ChannelTest, FullChannelRefusesAWrite) {
  const auto channel = make({.capacity = 1, .latency = 1});
  EXPECT_TRUE(channel->nb_write(1, 10));
  EXPECT_FALSE(channel->nb_write(2, 10));
  EXPECT_EQ(channel->size(), 1U);
}

TEST_F(ChannelTest, ProducerLearnsOfAReadOneLatencyLater) {
  const auto channel = make({.capacity = 1, .latency = 4});
  channel->nb_write(1, 10);
  channel->read(20);
  EXPECT_EQ(channel->num_free(23), 0U);
  EXPECT_EQ(channel->num_free(24), 1U);
}

TEST_F(ChannelTest, BlockedProducerIsWokenWhenTheCreditArrives) {
  const auto channel = make({.capacity = 1, .latency = 4});
  producer.at(1, [&] {
    ASSERT_TRUE(channel->nb_write(1, 1));
    ASSERT_FALSE(channel->nb_write(2, 1));
    channel->notify_when_free(producer.inbox());
  });
  consumer.at(9, [&] { channel->read(9); });
  sc_core::sc_start();
  EXPECT_EQ(producer.wakes, (std::vector<Cycles>{1, 13}));
}

TEST_F(ChannelTest, ProducerRefusedWhileTheCreditIsOnItsWayIsWokenToo) {
  const auto channel = make({.capacity = 1, .latency = 4});
  producer.at(1, [&] { channel->nb_write(1, 1); });
  consumer.at(9, [&] { channel->read(9); });
  producer.at(10, [&] {
    ASSERT_FALSE(channel->nb_write(2, 10));
    channel->notify_when_free(producer.inbox());
  });
  sc_core::sc_start();
  EXPECT_EQ(producer.wakes, (std::vector<Cycles>{1, 10, 13}));
}

TEST_F(ChannelTest, ConsumerIsWokenAtTheArrival) {
  const auto channel = make({.capacity = 4, .latency = 6});
  producer.at(2, [&] { channel->nb_write(1, 2); });
  consumer.always([&](Cycles now) {
    if (channel->has_arrived(now)) channel->read(now);
  });
  sc_core::sc_start();
  EXPECT_EQ(consumer.wakes, (std::vector<Cycles>{8}));
}

TEST_F(ChannelTest, WritesAheadOfTimeArriveInOrderOfTheirTimes) {
  const auto channel = make({.capacity = Channel::kUnbounded, .latency = 2, .interval = 0});
  channel->write_ahead(30, 30);
  channel->write_ahead(10, 10);
  channel->write_ahead(20, 20);
  EXPECT_EQ(channel->next_arrival(), 12U);
  EXPECT_EQ(channel->read(12), 10);
  EXPECT_EQ(channel->read(22), 20);
  EXPECT_EQ(channel->read(32), 30);
}

TEST_F(ChannelTest, OfTheSameCycleTheLowerRankComesFirst) {
  const auto channel = make({.capacity = Channel::kUnbounded, .latency = 1, .interval = 0});
  channel->write_ahead(2, 5, 2);
  channel->write_ahead(1, 5, 1);
  channel->write_ahead(3, 5, 3);
  EXPECT_EQ(channel->read(6), 1);
  EXPECT_EQ(channel->read(6), 2);
  EXPECT_EQ(channel->read(6), 3);
}

TEST_F(ChannelTest, KeepsOrderWhileItsRingGrows) {
  const auto channel = make({.capacity = Channel::kUnbounded, .latency = 1, .interval = 0});
  int next_read = 0;
  for (int i = 0; i < 1000; ++i) {
    channel->nb_write(i, static_cast<Cycles>(i));
    if (i % 3 != 2) continue;
    EXPECT_EQ(channel->read(static_cast<Cycles>(i + 1)), next_read++);
  }
  while (channel->size() != 0) EXPECT_EQ(channel->read(2000), next_read++);
  EXPECT_EQ(next_read, 1000);
}

TEST_F(ChannelTest, LittlesLawHolds) {
  // Held: one from 0 to 8, one from 3 to 12.
  const auto channel = make({.capacity = 4, .latency = 4});
  channel->nb_write(1, 0);
  channel->nb_write(2, 3);
  channel->read(8);
  channel->read(12);
  EXPECT_EQ(channel->occupancy_cycles(), 8U + 9U);
}

TEST_F(ChannelTest, OccupancyCountsWhatAProducerBehindInTimeWritesLater) {
  const auto channel = make({.capacity = 8, .latency = 4});
  channel->nb_write(1, 10);
  channel->read(14);
  EXPECT_EQ(channel->max_size(), 1U);
  channel->write_ahead(2, 14);  // of the cycle of the read: not held before it
  EXPECT_EQ(channel->max_size(), 1U);
  channel->write_ahead(3, 13);
  EXPECT_EQ(channel->max_size(), 2U);
}

}  // namespace
}  // namespace sheaf::test
