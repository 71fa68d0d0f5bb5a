// SPDX-License-Identifier: GPL-3.0-or-later
//
// Most changes of an .amt file break a checksum and get no further than that. So files are taken apart, one
// part is changed, and they are put together again as a writer would: chunks in their places, sizes and
// checksums right, those of packed nodes too. One change in sixteen is left as it is.
#include <algorithm>
#include <cstring>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "fuzz/harness.h"
#include "io/format/checksum.h"
#include "io/format/layout.h"
#include "io/packed/layout.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace {

using namespace arete;
using Bytes = std::vector<std::uint8_t>;

struct Part {
  AmtChunk entry;
  Bytes bytes;
};

struct AmtParts {
  AmtHeader header;
  std::vector<Part> parts;
};

std::optional<AmtParts> takeApart(std::span<const std::uint8_t> file) {
  AmtParts amt;
  if (file.size() < sizeof(AmtHeader)) return std::nullopt;
  std::memcpy(&amt.header, file.data(), sizeof(AmtHeader));
  const std::size_t count = amt.header.chunkCount;
  if (count == 0 || count > kAmtMaxChunks || file.size() < sizeof(AmtHeader) + count * sizeof(AmtChunk))
    return std::nullopt;
  for (std::size_t i = 0; i < count; ++i) {
    AmtChunk entry;
    std::memcpy(&entry, file.data() + sizeof(AmtHeader) + i * sizeof entry, sizeof entry);
    if (entry.offset > file.size() || entry.bytes > file.size() - entry.offset) return std::nullopt;
    const auto bytes = file.subspan(entry.offset, entry.bytes);
    amt.parts.push_back({entry, Bytes(bytes.begin(), bytes.end())});
  }
  return amt;
}

/// The checksums that a directory of packed nodes keeps of them, where it still makes sense.
void sealPackedNodes(AmtParts& amt) {
  const auto find = [&](AmtTag tag) {
    return std::find_if(amt.parts.begin(), amt.parts.end(),
                        [&](const Part& p) { return p.entry.tag == tag; });
  };
  const auto directory = find(amt_tag::kPackedDirectory), nodes = find(amt_tag::kPackedNodes);
  if (directory == amt.parts.end() || nodes == amt.parts.end()) return;
  std::string problem;
  auto read = packed::directoryOf(std::as_bytes(std::span(directory->bytes)), problem);
  if (!read) return;
  for (packed::Packet& packet : read->packets)
    if (packet.offset <= nodes->bytes.size() && packet.bytes() <= nodes->bytes.size() - packet.offset)
      packet.checksum =
          amtChecksum(std::as_bytes(std::span(nodes->bytes)).subspan(packet.offset, packet.bytes()));
  const std::vector<std::byte> sealed = packed::toBytes(*read);
  directory->bytes.resize(sealed.size());
  std::memcpy(directory->bytes.data(), sealed.data(), sealed.size());
}

/// The file of these parts, with every size, place and checksum right.
Bytes putTogether(AmtParts& amt) {
  amt.header.chunkCount = static_cast<std::uint32_t>(amt.parts.size());
  amt.header.directoryBytes = amt.parts.size() * sizeof(AmtChunk);
  std::uint64_t end = sizeof(AmtHeader) + amt.header.directoryBytes;
  for (Part& part : amt.parts) {
    part.entry.offset = amtAligned(end);
    part.entry.bytes = part.bytes.size();
    part.entry.checksum = XXH3_64bits(part.bytes.data(), part.bytes.size());
    end = part.entry.offset + part.entry.bytes;
  }
  amt.header.fileBytes = amtAligned(end);
  Bytes file(amt.header.fileBytes);
  Bytes front(offsetof(AmtHeader, checksum));
  std::memcpy(front.data(), &amt.header, front.size());
  for (std::size_t i = 0; i < amt.parts.size(); ++i) {
    const Part& part = amt.parts[i];
    const auto* entry = reinterpret_cast<const std::uint8_t*>(&part.entry);
    std::copy_n(entry, sizeof part.entry, file.begin() + sizeof(AmtHeader) + i * sizeof part.entry);
    front.insert(front.end(), entry, entry + sizeof part.entry);
    std::copy(part.bytes.begin(), part.bytes.end(),
              file.begin() + static_cast<std::ptrdiff_t>(part.entry.offset));
  }
  amt.header.checksum = XXH3_64bits(front.data(), front.size());
  std::memcpy(file.data(), &amt.header, sizeof amt.header);
  return file;
}

/// Changes some bytes in place, as the fuzzer likes.
void mutateInPlace(std::uint8_t* begin, std::size_t size) {
  Bytes window(begin, begin + size);
  const std::size_t got = LLVMFuzzerMutate(window.data(), size, size);
  std::copy_n(window.begin(), std::min(got, size), begin);
}

/// One element, or what one of its neighbours has: an index that is in range, but not here.
void mutateElement(Part& part, std::minstd_rand& random) {
  const std::size_t size = part.entry.elementBytes;
  const std::size_t count = size == 0 ? 0 : part.bytes.size() / size;
  if (count == 0) return;
  std::uint8_t* const element = part.bytes.data() + random() % count * size;
  if (random() % 3 == 0)
    std::copy_n(part.bytes.data() + random() % count * size, size, element);
  else
    mutateInPlace(element, size);
}

void mutateParts(AmtParts& amt, std::minstd_rand& random) {
  Part& part = amt.parts[random() % amt.parts.size()];
  switch (random() % 16) {
    case 0:  // the header beside what putting together sets
      mutateInPlace(reinterpret_cast<std::uint8_t*>(&amt.header), sizeof amt.header);
      break;
    case 1:
      mutateInPlace(reinterpret_cast<std::uint8_t*>(&part.entry), sizeof part.entry);
      break;
    case 2:  // longer or shorter
    case 3: {
      const std::size_t size = part.bytes.size();
      part.bytes.resize(size + 64);
      part.bytes.resize(LLVMFuzzerMutate(part.bytes.data(), size, part.bytes.size()));
      break;
    }
    case 4:
    case 5:
    case 6: {  // the metadata, a text
      Bytes& text = amt.parts.front().bytes;
      const std::size_t size = text.size();
      text.resize(size + 64);
      text.resize(LLVMFuzzerMutate(text.data(), size, text.size()));
      break;
    }
    default:
      for (std::size_t changes = 1 + random() % 3; changes-- > 0;)
        mutateElement(amt.parts[random() % amt.parts.size()], random);
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
  std::minstd_rand random(seed);
  auto amt = takeApart({data, size});
  if (!amt || random() % 16 == 0) return LLVMFuzzerMutate(data, size, maxSize);
  mutateParts(*amt, random);
  sealPackedNodes(*amt);
  const Bytes file = putTogether(*amt);
  if (file.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
  std::copy(file.begin(), file.end(), data);
  return file.size();
}
