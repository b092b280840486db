// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "channels/clock_domain.h"
#include "channels/timed_channel.h"
#include "memory/memory_messages.h"
#include "stats/counters.h"
#include "timing/bench.h"
#include "units/clocked/link.h"

namespace sheaf::test {

// A unit between a source and a sink, once event-driven and once clocked. Both see the same
// surroundings: they act at times that a seed chose, with gaps between them, so that the unit is
// starved and blocked at random. What comes out when, and every counter, must be the same.

struct TimedModel {
  static constexpr bool kTimed = true;
  template <typename T>
  using Link = TimedChannel<T>;
};
struct ClockedModel {
  static constexpr bool kTimed = false;
  template <typename T>
  using Link = clocked::Link<T>;
};

/// When all is over. Surroundings act until the first of these, and everything has come to rest
/// long before the second.
inline constexpr Cycles kLastAction = 20000;
inline constexpr Cycles kEnd = 40000;

template <typename M>
class UnitBench : public Agent {
 public:
  template <typename T>
  using Link = typename M::template Link<T>;

  explicit UnitBench(std::uint64_t seed) : random(seed) {
    const std::uint64_t longest_gap = 1 + random.below(12);
    for (Cycles time = 0; time < kLastAction; time += 1 + random.below(longest_gap)) {
      times_.push_back(time);
    }
    if constexpr (M::kTimed) {
      domain.emplace("domain", one_nanosecond());
      const std::size_t agent = domain->add(*this);
      inbox_.bind(*domain, agent);
      domain->schedule(agent, times_.front());
    }
  }

  /// A link by which the surroundings write to the unit.
  template <typename T>
  Link<T>& to_unit(const std::string& name, const typename Link<T>::Spec& spec) {
    Link<T>& link = add<T>(name, spec);
    if constexpr (M::kTimed) link.add_producer(inbox_);
    return link;
  }
  /// One by which they read from it.
  template <typename T>
  Link<T>& from_unit(const std::string& name, const typename Link<T>::Spec& spec) {
    Link<T>& link = add<T>(name, spec);
    if constexpr (M::kTimed) link.set_consumer(inbox_);
    return link;
  }
  template <typename T>
  static bool write(Link<T>& link, const T& value, Cycles now) {
    if constexpr (M::kTimed) {
      return link.nb_write(value, now);
    } else {
      return link.write(value, now);
    }
  }

  /// Runs to the end; `tick`, what a clocked unit does in a cycle.
  template <typename Tick>
  void run(const Tick& tick) {
    if constexpr (M::kTimed) {
      sc_core::sc_start();
    } else {
      for (Cycles now = 0; now < kEnd; ++now) {
        act_if_due(now);
        tick(now);
      }
    }
  }
  /// The same for a unit that stands alone. An event-driven one wakes by itself.
  template <typename Unit>
  void run_unit(Unit& unit) {
    run([&](Cycles now) {
      if constexpr (!M::kTimed) unit.tick(now);
    });
  }
  Cycles wake(Cycles now) override { return act_if_due(now); }

  template <typename Stats>
  void note_counters(const Stats& stats) {
    stats.for_each([&](const CounterInfo& info, std::uint64_t value) {
      notes.push_back(std::string(info.name) + " " + std::to_string(value));
    });
  }
  template <typename Unit>
  void note_stalls(Unit& unit) {
    unit.finish(kEnd);
    note_counters(unit.stalls());
  }
  template <typename... Values>
  void note(const char* what, Values... values) {
    std::string text = what;
    ((text += ' ' + std::to_string(values)), ...);
    notes.push_back(std::move(text));
  }

  std::optional<ClockDomain> domain;
  Random random;
  std::function<void(Cycles)> act;  ///< what the surroundings do
  std::vector<std::string> notes;   ///< everything that can be seen from outside

 private:
  template <typename T>
  Link<T>& add(const std::string& name, const typename Link<T>::Spec& spec) {
    auto link = std::make_shared<Link<T>>(name.c_str(), spec);
    links_.push_back(link);
    return *link;
  }
  Cycles act_if_due(Cycles now) {
    if (next_ != times_.size() && times_[next_] == now) {
      ++next_;
      act(now);
    }
    return next_ == times_.size() ? kNever : times_[next_];
  }

  Inbox inbox_;
  std::vector<Cycles> times_;
  std::size_t next_ = 0;
  std::vector<std::shared_ptr<void>> links_;
};

/// What stands behind a private cache: answers its requests in any order, after any time.
template <typename M>
class LineServer {
 public:
  using Bench = UnitBench<M>;
  /// `number`: that of the cache as a requester.
  LineServer(Bench& bench, std::uint16_t number) : bench_(bench), number_(number) {}

  /// `requests` may be shared with other caches; only this one's are taken care of here.
  void take(const LineRequest& request, Cycles now) {
    if (request.requester != number_) return;
    bench_.note("request", now, request.requester, request.address, request.bytes,
                request.write ? 1 : 0);
    if (!request.write) pending_.push_back(request.address);
    if (request.acknowledged) pending_.push_back(LineResponse::kWriteTaken);
  }
  void answer(typename Bench::template Link<LineResponse>& responses, Cycles now) {
    // Towards the end everything at once, so that all comes to rest.
    const std::uint64_t most = now < kLastAction / 2 ? bench_.random.below(4) : pending_.size();
    for (std::uint64_t left = most; left != 0 && !pending_.empty(); --left) {
      const auto chosen =
          pending_.begin() + static_cast<std::ptrdiff_t>(bench_.random.below(pending_.size()));
      Bench::template write<LineResponse>(responses, {*chosen}, now);
      pending_.erase(chosen);
    }
  }

 private:
  Bench& bench_;
  const std::uint16_t number_;
  std::vector<Address> pending_;
};

inline constexpr Cycles kMemoryLatency = 3;

/// A private cache's links in a bench.
template <typename M>
struct CacheLinks {
  using Bench = UnitBench<M>;
  CacheLinks(Bench& bench, std::uint16_t number)
      : requests(bench.template from_unit<LineRequest>(
            "requests" + std::to_string(number),
            {.capacity = Bench::template Link<LineRequest>::kUnbounded,
             .latency = kMemoryLatency,
             .interval = 0})),
        responses(bench.template to_unit<LineResponse>(
            "responses" + std::to_string(number),
            {.capacity = Bench::template Link<LineResponse>::kUnbounded,
             .latency = kMemoryLatency,
             .interval = 2})),
        server(bench, number) {}
  void act(Cycles now) {
    while (requests.has_arrived(now)) server.take(requests.read(now), now);
    server.answer(responses, now);
  }
  typename Bench::template Link<LineRequest>& requests;
  typename Bench::template Link<LineResponse>& responses;
  LineServer<M> server;
};

/// Runs a bench of either model and compares what it has noted.
template <template <typename> typename Bench>
void expect_both_alike(std::uint64_t seed) {
  Bench<TimedModel> timed(seed);
  timed.run_to_end();
  Bench<ClockedModel> clocked(seed);
  clocked.run_to_end();
  ASSERT_GT(timed.bench.notes.size(), 100U);
  for (std::size_t i = 0; i < std::min(timed.bench.notes.size(), clocked.bench.notes.size()); ++i) {
    ASSERT_EQ(timed.bench.notes[i], clocked.bench.notes[i]) << "note " << i;
  }
  EXPECT_EQ(timed.bench.notes.size(), clocked.bench.notes.size());
}

// Each seed is a process of its own.
class BothModels : public testing::TestWithParam<std::uint64_t> {};

}  // namespace sheaf::test
