// SPDX-License-Identifier: GPL-3.0-or-later
//
// A GLB says its length and those of its chunks, and most changes break one of them. So the JSON or the bytes
// behind it are changed, and the lengths set right; one change in sixteen is left as it is.
#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "fuzz/harness.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace {

constexpr std::size_t kHeader = 12, kChunkHeader = 8;

std::uint32_t numberAt(const std::uint8_t* at) {
  std::uint32_t number = 0;
  std::memcpy(&number, at, sizeof number);
  return number;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
  std::minstd_rand random(seed);
  const std::size_t jsonBegin = kHeader + kChunkHeader;
  if (size < jsonBegin || numberAt(data + kHeader) > size - jsonBegin || random() % 16 == 0)
    return LLVMFuzzerMutate(data, size, maxSize);
  const std::size_t jsonSize = numberAt(data + kHeader);
  std::vector<std::uint8_t> json(data + jsonBegin, data + jsonBegin + jsonSize);
  std::vector<std::uint8_t> rest(data + jsonBegin + jsonSize, data + size);
  auto& part = random() % 3 != 0 || rest.size() < kChunkHeader ? json : rest;
  const std::size_t before = part.size();
  part.resize(before + 64);
  part.resize(LLVMFuzzerMutate(part.data(), before, part.size()));
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t length = jsonBegin + json.size() + rest.size();
  if (length > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
  const auto set = [](std::uint8_t* at, std::size_t number) {
    const auto narrow = static_cast<std::uint32_t>(number);
    std::memcpy(at, &narrow, sizeof narrow);
  };
  set(data + 8, length);
  set(data + kHeader, json.size());
  if (rest.size() >= kChunkHeader) set(rest.data(), rest.size() - kChunkHeader);
  std::copy(json.begin(), json.end(), data + jsonBegin);
  std::copy(rest.begin(), rest.end(), data + jsonBegin + json.size());
  return length;
}
