// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// Right checksums say only that a file is as it was made: what was made wrong is refused all the
// same.

#include <gtest/gtest.h>
#include <zstd.h>

#include <functional>

#include "base/errors.h"
#include "support/scratch_folder.h"
#include "tracefile/trace_reader.h"

namespace sheaf {
namespace {

using Frames = std::vector<TraceFrame>;

struct Forgery {
  std::function<void(Frames&)> headers = [](Frames&) {};  ///< of data and metadata, as stored
  std::function<void(Frames&)> index = [](Frames&) {};
  std::function<void(TraceTrailer&)> trailer = [](TraceTrailer&) {};
};

ByteVector packed(const ByteVector& raw) {
  ByteVector stored(ZSTD_compressBound(raw.size()));
  stored.resize(ZSTD_compress(stored.data(), stored.size(), raw.data(), raw.size(), 1));
  return stored;
}

void append(ByteVector& file, const ByteVector& bytes) {
  file.insert(file.end(), bytes.begin(), bytes.end());
}

/// A trace of two data frames, with checksums over whatever has been done to it.
ByteVector forge(const Forgery& forgery) {
  const ByteVector contents[] = {{1, 2, 3, 4}, {5, 6}, {'{', '}'}};
  ByteVector file = encode_header({TraceKind::kMemory, {}, {}});
  Frames frames;
  std::uint64_t offset = file.size();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto raw_bytes = static_cast<std::uint32_t>(contents[i].size());
    const auto stored_bytes = static_cast<std::uint32_t>(packed(contents[i]).size());
    frames.push_back({offset, i < 2 ? FrameType::kData : FrameType::kMetadata, i, i < 2 ? 10U : 0U,
                      raw_bytes, stored_bytes});
    offset += kFrameHeaderBytes + stored_bytes;
  }
  Frames headers = frames;
  forgery.headers(headers);
  for (std::size_t i = 0; i < 3; ++i) {
    append(file, encode_frame_header(headers[i], packed(contents[i])));
    append(file, packed(contents[i]));
  }
  forgery.index(frames);
  ByteVector index;
  for (const TraceFrame& frame : frames) encode_index_entry(frame, index);
  TraceTrailer trailer{offset, frames.size(), 20, 0};
  const TraceFrame index_frame{offset,
                               FrameType::kIndex,
                               0,
                               static_cast<std::uint32_t>(frames.size()),
                               static_cast<std::uint32_t>(index.size()),
                               static_cast<std::uint32_t>(packed(index).size())};
  append(file, encode_frame_header(index_frame, packed(index)));
  append(file, packed(index));
  trailer.file_bytes = file.size() + kTraceTrailerBytes;
  forgery.trailer(trailer);
  append(file, encode_trailer(trailer));
  return file;
}

/// What refuses the trace when it is opened, or by `use`; empty if nothing does.
std::string refusal_of(const Forgery& forgery, const std::function<void(TraceReader&)>& use) {
  const test::ScratchFolder scratch;
  const ByteVector file = forge(forgery);
  test::write_bytes(scratch / "forged.trace", std::string(file.begin(), file.end()));
  try {
    TraceReader reader(scratch / "forged.trace");
    use(reader);
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kTrace);
    return error.what();
  }
}

void verify(TraceReader& reader) {
  reader.verify();
}

void read_first(TraceReader& reader) {
  ByteVector raw;
  reader.read(reader.frames().front(), raw);
}

void expect_refused(const Forgery& forgery, const std::string& why,
                    const std::function<void(TraceReader&)>& use = verify) {
  const std::string refusal = refusal_of(forgery, use);
  EXPECT_NE(refusal.find(why), std::string::npos) << refusal;
}

TEST(ForgedTrace, IsAcceptedIfNothingIsWrongWithIt) {
  EXPECT_EQ(refusal_of({}, verify), "");
  EXPECT_EQ(refusal_of({}, read_first), "");
}

TEST(ForgedTrace, IsRefusedIfAFrameIsNotWhatTheIndexSays) {
  const char* const why = "the header does not match the index";
  const Forgery other_key{.index = [](Frames& frames) { frames[0].key = 7; }};
  expect_refused(other_key, why);
  expect_refused(other_key, why, read_first);
  const Forgery other_header{.headers = [](Frames& frames) { frames[0].num_records = 11; }};
  expect_refused(other_header, why);
  expect_refused(other_header, why, read_first);
}

TEST(ForgedTrace, IsRefusedIfItsIndexLeavesAFrameOut) {
  expect_refused({.index = [](Frames& frames) { frames.erase(frames.begin()); }},
                 "the entry of frame 0 is wrong");
  expect_refused({.index = [](Frames& frames) { frames.erase(frames.begin() + 1); }},
                 "the entry of frame 1 is wrong");
  expect_refused({.index = [](Frames& frames) { frames.clear(); }}, "do not fill the file");
}

TEST(ForgedTrace, IsRefusedIfItsIndexListsAFrameTwice) {
  expect_refused({.index = [](Frames& frames) { frames[1] = frames[0]; }},
                 "the entry of frame 1 is wrong");
}

TEST(ForgedTrace, IsRefusedIfItHasAnotherNumberOfRecords) {
  expect_refused({.trailer = [](TraceTrailer& trailer) { ++trailer.num_records; }},
                 "do not fill the file");
}

TEST(ForgedTrace, IsRefusedIfItSaysThatItHasAnotherLength) {
  expect_refused({.trailer = [](TraceTrailer& trailer) { ++trailer.file_bytes; }}, "bytes long");
}

TEST(ForgedTrace, IsRefusedIfAContentHasAnotherSize) {
  const auto larger = [](Frames& frames) { ++frames[0].raw_bytes; };
  expect_refused({.headers = larger, .index = larger}, "shorter than it should be", read_first);
  const auto smaller = [](Frames& frames) { --frames[0].raw_bytes; };
  expect_refused({.headers = smaller, .index = smaller}, "byte 64", read_first);
}

}  // namespace
}  // namespace sheaf
