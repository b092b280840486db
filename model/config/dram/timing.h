// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace sheaf {

// Timing parameters of a DRAM under their JEDEC names, in cycles of the memory clock (tCK), from
// command to command unless the meaning says otherwise. JESD79-4 (DDR4), JESD209-5 (LPDDR5),
// JESD250 (GDDR6) and JESD235 (HBM2) define them.
#define SHEAF_DRAM_TIMINGS(X)                                                      \
  X(tCL, "Read to its first data")                                                 \
  X(tCWL, "Write to its first data")                                               \
  X(tBL, "Length of a burst on the data bus")                                      \
  X(tRCD, "Activate to read of the same bank (tRCDRD where the standard has two)") \
  X(tRCDWR, "Activate to write of the same bank")                                  \
  X(tRP, "Precharge to activate of the same bank")                                 \
  X(tRAS, "Activate to precharge of the same bank")                                \
  X(tRC, "Activate to activate of the same bank")                                  \
  X(tCCD_S, "Column command to column command, other bank group")                  \
  X(tCCD_L, "Column command to column command, same bank group")                   \
  X(tRRD_S, "Activate to activate, other bank group")                              \
  X(tRRD_L, "Activate to activate, same bank group")                               \
  X(tFAW, "Window in which a rank may be activated four times")                    \
  X(tWR, "End of written data to precharge")                                       \
  X(tWTR_S, "End of written data to read, other bank group")                       \
  X(tWTR_L, "End of written data to read, same bank group")                        \
  X(tRTP, "Read to precharge")                                                     \
  X(tRTW, "Read to write, any bank: the data bus turns round")                     \
  X(tRTRS, "Gap on the data bus between bursts of two ranks")                      \
  X(tRFC, "Refresh of all banks to the next activate")                             \
  X(tREFI, "Mean interval of refreshes")

/// Values in tCK; as overrides, 0 means: as the preset has it.
struct DramTiming {
#define SHEAF_DRAM_TIMING_MEMBER(name, meaning) std::uint32_t name = 0;
  SHEAF_DRAM_TIMINGS(SHEAF_DRAM_TIMING_MEMBER)
#undef SHEAF_DRAM_TIMING_MEMBER
  bool operator==(const DramTiming&) const = default;
};

}  // namespace sheaf
