// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "base/units.h"

namespace sheaf::clocked {

/// Bounded, ordered link between two units: a delay line with credits. What is written in cycle t
/// arrives in t + latency, or `interval` cycles after the message before it, whichever is later. A
/// message holds a credit from its writing until the writer has learned of its reading, one latency
/// after it.
template <typename T>
class Link {
 public:
  static constexpr std::size_t kUnbounded = ~std::size_t{0};
  struct Spec {
    std::size_t capacity = kUnbounded;  ///< credits
    Cycles latency = 1;                 ///< cycles, >= 1
    Cycles interval = 1;                ///< cycles between two arrivals; 0 = any number a cycle
  };
  Link(std::string name, const Spec& spec) : name_(std::move(name)), spec_(spec) {}

  [[nodiscard]] bool has_room(Cycles now) {
    while (!credits_.empty() && credits_.front() <= now) credits_.pop_front();
    return messages_.size() + credits_.size() < spec_.capacity;
  }
  /// False, and nothing happens, if there is no room.
  bool write(const T& value, Cycles now) {
    if (!has_room(now)) return false;
    begin_cycle(now);
    const Cycles earliest = num_written_ == 0 ? 0 : last_arrival_ + spec_.interval;
    last_arrival_ = std::max(now + spec_.latency, earliest);
    messages_.push_back({last_arrival_, value});
    ++num_written_;
    return true;
  }

  [[nodiscard]] bool has_arrived(Cycles now) const { return arrival() <= now; }
  /// Arrival of the oldest message, or kNever.
  [[nodiscard]] Cycles arrival() const {
    return messages_.empty() ? kNever : messages_.front().arrival;
  }
  /// Takes the oldest message; has_arrived() must hold.
  T read(Cycles now) {
    begin_cycle(now);
    const T value = messages_.front().value;
    messages_.pop_front();
    if (spec_.capacity != kUnbounded) credits_.push_back(now + spec_.latency);
    return value;
  }

  /// A message or a credit is on its way.
  [[nodiscard]] bool is_moving(Cycles now) const {
    return (!messages_.empty() && messages_.back().arrival > now) ||
           (!credits_.empty() && credits_.back() > now);
  }
  [[nodiscard]] std::size_t size() const { return messages_.size(); }
  /// Most messages held from one cycle to the next.
  [[nodiscard]] std::size_t max_size() const { return max_size_; }
  [[nodiscard]] std::uint64_t num_written() const { return num_written_; }
  /// Messages held, summed over all cycles.
  [[nodiscard]] Cycles occupancy_cycles() const { return occupancy_cycles_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  struct Message {
    Cycles arrival = 0;
    T value{};
  };
  void begin_cycle(Cycles now) {
    if (now != cycle_) max_size_ = std::max(max_size_, messages_.size());
    occupancy_cycles_ += messages_.size() * (now - cycle_);
    cycle_ = now;
  }

  const std::string name_;
  const Spec spec_;
  std::deque<Message> messages_;
  std::deque<Cycles> credits_;  ///< when the writer learns of reads
  Cycles last_arrival_ = 0;
  Cycles cycle_ = 0;  ///< of the last write or read
  std::size_t max_size_ = 0;
  std::uint64_t num_written_ = 0;
  Cycles occupancy_cycles_ = 0;
};

/// The writer's end of several links of which any will do: they are taken in turn, and one without
/// a credit is passed over.
template <typename T>
class Outputs {
 public:
  void add(Link<T>& link) { links_.push_back(&link); }
  bool write(const T& value, Cycles now) {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const std::size_t candidate = (next_ + i) % links_.size();
      if (!links_[candidate]->write(value, now)) continue;
      next_ = (candidate + 1) % links_.size();
      return true;
    }
    return false;
  }

 private:
  std::vector<Link<T>*> links_;
  std::size_t next_ = 0;
};

/// The reader's end of several links: the earliest arrival comes first, of equal ones the lowest
/// link's.
template <typename T>
class Inputs {
 public:
  void add(Link<T>& link) { links_.push_back(&link); }
  [[nodiscard]] bool has_arrived(Cycles now) const { return first()->has_arrived(now); }
  T read(Cycles now) { return first()->read(now); }

 private:
  [[nodiscard]] Link<T>* first() const {
    return *std::min_element(links_.begin(), links_.end(), [](const Link<T>* a, const Link<T>* b) {
      return a->arrival() < b->arrival();
    });
  }
  std::vector<Link<T>*> links_;
};

}  // namespace sheaf::clocked
