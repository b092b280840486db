// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// In an elastic replay a chain begins its gap after what it waited for, whenever that is done here.

#include "units/replay_schedule.h"

#include <gtest/gtest.h>

#include "support/scratch_folder.h"
#include "timing/bench.h"
#include "tracefile/memory_recorder.h"

namespace sheaf::test {
namespace {

constexpr Cycles kStepDone = 100;    // in the replay, after its chain began; in the recording 50
constexpr Cycles kChainEnded = 150;  // likewise; in the recording 80
constexpr Cycles kGap = 10;
constexpr Cycles kAnswer = 5;

/// A unit whose chains have one step, and all take the same time.
class SlowUnit final : public ReplayedUnit {
 public:
  SlowUnit(ReplaySchedule& schedule, ClockDomain& domain) : schedule_(schedule), actor_(domain) {}

  [[nodiscard]] std::size_t num_free_contexts() const override { return 1; }
  void assign(ReplayChain& chain, Cycles at) override {
    begun.push_back(at);
    actor_.at(at + kStepDone, [this, &chain, now = at + kStepDone] {
      ASSERT_TRUE(schedule_.has_step(chain, now));
      schedule_.step_done(chain, *this, 0, now);
    });
    actor_.at(at + kChainEnded, [this, &chain, now = at + kChainEnded] {
      const std::uint64_t record = chain.steps[chain.next].number;
      schedule_.leave_step(chain, now);
      schedule_.chain_ended(chain, record, now);
    });
  }
  void answered(int /*context*/, std::uint64_t /*record*/, Cycles at) override {
    answers.push_back(at);
  }
  void all_done(Cycles /*now*/) override {}

  std::vector<Cycles> begun;
  std::vector<Cycles> answers;

 private:
  ReplaySchedule& schedule_;
  Actor actor_;
};

/// One chain in each of two units; the second waits for the first in the way that a test records.
struct ReplayScheduleTest : testing::Test {
  using Cause = AccessCause (*)(MemoryRecorder&, StreamRecorder&);

  void record(const Cause& cause) {
    TraceWriter writer(path, {TraceKind::kMemory, {}, {}});
    MemoryRecorder recorder(writer);
    StreamRecorder& first = recorder.add_stream({.name = "a0", .group = "a"});
    StreamRecorder& second = recorder.add_stream({.name = "b0", .group = "b"});
    recorder.set_answer_latency(kAnswer);
    const std::uint32_t compute = first.operation(0, [] { return MemoryOperation{}; });
    first.begin(0, recorder.all_earlier(0), 1, 1);
    first.step(0, compute, 0, true, 1);
    const AccessCause waited_for = cause(recorder, first);
    second.begin(0, waited_for, waited_for.done + kGap, waited_for.done + kGap);
    second.step(0, compute, 0, true, waited_for.done + kGap);
    second.end(0, 200);
    recorder.flush();
    layout = recorder.layout();
    writer.finish("{}");
  }
  /// When the second unit's chain began.
  Cycles replay() {
    TraceReader reader(path);
    ClockDomain domain("domain", one_nanosecond());
    ReplaySchedule schedule(layout, domain);
    SlowUnit first(schedule, domain);
    SlowUnit second(schedule, domain);
    schedule.add(first, MemoryStream(reader, layout, 0));
    schedule.add(second, MemoryStream(reader, layout, 1));
    schedule.begin();
    domain.run();
    EXPECT_TRUE(schedule.all_done());
    EXPECT_EQ(first.begun, (std::vector<Cycles>{1}));
    answers = first.answers;
    return second.begun.size() == 1 ? second.begun.front() : kNever;
  }

  ScratchFolder scratch;
  std::filesystem::path path = scratch / "some.trace";
  MemoryLayout layout;
  std::vector<Cycles> answers;
};

TEST_F(ReplayScheduleTest, BeginsTheGapAfterTheStepThatItWaitedFor) {
  record([](MemoryRecorder& /*recorder*/, StreamRecorder& first) {
    first.set_out(0, 50);
    const AccessCause step = first.cause(0);
    first.end(0, 80);
    return step;
  });
  EXPECT_EQ(replay(), 1 + kStepDone + kGap);
}

TEST_F(ReplayScheduleTest, BeginsTheGapAfterTheEndOfTheChainThatItWaitedFor) {
  record([](MemoryRecorder& /*recorder*/, StreamRecorder& first) {
    first.set_out(0, 50);
    return first.end(0, 80);
  });
  EXPECT_EQ(replay(), 1 + kChainEnded + kGap);
}

TEST_F(ReplayScheduleTest, BeginsTheGapAfterAllOfEarlierEpochs) {
  record([](MemoryRecorder& recorder, StreamRecorder& first) {
    first.set_out(0, 50);
    first.end(0, 80);
    return recorder.begin_epoch(80);
  });
  EXPECT_EQ(replay(), 1 + kChainEnded + kGap);
}

TEST_F(ReplayScheduleTest, BeginsTheGapAfterTheRaysWhoseRoomItTook) {
  record([](MemoryRecorder& recorder, StreamRecorder& first) {
    first.set_out(0, 50);
    recorder.retire(first.end(0, 80));
    return recorder.last_retired();
  });
  EXPECT_EQ(replay(), 1 + kChainEnded + kGap);
}

TEST_F(ReplayScheduleTest, AnswersTheStepThatCalled) {
  record([](MemoryRecorder& /*recorder*/, StreamRecorder& first) {
    first.set_out(0, 50);
    const AccessCause step = first.cause(0);
    first.end(0, 80);
    return step;
  });
  const Cycles begun = replay();
  EXPECT_EQ(answers, (std::vector<Cycles>{begun + kChainEnded + kAnswer}));
}

}  // namespace
}  // namespace sheaf::test
