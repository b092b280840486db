// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "report/perfetto_writer.h"

#include <fmt/format.h>

#include <protozero/pbf_writer.hpp>

#include "base/errors.h"

namespace sheaf {
namespace {

// Field numbers and values of google/perfetto's protos.
enum TraceField : protozero::pbf_tag_type { kPacket = 1 };
enum PacketField : protozero::pbf_tag_type {
  kTimestamp = 8,
  kSequence = 10,
  kTrackEvent = 11,
  kSequenceFlags = 13,
  kTrackDescriptor = 60
};
enum DescriptorField : protozero::pbf_tag_type { kUuid = 1, kName = 2, kParent = 5, kCounter = 8 };
enum CounterField : protozero::pbf_tag_type { kUnitName = 6 };
enum EventField : protozero::pbf_tag_type {
  kType = 9,
  kTrackUuid = 11,
  kEventName = 23,
  kCounterValue = 30,
  kFlow = 47,
  kTerminatingFlow = 48
};
enum EventType : std::int32_t { kBegin = 1, kEnd = 2, kInstant = 3, kValue = 4 };
constexpr std::uint32_t kStateCleared = 1;

constexpr std::uint32_t kOneSequence = 1;
constexpr std::size_t kBufferSize = 1U << 16;

}  // namespace

PerfettoWriter::PerfettoWriter(const std::filesystem::path& path)
    : path_(path), file_(path, std::ios::binary) {}

PerfettoWriter::Track PerfettoWriter::add_track(std::string_view name, Track parent) {
  return add_counter(name, parent, {});
}

PerfettoWriter::Track PerfettoWriter::add_counter(std::string_view name, Track parent,
                                                  std::string_view unit) {
  const Track track = ++num_tracks_;
  std::string packet;
  protozero::pbf_writer writer(packet);
  writer.add_uint32(kSequence, kOneSequence);
  if (!begun_) writer.add_uint32(kSequenceFlags, kStateCleared);
  begun_ = true;
  {
    protozero::pbf_writer descriptor(writer, kTrackDescriptor);
    descriptor.add_uint64(kUuid, track);
    descriptor.add_string(kName, name.data(), name.size());
    if (parent != kTop) descriptor.add_uint64(kParent, parent);
    if (!unit.empty()) {
      protozero::pbf_writer counter(descriptor, kCounter);
      counter.add_string(kUnitName, unit.data(), unit.size());
    }
  }
  add_packet(packet);
  return track;
}

void PerfettoWriter::begin(Track track, Cycles at, std::string_view name, std::uint64_t flow,
                           bool last) {
  add_event(track, at, {kBegin, name, flow, last});
}

void PerfettoWriter::end(Track track, Cycles at) {
  add_event(track, at, {kEnd, {}});
}

void PerfettoWriter::instant(Track track, Cycles at, std::string_view name, std::uint64_t flow) {
  add_event(track, at, {kInstant, name, flow});
}

void PerfettoWriter::value(Track track, Cycles at, std::uint64_t value) {
  const auto number = static_cast<std::int64_t>(value);
  add_event(track, at, {kValue, {}}, &number);
}

void PerfettoWriter::add_event(Track track, Cycles at, const Event& event,
                               const std::int64_t* value) {
  event_.clear();
  protozero::pbf_writer details(event_);
  details.add_enum(kType, event.type);
  details.add_uint64(kTrackUuid, track);
  if (!event.name.empty()) details.add_string(kEventName, event.name.data(), event.name.size());
  if (value != nullptr) details.add_int64(kCounterValue, *value);
  if (event.flow != 0) details.add_fixed64(event.last ? kTerminatingFlow : kFlow, event.flow);
  packet_.clear();
  protozero::pbf_writer packet(packet_);
  packet.add_uint64(kTimestamp, at);
  packet.add_uint32(kSequence, kOneSequence);
  packet.add_message(kTrackEvent, event_);
  add_packet(packet_);
  ++num_events_;
}

void PerfettoWriter::add_packet(const std::string& packet) {
  protozero::pbf_writer trace(buffer_);
  trace.add_message(kPacket, packet);
  if (buffer_.size() < kBufferSize) return;
  file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void PerfettoWriter::close() {
  file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  file_.close();
  if (!file_) {
    throw Error(ExitCode::kOutput,
                fmt::format("{}: cannot write the timeline; is the disk full?", path_.string()));
  }
}

}  // namespace sheaf
