// SPDX-License-Identifier: GPL-3.0-or-later
//
// Some tens of models are made once and taken apart. Each file takes one of them in turn and changes one to
// eight numbers of a kind; the kinds that pass the checks of the reader, positions, heights and errors, come
// more often.
#include "fuzz/hostile_amt.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string_view>

#include "datasets/families.h"
#include "fuzz/amt_parts.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"

namespace arete::fuzz {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

struct Seed {
  std::string name;
  AmtParts parts;
};

Bytes readBytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void addSeed(std::vector<Seed>& seeds, const fs::path& folder, std::string_view name,
             const Result<TerrainModel>& model, bool isPacked) {
  if (!model) return;  // a family that is degenerate at this size
  const fs::path path = folder / "seed.amt";
  if (!writeAmt(path.string(), *model, {}, {.writer = "Arete", .isPacked = isPacked})) std::abort();
  const Bytes bytes = readBytes(path);
  seeds.push_back({std::string(name), *takeApart(bytes)});
  fs::remove(path);
}

std::vector<Seed> makeSeeds(const fs::path& folder, std::uint64_t seed) {
  std::vector<Seed> seeds;
  for (const RasterFamily& family : rasterFamilies()) {
    addSeed(seeds, folder, family.name, build(family.make(9, 7, seed)), false);
    addSeed(seeds, folder, family.name, build(family.make(6, 5, seed), {.rimTolerance = 1}),
            seeds.size() % 3 == 0);
  }
  for (const PointFamily& family : pointFamilies())
    addSeed(seeds, folder, family.name, build(family.make(40, seed)), seeds.size() % 3 == 0);
  return seeds;
}

class Changes {
 public:
  explicit Changes(std::uint64_t seed) : random_(seed) {}

  /// Changes the parts. @return What was changed, for the name; empty where this model has nothing of the
  /// kind.
  std::string apply(AmtParts& amt) {
    constexpr std::array<AmtTag, 20> kTags = {
        amt_tag::kPlan,     amt_tag::kSamples,  amt_tag::kPlan,          amt_tag::kSamples,
        amt_tag::kHeights,  amt_tag::kHeights,  amt_tag::kError,         amt_tag::kSaturatedError,
        amt_tag::kSphere,   amt_tag::kBelow,    amt_tag::kAbove,         amt_tag::kLink,
        amt_tag::kFloor,    amt_tag::kRemover,  amt_tag::kRootTriangles, amt_tag::kFixedVertices,
        amt_tag::kMetadata, amt_tag::kMetadata, amt_tag::kPackedNodes,   amt_tag::kPackedTables};
    const AmtTag tag = kTags[pick(kTags.size())];
    const auto part = std::ranges::find_if(amt.parts, [&](const AmtPart& p) { return p.entry.tag == tag; });
    if (part == amt.parts.end() || part->bytes.empty()) return {};
    if (tag == amt_tag::kMetadata)
      changeText(part->bytes);
    else if (tag == amt_tag::kError || tag == amt_tag::kSaturatedError)
      pick(2) == 0 ? changeAll(*part) : changeSome(*part);
    else
      changeSome(*part);
    return part->entry.name();
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }

  double extreme() {
    constexpr double kMost = std::numeric_limits<double>::max(),
                     kLeast = std::numeric_limits<double>::denorm_min();
    constexpr std::array<double, 13> kValues = {0,    -0.0,  1,     kMost, -kMost, kLeast,      1e20,
                                                1e17, 1e-17, 1e300, -1e38, 3.5,    4294967296.0};
    return kValues[pick(kValues.size())];
  }

  /// One scalar of a type, as bytes.
  void setScalar(std::uint8_t* at, AmtScalar type, std::size_t bytes) {
    if (type == AmtScalar::f64) {
      const double value = extreme();
      std::memcpy(at, &value, sizeof value);
    } else if (type == AmtScalar::f32) {
      const auto value = static_cast<float>(std::clamp(extreme(), -3e38, 3e38));
      std::memcpy(at, &value, sizeof value);
    } else {
      constexpr std::array<std::uint32_t, 8> kValues = {0, 1, 2, 3, 7, 0x7FFF, 0xFFFF, 0xFFFFFFFF};
      const std::uint32_t value = kValues[pick(kValues.size())];
      std::memcpy(at, &value, std::min(bytes, sizeof value));
    }
  }

