// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "stability/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/table.h"

namespace sheaf::stability {
namespace {

/// Whole numbers in full, others with three digits.
std::string number(double x) {
  if (x == static_cast<double>(static_cast<std::int64_t>(x)) && std::abs(x) < 1e9) {
    return fmt::format("{}", static_cast<std::int64_t>(x));
  }
  return fmt::format("{:.3g}", x);
}

const char* verdict(const Finding& finding) {
  return finding.passes() ? "pass" : "FAIL";
}

/// Numbers the reasons in the order of their first use.
class Reasons {
 public:
  std::size_t number_of(const std::string& why) {
    const auto found = std::ranges::find(list_, why);
    if (found != list_.end()) return static_cast<std::size_t>(found - list_.begin()) + 1;
    list_.push_back(why);
    return list_.size();
  }
  [[nodiscard]] const std::vector<std::string>& list() const { return list_; }

 private:
  std::vector<std::string> list_;
};

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    result += c;
    if (c == '"') result += c;
  }
  return result + '"';
}

}  // namespace

bool CaseResult::passes() const {
  return !findings.empty() && std::ranges::all_of(findings, &Finding::passes);
}

std::string as_text(const CaseResult& result) {
  std::string text =
      fmt::format("{}: {} ({})\n", result.source.group, result.source.name, result.source.extreme);
  TextTable table({Align::kLeft, Align::kRight, Align::kRight, Align::kRight, Align::kLeft});
  for (const Finding& f : result.findings) {
    table.add_row({f.measured, grouped(f.trials), number(f.error), "<= " + number(f.bound.value),
                   verdict(f)});
  }
  text += table.text(2);
  for (const Finding& f : result.findings) {
    if (!f.passes() && !f.worst.empty()) text += fmt::format("  FAIL at {}\n", f.worst);
  }
  return text;
}

std::string as_markdown(const std::vector<CaseResult>& results, const Effort& effort) {
  Reasons reasons;
  std::string text;
  std::string group;
  for (const CaseResult& result : results) {
    if (result.source.group != group) {
      group = result.source.group;
      text += fmt::format(
          "\n### {}\n\n| case | what is extreme | measured | of | error | bound | why | verdict |\n"
          "| --- | --- | --- | ---: | ---: | ---: | --- | --- |\n",
          group);
    }
    bool first = true;
    for (const Finding& f : result.findings) {
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n",
                          first ? result.source.name : "", first ? result.source.extreme : "",
                          f.measured, grouped(f.trials), number(f.error), number(f.bound.value),
                          reasons.number_of(f.bound.why), verdict(f));
      first = false;
    }
  }
  text += "\n### Why these bounds\n\n";
  for (std::size_t i = 0; i < reasons.list().size(); ++i) {
    text += fmt::format("{}. {}\n", i + 1, reasons.list()[i]);
  }
  const auto passed = std::ranges::count_if(results, &CaseResult::passes);
  return fmt::format("{} of {} cases pass{}.\n", passed, results.size(),
                     effort.quick ? " (quick: a twentieth of the trials)" : "") +
         text;
}

std::string as_csv(const std::vector<CaseResult>& results) {
  std::string text = "group,case,extreme,measured,trials,error,bound,verdict,why\n";
  for (const CaseResult& result : results) {
    for (const Finding& f : result.findings) {
      text +=
          fmt::format("{},{},{},{},{},{},{},{},{}\n", result.source.group,
                      quoted(result.source.name), quoted(result.source.extreme), quoted(f.measured),
                      f.trials, f.error, f.bound.value, verdict(f), quoted(f.bound.why));
    }
  }
  return text;
}

}  // namespace sheaf::stability
