// SPDX-License-Identifier: GPL-3.0-or-later
//
// A span file: a head, and the blocks that its bits name, one after the other. The time of a file is when it
// was used last. The folder is counted when the process writes first, and again after every 1/16 of the
// budget: other processes write too.
#include "io/files/ranges/span_cache.h"

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "io/files/temporary_files.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtension = ".span";
constexpr std::uint32_t kSpanHasBlocks = 16;
constexpr std::array<char, 8> kSpanMagic = {'A', 'r', 'e', 't', 'e', 'S', 'p', '1'};
constexpr std::size_t kKeyLetters = 32;

struct SpanHead {
  std::array<char, 8> magic = kSpanMagic;
  CacheKey key;
  std::uint64_t span = 0;
  std::uint32_t length = 0, blocks = 0;
  std::uint64_t checksum = 0;  ///< of the head with 0 here, and of the blocks
};
static_assert(sizeof(SpanHead) == 48);

std::uint64_t sumOf(SpanHead head, std::span<const std::byte> blocks) {
  head.checksum = 0;
  const XXH64_hash_t ofHead = XXH3_64bits(&head, sizeof head);
  return XXH3_64bits_withSeed(blocks.data(), blocks.size(), ofHead);
}

/// The places of the blocks in a span of `length` bytes, in order.
template <class Visit>
void forBlocks(std::uint32_t blocks, std::size_t length, const Visit& visit) {
  for (std::uint32_t i = 0; i < kSpanHasBlocks; ++i) {
    const std::size_t begin = i * SpanCache::kBlock;
    if ((blocks >> i & 1) == 0 || begin >= length) continue;
    visit(begin, std::min<std::size_t>(SpanCache::kBlock, length - begin));
  }
}

std::vector<std::byte> readWhole(const fs::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const auto size = static_cast<std::streamoff>(file.tellg());
  if (size < 0 || size > static_cast<std::streamoff>(sizeof(SpanHead) + SpanCache::kSpan)) return {};
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), size);
  if (file.gcount() != size) return {};
  return bytes;
}

/// The head of a sound span file of that key and place; nothing of any other.
std::optional<SpanHead> soundHead(std::span<const std::byte> file, const CacheKey& key, std::uint64_t span,
                                  std::size_t length) {
  SpanHead head;
  if (file.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, file.data(), sizeof head);
  const std::span<const std::byte> blocks = file.subspan(sizeof head);
  std::size_t size = 0;
  forBlocks(head.blocks, length, [&](std::size_t, std::size_t count) { size += count; });
  const bool isSound = head.magic == kSpanMagic && head.key == key && head.span == span &&
                       head.length == length && (head.blocks >> kSpanHasBlocks) == 0 &&
                       blocks.size() == size && head.checksum == sumOf(head, blocks);
  return isSound ? std::optional(head) : std::nullopt;
}

bool isSpanFile(const fs::path& path) {
  const std::string name = path.filename().string();
  return path.extension() == kExtension && name.size() > kKeyLetters &&
         name.find_first_not_of("0123456789abcdef") == kKeyLetters;
}

}  // namespace

CacheKey CacheKey::of(const std::string& address, const std::string& version, std::uint64_t length) {
  const std::string text = fmt::format("{}\n{}\n{}", address, version, length);
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return {hash.low64, hash.high64};
}

Result<std::shared_ptr<SpanCache>> SpanCache::open(const fs::path& folder, std::uint64_t budget) {
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path probe = temporaryBeside(folder / "probe.span");
  const bool isWritten = !error && std::ofstream(probe, std::ios::binary).put('x').flush().good();
  std::error_code ignored;
  fs::remove(probe, ignored);
  if (!isWritten)
    return failure(ErrorCode::unreadable,
                   error ? fmt::format("cannot be a folder for a cache: {}", error.message())
                         : std::string("cannot be written to"),
                   folder.string());
  return std::shared_ptr<SpanCache>(new SpanCache(folder, budget));
}

