// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/vcd_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>

#include "base/errors.h"

namespace sheaf {
namespace {

// Sets a signal; counts it if that is a change.
template <typename T>
void set(T& signal, T value, std::uint64_t& num_changes) {
  if (signal == value) return;
  signal = value;
  ++num_changes;
}

}  // namespace

VcdTrace::VcdTrace(std::filesystem::path path, std::string unit, const WatchWindow& window)
    : path_(std::move(path)), unit_(std::move(unit)), window_(window) {}

void VcdTrace::attach(const MachineProbes& probes) {
  const auto it = std::ranges::find(probes.units, unit_, &UnitProbe::name);
  if (it == probes.units.end()) {
    std::string names;
    for (const UnitProbe& probe : probes.units) names += (names.empty() ? "" : ", ") + probe.name;
    throw Error(ExitCode::kUsage,
                fmt::format("--vcd {}: this machine has no such unit; it has {}", unit_, names));
  }
  probe_ = *it;
  for (const LinkProbe& link : probes.links) {
    if (link.reader == unit_) depths_.push_back({link});
  }
  open();
}

void VcdTrace::open() {
  // SystemC adds the suffix.
  const std::string stem = (path_.parent_path() / path_.stem()).string();
  file_.reset(sc_core::sc_create_vcd_trace_file(stem.c_str()));
  file_->set_time_unit(1, sc_core::SC_PS);
  const auto name = [&](const char* signal) { return unit_ + '.' + signal; };
  sc_core::sc_trace(file_.get(), cause_, name("stall_cause"), 3);
  sc_core::sc_trace(file_.get(), issuing_, name("issue_port"));
  if (probe_.contexts != 0) {
    const auto width = static_cast<int>(probe_.contexts);
    sc_core::sc_trace(file_.get(), contexts_, name("contexts"), width);
    sc_core::sc_trace(file_.get(), occupancy_, name("occupancy"), 7);
  }
  for (Depth& depth : depths_) {
    sc_core::sc_trace(file_.get(), depth.value, name("depth_") + depth.probe.name);
  }
}

Cycles VcdTrace::next_observed(Cycles cycle) {
  return num_changes_ < window_.max_events ? window_.next(cycle) : kNever;
}

void VcdTrace::observe(Cycles cycle) {
  const UnitState state = probe_.state(cycle);
  set(cause_, static_cast<std::uint32_t>(state.cause), num_changes_);
  set(issuing_, state.issuing, num_changes_);
  set(contexts_, state.contexts, num_changes_);
  set(occupancy_, static_cast<std::uint32_t>(std::popcount(state.contexts)), num_changes_);
  for (Depth& depth : depths_) {
    set(depth.value, static_cast<std::uint32_t>(depth.probe.depth(cycle)), num_changes_);
  }
}

void VcdTrace::finish(Cycles /*end*/) {
  file_.reset();
  remove_date();
}

// SystemC writes when it was run, which would make every file another one.
void VcdTrace::remove_date() const {
  const std::filesystem::path raw = path_.string() + ".raw";
  std::error_code error;
  std::filesystem::rename(path_, raw, error);
  std::ifstream in(raw);
  std::ofstream out(path_);
  bool in_date = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("$date")) in_date = true;
    if (!in_date) out << line << '\n';
    if (line.find("$end") != std::string::npos) in_date = false;
  }
  out.close();
  std::filesystem::remove(raw, error);
  if (!out || !in.eof()) {
    throw Error(ExitCode::kOutput,
                fmt::format("{}: cannot write the signals; is the disk full?", path_.string()));
  }
}

}  // namespace sheaf
