// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Sums of contributions in the film, by number format, against sums without any rounding.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/random.h"
#include "image/film.h"
#include "stability/catalogue.h"
#include "stability/exact.h"
#include "stability/film_rounding.h"

namespace sheaf::stability {
namespace {

const char* const kOnce = "half an ulp of a float: the exact film rounds once, when it is read";

const char* const kDefinition =
    "each sum is what was stored plus the contribution, rounded once (film.h), in integer "
    "arithmetic";

/// The loss that a format cannot help, and whether it loses that and no more.
std::vector<Finding> sum_in(const FilmRounding& format, const std::vector<float>& terms) {
  const std::vector<float> defined = sums_by_definition(format.format, terms);
  const auto film = make_film(format.format, 1);
  Failures other;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    film->add(0, Vec3(terms[i]));
    other.check(film->value(0) == Vec3(defined[i]), [&] {
      return fmt::format("after contribution {}: {:a} for {:a}", i, film->value(0).x, defined[i]);
    });
  }
  return {{fmt::format("relative error in {}", format.name),
           terms.size(),
           relative_error(format, double{film->value(0).x}, sum_exactly(terms)),
           {relative_error_bound(format, terms), kRunningErrorBound},
           ""},
          other.finding(fmt::format("sums in {} other than defined", format.name), kDefinition)};
}

Finding sum_in_exact_film(std::vector<float> terms, Random& random) {
  const double right = sum_exactly(terms);
  Largest error;
  for (int order = 0; order < 3; ++order) {
    const auto film = make_film(FilmFormat::kExact, 1);
    for (const float term : terms) film->add(0, Vec3(term));
    // In units of the float's last place there, so that denormals are held to the same.
    const double ulp = std::ldexp(1.0, std::max(std::ilogb(right), -126) - 23);
    error.add(std::abs(double{film->value(0).x} - std::min(right, kFloatMax)) / ulp,
              [&] { return fmt::format("order {}", order); });
    for (std::size_t i = terms.size() - 1; i > 0; --i)
      std::swap(terms[i], terms[random.below(i + 1)]);
  }
  return error.finding("ulps off in exact, three orders", {0.5, kOnce});
}

std::vector<Finding> sum_in_all(const std::vector<float>& terms) {
  std::vector<Finding> findings;
  for (const FilmRounding& format : kFilmRoundings) {
    for (Finding& finding : sum_in(format, terms)) findings.push_back(std::move(finding));
  }
  Random random(71);
  findings.push_back(sum_in_exact_film(terms, random));
  return findings;
}

/// Log-uniform in [2^lowest, 2^highest).
std::vector<float> spread(int count, int lowest, int highest) {
  Random random(72);
  std::vector<float> terms;
  for (int i = 0; i < count; ++i) {
    const auto range = static_cast<std::uint64_t>(highest - lowest);
    terms.push_back(
        std::ldexp(1.0F + random.uniform(), lowest + static_cast<int>(random.below(range))));
  }
  return terms;
}

/// What no film may take: each is refused, and leaves the sum as it was.
std::vector<Finding> refuse() {
  const float infinity = std::numeric_limits<float>::infinity();
  Failures taken;
  for (const FilmFormat format :
       {FilmFormat::kUnorm8, FilmFormat::kHalf, FilmFormat::kFloat, FilmFormat::kExact}) {
    for (const float bad : {-1.0F, -1e-45F, std::nanf(""), infinity, -infinity}) {
      for (int channel = 0; channel < 3; ++channel) {
        const auto film = make_film(format, 1);
        Vec3 contribution(0.5F);
        contribution[channel] = bad;
        bool refused = false;
        try {
          film->add(0, contribution);
        } catch (const std::logic_error&) {
          refused = true;
        }
        taken.check(refused && film->value(0) == Vec3(0.0F),
                    [&] { return fmt::format("{} in channel {}", bad, channel); });
      }
    }
  }
  return {taken.finding("contributions taken that are negative or no number",
                        "the film's contract (film.h)")};
}

}  // namespace

std::vector<StabilityCase> sum_cases() {
  constexpr int kMany = 1'000'000;
  std::vector<StabilityCase> cases;
  const auto add = [&](const char* name, const char* extreme, auto terms) {
    cases.push_back(
        {"sums", name, extreme, [terms](const Effort&) { return sum_in_all(terms()); }});
  };
  add("a million millionths", "1e6 contributions of 1e-6",
      [] { return std::vector<float>(kMany, 1e-6F); });
  add("a thousand thousandths", "the paper's example: 1000 shadow rays of weight 0.001",
      [] { return std::vector<float>(1000, 0.001F); });
  add("one and crumbs", "1, then 1e6 contributions of a quarter of its ulp", [] {
    std::vector<float> terms(kMany + 1, 0x1p-25F);
    terms[0] = 1.0F;
    return terms;
  });
  add("mixed magnitudes", "1e5 contributions from 1e-30 to 1e30",
      [] { return spread(100'000, -100, 100); });
  add("denormal weights", "1e5 contributions from 1e-45 to 1e-38",
      [] { return spread(100'000, -149, -126); });
  add("overflow", "1000 contributions near the largest float",
      [] { return spread(1000, 126, 128); });
  // Half a step of unorm8, and, beside 1 and a number next to it, half a step of half; rounded to a
  // float first, the latter would be a tie.
  add("beside ties", "contributions just above half a step of unorm8 and of half", [] {
    return std::vector<float>{0.5F / 255.0F * 1.000001F, 1.0F, 0x1.000002p-11F, 0x1.000002p-11F};
  });
  cases.push_back({"sums", "no numbers", "negative, infinite and NaN contributions",
                   [](const Effort&) { return refuse(); }});
  return cases;
}

}  // namespace sheaf::stability
