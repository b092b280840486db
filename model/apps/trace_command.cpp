// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/trace_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <utility>

#include "apps/exit_codes.h"
#include "apps/shared_options.h"
#include "apps/trace_export.h"
#include "base/errors.h"
#include "report/table.h"
#include "tracefile/columns.h"
#include "tracefile/memory_stream.h"
#include "tracefile/ray_block.h"
#include "tracefile/trace_metadata.h"

namespace sheaf {
namespace {

constexpr std::array<std::pair<const char*, TraceOptions::Format>, 3> kFormats{
    {{"ramulator2", TraceOptions::Format::kRamulator2},
     {"dramsim3", TraceOptions::Format::kDramSim3},
     {"dramsys", TraceOptions::Format::kDramSys}}};
constexpr std::array<std::pair<const char*, TraceOptions::Level>, 2> kLevels{
    {{"dram", TraceOptions::Level::kDram}, {"units", TraceOptions::Level::kUnits}}};

std::string per(std::uint64_t bytes, std::uint64_t things) {
  if (things == 0) return "-";
  return fmt::format("{:.2f}", static_cast<double>(bytes) / static_cast<double>(things));
}

/// Records of a stream, from the index alone.
std::uint64_t records_of(const TraceReader& reader, std::size_t stream) {
  std::uint64_t records = 0;
  for (const TraceFrame& frame : reader.frames()) {
    if (stream_of_key(frame.key) == stream) records += frame.num_records;
  }
  return records;
}

std::string info_of(const TraceReader& reader, const TraceMetadata& metadata) {
  const bool rays = reader.identity().kind == TraceKind::kRays;
  TextTable table({Align::kLeft, Align::kLeft});
  const auto row = [&](const char* name, const std::string& value) {
    table.add_row({name, value});
  };
  row("kind", to_string(reader.identity().kind));
  row("recorded by", fmt::format("Sheaf {}, format {}", metadata.version, kTraceVersion));
  row("scene", metadata.scene_name);
  row("scene hash", to_hex(reader.identity().scene_hash));
  row("configuration hash", to_hex(reader.identity().config_hash));
  row("picture", fmt::format("{} x {}", metadata.width, metadata.height));
  row("complete", metadata.complete ? "yes" : "no: the run was cut short");
  row("cycles", metadata.cycles == 0 ? "not simulated" : grouped(metadata.cycles));
  row("rays", grouped(metadata.num_rays));
  row("bytes", grouped(reader.file_bytes()));
  row("frames", grouped(reader.frames().size()));
  row(rays ? "rays other than shadow" : "records", grouped(reader.num_records()));
  row("bytes per ray", per(reader.file_bytes(), metadata.num_rays));
  row("bytes per record", per(reader.file_bytes(), reader.num_records()));
  std::string text = table.text();
  if (rays) return text;
  TextTable streams({Align::kLeft, Align::kRight, Align::kRight, Align::kLeft});
  streams.add_row({"stream", "records", "contexts", "caches"});
  for (std::size_t i = 0; i < metadata.memory.streams.size(); ++i) {
    const MemoryTraceStream& stream = metadata.memory.streams[i];
    std::string caches;
    for (const MemoryTraceCache& cache : stream.caches) {
      caches += (caches.empty() ? "" : ", ") + cache.name;
    }
    streams.add_row(
        {stream.name, grouped(records_of(reader, i)), fmt::format("{}", stream.contexts), caches});
  }
  return text + "\n" + streams.text();
}

/// Decodes everything. Throws Error(kTrace).
void decode_all(TraceReader& reader, const TraceMetadata& metadata) {
  if (reader.identity().kind == TraceKind::kMemory) {
    for (std::size_t i = 0; i < metadata.memory.streams.size(); ++i) {
      MemoryStream stream(reader, metadata.memory, i);
      while (stream.peek() != nullptr) stream.pop();
    }
    return;
  }
  const BlockGrid grid(metadata.width, metadata.height);
  ByteVector raw;
  RayBlock block;
  for (const TraceFrame& frame : reader.frames()) {
    if (frame.key >= grid.num_blocks()) reader.refuse(frame, "the picture has no such block");
    reader.read(frame, raw);
    block.clear();
    try {
      decode_ray_block(raw, frame.key, frame.num_records, grid, block);
    } catch (const BadColumn& problem) {
      reader.refuse(frame, problem.what());
    }
  }
}

}  // namespace

void declare_trace_command(CLI::App& app, TraceOptions& options) {
  const std::string codes = exit_codes({ExitCode::kTrace});
  CLI::App* trace = app.add_subcommand("trace", "Look into a recorded trace, check or export it");
  trace->require_subcommand(1);
  trace->footer(codes);
  const auto add = [&](const char* name, const char* meaning, TraceOptions::What what) {
    CLI::App* command = trace->add_subcommand(name, meaning);
    declare_trace(*command, options);
    command->callback([&options, what] { options.what = what; });
    command->footer(codes);
    return command;
  };
  add("info", "Tell what a trace holds", TraceOptions::What::kInfo);
  add("verify", "Check every byte of a trace", TraceOptions::What::kVerify);
  CLI::App* to_text = add("export", "Write a memory trace as text for other memory simulators",
                          TraceOptions::What::kExport);
  add_choice(*to_text, "--format", kFormats, options.format,
             "ramulator2 (LD 0x12340, ST 4096: reads in hexadecimal, writes in decimal), dramsim3 "
             "(0x2000D5C0 READ 30) or dramsys (31: read 0x400140)")
      ->default_str(name_of(kFormats, options.format));
  add_choice(*to_text, "--level", kLevels, options.level,
             "dram: what the recorded caches leave for DRAM, whole lines; units: every access of "
             "the units")
      ->default_str(name_of(kLevels, options.level));
  to_text->add_option("--out", options.out, "File to write (default standard output)")
      ->type_name("FILE");
}

int trace_command(const TraceOptions& options) {
  TraceReader reader(options.trace);
  const TraceMetadata metadata = read_metadata(reader);
  if (options.what == TraceOptions::What::kInfo) {
    std::fputs(info_of(reader, metadata).c_str(), stdout);
    return static_cast<int>(ExitCode::kOk);
  }
  reader.verify();
  if (options.what == TraceOptions::What::kExport) {
    reader.require(TraceKind::kMemory, "an export");
    export_trace(options, reader, metadata);
    return static_cast<int>(ExitCode::kOk);
  }
  decode_all(reader, metadata);
  std::fputs(fmt::format("{}: whole and sound: {} frames, {} records, {} bytes\n",
                         options.trace.string(), grouped(reader.frames().size()),
                         grouped(reader.num_records()), grouped(reader.file_bytes()))
                 .c_str(),
             stdout);
  return static_cast<int>(ExitCode::kOk);
}

}  // namespace sheaf
