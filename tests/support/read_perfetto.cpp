// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "support/read_perfetto.h"

#include <fstream>
#include <iterator>
#include <protozero/pbf_reader.hpp>
#include <stdexcept>

namespace sheaf::test {
namespace {

// Field numbers of protos/perfetto/trace in google/perfetto.

void read_descriptor(protozero::pbf_reader reader, PerfettoTrace& trace) {
  std::uint64_t uuid = 0;
  PerfettoTrack track;
  while (reader.next()) {
    switch (reader.tag()) {
      case 1:
        uuid = reader.get_uint64();
        break;
      case 2:
        track.name = reader.get_string();
        break;
      case 5:
        track.parent = trace.tracks.at(reader.get_uint64()).name;
        break;
      case 8:
        track.counter = true;
        reader.skip();
        break;
      default:
        throw std::runtime_error("TrackDescriptor: unexpected field");
    }
  }
  if (!trace.tracks.emplace(uuid, track).second) throw std::runtime_error("track described twice");
}

PerfettoEvent read_event(protozero::pbf_reader reader) {
  PerfettoEvent event;
  while (reader.next()) {
    switch (reader.tag()) {
      case 9:
        event.type = static_cast<PerfettoEvent::Type>(reader.get_enum());
        break;
      case 11:
        event.track = reader.get_uint64();
        break;
      case 23:
        event.name = reader.get_string();
        break;
      case 30:
        event.value = reader.get_int64();
        break;
      case 47:
        event.flow = reader.get_fixed64();
        break;
      case 48:
        event.flow = reader.get_fixed64();
        event.ends_flow = true;
        break;
      default:
        throw std::runtime_error("TrackEvent: unexpected field");
    }
  }
  return event;
}

void read_packet(protozero::pbf_reader reader, PerfettoTrace& trace) {
  std::uint64_t at = 0;
  std::uint32_t sequence = 0;
  while (reader.next()) {
    switch (reader.tag()) {
      case 8:
        at = reader.get_uint64();
        break;
      case 10:
        sequence = reader.get_uint32();
        break;
      case 11:
        trace.events.push_back(read_event(reader.get_message()));
        trace.events.back().at = at;
        static_cast<void>(trace.tracks.at(trace.events.back().track));
        break;
      case 13:
        reader.skip();
        break;
      case 60:
        read_descriptor(reader.get_message(), trace);
        break;
      default:
        throw std::runtime_error("TracePacket: unexpected field");
    }
  }
  if (sequence == 0) throw std::runtime_error("TracePacket: no sequence");
}

}  // namespace

std::string PerfettoTrace::path(const PerfettoEvent& event) const {
  const PerfettoTrack& track = tracks.at(event.track);
  return track.parent.empty() ? track.name : track.parent + '/' + track.name;
}

PerfettoTrace read_perfetto(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  PerfettoTrace trace;
  protozero::pbf_reader reader(bytes);
  while (reader.next(1)) read_packet(reader.get_message(), trace);
  return trace;
}

}  // namespace sheaf::test
