// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/memory/memory_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "engine/memory/required_memory.h"
#include "io/files/text/byte_size.h"
#include "io/files/text/grouped.h"
#include "io/geo/gdal/block_cache.h"

namespace arete {
namespace {

constexpr const char* kMemoryOption = "--memory";

/// Less holds no model, and is mostly a number whose unit was forgotten.
constexpr std::uint64_t kLeastMemory = 1'000'000;

}  // namespace

void addMemoryTo(CLI::App& command) {
  command
      .add_option_function<std::string>(
          kMemoryOption, [](const std::string& text) { setMemoryBudget(parseByteSize(text).value_or(0)); },
          "Refuse work that takes more memory than this (500MB, 2G), beside the program itself, about 60 MB; "
          "a\n"
          "model in pages is read in batches within it")
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            const auto bytes = parseByteSize(text);
            if (bytes && *bytes >= kLeastMemory) return {};
            return fmt::format("'{}' is not a number of bytes of at least 1MB, as 500MB or 2G", text);
          },
          ""))
      ->type_name("BYTES")
      ->group("Output");
}

void boundLibraries() {
  constexpr std::uint64_t kMostCache = std::uint64_t{64} << 20;
  if (memoryBudget() > 0) boundGdalCache(std::min(memoryBudget() / 8, kMostCache));
}

void nameBudget(Error& error) {
  if (error.code != ErrorCode::outOfMemory || memoryBudget() == 0) return;
  if (error.message.find("`memory`") == error.message.npos)
    error.message += fmt::format(": `memory` allows {}", byteCount(memoryBudget()));
}

}  // namespace arete
