// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/errors.h"
#include "config/dram/presets.h"
#include "unit/memory/dram_bench.h"

namespace sheaf::test {
namespace {

std::string refusal(const Change& change) {
  try {
    static_cast<void>(ddr4(change));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    return error.what();
  }
  return "accepted";
}

void expect_rule(const Change& change, const std::string& first, const std::string& second) {
  const std::string text = refusal(change);
  EXPECT_NE(text.find(first), std::string::npos) << text;
  EXPECT_NE(text.find(second), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(DramRefusals, TrasShorterThanTrcd) {
  expect_rule([](DramSpec& s) { s.timing.tRAS = 10; }, "dram.tRAS = 10", "dram.tRCD = 17");
}
TEST(DramRefusals, TrcShorterThanTras) {
  expect_rule([](DramSpec& s) { s.timing.tRC = 38; }, "dram.tRC = 38", "dram.tRAS = 39");
}
TEST(DramRefusals, BurstsThatOverlap) {
  expect_rule([](DramSpec& s) { s.timing.tCCD_S = 3; }, "dram.tCCD_S = 3", "dram.tBL = 4");
}
TEST(DramRefusals, SameBankGroupFasterThanAnother) {
  expect_rule([](DramSpec& s) { s.timing.tCCD_S = 7; }, "dram.tCCD_L = 6", "dram.tCCD_S = 7");
  expect_rule([](DramSpec& s) { s.timing.tRRD_S = 7; }, "dram.tRRD_L = 6", "dram.tRRD_S = 7");
  expect_rule([](DramSpec& s) { s.timing.tWTR_S = 10; }, "dram.tWTR_L = 9", "dram.tWTR_S = 10");
}
TEST(DramRefusals, WindowShorterThanAnInterval) {
  expect_rule([](DramSpec& s) { s.timing.tFAW = 3; }, "dram.tFAW = 3", "dram.tRRD_S = 4");
}
TEST(DramRefusals, RefreshThatTakesAllTime) {
  expect_rule([](DramSpec& s) { s.timing.tREFI = 470; }, "dram.tREFI = 470", "dram.tRFC = 420");
}
TEST(DramRefusals, DrainBeyondTheQueue) {
  expect_rule([](DramSpec& s) { s.write_queue = 16; }, "dram.write_high = 24",
              "dram.write_queue = 16");
}
TEST(DramRefusals, DrainThatTakesNothingOut) {
  expect_rule([](DramSpec& s) { s.write_low = 24; }, "dram.write_low = 24", "dram.write_high = 24");
}
TEST(DramRefusals, ChannelsThatAreNoPowerOfTwo) {
  expect_rule([](DramSpec& s) { s.channels = 3; }, "dram.channels = 3", "power of two");
}
TEST(DramRefusals, MoreBanksThanAChannelCanHave) {
  expect_rule([](DramSpec& s) { s.ranks = 8; }, "dram.ranks = 8", "64 banks");
}

TEST(DramPresets, AllAreAcceptedAndNameTheirSources) {
  for (const DramPreset& preset : dram_presets()) {
    const DramDevice device = ddr4([&](DramSpec& s) { s.model = preset.model; });
    EXPECT_EQ(device.timing, preset.timing) << preset.name;
    EXPECT_FALSE(preset.timing_source.empty());
    EXPECT_FALSE(preset.energy.source.empty());
  }
}

TEST(DramPresets, PeakBandwidthIsThatOfTheName) {
  const auto peak = [](DramModel model) {
    return ddr4([&](DramSpec& s) { s.model = model; }).peak_bandwidth() / 1e9;
  };
  EXPECT_NEAR(peak(DramModel::kDdr4_2400), 8 * 2.4, 1e-9);
  EXPECT_NEAR(peak(DramModel::kDdr4_3200), 8 * 3.2, 1e-9);
  EXPECT_NEAR(peak(DramModel::kLpddr5_6400), 2 * 2 * 6.4, 1e-9);
  EXPECT_NEAR(peak(DramModel::kGddr6_14000), 2 * 2 * 14, 1e-9);
  EXPECT_NEAR(peak(DramModel::kHbm2_2000), 16 * 8 * 2, 1e-9);
}

TEST(DramPresets, OverriddenTermsChangeTheirSums) {
  const DramDevice device = ddr4([](DramSpec& s) {
    s.timing.tRP = 20;
    s.timing.tCL = 20;
  });
  EXPECT_EQ(device.timing.tRC, 59U);
  EXPECT_EQ(device.timing.tRTW, 14U);
}

}  // namespace
}  // namespace sheaf::test