  static std::size_t scalarBytes(AmtScalar type) {
    switch (type) {
      case AmtScalar::f64:
        return 8;
      case AmtScalar::f32:
      case AmtScalar::u32:
        return 4;
      case AmtScalar::u16:
      case AmtScalar::i16:
        return 2;
      default:
        return 1;
    }
  }

  void changeSome(AmtPart& part) {
    const std::size_t size = std::max<std::size_t>(1, part.entry.elementBytes),
                      count = part.bytes.size() / size, scalar = scalarBytes(part.entry.scalar);
    for (std::size_t changes = 1 + pick(8); changes-- > 0;) {
      std::uint8_t* const element = part.bytes.data() + pick(count) * size;
      if (pick(2) == 0)  // the value of another one: in range, but not here
        std::memmove(element, part.bytes.data() + pick(count) * size, size);
      else
        setScalar(element + pick(std::max<std::size_t>(1, size / scalar)) * scalar, part.entry.scalar,
                  scalar);
    }
  }

  void changeAll(AmtPart& part) {
    const std::uint8_t value = pick(2) == 0 ? 0 : 0x7F;
    std::ranges::fill(part.bytes, value);
  }

  /// A number of the metadata, or the CRS.
  void changeText(Bytes& bytes) {
    std::string text(bytes.begin(), bytes.end());
    if (pick(3) == 0) {
      constexpr std::array<std::string_view, 8> kTexts = {
          "+init=/dev/fd/0:1 +type=crs",
          "+proj=longlat +ellps=clrk66 +nadgrids=/dev/stdin +type=crs",
          "+proj=longlat +ellps=clrk66 +nadgrids=./fifo,@../x +no_defs",
          "+proj=utm +zone=33 +geoidgrids=/etc/passwd +vunits=m +type=crs",
          "EPSG:999999",
          "EPSG:4978",
          "GEOGCS[\\\"x\\\",DATUM[\\\"y\\\",SPHEROID[\\\"z\\\",0,0]],PRIMEM[\\\"w\\\",0],UNIT[\\\"v\\\",0]]",
          "http://localhost:1/crs"};
      const std::string key = "\"crsWkt\": \"";
      if (const std::size_t at = text.find(key); at != text.npos) {
        const std::size_t begin = at + key.size();
        std::size_t end = begin;
        while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
        text.replace(begin, end - begin, kTexts[pick(kTexts.size())]);
      }
    } else {
      constexpr std::array<std::string_view, 12> kNumbers = {
          "0", "1", "-1", "2", "65535", "65536", "1e300", "4294967295", "0.5", "1e-300", "-1e17", "30000"};
      std::vector<std::pair<std::size_t, std::size_t>> numbers;
      for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_not_of("0123456789.eE+-", at), text.size());
        const bool isAlone = at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\n');
        if (end > at && isAlone) numbers.emplace_back(at, end - at);
        at = std::max(end, at + 1);
      }
      if (!numbers.empty()) {
        const auto [begin, length] = numbers[pick(numbers.size())];
        text.replace(begin, length, kNumbers[pick(kNumbers.size())]);
      }
    }
    bytes.assign(text.begin(), text.end());
  }

  std::mt19937_64 random_;
};

}  // namespace

std::vector<fs::path> writeHostileAmts(const fs::path& folder, std::size_t count, std::uint64_t seed) {
  const std::vector<Seed> seeds = makeSeeds(folder, seed);
  Changes changes(seed);
  std::vector<fs::path> files;
  for (std::size_t tried = 0; files.size() < count; ++tried) {
    const Seed& of = seeds[tried % seeds.size()];
    AmtParts parts = of.parts;
    const std::string what = changes.apply(parts);
    if (what.empty()) continue;
    const Bytes bytes = putTogether(parts);
    files.push_back(folder / fmt::format("{:03} {}, {}.amt", files.size(), of.name, what));
    std::ofstream(files.back(), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  return files;
}

}  // namespace arete::fuzz
