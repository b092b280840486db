// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "traversal/ray_packet.h"

namespace sheaf {

/// Packets in flight, reused: grows to the most that were ever out at a time.
class PacketPool {
 public:
  explicit PacketPool(int packet_size) : packet_size_(packet_size) {}

  /// An empty packet of the machine's size.
  [[nodiscard]] RayPacket* acquire() {
    if (free_.empty()) {
      all_.push_back(std::make_unique<RayPacket>());
      free_.push_back(all_.back().get());
    }
    RayPacket* packet = free_.back();
    free_.pop_back();
    packet->clear(packet_size_);
    return packet;
  }
  void release(RayPacket* packet) { free_.push_back(packet); }

  [[nodiscard]] int packet_size() const { return packet_size_; }
  [[nodiscard]] std::size_t num_out() const { return all_.size() - free_.size(); }
  [[nodiscard]] std::size_t num_made() const { return all_.size(); }

 private:
  int packet_size_;
  std::vector<std::unique_ptr<RayPacket>> all_;
  std::vector<RayPacket*> free_;
};

}  // namespace sheaf
