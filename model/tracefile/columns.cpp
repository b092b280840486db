// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
#include "tracefile/columns.h"

namespace sheaf {

template <typename Fill>
void ColumnWriter::column(const Fill& fill) {
  const std::size_t begin = out_.size();
  put_le(out_, std::uint32_t{0});
  fill();
  const std::size_t length = out_.size() - begin - 4;
  for (std::size_t i = 0; i < 4; ++i) {
    out_[begin + i] = static_cast<std::uint8_t>(length >> (8 * i));
  }
}

void ColumnWriter::bytes(ByteSpan values) {
  column([&] { out_.insert(out_.end(), values.begin(), values.end()); });
}

void ColumnWriter::words(std::span<const std::uint32_t> values) {
  column([&] {
    const std::size_t begin = out_.size();
    out_.resize(begin + 4 * values.size());
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::uint32_t change = values[i] ^ before;
      before = values[i];
      for (std::size_t plane = 0; plane < 4; ++plane) {
        out_[begin + plane * values.size() + i] = static_cast<std::uint8_t>(change >> (8 * plane));
      }
    }
  });
}

void ColumnWriter::longs(std::span<const std::uint64_t> values) {
  column([&] {
    for (const std::uint64_t value : values) put_le(out_, value);
  });
}

ByteSpan ColumnReader::next_column() {
  if (raw_.size() - position_ < 4) throw BadColumn("a column is missing");
  const auto length = get_le<std::uint32_t>(raw_, position_);
  position_ += 4;
  if (raw_.size() - position_ < length) throw BadColumn("a column is longer than the frame");
  position_ += length;
  return raw_.subspan(position_ - length, length);
}

void ColumnReader::bytes(std::size_t count, std::vector<std::uint8_t>& values) {
  const ByteSpan column = next_column();
  if (column.size() != count) throw BadColumn("a column has another length than its records");
  values.assign(column.begin(), column.end());
}

void ColumnReader::varints(std::size_t count, std::vector<std::uint64_t>& values) {
  const ByteSpan column = next_column();
  if (column.size() < count) throw BadColumn("a column is shorter than its records");
  values.resize(count);
  std::size_t at = 0;
  for (std::uint64_t& value : values) {
    value = 0;
    for (unsigned shift = 0;; shift += 7) {
      if (at == column.size()) throw BadColumn("a number is cut off");
      const std::uint8_t byte = column[at++];
      if (shift == 63 && byte > 1) throw BadColumn("a number has more than 64 bits");
      value |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80) break;
    }
  }
  if (at != column.size()) throw BadColumn("a column has more numbers than its records");
}

void ColumnReader::words(std::size_t count, std::vector<std::uint32_t>& values) {
  const ByteSpan column = next_column();
  if (column.size() != 4 * count) throw BadColumn("a column has another length than its records");
  values.resize(count);
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t change = 0;
    for (std::size_t plane = 0; plane < 4; ++plane) {
      change |= std::uint32_t{column[plane * count + i]} << (8 * plane);
    }
    before ^= change;
    values[i] = before;
  }
}

void ColumnReader::longs(std::size_t count, std::vector<std::uint64_t>& values) {
  const ByteSpan column = next_column();
  if (column.size() != 8 * count) throw BadColumn("a column has another length than its records");
  values.resize(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = get_le<std::uint64_t>(column, 8 * i);
}

void ColumnReader::finish() const {
  if (position_ != raw_.size()) throw BadColumn("there is more than its columns");
}

}  // namespace sheaf
