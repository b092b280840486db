// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Links, and the L2 with memory behind it, of both models, side by side.

#include "config/dram/device.h"
#include "config/parameters.h"
#include "memory/banked_dram.h"
#include "memory/fixed_dram.h"
#include "memory/l2_cache.h"
#include "timing/both_models.h"
#include "timing/random_specs.h"
#include "units/clocked/dram.h"
#include "units/clocked/l2_cache.h"

namespace sheaf::test {
namespace {

/// A link alone: one writer, one reader.
template <typename M>
struct LinkBench {
  explicit LinkBench(std::uint64_t seed) : bench(seed) {
    const typename M::template Link<int>::Spec spec{.capacity = 1 + bench.random.below(6),
                                                    .latency = 1 + bench.random.below(9),
                                                    .interval = bench.random.below(4)};
    link = &bench.template from_unit<int>("link", spec);
    bench.act = [this](Cycles now) {
      for (std::uint64_t i = bench.random.below(3); i != 0; --i) {
        bench.note("write", now, UnitBench<M>::template write<int>(*link, next++, now) ? 1 : 0);
      }
      for (std::uint64_t i = bench.random.below(3); i != 0 && link->has_arrived(now); --i) {
        bench.note("read", now, link->read(now));
      }
    };
  }
  void run_to_end() {
    bench.run([](Cycles) {});
    bench.note("written", link->num_written());
  }
  UnitBench<M> bench;
  typename M::template Link<int>* link = nullptr;
  int next = 0;
};

constexpr std::uint16_t kNumRequesters = 3;
constexpr double kCoreHz = 1e9;
// Few enough to have been dealt with before the end, whatever the write buffers.
constexpr int kMostRequests = 600;

template <typename M, DramModel kModel>
struct L2Bench {
  explicit L2Bench(std::uint64_t seed) : bench(seed), dram_spec(defaults()) {
    spec.line = 64;
    choose_options(bench.random, spec);
    choose_writes(bench.random, spec.write);
    spec.capacity = spec.line * spec.ways * spec.banks * 4;
    spec.hit_latency = 1 + bench.random.below(12);
    if (bench.random.below(2) == 0) {
      crossbar.request_width = 16U << bench.random.below(3);
      crossbar.depth = static_cast<std::uint32_t>(bench.random.below(3));
    }
    if (bench.random.below(2) == 0) crossbar.response_width = 8U << bench.random.below(4);
    build();
    bench.act = [this](Cycles now) { act(now); };
  }
  static DramSpec defaults() {
    Config config;
    static_cast<void>(declare_parameters(config));
    config.dram.model = kModel;
    config.dram.latency = 60;
    return config.dram;
  }

  void build() {
    constexpr auto kUnbounded = clocked::Link<int>::kUnbounded;
    const std::size_t num_links = M::kTimed ? 1 : kNumRequesters;
    for (std::size_t i = 0; i < num_links; ++i) {
      requests.push_back(&bench.template to_unit<LineRequest>(
          "requests" + std::to_string(i),
          {.capacity = kUnbounded, .latency = kMemoryLatency, .interval = 0}));
    }
    for (std::size_t i = 0; i < kNumRequesters; ++i) {
      responses.push_back(&bench.template from_unit<LineResponse>(
          "responses" + std::to_string(i),
          {.capacity = kUnbounded, .latency = kMemoryLatency, .interval = i}));
    }
    if constexpr (M::kTimed) {
      l2 = std::make_unique<L2>("l2", spec, crossbar, *bench.domain);
      l2->in_requests(*requests[0]);
      for (auto* link : responses) l2->out_responses(*link);
      if constexpr (kModel == DramModel::kFixed) {
        dram = std::make_unique<FixedDram>("dram", dram_spec, *bench.domain);
      } else {
        auto banked =
            std::make_unique<BankedDram>("dram", resolve_dram(dram_spec), kCoreHz, *bench.domain);
        l2->expect_answers_from(banked->agent());
        dram = std::move(banked);
      }
      l2->to_dram.bind(dram->from_cache);
    } else {
      if constexpr (kModel == DramModel::kFixed) {
        dram = std::make_unique<clocked::FixedDram>(spec.hit_latency, dram_spec);
      } else {
        dram = std::make_unique<clocked::BankedDram>(spec.hit_latency, resolve_dram(dram_spec),
                                                     kCoreHz);
      }
      l2 = std::make_unique<L2>(spec, crossbar, *dram);
      l2->in_requests = requests;
      l2->out_responses = responses;
    }
  }

