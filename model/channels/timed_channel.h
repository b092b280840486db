// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <systemc>
#include <vector>

#include "base/units.h"
#include "channels/clock_domain.h"

namespace sheaf {

template <typename T>
class TimedChannel;

/// Producer's side of a timed channel. The names follow sc_fifo's; every call gives the caller's
/// local cycle, since units run ahead of the kernel. Ports are bound as SystemC has it; calls go
/// straight to the one kind of channel there is, since they are made for every line and packet.
template <typename T>
class TimedOut : public virtual sc_core::sc_interface {
 public:
  /// Slots that a producer can fill at `now`: it learns of a read one latency later.
  [[nodiscard]] std::size_t num_free(Cycles now) { return channel().num_free(now); }
  /// False, and nothing happens, if no slot is free.
  bool nb_write(const T& value, Cycles now) { return channel().nb_write(value, now); }
  /// A write at `ready`, which may be earlier or later than that of what has been written already;
  /// of writes of the same cycle the lower rank comes first. The channel must have room.
  void write_ahead(const T& value, Cycles ready, std::uint32_t rank = 0) {
    channel().write_ahead(value, ready, rank);
  }
  /// Wakes `producer` once a slot becomes free after a refused write.
  void notify_when_free(Inbox& producer) { channel().notify_when_free(producer); }
  /// Makes known who writes. A producer that stays unknown costs speed, see LinkMap::reach.
  void add_producer(const Inbox& producer) { channel().add_producer(producer); }

 private:
  friend class TimedChannel<T>;
  TimedOut() = default;
  [[nodiscard]] TimedChannel<T>& channel() { return static_cast<TimedChannel<T>&>(*this); }
};

/// Consumer's side of a timed channel.
template <typename T>
class TimedIn : public virtual sc_core::sc_interface {
 public:
  /// Arrival of the oldest value, or kNever. The reference stays valid, so that a consumer can look
  /// without a call.
  [[nodiscard]] const Cycles& next_arrival() const { return next_arrival_; }
  /// True if the oldest value has arrived by `now`.
  [[nodiscard]] bool has_arrived(Cycles now) const { return next_arrival_ <= now; }
  /// Takes the oldest value; has_arrived() must hold.
  T read(Cycles now) { return static_cast<TimedChannel<T>&>(*this).read(now); }
  /// The inbox that is told of every arrival.
  void set_consumer(Inbox& consumer) {
    static_cast<TimedChannel<T>&>(*this).set_consumer(consumer);
  }
  /// The agents that are known to write.
  [[nodiscard]] const std::vector<std::size_t>& producers() const { return producers_; }

 private:
  friend class TimedChannel<T>;
  TimedIn() = default;
  Inbox* consumer_ = nullptr;
  std::vector<std::size_t> producers_;
  Cycles next_arrival_ = kNever;  ///< of the oldest value
};

/// Bounded, ordered link between units: a value written at cycle t arrives at t + latency, or
/// `interval` cycles after the one before it, whichever is later. Its slot is occupied from the
/// write until the producer has learned of the read, one latency after it; a full channel holds its
/// producers up.
template <typename T>
class TimedChannel final : public sc_core::sc_object, public TimedOut<T>, public TimedIn<T> {
 public:
  /// For a link that another rule keeps from filling up; it counts no credits.
  static constexpr std::size_t kUnbounded = ~std::size_t{0};

  struct Spec {
    std::size_t capacity = 1;  ///< values, >= 1
    Cycles latency = 1;        ///< cycles, >= 1
    Cycles interval = 1;       ///< cycles between two arrivals; 0 = any number a cycle
  };

  TimedChannel(const char* name, const Spec& spec) : sc_object(name), spec_(spec) {
    std::size_t slots = 1;
    while (slots < (spec.capacity < kFirstSlots ? spec.capacity : kFirstSlots)) slots *= 2;
    ring_.resize(slots);
  }

  [[nodiscard]] std::size_t num_free(Cycles now) {
    drop_returned(now);
    return spec_.capacity - size_ - num_returning_;
  }

  bool nb_write(const T& value, Cycles now) {
    if (num_free(now) == 0) return false;
    write_ahead(value, now);
    return true;
  }

  void write_ahead(const T& value, Cycles ready, std::uint32_t rank = 0) {
    if (size_ == ring_.size()) grow();
    const Entry entry{ready, rank, value};
    std::size_t position = size_++;
    for (; position > 0 && entry.precedes(at(position - 1)); --position) {
      at(position) = at(position - 1);
    }
    at(position) = entry;
    ++num_written_;
    if (!recent_reads_.empty() && ready < recent_reads_.back().time) count_late(ready);
    if (position == 0) {
      update_head();
      this->consumer_->expect(this->next_arrival_);
    }
  }

  void notify_when_free(Inbox& producer) {
    if (num_returning_ != 0) {  // the read has happened already, its credit is on the way
      producer.nudge(returning_[first_returning_]);
      return;
    }
    for (const Inbox* waiting : waiting_) {
      if (waiting == &producer) return;
    }
    waiting_.push_back(&producer);
  }

  T read(Cycles now) {
    if (spec_.capacity != kUnbounded || size_ > max_size_) note_occupancy(now);
    const T value = ring_[head_].value;
    occupancy_cycles_ += now - ring_[head_].ready;
    last_arrival_ = this->next_arrival_;
    head_ = (head_ + 1) & (ring_.size() - 1);
    --size_;
    update_head();
    if (spec_.capacity != kUnbounded) return_credit(now + spec_.latency);
    return value;
  }

