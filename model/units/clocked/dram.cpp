// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "units/clocked/dram.h"

#include <algorithm>

#include "memory/dram/dram_report.h"

namespace sheaf::clocked {

Dram::Answer Dram::take_answer() {
  const Answer answer = *answers_.begin();
  answers_.erase(answers_.begin());
  return answer;
}

void Dram::count_request(const DramRequest& request) {
  ++(request.write ? stats_.num_writes : stats_.num_reads);
  (request.write ? stats_.bytes_written : stats_.bytes_read) += request.bytes;
}

void Dram::complete(const DramRequest& request, Cycles asked, Cycles at) {
  answers_.insert({at, request.address, request.write});
  if (request.write) return;
  stats_.sum_read_latency += at - asked;
  stats_.max_read_latency = std::max(stats_.max_read_latency, at - asked);
}

void FixedDram::tick(Cycles now) {
  while (requests.has_arrived(now)) {
    const DramRequest request = requests.read(now);
    count_request(request);
    const Cycles transfer = (request.bytes + spec_.bytes_per_cycle - 1) / spec_.bytes_per_cycle;
    stats_.bus_busy_cycles += transfer;
    bus_free_ = std::max(now + spec_.latency, bus_free_) + transfer;
    complete(request, now, bus_free_);
  }
}

BankedDram::BankedDram(Cycles request_latency, const DramDevice& device, double core_hz)
    : Dram(request_latency),
      memory_(device),
      to_memory_(ClockRatio::whole_hertz(core_hz), device.clock_hz),
      to_core_(device.clock_hz, ClockRatio::whole_hertz(core_hz)) {}

// A request is seen at the first tick of the memory's clock that is not before its arrival, and its
// data at the first core cycle that is not before their last byte.
void BankedDram::tick(Cycles now) {
  while (requests.has_arrived(now)) {
    const DramRequest request = requests.read(now);
    count_request(request);
    Served* served = served_.acquire();
    *served = {request, now};
    memory_.push({.arrival = to_memory_.up(now),
                  .address = request.address,
                  .bytes = request.bytes,
                  .write = request.write,
                  .user = served});
  }
  memory_.advance(to_memory_.up(now + 1), [this](const DramSystem::Done& done) {
    auto* served = static_cast<Served*>(done.user);
    complete(served->request, served->asked, to_core_.up(done.at));
    served_.release(served);
  });
}

Cycles BankedDram::memory_end(Cycles end) const {
  return std::max(to_memory_.up(end), memory_.now() + 1);
}

DramStats BankedDram::stats(Cycles end) const {
  DramStats stats = stats_;
  const std::uint64_t busy = memory_.stats(memory_end(end)).bus_busy_cycles;
  stats.bus_busy_cycles = to_core_.up(busy / memory_.num_channels());
  return stats;
}

void BankedDram::report_details(const std::string& path, Cycles end, StatsTree& stats) const {
  const Cycles memory_cycles = memory_end(end);
  report_dram(path, memory_.device(), memory_.stats(memory_cycles), memory_cycles, stats);
}

}  // namespace sheaf::clocked
