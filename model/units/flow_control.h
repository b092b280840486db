// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "channels/clock_domain.h"
#include "config/config.h"
#include "geometry/ray.h"

namespace sheaf {

/// Worst case of what one ray can turn into: the most rays that may wait or travel in its place at
/// a time. A hit replaces a ray by one shadow ray a light and, below the recursion level, by
/// `branches` rays one deeper; shadow rays end.
///   W(L) = max(1, lights)      W(d) = max(1, lights + branches · W(d + 1))
class WorstCase {
 public:
  WorstCase(std::uint32_t recursion_level, std::uint32_t lights, std::uint32_t branches) {
    at_depth_.assign(recursion_level + 1, std::max<std::uint64_t>(1, lights));
    for (std::uint32_t d = recursion_level; d-- > 0;) {
      const std::uint64_t all = lights + branches * at_depth_[d + 1];
      at_depth_[d] = std::clamp<std::uint64_t>(all, 1, kCeiling);
    }
  }
  [[nodiscard]] std::uint64_t of(const RayTag& tag) const {
    return tag.kind == RayKind::kShadow ? 1 : at_depth_[tag.depth];
  }

  /// High enough to be out of any machine's reach, low enough never to overflow a sum.
  static constexpr std::uint64_t kCeiling = std::uint64_t{1} << 40;

 private:
  std::vector<std::uint64_t> at_depth_;
};

/// Counts the rays in the loop and says when a tile is finished, when the ray cache must be swept
/// and whether another primary packet fits.
///
/// What is asked for with a cycle is answered from registers: as it was at the end of the cycle
/// before, whatever has changed in this one already. Cycles never go back; without time they are
/// all 0, and the counts are asked for as they stand.
class FlowControl {
 public:
  FlowControl(const FlowSpec& spec, WorstCase worst_case, std::uint64_t credits)
      : worst_case_(std::move(worst_case)), credits_(credits), policy_(spec.control) {}

  void bind_source(Inbox& inbox) { source_ = &inbox; }
  void bind_regrouper(Inbox& inbox) { regrouper_ = &inbox; }
  void bind_shader_cache(Inbox& inbox) { shader_cache_ = &inbox; }
  void bind_film(Inbox& inbox) { film_ = &inbox; }
  void bind_shader(const Inbox& inbox) { shaders_.push_back(inbox.agent()); }
  /// Tells the clock domain who is woken by whose changes, once all have been bound.
  void declare_links() const {
    for (const Inbox* woken : {source_, regrouper_, shader_cache_, film_}) {
      if (woken == nullptr) continue;
      for (const std::size_t shader : shaders_) {
        woken->domain().declare_link(shader, woken->agent(), kNotice);
      }
      woken->domain().declare_link(source_->agent(), woken->agent(), kNotice);
    }
    if (shader_cache_ != nullptr && regrouper_ != nullptr) {
      shader_cache_->domain().declare_link(regrouper_->agent(), shader_cache_->agent(), kNotice);
    }
  }

  [[nodiscard]] bool by_tile() const { return policy_ == FlowPolicy::kTile; }
  [[nodiscard]] std::uint64_t worst_case(const RayTag& tag) const { return worst_case_.of(tag); }
  [[nodiscard]] bool admits(std::uint64_t reservation) const {
    return policy_ != FlowPolicy::kCredits || counts_.reserved + reservation <= credits_;
  }
  [[nodiscard]] bool admits(std::uint64_t reservation, Cycles now) const {
    return policy_ != FlowPolicy::kCredits || seen(now).reserved + reservation <= credits_;
  }
  void admit(std::uint64_t rays, std::uint64_t reservation, Cycles now) {
    Counts& counts = change(now);
    counts.live += rays;
    counts.reserved += reservation;
    max_live_ = std::max(max_live_, counts.live);
  }