  void add_producer(const Inbox& producer) {
    this->producers_.push_back(producer.agent());
    if (this->consumer_ != nullptr) declare_links(producer.agent());
  }
  void set_consumer(Inbox& consumer) {
    this->consumer_ = &consumer;
    for (const std::size_t producer : this->producers_) declare_links(producer);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Of these, the ones written by `now`.
  [[nodiscard]] std::size_t num_held(Cycles now) const {
    std::size_t held = size_;
    while (held != 0 && at(held - 1).ready > now) --held;
    return held;
  }
  /// The i-th value from the back, 0 the newest; there must be that many.
  [[nodiscard]] const T& from_back(std::size_t i) const { return at(size_ - 1 - i).value; }
  /// Most values held at the beginning of a cycle in which one was read, which is the most ever
  /// held, since their number only grows between two reads.
  [[nodiscard]] std::size_t max_size() const { return max_size_; }
  [[nodiscard]] std::uint64_t num_written() const { return num_written_; }
  /// Values held, summed over all cycles: as well the time from writing to reading, summed over
  /// values.
  [[nodiscard]] Cycles occupancy_cycles() const { return occupancy_cycles_; }
  [[nodiscard]] const Spec& spec() const { return spec_; }

 private:
  struct Entry {
    Cycles ready = 0;  ///< time of the write
    std::uint32_t rank = 0;
    T value{};
    [[nodiscard]] bool precedes(const Entry& other) const {
      return ready != other.ready ? ready < other.ready : rank < other.rank;
    }
  };
  struct Read {
    Cycles time = 0;
    std::size_t held = 0;  ///< values held when it happened
  };
  static constexpr std::size_t kFirstSlots = 16;
  // Values go one way, credits the other.
  void declare_links(std::size_t producer) {
    ClockDomain& domain = this->consumer_->domain();
    domain.declare_link(producer, this->consumer_->agent(), spec_.latency);
    if (spec_.capacity == kUnbounded) return;
    domain.declare_link(this->consumer_->agent(), producer, spec_.latency);
  }
  void drop_returned(Cycles now) {
    while (num_returning_ != 0 && returning_[first_returning_] <= now) {
      first_returning_ = (first_returning_ + 1) & (returning_.size() - 1);
      --num_returning_;
    }
  }
  void return_credit(Cycles arrival) {
    if (num_returning_ == returning_.size()) {
      std::vector<Cycles> larger(returning_.empty() ? kFirstSlots : returning_.size() * 2);
      for (std::size_t i = 0; i < num_returning_; ++i) {
        larger[i] = returning_[(first_returning_ + i) & (returning_.size() - 1)];
      }
      returning_.swap(larger);
      first_returning_ = 0;
    }
    returning_[(first_returning_ + num_returning_++) & (returning_.size() - 1)] = arrival;
    if (waiting_.empty()) return;
    for (Inbox* producer : waiting_) producer->nudge(arrival);
    waiting_.clear();
  }

  [[nodiscard]] Entry& at(std::size_t position) {
    return ring_[(head_ + position) & (ring_.size() - 1)];
  }
  [[nodiscard]] const Entry& at(std::size_t position) const {
    return ring_[(head_ + position) & (ring_.size() - 1)];
  }
  // Values that a producer ahead in time has written do not count yet; those that one behind in
  // time writes later are counted then.
  void note_occupancy(Cycles now) {
    std::size_t held = size_;
    while (held != 0 && at(held - 1).ready >= now) --held;
    max_size_ = std::max(max_size_, held);
    // What is still unwritten cannot arrive before now, so it is not written earlier than this.
    const auto settled = [&](const Read& read) { return read.time + spec_.latency <= now; };
    std::erase_if(recent_reads_, settled);
    recent_reads_.push_back({now, held});
  }
  void count_late(Cycles ready) {
    for (Read& read : recent_reads_) {
      if (ready < read.time) max_size_ = std::max(max_size_, ++read.held);
    }
  }
  void update_head() {
    this->next_arrival_ = kNever;
    if (size_ == 0) return;
    this->next_arrival_ = ring_[head_].ready + spec_.latency;
    if (last_arrival_ != kNever && this->next_arrival_ < last_arrival_ + spec_.interval) {
      this->next_arrival_ = last_arrival_ + spec_.interval;
    }
  }

  void grow() {
    std::vector<Entry> larger(ring_.size() * 2);
    for (std::size_t i = 0; i < size_; ++i) larger[i] = at(i);
    ring_.swap(larger);
    head_ = 0;
  }

  const Spec spec_;
  std::vector<Inbox*> waiting_;
  std::vector<Entry> ring_;  ///< size is a power of two
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  std::size_t max_size_ = 0;
  std::vector<Read> recent_reads_;
  std::vector<Cycles> returning_;  ///< ring: when the producer learns of reads
  std::size_t first_returning_ = 0;
  std::size_t num_returning_ = 0;
  Cycles last_arrival_ = kNever;  ///< of the value read last
  std::uint64_t num_written_ = 0;
  Cycles occupancy_cycles_ = 0;
};

}  // namespace sheaf
