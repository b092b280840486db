// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0

// A trace is read back as it was written, and anything else is refused: every single byte matters.

#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/scratch_folder.h"
#include "tracefile/trace_reader.h"
#include "tracefile/trace_writer.h"

namespace sheaf {
namespace {

using test::read_bytes;
using test::ScratchFolder;
using test::write_bytes;

const TraceIdentity kIdentity{TraceKind::kMemory, {1, 2, 3}, {4, 5, 6}};
const ByteVector kFirst(1000, 7);
const ByteVector kSecond{1, 2, 3, 4, 5};

class Container : public testing::Test {
 protected:
  void SetUp() override {
    TraceWriter writer(path_, kIdentity);
    writer.add(0, 3, [] { return kFirst; });
    writer.add(3, 2, [] { return kSecond; });
    writer.finish("{\"a\": 1}");
    bytes_ = read_bytes(path_);
  }
  /// What opening and checking the trace says; empty if it is accepted.
  [[nodiscard]] std::string refusal() const {
    try {
      TraceReader reader(path_);
      reader.verify();
      return {};
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kTrace);
      return error.what();
    }
  }
  [[nodiscard]] std::string refusal_of(const std::string& bytes) const {
    write_bytes(path_, bytes);
    return refusal();
  }
  const ScratchFolder scratch_;
  const std::filesystem::path path_ = scratch_ / "some.trace";
  std::string bytes_;
};

TEST_F(Container, GivesBackWhatWasWritten) {
  TraceReader reader(path_);
  EXPECT_NO_THROW(reader.verify());
  EXPECT_EQ(reader.identity().kind, TraceKind::kMemory);
  EXPECT_EQ(reader.identity().scene_hash, kIdentity.scene_hash);
  EXPECT_EQ(reader.identity().config_hash, kIdentity.config_hash);
  EXPECT_EQ(reader.metadata(), "{\"a\": 1}");
  EXPECT_EQ(reader.num_records(), 5U);
  EXPECT_EQ(reader.file_bytes(), bytes_.size());
  ASSERT_EQ(reader.frames().size(), 2U);
  EXPECT_EQ(reader.frames()[1].key, 3U);
  ByteVector raw;
  reader.read(reader.frames()[1], raw);  // frames in any order
  EXPECT_EQ(raw, kSecond);
  reader.read(reader.frames()[0], raw);
  EXPECT_EQ(raw, kFirst);
}

TEST_F(Container, IsLittleEndian) {
  EXPECT_EQ(bytes_.substr(0, 16), std::string("\x89SHEAF\r\n\x01\0\0\0\x02\0\0\0", 16));
  EXPECT_EQ(bytes_.substr(64, 4), "FRAM");
}

TEST_F(Container, RefusesEverySingleFlippedBit) {
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = bytes_;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      const std::string why = refusal_of(damaged);
      ASSERT_FALSE(why.empty()) << "byte " << at << ", bit " << bit;
      ASSERT_EQ(why.find('\n'), std::string::npos) << why;
      ASSERT_NE(why.find(path_.string()), std::string::npos) << why;
    }
  }
}

TEST_F(Container, RefusesEveryTruncation) {
  for (std::size_t size = 0; size < bytes_.size(); ++size) {
    ASSERT_NE(refusal_of(bytes_.substr(0, size)), "") << size;
  }
}

TEST_F(Container, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(refusal_of(bytes_ + '\0').find("trailer"), std::string::npos);
  EXPECT_NE(refusal_of(bytes_.substr(0, bytes_.size() - 1)).find("truncated"), std::string::npos);
  EXPECT_NE(refusal_of("glTF and so on").find("is no trace of Sheaf"), std::string::npos);
  EXPECT_NE(refusal_of("").find("is no trace of Sheaf"), std::string::npos);
  std::string newer = bytes_;
  newer[8] = 2;
  EXPECT_NE(refusal_of(newer).find("version 2, this Sheaf reads version 1"), std::string::npos);
  std::string damaged = bytes_;
  damaged[64 + 48] = static_cast<char>(damaged[64 + 48] ^ 1);
  EXPECT_NE(refusal_of(damaged).find("byte 64: in the frame that begins here, the content does not "
                                     "match its checksum"),
            std::string::npos);
}

TEST_F(Container, RefusesFramesThatChangedPlaces) {
  const ScratchFolder other;
  {
    TraceWriter writer(other / "two.trace", kIdentity);
    writer.add(0, 1, [] { return kSecond; });
    writer.add(0, 1, [] { return ByteVector{5, 4, 3, 2, 1}; });
    writer.finish("{}");
  }
  std::string bytes = read_bytes(other / "two.trace");
  ASSERT_NO_THROW(TraceReader(other / "two.trace").verify());
  const std::size_t frame = 48 + TraceReader(other / "two.trace").frames()[0].stored_bytes;
  const std::string swapped = bytes.substr(0, 64) + bytes.substr(64 + frame, frame) +
                              bytes.substr(64, frame) + bytes.substr(64 + 2 * frame);
  EXPECT_NE(refusal_of(swapped), "");
}

TEST_F(Container, RefusesWhatIsNoFile) {
  EXPECT_THROW(TraceReader(scratch_ / "nothing"), Error);
  EXPECT_THROW(TraceReader(scratch_.path()), Error);
}

TEST_F(Container, OfTheOtherKindNamesTheRemedy) {
  const TraceReader reader(path_);
  EXPECT_NO_THROW(reader.require(TraceKind::kMemory, "a curve"));
  try {
    reader.require(TraceKind::kRays, "this replay");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("record it with --record rays"), std::string::npos);
  }
}

TEST_F(Container, HasItsNameOnlyOnceItIsWhole) {
  const std::filesystem::path path = scratch_ / "new.trace";
  {
    TraceWriter writer(path, kIdentity);
    writer.add(0, 1, [] { return kSecond; });
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_TRUE(std::filesystem::exists(path_));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch_.path()), {}), 1)
      << "a trace that was not finished left something behind";
}

}  // namespace
}  // namespace sheaf
