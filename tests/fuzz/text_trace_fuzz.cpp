// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// Memory traces in text.
#include "fuzz_input.h"
#include "memory/dram/text_trace.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sheaf::test::read_as_file(data, size, "trace.txt", [](const std::filesystem::path& path) {
    sheaf::TextTrace trace(path);
    sheaf::TraceAccess access;
    while (trace.next(access)) continue;
  });
  return 0;
}
