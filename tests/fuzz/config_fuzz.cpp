// SPDX-FileCopyrightText: 2026 The Sheaf authors
// SPDX-License-Identifier: Apache-2.0
// The configuration as a TOML file, and each of its first lines as a --set.
#include <sstream>
#include <vector>

#include "config/config_text.h"
#include "config/read_config.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sheaf::test::read_as_file(data, size, "machine.toml", [](const std::filesystem::path& path) {
    static_cast<void>(sheaf::resolve_config(path, {}));
  });
  std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
  std::vector<std::string> settings(1);
  constexpr int kLines = 2;  // each is a run, and takes its time from new inputs
  for (int i = 0; i < kLines && std::getline(text, settings[0]); ++i) {
    try {
      static_cast<void>(sheaf::resolve_config({}, settings));
    } catch (const sheaf::Error&) {
      continue;
    }
  }
  return 0;
}
