// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <tlm_utils/simple_target_socket.h>

#include <memory>
#include <utility>
#include <vector>

#include "memory/l2_cache.h"
#include "timing/bench.h"

namespace sheaf::test {

inline constexpr Cycles kDramLatency = 50;

/// Answers every request after a fixed time, however many there are.
struct IdealDram : sc_core::sc_module {
  tlm_utils::simple_target_socket<IdealDram> socket{"socket"};
  std::vector<Cycles> reads;
  std::vector<Cycles> writes;
  std::vector<Bytes> read_bytes;
  std::vector<Address> written;

  explicit IdealDram(const sc_core::sc_module_name& name) : sc_module(name) {
    socket.register_nb_transport_fw(this, &IdealDram::transport);
  }
  tlm::tlm_sync_enum transport(tlm::tlm_generic_payload& payload, tlm::tlm_phase& /*phase*/,
                               sc_core::sc_time& delay) {
    const auto now = (sc_core::sc_time_stamp() + delay).value() / one_nanosecond().value();
    (payload.is_write() ? writes : reads).push_back(now);
    if (payload.is_write()) written.push_back(payload.get_address());
    if (payload.is_read()) read_bytes.push_back(payload.get_data_length());
    delay += one_nanosecond() * static_cast<double>(kDramLatency);
    return tlm::TLM_COMPLETED;
  }
};

/// An L2 of two banks of four sets of two ways, three caches that ask it over links of 8 cycles,
/// and an ideal DRAM.
struct L2Test : testing::Test {
  static constexpr std::uint16_t kCaches = 3;

  static L2Spec spec() {
    return {.mode = CacheMode::kNormal,
            .capacity = 1024,
            .line = 64,
            .ways = 2,
            .banks = 2,
            .mshrs = 2,
            .hit_latency = 12};
  }
  struct Arrival {
    Cycles first = 0;    ///< when
    Address second = 0;  ///< which line
    std::uint16_t cache = 0;
    bool of_write = false;
  };

  ClockDomain domain{"domain", one_nanosecond()};
  Actor requester{domain};
  TimedChannel<LineRequest> requests{
      "requests", {.capacity = TimedChannel<LineRequest>::kUnbounded, .latency = 8, .interval = 0}};
  std::vector<std::unique_ptr<TimedChannel<LineResponse>>> responses;
  IdealDram dram{"dram"};
  std::unique_ptr<L2Cache> l2;
  std::vector<Arrival> arrived;

  void build(const L2Spec& l2_spec, const CrossbarSpec& crossbar = {}) {
    l2 = std::make_unique<L2Cache>("l2", l2_spec, crossbar, domain);
    l2->in_requests(requests);
    l2->to_dram.bind(dram.socket);
    for (std::uint16_t cache = 0; cache < kCaches; ++cache) {
      responses.push_back(std::make_unique<TimedChannel<LineResponse>>(
          ("responses" + std::to_string(cache)).c_str(),
          TimedChannel<LineResponse>::Spec{
              .capacity = TimedChannel<LineResponse>::kUnbounded, .latency = 8, .interval = 1}));
      l2->out_responses(*responses.back());
      responses.back()->set_consumer(requester.inbox());
    }
    requester.always([this](Cycles now) { take_responses(now); });
  }
  void read_at(Cycles time, std::uint64_t line, std::uint16_t cache = 0) {
    send_at(time, {line * 64, 64, cache, DataKind::kNode, false, false});
  }
  void write_at(Cycles time, std::uint64_t line, std::uint16_t cache = 0) {
    send_at(time, {line * 64, 64, cache, DataKind::kPixel, true, false});
  }
  void send_at(Cycles time, const LineRequest& request) {
    requester.at(time, [=, this] { requests.write_ahead(request, time, request.requester); });
  }
  /// Arrival of the response to the n-th request.
  Cycles arrival(std::size_t n) { return arrived.at(n).first; }

 private:
  void take_responses(Cycles now) {
    for (std::uint16_t cache = 0; cache < kCaches; ++cache) {
      TimedChannel<LineResponse>& link = *responses[cache];
      while (link.has_arrived(now)) {
        const LineResponse response = link.read(now);
        arrived.push_back({now, response.address, cache, response.of_write()});
      }
      if (link.next_arrival() != kNever) requester.inbox().nudge(link.next_arrival());
    }
  }
};

}  // namespace sheaf::test
