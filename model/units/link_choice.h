// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "channels/timed_channel.h"

namespace sheaf {

enum class Sent : std::uint8_t { kYes, kNo, kUnknown };

/// Writes to the first of several links that has room, beginning behind the one written last.
template <typename T>
class RoundRobin {
 public:
  template <typename Port>
  void bind(Port& port, const Inbox& producer) {
    for (int i = 0; i < port.size(); ++i) {
      port[i]->add_producer(producer);
      links_.push_back(port[i]);
    }
  }
  /// kNo: all links are full; `producer` is then woken when one of them is not. kUnknown: one seems
  /// full, and it is not `certain` that it is; nothing has happened.
  Sent write(const T& value, Cycles now, bool certain, Inbox& producer) {
    std::size_t candidate = next_;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      TimedOut<T>* link = links_[candidate];
      candidate = candidate + 1 == links_.size() ? 0 : candidate + 1;
      if (link->nb_write(value, now)) {
        next_ = candidate;
        return Sent::kYes;
      }
      if (!certain) return Sent::kUnknown;
    }
    for (TimedOut<T>* link : links_) link->notify_when_free(producer);
    return Sent::kNo;
  }

 private:
  std::vector<TimedOut<T>*> links_;
  std::size_t next_ = 0;
};

/// Reads from several links in order of arrival; of the same cycle, the lowest link first.
template <typename T>
class MergedInput {
 public:
  template <typename Port>
  void bind(Port& port, Inbox& consumer) {
    for (int i = 0; i < port.size(); ++i) {
      port[i]->set_consumer(consumer);
      links_.push_back({port[i], &port[i]->next_arrival()});
    }
  }
  /// The agents at the other ends.
  [[nodiscard]] std::vector<std::size_t> producers() const {
    std::vector<std::size_t> all;
    for (const Link& link : links_) {
      all.insert(all.end(), link.in->producers().begin(), link.in->producers().end());
    }
    return all;
  }
  [[nodiscard]] Cycles next_arrival() const {
    Cycles next = kNever;
    for (const Link& link : links_) next = *link.next < next ? *link.next : next;
    return next;
  }
  /// False if nothing has arrived by `now`.
  bool read(T& value, Cycles now) {
    const Link* first = nullptr;
    for (const Link& link : links_) {
      if (*link.next <= now && (first == nullptr || *link.next < *first->next)) first = &link;
    }
    if (first == nullptr) return false;
    value = first->in->read(now);
    return true;
  }

 private:
  struct Link {
    TimedIn<T>* in;
    const Cycles* next;
  };
  std::vector<Link> links_;
};

}  // namespace sheaf
