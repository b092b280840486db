// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "config/dram/presets.h"

#include <array>

namespace sheaf {
namespace {

/// Supply currents of one device in mA, as data sheets name them, and how many devices answer a
/// command together.
struct Currents {
  double vdd = 0;
  double idd0 = 0, idd2n = 0, idd3n = 0, idd4r = 0, idd4w = 0, idd5b = 0;
  int devices = 0;
};

/// Command energies after Micron's technical note TN-40-07, "Calculating Memory Power for DDR4
/// SDRAM": each command costs what its current exceeds the standby current that flows anyway, for
/// as long as the command lasts. mA x V x ns = pJ. Vpp and the interface's termination are not in
/// it.
DramEnergyTable energy_of(const Currents& i, const DramTiming& t, double clock_hz,
                          std::string_view source) {
  const double ns = 1e9 / clock_hz;
  const double scale = i.vdd * i.devices;
  const double cycle = t.tRC * i.idd0 - t.tRAS * i.idd3n - (t.tRC - t.tRAS) * i.idd2n;
  return {.activate_precharge_pj = scale * cycle * ns,
          .read_pj = scale * (i.idd4r - i.idd3n) * t.tBL * ns,
          .write_pj = scale * (i.idd4w - i.idd3n) * t.tBL * ns,
          .refresh_pj = scale * (i.idd5b - i.idd3n) * t.tRFC * ns,
          .active_standby_mw = scale * i.idd3n,
          .precharge_standby_mw = scale * i.idd2n,
          .source = source};
}

// 8 Gb x8, speed bin 2400R 17-17-17. JESD79-4: tRAS 32 ns, tRRD_S/L 3.3/4.9 ns and tFAW 21 ns for
// pages of 1 KiB, tCCD_L 5 ns, tRTP 7.5 ns, tWR 15 ns, tWTR_S/L 2.5/7.5 ns, tRFC1 350 ns, tREFI
// 7.8 us; CWL 12 with a write preamble of one cycle. tRTW = CL + BL/2 + 2 - CWL (JESD79-4, read to
// write with a preamble of one cycle).
constexpr DramTiming kDdr4_2400{.tCL = 17,
                                .tCWL = 12,
                                .tBL = 4,
                                .tRCD = 17,
                                .tRCDWR = 17,
                                .tRP = 17,
                                .tRAS = 39,
                                .tRC = 56,
                                .tCCD_S = 4,
                                .tCCD_L = 6,
                                .tRRD_S = 4,
                                .tRRD_L = 6,
                                .tFAW = 26,
                                .tWR = 18,
                                .tWTR_S = 3,
                                .tWTR_L = 9,
                                .tRTP = 9,
                                .tRTW = 11,
                                .tRTRS = 2,
                                .tRFC = 420,
                                .tREFI = 9360};
// The same in ns, speed bin 3200AA 22-22-22, CWL 16.
constexpr DramTiming kDdr4_3200{.tCL = 22,
                                .tCWL = 16,
                                .tBL = 4,
                                .tRCD = 22,
                                .tRCDWR = 22,
                                .tRP = 22,
                                .tRAS = 52,
                                .tRC = 74,
                                .tCCD_S = 4,
                                .tCCD_L = 8,
                                .tRRD_S = 4,
                                .tRRD_L = 8,
                                .tFAW = 34,
                                .tWR = 24,
                                .tWTR_S = 4,
                                .tWTR_L = 12,
                                .tRTP = 12,
                                .tRTW = 12,
                                .tRTRS = 2,
                                .tRFC = 560,
                                .tREFI = 12480};
// 8 Gb x16 channel, CK 800 MHz and WCK 4:1, bank-group mode, BL16 = 2 tCK. JESD209-5: RL 17 and
// WL 9 (set 0, set A), tRCD 18 ns, tRPpb 18 ns, tRAS 42 ns, tRRD 5 ns and tFAW 20 ns in bank-group
// mode, tWR 34 ns, tWTR_S/L 6.25/12 ns, tRBTP 7.5 ns - 2 tCK, tRFCab 210 ns, tREFI 3.904 us.
constexpr DramTiming kLpddr5_6400{.tCL = 17,
                                  .tCWL = 9,
                                  .tBL = 2,
                                  .tRCD = 15,
                                  .tRCDWR = 15,
                                  .tRP = 15,
                                  .tRAS = 34,
                                  .tRC = 49,
                                  .tCCD_S = 2,
                                  .tCCD_L = 4,
                                  .tRRD_S = 4,
                                  .tRRD_L = 4,
                                  .tFAW = 16,
                                  .tWR = 28,
                                  .tWTR_S = 5,
                                  .tWTR_L = 10,
                                  .tRTP = 4,
                                  .tRTW = 11,
                                  .tRTRS = 2,
                                  .tRFC = 168,
                                  .tREFI = 3123};
// 8 Gb with two channels x16, CK 1.75 GHz and eight transfers a CK, BL16 = 2 tCK. Times of 15 ns
// (tRCDRD, tRP, tWR), 9 ns (tRCDWR), 30 ns (tRAS), 45 ns (tRC), 4 ns (tRRD), 16 ns (tFAW), 120 ns
// (tRFC) and 1.9 us (tREFI), as Ramulator 2's preset GDDR6_2000_1350mV has them (CL 24, CWL 6, WTR
// 9/11, RTP 4 in CK); tCCD_S/L 2/3 after JESD250.
constexpr DramTiming kGddr6_14000{.tCL = 24,
                                  .tCWL = 6,
                                  .tBL = 2,
                                  .tRCD = 26,
                                  .tRCDWR = 16,
                                  .tRP = 26,
                                  .tRAS = 53,
                                  .tRC = 79,
                                  .tCCD_S = 2,
                                  .tCCD_L = 3,
                                  .tRRD_S = 7,
                                  .tRRD_L = 7,
                                  .tFAW = 28,
                                  .tWR = 26,
                                  .tWTR_S = 9,
                                  .tWTR_L = 11,
                                  .tRTP = 4,
                                  .tRTW = 23,
                                  .tRTRS = 0,
                                  .tRFC = 210,
                                  .tREFI = 3333};
// A stack of four 8 Gb dies as 16 pseudo channels of 64 bits, CK 1 GHz, BL4 = 2 tCK. Values of
// DRAMsim3's HBM2_8Gb_x128, with tCCD_S/L for bursts of four (JESD235: a burst, twice a burst),
// tFAW 16 ns of a pseudo channel (as in DRAMSys' HBM2) and tRFC 350 ns of an 8 Gb die.
constexpr DramTiming kHbm2_2000{.tCL = 14,
                                .tCWL = 4,
                                .tBL = 2,
                                .tRCD = 14,
                                .tRCDWR = 14,
                                .tRP = 14,
                                .tRAS = 34,
                                .tRC = 48,
                                .tCCD_S = 2,
                                .tCCD_L = 4,
                                .tRRD_S = 4,
                                .tRRD_L = 6,
                                .tFAW = 16,
                                .tWR = 16,
                                .tWTR_S = 6,
                                .tWTR_L = 8,
                                .tRTP = 6,
                                .tRTW = 14,
                                .tRTRS = 0,
                                .tRFC = 350,
                                .tREFI = 3900};

// One burst of 32 bytes at (1.51 + 1.17 + 0.80) pJ a bit: array to global sense amplifier, on to
// the pads, interface; 909 pJ for a row of 1 KiB. Refresh and standby are not given there.
constexpr double kHbm2Burst = 256 * (1.51 + 1.17 + 0.80);
constexpr DramEnergyTable kHbm2Energy{
    .activate_precharge_pj = 909,
    .read_pj = kHbm2Burst,
    .write_pj = kHbm2Burst,
    .refresh_pj = {},
    .active_standby_mw = {},
    .precharge_standby_mw = {},
    .source = "O'Connor et al., Fine-Grained DRAM, MICRO 2017, table of HBM2 energies"};

constexpr DramEnergyTable kNoEnergy{.activate_precharge_pj = {},
                                    .read_pj = {},
                                    .write_pj = {},
                                    .refresh_pj = {},
                                    .active_standby_mw = {},
                                    .precharge_standby_mw = {},
                                    .source = "none: no freely published currents are known"};

// Per device: module current = 9 active devices + 9 in power-down, for one rank of the module.
constexpr Currents kMicron8Gb2400{.vdd = 1.2,
                                  .idd0 = 48,
                                  .idd2n = 34,
                                  .idd3n = 43,
                                  .idd4r = 135,
                                  .idd4w = 123,
                                  .idd5b = 250,
                                  .devices = 8};
constexpr Currents kMicron8Gb3200{.vdd = 1.2,
                                  .idd0 = 57,
                                  .idd2n = 37,
                                  .idd3n = 52,
                                  .idd4r = 168,
                                  .idd4w = 150,
                                  .idd5b = 250,
                                  .devices = 8};

constexpr DramOrganization kDdr4_8Gb_x8{.channels = 1,
                                        .ranks = 1,
                                        .bank_groups = 4,
                                        .banks = 4,
                                        .rows = 65536,
                                        .columns = 128,
                                        .burst_bytes = 64};

constexpr std::string_view kLineMapping = "row rank bank bankgroup column channel";
// Two bursts make a line of 64 bytes; neighbouring lines go to other channels, then bank groups.
constexpr std::string_view kPairMapping = "row rank bank column bankgroup channel column:1";

std::array<DramPreset, 5> make_presets() {
  return {{
      {DramModel::kDdr4_2400, "DDR4-2400", "JESD79-4 for 8 Gb x8, speed bin 2400R (17-17-17)",
       kLineMapping, 1'200'000'000, kDdr4_8Gb_x8, false, kDdr4_2400,
       energy_of(kMicron8Gb2400, kDdr4_2400, 1.2e9,
                 "Micron MT40A1G8 rev. B at 2400, from the module data sheet MTA18ASF2G72HZ rev. F "
                 "(2016), table 15; Micron TN-40-07")},
      {DramModel::kDdr4_3200, "DDR4-3200", "JESD79-4 for 8 Gb x8, speed bin 3200AA (22-22-22)",
       kLineMapping, 1'600'000'000, kDdr4_8Gb_x8, false, kDdr4_3200,
       energy_of(kMicron8Gb3200, kDdr4_3200, 1.6e9,
                 "Micron 8 Gb x8 at 3200, as DRAMsim3's DDR4_8Gb_x8_3200 quotes the data sheet; "
                 "Micron TN-40-07")},
      {DramModel::kLpddr5_6400,
       "LPDDR5-6400",
       "JESD209-5 for 8 Gb x16, bank-group mode; as gem5's LPDDR5_6400_1x16_BG_BL16",
       kPairMapping,
       800'000'000,
       {.channels = 2,
        .ranks = 1,
        .bank_groups = 4,
        .banks = 4,
        .rows = 32768,
        .columns = 64,
        .burst_bytes = 32},
       false,
       kLpddr5_6400,
       kNoEnergy},
      {DramModel::kGddr6_14000,
       "GDDR6-14000",
       "JESD250; Ramulator 2's GDDR6_2000_1350mV",
       kPairMapping,
       1'750'000'000,
       {.channels = 2,
        .ranks = 1,
        .bank_groups = 4,
        .banks = 4,
        .rows = 16384,
        .columns = 64,
        .burst_bytes = 32},
       false,
       kGddr6_14000,
       kNoEnergy},
      {DramModel::kHbm2_2000,
       "HBM2-2000",
       "JESD235; DRAMsim3's HBM2_8Gb_x128, DRAMSys' HBM2",
       kPairMapping,
       1'000'000'000,
       {.channels = 16,
        .ranks = 1,
        .bank_groups = 4,
        .banks = 4,
        .rows = 16384,
        .columns = 32,
        .burst_bytes = 32},
       true,
       kHbm2_2000,
       kHbm2Energy},
  }};
}

}  // namespace

std::span<const DramPreset> dram_presets() {
  static const std::array<DramPreset, 5> kPresets = make_presets();
  return kPresets;
}

}  // namespace sheaf
