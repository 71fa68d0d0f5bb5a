// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/amt_parts.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "io/store/format/checksum.h"
#include "io/store/packed/nodes/layout.h"
#include "io/store/packed/pages/directory_blocks.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace arete::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

AmtPart* find(AmtParts& amt, AmtTag tag) {
  const auto found = std::ranges::find_if(amt.parts, [&](const AmtPart& p) { return p.entry.tag == tag; });
  return found == amt.parts.end() ? nullptr : &*found;
}

/// The checksums that a directory of packed nodes keeps of them, where it still makes sense.
void sealPackedNodes(AmtParts& amt) {
  AmtPart *const directory = find(amt, amt_tag::kPackedDirectory), *const nodes =
                                                                       find(amt, amt_tag::kPackedNodes);
  if (!directory || !nodes) return;
  std::string problem;
  auto read = packed::directoryOf(std::as_bytes(std::span(directory->bytes)), problem,
                                  find(amt, amt_tag::kPackedNumbers) != nullptr);
  if (!read) return;
  for (packed::Packet& packet : read->packets) {
    packed::Segment& all = packet.segments[0];
    if (all.begin() <= nodes->bytes.size() && all.bytes() <= nodes->bytes.size() - all.begin())
      all.checksum = amtChecksum(std::as_bytes(std::span(nodes->bytes)).subspan(all.begin(), all.bytes()));
  }
  const std::vector<std::byte> sealed = packed::toBytes(*read);
  directory->bytes.resize(sealed.size());
  std::memcpy(directory->bytes.data(), sealed.data(), sealed.size());
}

/// Replaces a checksum that some bytes hold.
void replaceSum(std::span<std::uint8_t> in, std::uint64_t old, std::uint64_t sum) {
  const auto *const from = reinterpret_cast<const std::uint8_t*>(&old),
             *const to = reinterpret_cast<const std::uint8_t*>(&sum);
  const auto found = std::ranges::search(in, std::span(from, sizeof old)).begin();
  if (found != in.end()) std::copy_n(to, sizeof sum, found);
}

/// Those that the directory of pages keeps of segments and of its own blocks: of one level of blocks.
void sealPages(AmtParts& amt) {
  AmtPart *const directory = find(amt, amt_tag::kPageRoot), *const blocks = find(amt, amt_tag::kPageBlocks),
                 *const nodes = find(amt, amt_tag::kPackedNodes);
  if (!directory || !blocks || !nodes) return;
  std::string problem;
  const auto root = packed::pageRootOf(std::as_bytes(std::span(directory->bytes)), problem);
  if (!root || root->levels != 1) return;
  std::uint32_t first = 0;
  for (const packed::BlockEntry& entry : root->entries) {
    if (entry.offset > blocks->bytes.size() || entry.bytes > blocks->bytes.size() - entry.offset) continue;
    const std::span block = std::span(blocks->bytes).subspan(entry.offset, entry.bytes);
    const auto pages = packed::pagesOf(std::as_bytes(block), entry, first);
    first += packed::kPagesPerBlock;
    for (const packed::Packet& page : pages.value_or(std::vector<packed::Packet>())) {
      for (const packed::Segment& s : page.segments) {
        if (s.begin() > nodes->bytes.size() || s.bytes() > nodes->bytes.size() - s.begin()) continue;
        const auto bytes = std::as_bytes(std::span(nodes->bytes)).subspan(s.begin(), s.bytes());
        replaceSum(block, s.checksum, amtChecksum(bytes));
      }
    }
    replaceSum(directory->bytes, entry.checksum, amtChecksum(std::as_bytes(block)));
  }
}

/// The checksums of segments, in the order of the directory.
void sealSegments(AmtParts& amt) {
  AmtPart* const seal = find(amt, amt_tag::kSegmentChecksums);
  if (!seal) return;
  std::vector<std::uint64_t> checksums;
  for (const AmtPart& part : amt.parts) {
    const std::uint64_t segments = amtSegmentCount(part.entry.tag, part.bytes.size());
    for (std::uint64_t i = 0; i < segments; ++i) {
      const std::size_t at = i * kAmtSegmentBytes;
      const std::size_t bytes = std::min<std::size_t>(kAmtSegmentBytes, part.bytes.size() - at);
      checksums.push_back(amtChecksum(std::as_bytes(std::span(part.bytes)).subspan(at, bytes)));
    }
  }
  seal->bytes.resize(checksums.size() * sizeof(std::uint64_t));
  std::memcpy(seal->bytes.data(), checksums.data(), seal->bytes.size());
}

}  // namespace

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

Bytes putTogether(AmtParts& amt) {
  sealPackedNodes(amt);
  sealPages(amt);
  sealSegments(amt);
  amt.header.chunkCount = static_cast<std::uint32_t>(amt.parts.size());
  amt.header.directoryBytes = amt.parts.size() * sizeof(AmtChunk);
  std::uint64_t end = sizeof(AmtHeader) + amt.header.directoryBytes;
  for (AmtPart& part : amt.parts) {
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
    const AmtPart& part = amt.parts[i];
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

}  // namespace arete::fuzz
