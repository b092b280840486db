// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/heuristic.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/errors.h"
#include "sorting/arrival.h"
#include "sorting/dir.h"
#include "sorting/fastpos.h"
#include "sorting/mdir.h"
#include "sorting/pos.h"
#include "sorting/ray5d.h"

namespace sheaf {
namespace {

using Kind = HeuristicChoice::Kind;

// A direction cube finer than this has cells narrower than single precision resolves well, and
// tables larger than any cache.
constexpr double kMaxDirectionCells = 6.0 * 256 * 256;

// Squared distances that single precision, in which the hardware compares them, can hold.
constexpr double kMinDistance2 = 1e-30;
constexpr double kMaxDistance2 = 1e30;

// 262,144 voxels: more than there are rays to wait in them.
constexpr double kMaxVoxelsPerAxis = 64;

[[noreturn]] void refuse(std::string_view text, std::string_view rule) {
  throw Error(ExitCode::kUsage, fmt::format("ray_cache.heuristic = '{}': {}", text, rule));
}

double parse_argument(std::string_view text, std::string_view argument) {
  double x = 0.0;
  const char* end = argument.data() + argument.size();
  const auto [ptr, error] = std::from_chars(argument.data(), end, x);
  if (error != std::errc{} || ptr != end || !std::isfinite(x)) {
    refuse(text, "the x in parentheses must be a finite number");
  }
  return x;
}

std::uint32_t cube_cells_per_side(double x) {
  return static_cast<std::uint32_t>(std::lround(std::sqrt(x / 6.0)));
}

void check_mdir(std::string_view text, double x) {
  if (!(x >= 6.0) || x > kMaxDirectionCells) refuse(text, "x of mdir(x) must be 6 to 393216");
  const double k = cube_cells_per_side(x);
  if (6.0 * k * k != x) refuse(text, "x of mdir(x) must be 6 k², for example 24, 96 or 216");
}

void check_whole(std::string_view text, double x, double least, double most,
                 std::string_view rule) {
  if (!(x >= least && x <= most) || x != std::floor(x)) refuse(text, rule);
}

HeuristicChoice parse_with_argument(std::string_view text, std::string_view name, double x) {
  if (name == "mdir") {
    check_mdir(text, x);
    return {Kind::kMdir, x};
  }
  if (name == "pos") {
    if (!(x >= kMinDistance2 && x <= kMaxDistance2)) {
      refuse(text, "x of pos(x) must be 1e-30 to 1e30");
    }
    return {Kind::kPos, x};
  }
  if (name == "ray5d") {
    check_whole(text, x, 0, Ray5dHeuristic::kMaxLevels, "x of ray5d(x) must be 0, 1, 2 or 3");
    return {Kind::kRay5d, x};
  }
  check_whole(text, x, 1, kMaxVoxelsPerAxis, "x of grid(x) must be a whole number, 1 to 64");
  return {Kind::kGrid, x};
}

}  // namespace

HeuristicChoice HeuristicChoice::parse(std::string_view text) {
  if (text == "none") return {Kind::kNone, 0.0};
  if (text == "dir") return {Kind::kDir, 0.0};
  if (text == "fastpos") return {Kind::kFastpos, 0.0};
  if (text == "opos") return {Kind::kOpos, 0.0};
  const auto open = text.find('(');
  if (open != std::string_view::npos && text.ends_with(')')) {
    const std::string_view name = text.substr(0, open);
    const std::string_view argument = text.substr(open + 1, text.size() - open - 2);
    if (name == "mdir" || name == "pos" || name == "ray5d" || name == "grid") {
      return parse_with_argument(text, name, parse_argument(text, argument));
    }
  }
  refuse(text,
         "must be one of none, dir, mdir(x), fastpos, pos(x), opos, ray5d(x), grid(x); for example "
         "mdir(96)");
}

std::string HeuristicChoice::to_string() const {
  switch (kind) {
    case Kind::kNone:
      return "none";
    case Kind::kDir:
      return "dir";
    case Kind::kMdir:
      return fmt::format("mdir({})", x);
    case Kind::kFastpos:
      return "fastpos";
    case Kind::kPos:
      return fmt::format("pos({})", x);
    case Kind::kOpos:
      return "opos";
    case Kind::kRay5d:
      return fmt::format("ray5d({})", x);
    case Kind::kGrid:
      return fmt::format("grid({})", x);
  }
  return {};
}

std::uint32_t HeuristicChoice::natural_cells() const {
  switch (kind) {
    case Kind::kNone:
      return 1;
    case Kind::kMdir:
      return static_cast<std::uint32_t>(x);
    case Kind::kPos:
    case Kind::kGrid:
      return 64;
    case Kind::kRay5d:
      return std::min(Ray5dHeuristic::num_keys(static_cast<std::uint32_t>(x)), 192U);
    case Kind::kDir:
    case Kind::kFastpos:
    case Kind::kOpos:
      break;
  }
  return 8;
}

std::unique_ptr<Heuristic> make_heuristic(const HeuristicChoice& choice, std::uint32_t num_cells,
                                          const Box& scene_bounds) {
  switch (choice.kind) {
    case Kind::kDir:
      return std::make_unique<DirHeuristic>(num_cells);
    case Kind::kMdir:
      return std::make_unique<MdirHeuristic>(cube_cells_per_side(choice.x), num_cells);
    case Kind::kFastpos:
      return std::make_unique<FastposHeuristic>(scene_bounds, num_cells);
    case Kind::kPos:
      return std::make_unique<PosHeuristic>(static_cast<float>(choice.x), num_cells);
    case Kind::kRay5d:
      return std::make_unique<Ray5dHeuristic>(static_cast<std::uint32_t>(choice.x), scene_bounds,
                                              num_cells);
    case Kind::kNone:
      return std::make_unique<ArrivalHeuristic>(num_cells);
    case Kind::kOpos:
    case Kind::kGrid:
      break;
  }
  throw std::logic_error("this heuristic has no cells");
}

}  // namespace sheaf
