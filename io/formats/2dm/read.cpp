// SPDX-License-Identifier: GPL-3.0-or-later
//
// One pass over the lines; the first word of each is its card. Elements name nodes by number, and a node may
// come after the elements that name it, so numbers become indices at the end: directly where the nodes are
// numbered 1, 2, 3, ..., as most programs do, by a sorted list otherwise. Lines with an unknown card are
// left out and counted, a block (BEGPARAMDEF to ENDPARAMDEF) as one; lines without a card behind them belong
// to them: the points of a curve (XYS) are such.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/counted.h"
#include "io/files/file_bytes.h"
#include "io/files/text_scan.h"
#include "io/formats/2dm/2dm.h"
#include "io/formats/common/text_reader.h"

namespace arete {

namespace {

constexpr std::int32_t kUsualMaterial = 1, kNoMaterial = 0;

class TwoDmReader final : public MeshTextReader {
 public:
  using MeshTextReader::MeshTextReader;

 private:
  Status readLine() override {
    line_ = at();
    lineEnd_ = lineEnd();
    const Status status = readCard();
    at() = lineEnd_;
    return status;
  }

  /// The next word of the line; empty at its end.
  std::string_view nextWord() {
    const char*& p = at();
    while (p < lineEnd_ && text::isBlank(*p)) ++p;
    const char* from = p;
    while (p < lineEnd_ && !text::isBlank(*p)) ++p;
    return {from, static_cast<std::size_t>(p - from)};
  }

  // The first card must be MESH2D. A card that is not known is left out, with the lines of data behind it;
  // such a line behind any other card is an error.
  Status readCard() {
    const std::string_view card = nextWord();
    if (card.empty()) return {};
    if (!isMesh_ && card != "MESH2D") return corrupt(line_, "is not MESH2D, the first line of a 2DM");
    isMesh_ = true;
    if (card.front() == '#') {
      takeComment(std::string_view(card.data() + 1, static_cast<std::size_t>(lineEnd_ - card.data() - 1)));
      return {};
    }
    const bool isBehindUnknown = std::exchange(isBehindUnknown_, false);
    if (card == "ND") return readNode();
    if (card == "E3T") return readElement(3);
    if (card == "E4Q") return readElement(4);
    if (card == "E6T" || card == "E8Q" || card == "E9Q") {
      const Error error =
          corrupt(line_, fmt::format("is an element with curved sides ({}), which Arete does not read", card))
              .value();
      return unsupported(error.message);
    }
    const bool isData = std::string_view("0123456789+-.\"").find(card.front()) != std::string_view::npos;
    if (isData ? !isBehindUnknown : !isKeyword(card))
      return corrupt(line_, fmt::format("begins with {}: unknown 2DM card", text::quotedToken(card)));
    isBehindUnknown_ = card != "MESH2D";
    if (isBehindUnknown_ && !isData) leaveOutCard(card);
    return {};
  }

  // A block is counted once, by its beginning.
  void leaveOutCard(std::string_view card) {
    const bool begins = card.starts_with("BEG"), ends = card.starts_with("END");
    if (!ends && !isInBlock_ && card != "NUM_MATERIALS_PER_ELEM") leaveOut(card);
    if (begins || ends) isInBlock_ = begins;
  }

