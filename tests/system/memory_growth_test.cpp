// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Rays live only while they are in flight: the simulator's memory grows with the picture by what
// the picture itself takes.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <iostream>

#include "support/scenes.h"
#include "support/scratch_folder.h"
#include "support/sheaf_command.h"
#include "support/tiny_gltf.h"

namespace sheaf::test {
namespace {

// What a pixel of a small picture takes besides the film: albedo, normal and depth of the camera's
// hits, and some room for what the system rounds up to.
constexpr double kLayers = 28.0;
constexpr double kRoom = 4.0;

struct Case {
  const char* name;
  std::vector<std::string> settings;
  double film;  ///< bytes that the simulator keeps for a pixel of the film
};

void PrintTo(const Case& of, std::ostream* out) {
  *out << of.name;
}

class MemoryGrowth : public testing::TestWithParam<Case> {
 protected:
  [[nodiscard]] CommandResult run_at(int width, int height) const {
    std::vector<std::string> settings = GetParam().settings;
    settings.push_back("image.width=" + std::to_string(width));
    settings.push_back("image.height=" + std::to_string(height));
    settings.emplace_back("render.recursion_level=3");
    const auto scene = TinyGltf().write(scratch_.path());
    CommandResult result = run_sheaf(run_arguments(scene, scratch_ / "result", settings));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result;
  }
  const ScratchFolder scratch_;
};

// A scene so small that nothing hides the growth. A ray in flight takes more than 64 bytes, and a
// pixel has four here: rays that were kept would show.
TEST_P(MemoryGrowth, IsThatOfThePicture) {
  const CommandResult small = run_at(400, 300);
  const CommandResult large = run_at(640, 480);
  rusage own{};
  getrusage(RUSAGE_SELF, &own);
  ASSERT_GT(small.peak_bytes, own.ru_maxrss * 1024) << "the test's own memory hides the growth";
  const double growth =
      static_cast<double>(large.peak_bytes) - static_cast<double>(small.peak_bytes);
  const double per_pixel = growth / (640 * 480 - 400 * 300);
  std::cout << per_pixel << " bytes a pixel, " << small.peak_bytes << " to " << large.peak_bytes
            << '\n';
  EXPECT_LE(per_pixel, GetParam().film + kLayers + kRoom);
}

INSTANTIATE_TEST_SUITE_P(
    Machines, MemoryGrowth,
    testing::Values(Case{"timed", {"run.fidelity=timed"}, 12.0},
                    Case{"functional", {"run.fidelity=functional"}, 12.0},
                    Case{"credits", {"run.fidelity=functional", "flow.control=credits"}, 12.0},
                    Case{"opos", {"run.fidelity=functional", "ray_cache.heuristic=opos"}, 12.0},
                    Case{"unorm8", {"run.fidelity=functional", "film.format=unorm8"}, 3.0},
                    Case{"exact", {"run.fidelity=functional", "film.format=exact"}, 120.0}),
    [](const auto& of) { return std::string(of.param.name); });

// Pixels of a large picture need not stay in memory.
TEST(PeakMemory, IsWithinTheBudgetWhateverThePicture) {
  const ScratchFolder scratch;
  const auto scene = TinyGltf().write(scratch.path());
  const CommandResult result =
      run_sheaf(run_arguments(scene, scratch / "result",
                              {"image.width=2048", "image.height=1536", "render.recursion_level=1",
                               "run.fidelity=functional", "ray_cache.heuristic=none"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LE(result.peak_bytes, std::uint64_t{64} << 20U);
}

// In this scene each hit turns one ray into one: no more are in the loop than a tile has pixels.
TEST(RaysInFlight, AreNoMoreThanThoseOfATile) {
  const ScratchFolder scratch;
  const auto scene = TinyGltf().write(scratch.path());
  for (const char* width : {"image.width=32", "image.width=320"}) {
    const CommandResult result = run_sheaf(run_arguments(
        scene, scratch / "result", {width, "image.height=64", "render.recursion_level=3"}));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_stats(scratch / "result").at("system.max_rays_in_flight").at("value"), 256);
  }
}

}  // namespace
}  // namespace sheaf::test
