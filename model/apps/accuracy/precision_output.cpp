// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/accuracy/precision.h"
#include "report/table.h"

namespace sheaf {
namespace {

std::string percent(double share) {
  return fmt::format("{:+.3f}", 100.0 * share);
}

}  // namespace

std::string precision_text(const PrecisionCosts& costs) {
  constexpr auto kRight = Align::kRight;
  TextTable table({Align::kLeft, Align::kLeft, kRight, kRight, kRight, kRight, kRight, kRight});
  table.add_row({"stored in it", "format", "node bits", "ray bits", "steps %", "tests %",
                 "other hits", "RMSE"});
  table.add_rule();
  for (const PrecisionCost& row : costs.rows) {
    table.add_row({row.stored, row.format, fmt::format("{}", -row.node_bits),
                   fmt::format("{}", -row.ray_bits), percent(row.steps), percent(row.tests),
                   grouped(row.differing), fmt::format("{:.3g}", row.rmse)});
  }
  return fmt::format(
      "\nSplit planes and rays in fewer bits\n\n{}\n  node, ray bits: of the 64 of an inner node "
      "and of the 192 of a ray's origin and inverse\n  direction in the traversal unit; steps, "
      "tests: of single rays, {} of the frame's {};\n  other hits: rays that meet something else; "
      "RMSE: of the picture they give. Leaves are tested\n  in full precision.\n",
      table.text(2), grouped(costs.num_traced), grouped(costs.num_rays));
}

std::string precision_csv(const PrecisionCosts& costs) {
  std::string csv =
      "stored,format,node_bits_saved,ray_bits_saved,rays,steps_added,tests_added,other_hits,rmse\n";
  for (const PrecisionCost& row : costs.rows) {
    csv += fmt::format("{},{},{},{},{},{:.6g},{:.6g},{},{:.9g}\n", row.stored, row.format,
                       row.node_bits, row.ray_bits, costs.num_traced, row.steps, row.tests,
                       row.differing, row.rmse);
  }
  return csv;
}

}  // namespace sheaf
