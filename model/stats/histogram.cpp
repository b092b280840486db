// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stats/histogram.h"

#include <fmt/format.h>

#include "stats/report_tree.h"

namespace sheaf {

template <typename Binning>
void add_histogram(StatsTree& tree, std::string_view path, const Histogram<Binning>& histogram,
                   std::string_view what, std::string_view unit, std::string_view meaning) {
  tree.add(fmt::format("{}.num", path), histogram.num(), what, fmt::format("{}: number", meaning));
  tree.add_ratio(fmt::format("{}.mean", path), histogram.sum(), histogram.num(), unit,
                 fmt::format("{}: mean", meaning));
  tree.add(fmt::format("{}.max", path), histogram.max(), unit,
           fmt::format("{}: greatest", meaning));
  for (std::size_t i = 0; i < Binning::kNumBins; ++i) {
    if (histogram.bin(i) == 0) continue;
    tree.add(
        fmt::format("{}.bin_{}", path, Binning::lowest(i)), histogram.bin(i), what,
        fmt::format("{}: number from {} {} up to the next bin", meaning, Binning::lowest(i), unit));
  }
}

template void add_histogram(StatsTree&, std::string_view, const Histogram<PowerOfTwoBins>&,
                            std::string_view, std::string_view, std::string_view);
template void add_histogram(StatsTree&, std::string_view, const Histogram<LinearBins>&,
                            std::string_view, std::string_view, std::string_view);

}  // namespace sheaf
