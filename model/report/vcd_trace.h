// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "report/watch_window.h"
#include "system/machine_observer.h"

namespace sheaf {

/// Writes the signals of one unit as a value change dump, by SystemC's own tracing: what the cycle
/// goes to (stall_cause: 0 busy, 1 input, 2 memory, 3 blocked, 4 idle), the issue port, the
/// contexts held, as bits and as a number, and the depths of the links that lead to it.
class VcdTrace final : public MachineObserver {
 public:
  /// `path` ends in .vcd.
  VcdTrace(std::filesystem::path path, std::string unit, const WatchWindow& window);

  /// Throws Error(kUsage), naming the units there are, if there is none of this name.
  void attach(const MachineProbes& probes) override;
  [[nodiscard]] Cycles next_observed(Cycles cycle) override;
  void observe(Cycles cycle) override;
  [[nodiscard]] bool wants_kernel_time() const override { return true; }
  /// Throws Error(kOutput) if the file could not be written.
  void finish(Cycles end) override;

 private:
  struct Depth {
    LinkProbe probe;
    std::uint32_t value = 0;
  };
  struct CloseFile {
    void operator()(sc_core::sc_trace_file* file) const { sc_core::sc_close_vcd_trace_file(file); }
  };
  void open();
  void remove_date() const;

  const std::filesystem::path path_;
  const std::string unit_;
  const WatchWindow window_;
  UnitProbe probe_;
  std::unique_ptr<sc_core::sc_trace_file, CloseFile> file_;
  std::uint64_t num_changes_ = 0;
  // Traced.
  std::uint32_t cause_ = static_cast<std::uint32_t>(StallCause::kIdle);
  std::uint32_t occupancy_ = 0;
  std::uint64_t contexts_ = 0;
  bool issuing_ = false;
  std::vector<Depth> depths_;
};

}  // namespace sheaf