  /// One packet's rays have been shaded: `retired` rays are gone, `spawned` have come.
  void replace(std::uint64_t retired, std::uint64_t spawned, std::uint64_t reserved_before,
               std::uint64_t reserved_after, Cycles now) {
    Counts& counts = change(now);
    counts.live = counts.live + spawned - retired;
    max_live_ = std::max(max_live_, counts.live);
    counts.reserved = counts.reserved + reserved_after - reserved_before;
    if (counts.is_quiet()) {
      nudge(source_, now);
      nudge(regrouper_, now);
      nudge(shader_cache_, now);
    } else if (policy_ == FlowPolicy::kCredits) {
      nudge(source_, now);
    }
    if (counts.is_finished()) nudge(film_, now);
  }

  /// Rays in the cells of the ray cache, which move only when others arrive or a sweep comes.
  void set_waiting(std::uint64_t waiting, Cycles now) {
    if (counts_.waiting == waiting) return;
    Counts& counts = change(now);
    counts.waiting = waiting;
    if (counts.waiting_for_shader != 0 && counts.is_quiet()) nudge(shader_cache_, now);
  }
  /// The same in the cells of the shader cache, which are swept before those of the ray cache.
  void set_waiting_for_shader(std::uint64_t waiting, Cycles now) {
    if (counts_.waiting_for_shader == waiting) return;
    change(now).waiting_for_shader = waiting;
  }
  [[nodiscard]] bool waits_for_shader(Cycles now) const {
    return seen(now).waiting_for_shader != 0;
  }
  /// Nothing moves: every ray in the loop waits in a cell.
  [[nodiscard]] bool is_quiet(Cycles now) const { return seen(now).is_quiet(); }

  enum class Source : std::uint8_t { kIssuing, kTileIssued, kNoCredit, kExhausted };
  void set_source(Source state, Cycles now) {
    if (counts_.source == state) return;
    Counts& counts = change(now);
    counts.source = state;
    if (state != Source::kIssuing && counts.is_quiet()) {
      nudge(regrouper_, now);
      nudge(shader_cache_, now);
      if (counts.is_finished()) nudge(film_, now);
    }
  }
  [[nodiscard]] Source source() const { return counts_.source; }
  [[nodiscard]] Source source(Cycles now) const { return seen(now).source; }
  [[nodiscard]] std::uint64_t live() const { return counts_.live; }
  [[nodiscard]] std::uint64_t live(Cycles now) const { return seen(now).live; }
  /// When what has changed in cycle `now` can be seen, kNever if nothing has. Who goes to sleep in
  /// that cycle must be awake then: it was woken for this cycle already, so that the wake-up for
  /// the next one is lost.
  [[nodiscard]] Cycles next_notice(Cycles now) const {
    return changed_ == now ? now + kNotice : kNever;
  }
  [[nodiscard]] std::uint64_t max_live() const { return max_live_; }
  [[nodiscard]] bool finished() const { return counts_.is_finished(); }
  [[nodiscard]] bool finished(Cycles now) const { return seen(now).is_finished(); }

 private:
  static constexpr Cycles kNotice = 1;  ///< from a change to the wake-up of who waits for it
  struct Counts {
    std::uint64_t live = 0;
    std::uint64_t reserved = 0;
    std::uint64_t waiting = 0;
    std::uint64_t waiting_for_shader = 0;
    Source source = Source::kIssuing;
    [[nodiscard]] bool is_quiet() const { return live == waiting + waiting_for_shader; }
    [[nodiscard]] bool is_finished() const { return live == 0 && source == Source::kExhausted; }
  };
  Counts& change(Cycles now) {
    if (now != changed_) before_ = counts_;
    changed_ = now;
    return counts_;
  }
  [[nodiscard]] const Counts& seen(Cycles now) const { return now > changed_ ? counts_ : before_; }
  static void nudge(Inbox* inbox, Cycles now) {
    if (inbox != nullptr) inbox->nudge(now + kNotice);
  }

  const WorstCase worst_case_;
  const std::uint64_t credits_;
  const FlowPolicy policy_;
  Counts counts_;
  Counts before_;       ///< at the end of the cycle before changed_
  Cycles changed_ = 0;  ///< cycle of the last change
  std::uint64_t max_live_ = 0;
  Inbox* source_ = nullptr;
  Inbox* regrouper_ = nullptr;
  Inbox* shader_cache_ = nullptr;
  Inbox* film_ = nullptr;
  std::vector<std::size_t> shaders_;
};

}  // namespace sheaf
