// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "sorting/heuristic.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/errors.h"
#include "sorting/dir.h"
#include "sorting/fastpos.h"
#include "sorting/mdir.h"
#include "sorting/pos.h"

namespace sheaf {
namespace {

using Kind = HeuristicChoice::Kind;

// A direction cube finer than this has cells narrower than single precision resolves well, and
// tables larger than any cache.
constexpr double kMaxDirectionCells = 6.0 * 256 * 256;

// Squared distances that single precision, in which the hardware compares them, can hold.
constexpr double kMinDistance2 = 1e-30;
constexpr double kMaxDistance2 = 1e30;

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
    if (name == "mdir") {
      const double x = parse_argument(text, argument);
      check_mdir(text, x);
      return {Kind::kMdir, x};
    }
    if (name == "pos") {
      const double x = parse_argument(text, argument);
      if (!(x >= kMinDistance2 && x <= kMaxDistance2)) {
        refuse(text, "x of pos(x) must be 1e-30 to 1e30");
      }
      return {Kind::kPos, x};
    }
  }
  refuse(text, "must be one of none, dir, mdir(x), fastpos, pos(x), opos; for example mdir(96)");
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
  }
  return {};
}

std::uint32_t HeuristicChoice::natural_cells() const {
  if (kind == Kind::kMdir) return static_cast<std::uint32_t>(x);
  return kind == Kind::kPos ? 64 : 8;
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
    case Kind::kNone:
    case Kind::kOpos:
      break;
  }
  throw std::logic_error("this heuristic has no cells");
}

}  // namespace sheaf