  template <class Number>
  bool nextNumber(Number& number) {
    const std::string_view word = nextWord();
    const auto [behind, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && behind == word.data() + word.size() && !word.empty();
  }

  /// A node's number is kept as it is, since elements refer to it and may come before it.
  Status readNode() {
    std::uint32_t number = 0;
    if (!nextNumber(number)) return corrupt(line_, "is a node without a number of its own");
    std::array<double, 3> xyz;
    for (double& value : xyz) {
      const std::string_view word = nextWord();
      const char* from = word.data();
      if (word.empty() || !text::scanNumber(from, from + word.size(), value))
        return corrupt(line_, "is a node without three coordinates");
      if (!std::isfinite(value)) return corrupt(line_, "has a coordinate that is not finite");
    }
    auto& positions = mesh().mesh.positions;
    areInOrder_ = areInOrder_ && number == positions.size() + 1;
    numbers_.push_back(number);
    positions.push_back({xyz[0], xyz[1], xyz[2]});
    return {};
  }

  /// Triangles hold the numbers of nodes until all nodes are read.
  Status readElement(int corners) {
    std::uint32_t number = 0;
    if (!nextNumber(number)) return corrupt(line_, "is an element without a number of its own");
    std::array<std::uint32_t, 4> nodes{};
    for (int k = 0; k < corners; ++k)
      if (!nextNumber(nodes[std::size_t(k)]))
        return corrupt(line_, fmt::format("is an element without {} nodes", corners));
    readMaterial();
    faces().add(mesh().mesh, std::span(nodes).first(std::size_t(corners)));
    return {};
  }

  /// Reads what an element has behind its nodes: the number of its material, and perhaps more.
  void readMaterial() {
    const char* const from = at();
    std::int32_t material = 0;
    if (nextWord().empty()) {
      addMaterial(kNoMaterial);
      return;
    }
    at() = from;
    const bool isNumber = nextNumber(material);
    addMaterial(isNumber ? material : kNoMaterial);
    if (!isNumber || !nextWord().empty()) ++elementsWithMore_;
  }

  /// Listed by face (io/formats/common/faces.h) from the first one on whose material is not the usual one.
  void addMaterial(std::int32_t material) {
    if (materials_.empty() && material == kUsualMaterial) return;
    materials_.resize(faces().size(), kUsualMaterial);
    materials_.push_back(material);
  }

  // Without any material but the usual one, or with none at all, the mesh gets no attribute.
  void takeMaterials() {
    const bool areNone = std::ranges::all_of(materials_, [](std::int32_t m) { return m == kNoMaterial; }) &&
                         materials_.size() == faces().size();
    if (materials_.empty() || areNone) return;
    materials_.resize(faces().size(), kUsualMaterial);
    Attribute attribute{.name = std::string(k2dmMaterialName), .type = ScalarType::int32};
    const std::span bytes = std::as_bytes(std::span(materials_));
    attribute.values.assign(bytes.begin(), bytes.end());
    mesh().mesh.triangleAttributes.push_back(std::move(attribute));
  }

  // Elements can be resolved only now, when all nodes are known.
  Status finish() override {
    if (!isMesh_) return failure(ErrorCode::corrupt, "is not a 2DM: it is empty", path());
    if (!isOurs() && mesh().mesh.triangles.empty())
      return unsupported("holds no element of three or four corners");
    if (numbers_.size() >= std::numeric_limits<std::uint32_t>::max())
      return unsupported("holds more nodes than an index can name");
    takeMaterials();
    if (elementsWithMore_ > 0)
      mesh().warnings.push_back(
          {WarningCode::omitted,
           fmt::format("{} of its {} {} values that are no number of a material; these are left out",
                       elementsWithMore_, counted(faces().size(), "element", "elements"),
                       agreeing(elementsWithMore_, "has", "have"))});
    warnOfLeftOut("cards");
    return areInOrder_ ? indexDirectly() : indexBySortedNumbers();
  }

  /// Both functions below replace numbers of nodes by indices, and refuse a number that no node has.
  tl::unexpected<Error> missingNode(std::size_t triangle, std::uint32_t number) const {
    return failure(ErrorCode::corrupt,
                   fmt::format("triangle {} names node {}, which does not exist", triangle, number), path());
  }

  Status indexDirectly() {
    auto& triangles = mesh().mesh.triangles;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::uint32_t& v : triangles[t]) {
        if (v < 1 || v > numbers_.size()) return missingNode(t, v);
        --v;
      }
    return {};
  }

  Status indexBySortedNumbers() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> byNumber;
    byNumber.reserve(numbers_.size());
    for (std::uint32_t v = 0; v < numbers_.size(); ++v) byNumber.emplace_back(numbers_[v], v);
    std::ranges::sort(byNumber);
    for (std::size_t i = 1; i < byNumber.size(); ++i)
      if (byNumber[i].first == byNumber[i - 1].first)
        return failure(ErrorCode::corrupt, fmt::format("there are two nodes {}", byNumber[i].first), path());
    auto& triangles = mesh().mesh.triangles;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::uint32_t& v : triangles[t]) {
        const auto found =
            std::ranges::lower_bound(byNumber, v, {}, &std::pair<std::uint32_t, std::uint32_t>::first);
        if (found == byNumber.end() || found->first != v) return missingNode(t, v);
        v = found->second;
      }
    return {};
  }

  const char* line_ = nullptr;
  const char* lineEnd_ = nullptr;
  std::vector<std::uint32_t> numbers_;
  bool areInOrder_ = true, isMesh_ = false;
  std::vector<std::int32_t> materials_;
  std::uint64_t elementsWithMore_ = 0;
  bool isInBlock_ = false;        // from a BEG... to its END...
  bool isBehindUnknown_ = false;  // the last card is not read, and may have lines of its own
};

}  // namespace

Result<MeshFile> read2dm(const std::filesystem::path& path, const RunContext& context) {
  ARETE_TRY(const FileBytes file, FileBytes::readText(path));
  return TwoDmReader(file, path.string(), context).read();
}

}  // namespace arete