fs::path SpanCache::fileOf(const CacheKey& key, std::uint64_t span) const {
  return folder_ / fmt::format("{:016x}{:016x}-{:x}{}", key.high, key.low, span, kExtension);
}

SpanCache::Blocks SpanCache::read(const CacheKey& key, std::uint64_t span, std::span<std::byte> bytes) {
  const std::lock_guard lock(mutex_);
  const fs::path path = fileOf(key, span);
  const std::vector<std::byte> file = readWhole(path);
  const auto head = soundHead(file, key, span, bytes.size());
  if (!head) return 0;
  std::size_t from = sizeof(SpanHead);
  forBlocks(head->blocks, bytes.size(), [&](std::size_t begin, std::size_t count) {
    std::memcpy(bytes.data() + begin, file.data() + from, count);
    from += count;
  });
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return static_cast<Blocks>(head->blocks);
}

void SpanCache::write(const CacheKey& key, std::uint64_t span, std::span<const std::byte> bytes,
                      Blocks blocks) {
  const std::lock_guard lock(mutex_);
  const fs::path path = fileOf(key, span);
  std::vector<std::byte> whole(bytes.begin(), bytes.end());
  std::uint32_t all = blocks;
  const std::vector<std::byte> older = readWhole(path);
  if (const auto head = soundHead(older, key, span, bytes.size())) {
    std::size_t from = sizeof(SpanHead);
    forBlocks(head->blocks, bytes.size(), [&](std::size_t begin, std::size_t count) {
      if ((blocks >> (begin / kBlock) & 1) == 0)
        std::memcpy(whole.data() + begin, older.data() + from, count);
      from += count;
    });
    if ((head->blocks | all) == head->blocks) return;
    all |= head->blocks;
  }
  SpanHead head;
  head.key = key;
  head.span = span;
  head.length = static_cast<std::uint32_t>(bytes.size());
  head.blocks = all;
  std::vector<std::byte> kept;
  forBlocks(all, bytes.size(), [&](std::size_t begin, std::size_t count) {
    kept.insert(kept.end(), whole.begin() + std::ptrdiff_t(begin),
                whole.begin() + std::ptrdiff_t(begin + count));
  });
  head.checksum = sumOf(head, kept);
  // Another cache of this process may write the same span.
  static std::atomic<unsigned> number = 0;
  const fs::path temporary =
      temporaryBeside(folder_ / fmt::format("{}-{}", ++number, path.filename().string()));
  std::error_code error;
  {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(&head), sizeof head);
    file.write(reinterpret_cast<const char*>(kept.data()), static_cast<std::streamsize>(kept.size()));
    file.close();
    if (!file) error = std::make_error_code(std::errc::io_error);
  }
  if (!error) fs::rename(temporary, path, error);
  std::error_code ignored;
  if (error) {
    fs::remove(temporary, ignored);
    return;
  }
  keepBudget(sizeof head + kept.size());
}

void SpanCache::keepBudget(std::uint64_t written) {
  sinceCount_ += written;
  if (sinceCount_ <= budget_ / 16 && known_ + sinceCount_ <= budget_) return;
  removeAbandonedFiles(folder_);
  struct Kept {
    fs::file_time_type time;
    std::uint64_t bytes;
    fs::path path;
  };
  std::vector<Kept> files;
  std::error_code error, ignored;
  known_ = sinceCount_ = 0;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
    if (!isSpanFile(entry->path())) continue;
    std::error_code gone;
    const std::uint64_t bytes = entry->file_size(gone);
    const fs::file_time_type time = gone ? fs::file_time_type() : entry->last_write_time(gone);
    if (gone) continue;
    known_ += bytes;
    files.push_back({time, bytes, entry->path()});
  }
  if (known_ <= budget_) return;
  std::ranges::sort(files, {}, &Kept::time);
  const std::uint64_t least = budget_ - budget_ / 8;
  for (const Kept& file : files) {
    if (known_ <= least) return;
    fs::remove(file.path, ignored);
    known_ -= file.bytes;
  }
}

}  // namespace arete
