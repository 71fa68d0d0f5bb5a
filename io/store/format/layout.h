// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace arete {

/// The bytes of an .amt file (docs/topics/amt-format.md): a header, a directory of chunks, the chunks. All
/// numbers are little-endian. The directory follows the header. Every chunk begins at a multiple of 64: the
/// first one at or after the end of what precedes it, the directory or a chunk. The file ends at such a
/// multiple, too. The bytes between are zero.

/// Terrain is written as version 2, surfaces as version 3 (docs/decisions/0031): a version 3 file has chunks
/// that a reader of version 2 must not skip.
inline constexpr std::uint32_t kAmtVersion = 2, kAmtNewestVersion = 3;
inline constexpr std::uint64_t kAmtAlignment = 64;
/// Larger directories and metadata are refused, because opening a file reads both.
inline constexpr std::uint32_t kAmtMaxChunks = 64;
inline constexpr std::uint64_t kAmtMaxMetadataBytes = std::uint64_t{1} << 20;

/// The size of a segment: a part of a chunk with a checksum of its own, so that a part of a file can be read
/// and checked alone.
inline constexpr std::uint64_t kAmtSegmentBytes = std::uint64_t{1} << 16;

/// Like PNG's: a byte outside ASCII, the format's name, and line ends of every kind, so that damage by a
/// transfer in text mode is detected.
inline constexpr std::array<char, 8> kAmtMagic = {'\x89', 'A', 'M', 'T', '\r', '\n', '\x1a', '\n'};
inline constexpr std::uint32_t kAmtByteOrder = 0x01020304;
inline constexpr std::uint32_t kAmtByteOrderSwapped = 0x04030201;

/// The first 64 bytes of a file.
struct AmtHeader {
  std::array<char, 8> magic = kAmtMagic;
  std::uint32_t byteOrder = kAmtByteOrder;
  std::uint32_t version = kAmtVersion;
  std::uint32_t headerBytes = 64;
  std::uint32_t chunkCount = 0;
  std::uint64_t fileBytes = 0;
  std::uint64_t directoryOffset = 64;
  std::uint64_t directoryBytes = 0;  ///< 40 per chunk
  std::uint64_t reserved = 0;
  std::uint64_t checksum = 0;  ///< XXH3-64 of the header's first 56 bytes and the directory
};
static_assert(sizeof(AmtHeader) == 64 && offsetof(AmtHeader, checksum) == 56);

/// What a file holds the model of.
enum class ModelKind { terrain, surface };

/// The type of the numbers that a chunk's elements are made of.
enum class AmtScalar : std::uint32_t { u8 = 1, u16 = 2, u32 = 3, i16 = 4, f32 = 5, f64 = 6 };

using AmtTag = std::array<char, 4>;

/// A flag of a chunk: a reader that does not know its tag refuses the file.
inline constexpr std::uint32_t kAmtRequired = 1;

/// One entry of the directory.
struct AmtChunk {
  AmtTag tag{};
  AmtScalar scalar = AmtScalar::u8;
  std::uint32_t elementBytes = 1;  ///< size of one element: that of the scalar times the number of components
  std::uint32_t flags = 0;         ///< kAmtRequired, in version 3
  std::uint64_t offset = 0;        ///< from the beginning of the file
  std::uint64_t bytes = 0;         ///< without the padding behind it
  std::uint64_t checksum = 0;      ///< XXH3-64 of the bytes

  /// The tag as text; bytes that cannot be printed are question marks.
  std::string name() const {
    std::string text(tag.begin(), tag.end());
    for (char& c : text)
      if (c < ' ' || c > '~') c = '?';
    return text;
  }
};
static_assert(sizeof(AmtChunk) == 40);

