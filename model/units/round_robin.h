// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "channels/timed_channel.h"

namespace sheaf {

/// Writes to the first of several links that has room, beginning behind the one written last.
template <typename T>
class RoundRobin {
 public:
  template <typename Port>
  void bind(Port& port) {
    for (int i = 0; i < port.size(); ++i) links_.push_back(port[i]);
  }
  /// False if all are full; `producer` is then woken when one of them is not.
  bool write(const T& value, Cycles now, Inbox& producer) {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      TimedOut<T>* link = links_[next_];
      next_ = next_ + 1 == links_.size() ? 0 : next_ + 1;
      if (link->nb_write(value, now)) return true;
    }
    for (TimedOut<T>* link : links_) link->notify_when_free(producer);
    return false;
  }

 private:
  std::vector<TimedOut<T>*> links_;
  std::size_t next_ = 0;
};

}  // namespace sheaf