  void act(Cycles now) {
    for (std::uint16_t requester = 0; requester < kNumRequesters; ++requester) {
      while (responses[requester]->has_arrived(now)) {
        bench.note("answer", now, requester, responses[requester]->read(now).address);
      }
      if (num_sent < kMostRequests && bench.random.below(3) == 0) {
        ++num_sent;
        auto& link = *requests[M::kTimed ? 0 : requester];
        UnitBench<M>::template write<LineRequest>(link, make_request(requester), now);
      }
    }
  }

  // Some are of parts of a line, as write-through and small lines make them.
  LineRequest make_request(std::uint16_t requester) {
    const Bytes line = spec.line / spec.sectors;
    const Bytes bytes = bench.random.below(3) == 0 ? 16 : line;
    LineRequest request;
    request.address = 0x10000000 + bytes * bench.random.below(40 * line / bytes);
    request.bytes = static_cast<std::uint32_t>(bytes);
    request.requester = requester;
    request.kind = DataKind::kNode;
    request.write = bench.random.below(4) == 0;
    request.acknowledged = request.write && bench.random.below(2) == 0;
    return request;
  }

  void run_to_end() {
    bench.run([&](Cycles now) {
      if constexpr (!M::kTimed) {
        l2->tick(now);
        if (now < kLastAction || !dram->is_idle()) dram->tick(now);
      }
    });
    EXPECT_TRUE(l2->is_idle());
    bench.note_counters(l2->stats());
    bench.note_counters(l2->kind_stats(DataKind::kNode));
    if (l2->request_crossbar()) bench.note_counters(l2->request_crossbar()->stats());
    if (l2->response_crossbar()) bench.note_counters(l2->response_crossbar()->stats());
    if constexpr (M::kTimed) dram->finish(kLastAction);
    StatsTree details;
    bench.note_counters(dram->stats(kLastAction));
    dram->report_details("dram", kLastAction, details);
    for (const StatsEntry& entry : details.entries()) {
      const auto* count = std::get_if<std::uint64_t>(&entry.value);
      if (count != nullptr) bench.note(entry.path.c_str(), *count);
    }
  }

  using L2 = std::conditional_t<M::kTimed, L2Cache, clocked::L2Cache>;
  using Memory = std::conditional_t<M::kTimed, MainMemory, clocked::Dram>;
  UnitBench<M> bench;
  L2Spec spec;
  CrossbarSpec crossbar;
  DramSpec dram_spec;
  int num_sent = 0;
  std::vector<typename M::template Link<LineRequest>*> requests;
  std::vector<typename M::template Link<LineResponse>*> responses;
  std::unique_ptr<Memory> dram;
  std::unique_ptr<L2> l2;
};

template <typename M>
using L2WithFixedDram = L2Bench<M, DramModel::kFixed>;
template <typename M>
using L2WithBanks = L2Bench<M, DramModel::kDdr4_2400>;
template <typename M>
using L2WithChannels = L2Bench<M, DramModel::kGddr6_14000>;

class MemoryUnits : public BothModels {};

TEST_P(MemoryUnits, LinkIsTheSame) {
  expect_both_alike<LinkBench>(GetParam());
}
TEST_P(MemoryUnits, L2WithFixedDramIsTheSame) {
  expect_both_alike<L2WithFixedDram>(GetParam());
}
TEST_P(MemoryUnits, L2WithBanksIsTheSame) {
  expect_both_alike<L2WithBanks>(GetParam());
}
TEST_P(MemoryUnits, L2WithChannelsIsTheSame) {
  expect_both_alike<L2WithChannels>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Seeds, MemoryUnits, testing::Range<std::uint64_t>(0, 20));

}  // namespace
}  // namespace sheaf::test
