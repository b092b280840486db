// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "channels/stepping_agent.h"
#include "timing/bench.h"

namespace sheaf::test {
namespace {

constexpr Cycles kQuantum = 10;

/// Acts every cycle from 100 to 200 and remembers when.
class Stepper final : public SteppingAgent {
 public:
  explicit Stepper(ClockDomain& domain) : SteppingAgent(domain) {
    inbox.bind(domain, domain.add(*this));
    inbox.nudge(100);
  }
  Inbox inbox;
  std::vector<Cycles> acted;

 private:
  Cycles act(Cycles now) override {
    acted.push_back(now);
    return now < 200 ? now + 1 : kNever;
  }
};

struct Quantum : testing::Test {
  ClockDomain domain{"domain", one_nanosecond()};
  Stepper stepper{domain};
  Actor other{domain};
};

TEST_F(Quantum, WithoutOneAnAgentStopsBeforeTheNextOneActs) {
  other.at(150, [&] { EXPECT_EQ(stepper.acted.back(), 150U); });
  other.at(151, [&] { EXPECT_EQ(stepper.acted.back(), 151U); });
  sc_core::sc_start();
}

TEST_F(Quantum, IsHowMuchFurtherAnAgentRuns) {
  domain.set_quantum(kQuantum);
  other.at(150, [&] { EXPECT_EQ(stepper.acted.back(), 150U + kQuantum - 1); });
  sc_core::sc_start();
}

TEST_F(Quantum, WhatComesLateIsTakenAtTheAgentsOwnTime) {
  domain.set_quantum(kQuantum);
  other.at(205, [&] { stepper.inbox.nudge(180); });
  sc_core::sc_start();
  EXPECT_EQ(stepper.acted.back(), 201U);
  EXPECT_EQ(domain.latest(), 201U);
}

TEST_F(Quantum, MakesAnAgentBlindForWhatMayComeSooner) {
  domain.set_quantum(kQuantum);
  Lookahead ahead;
  domain.declare_link(1, 0, 4);
  ahead.bind(domain, {1}, 0);
  domain.schedule(1, 50);
  EXPECT_TRUE(ahead.is_beyond(50 + 4 + kQuantum - 1));
  EXPECT_FALSE(ahead.is_beyond(50 + 4 + kQuantum));
}

}  // namespace
}  // namespace sheaf::test