namespace amt_tag {
inline constexpr AmtTag kMetadata = {'M', 'E', 'T', 'A'};
inline constexpr AmtTag kRootTriangles = {'R', 'T', 'R', 'I'};
inline constexpr AmtTag kSlotBegin = {'S', 'L', 'O', 'T'};
inline constexpr AmtTag kLink = {'L', 'I', 'N', 'K'};
inline constexpr AmtTag kRemover = {'R', 'M', 'V', 'R'};
inline constexpr AmtTag kError = {'E', 'R', 'R', 'R'};
inline constexpr AmtTag kBelow = {'B', 'L', 'O', 'W'};
inline constexpr AmtTag kAbove = {'A', 'B', 'O', 'V'};
inline constexpr AmtTag kFloor = {'F', 'L', 'O', 'R'};
inline constexpr AmtTag kSaturatedError = {'S', 'E', 'R', 'R'};
inline constexpr AmtTag kSphere = {'S', 'P', 'H', 'R'};
inline constexpr AmtTag kBlockError = {'B', 'E', 'R', 'R'};
inline constexpr AmtTag kBlockSphere = {'B', 'S', 'P', 'H'};
inline constexpr AmtTag kCreatorHint = {'H', 'I', 'N', 'T'};
inline constexpr AmtTag kSamples = {'S', 'A', 'M', 'P'};
inline constexpr AmtTag kPlan = {'P', 'L', 'A', 'N'};
inline constexpr AmtTag kHeights = {'H', 'G', 'H', 'T'};
// In a packed file, in place of all of the above except the metadata:
inline constexpr AmtTag kPackedDirectory = {'P', 'D', 'I', 'R'};
inline constexpr AmtTag kPackedTables = {'P', 'T', 'A', 'B'};
inline constexpr AmtTag kPackedNodes = {'P', 'N', 'O', 'D'};
// In a paged file, in place of the directory of a packed one:
inline constexpr AmtTag kPageRoot = {'P', 'A', 'G', 'E'};
inline constexpr AmtTag kPageBlocks = {'P', 'B', 'L', 'K'};
// In every file:
inline constexpr AmtTag kIsolatedSamples = {'I', 'S', 'A', 'M'};
inline constexpr AmtTag kIsolatedHeights = {'I', 'H', 'G', 'T'};
inline constexpr AmtTag kFixedVertices = {'F', 'I', 'X', 'V'};
// The last chunk of a plain file; files written by earlier builds of Arete lack it:
inline constexpr AmtTag kSegmentChecksums = {'P', 'S', 'U', 'M'};
// Of surfaces, in place of samples, plan, heights, bounds and what is in every file of terrain:
inline constexpr AmtTag kPlaces = {'S', 'U', 'R', 'F'};
inline constexpr AmtTag kRms = {'R', 'M', 'S', 'E'};
inline constexpr AmtTag kVertexNumbers = {'V', 'N', 'U', 'M'};
inline constexpr AmtTag kFaceNumbers = {'F', 'N', 'U', 'M'};
inline constexpr AmtTag kWedges = {'W', 'E', 'D', 'G'};
inline constexpr AmtTag kLeftOutFaces = {'L', 'E', 'F', 'T'};
inline constexpr AmtTag kAttributes = {'A', 'T', 'T', 'R'};
inline constexpr AmtTag kAttributeErrors = {'A', 'E', 'R', 'R'};
inline constexpr AmtTag kDirections = {'D', 'I', 'R', 'S'};
inline constexpr AmtTag kReaches = {'R', 'E', 'A', 'C'};
inline constexpr AmtTag kLooks = {'L', 'O', 'O', 'K'};
inline constexpr AmtTag kPictures = {'P', 'I', 'C', 'T'};
// In a packed file of a surface, in place of vertex and face numbers and wedges, and of directions and
// reaches:
inline constexpr AmtTag kPackedNumbers = {'P', 'N', 'U', 'M'};
inline constexpr AmtTag kPackedDisplacement = {'P', 'D', 'S', 'P'};
}  // namespace amt_tag

/// The number of segments of a chunk; 0 for the metadata and the checksums of segments.
constexpr std::uint64_t amtSegmentCount(const AmtTag& tag, std::uint64_t bytes) {
  if (tag == amt_tag::kMetadata || tag == amt_tag::kSegmentChecksums) return 0;
  return (bytes + kAmtSegmentBytes - 1) / kAmtSegmentBytes;
}

/// The first multiple of the alignment at or behind `offset`. Precondition: offset < 2^64 - 63.
constexpr std::uint64_t amtAligned(std::uint64_t offset) {
  return (offset + kAmtAlignment - 1) / kAmtAlignment * kAmtAlignment;
}

}  // namespace arete
