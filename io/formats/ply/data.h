// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/counted.h"
#include "io/files/file_bytes.h"
#include "io/files/text_scan.h"
#include "io/formats/common/faces.h"
#include "io/formats/common/finite.h"
#include "io/formats/ply/corners.h"
#include "io/formats/ply/findings.h"
#include "io/formats/ply/header.h"
#include "io/formats/ply/notes.h"
#include "io/formats/ply/scheme.h"

namespace arete {

/// What the comments of a header say, beside CRS and unit.
struct PlyComments {
  std::vector<PlyNote> notes;
  std::vector<std::string> pictures;
};

/// Reads the data behind the header, record by record. What is done with a property is decided once for each
/// element (io/formats/ply/scheme.h). Before an element is read, its stated count is checked against the
/// bytes that are left, since each record needs a minimum of bytes; memory is reserved only then, so it is at
/// most a small multiple of the file's size.
///
/// `Scalars` finds the next number (io/formats/ply/scalars.h). Everything must outlive the reader.
template <class Scalars>
class PlyReader {
 public:
  PlyReader(const FileBytes& file, const PlyHeader& header, const PlyComments& comments,
            const std::string& path, const RunContext& context)
      : file_(file),
        header_(header),
        comments_(comments),
        path_(path),
        context_(context),
        scalars_{file.begin() + header.dataBegin, file.end()} {}

  /// Fills the mesh, its errors and the warnings.
  ///
  /// Errors: corrupt, unsupported; interrupted.
  Status readInto(MeshFile& file) {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") vertexCount_ = element.count;
      hasStrips_ = hasStrips_ || (element.name == "tristrips" && element.count > 0);
      if (!element.properties.empty()) records_ += element.count;
    }
    for (const PlyElement& element : header_.elements) {
      ARETE_CHECK(readElement(element));
      if (hasStrips_ && element.name == "face" && element.count > 0 && element.properties.size() > 1)
        findings_.facesLoseProperties = true;
    }
    if (mesh_.triangles.empty() && findings_.smallFaces > 0)
      return failure(ErrorCode::corrupt, firstSmallFace_, path_);
    if (const auto v = firstUnusable(mesh_))
      return failure(
          ErrorCode::corrupt,
          fmt::format("vertex {} of {} has a coordinate that is not finite", *v, mesh_.positions.size()),
          path_);
    takeMaterials();
    file.mesh = std::move(mesh_);
    file.triangleErrors = std::move(errors_);
    findings_.scalarMisfits = scalars_.misfits;
    findings_.warn(file.warnings);
    if (const Status ok = faces_.finish(file, context_); !ok)
      return failure(ok.error().code, ok.error().message, path_);
    if (corners_) corners_->join(file.mesh, file.warnings);
    keepOddErrors(file);
    leaveOutUnusedNumbers(file);
    return {};
  }

 private:
  using Kind = PlyRole::Kind;
  static constexpr std::uint64_t kRecordsPerCancelCheck = 1 << 16;
  static constexpr std::size_t kLongestName = 40, kMostComponents = 255;

  struct Reading {
    const PlyElement& element;
    PlyScheme scheme;
    bool isVertex = false, isFace = false, isStrips = false;
    std::vector<bool> varies = {};    // by attribute of a list: the lengths differ
    std::vector<std::byte*> to = {};  // by attribute of scalars: where the record's values go
  };

  tl::unexpected<Error> corrupt(std::string message) const {
    if constexpr (Scalars::kIsText)
      message += fmt::format(" (line {})", text::lineOf(file_.begin(), scalars_.at));
    return failure(ErrorCode::corrupt, std::move(message), path_);
  }
  std::string ofRecord(const PlyElement& element, std::uint64_t record, std::string_view what) const {
    return fmt::format("{} {} of {} {}", text::printable(element.name, kLongestName), record, element.count,
                       what);
  }
  tl::unexpected<Error> corruptRecord(const PlyElement& element, std::uint64_t record,
                                      std::string_view what) const {
    return corrupt(ofRecord(element, record, what));
  }
  std::size_t left() const { return static_cast<std::size_t>(scalars_.end - scalars_.at); }

  /// An element that is not read has roles that skip everything.
  Reading readingOf(const PlyElement& element) {
    Reading reading{.element = element, .scheme = {}};
    reading.isVertex = element.name == "vertex";
    reading.isFace = element.name == "face";
    reading.isStrips = element.name == "tristrips";
    if (reading.isVertex)
      reading.scheme = vertexScheme(element, comments_.notes);
    else if (reading.isFace)
      // Triangles of strips have no attributes, and an attribute belongs to all triangles.
      reading.scheme =
          faceScheme(element, comments_.notes, !comments_.pictures.empty() && !hasStrips_, !hasStrips_);
    else if (reading.isStrips)
      reading.scheme = stripScheme(element);
    else
      reading.scheme.roles.resize(element.properties.size());
    return reading;
  }

  Status readElement(const PlyElement& element) {
    Reading reading = readingOf(element);
    PlyScheme& scheme = reading.scheme;
    if (element.count == 0) return {};
    if (reading.isVertex &&
        (scheme.count(Kind::x) != 1 || scheme.count(Kind::y) != 1 || scheme.count(Kind::z) != 1))
      return failure(ErrorCode::corrupt, "the vertices do not have exactly one x, y and z", path_);
    if (reading.isFace && scheme.count(Kind::indices) != 1)
      return failure(ErrorCode::corrupt, "the faces do not have exactly one list of vertex_indices", path_);
    if (reading.isStrips && scheme.count(Kind::indices) != 1)
      return failure(ErrorCode::corrupt, "the triangle strips do not have exactly one list of vertex_indices",
                     path_);
    if (element.properties.empty()) return {};
    if (!reading.isVertex && !reading.isFace && !reading.isStrips)
      findings_.elementsLeftOut.emplace_back(element.name, element.count);

    std::size_t leastSize = 0, triangleSize = 0;
    for (std::size_t p = 0; p < scheme.roles.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      leastSize += Scalars::leastSize(property.isList ? property.countType : property.type);
      if (scheme.roles[p].kind == Kind::indices) triangleSize = 3 * Scalars::leastSize(property.type);
    }
    // In a text, the first token needs no blank before it.
    if (element.count > (left() + 1) / leastSize)
      return corrupt(fmt::format("is truncated: {} of element {} {} not fit into the {} left",
                                 counted(element.count, "record", "records"), text::quotedToken(element.name),
                                 agreeing(element.count, "does", "do"),
                                 counted(left(), "byte that is", "bytes that are")));
    if (reading.isVertex) mesh_.positions.reserve(element.count);
    if (reading.isFace)
      mesh_.triangles.reserve(std::min(element.count, (left() + 1) / (leastSize + triangleSize)));
    begin(reading);

    for (std::uint64_t record = 0; record < element.count; ++record) {
      if (record % kRecordsPerCancelCheck == 0) {
        context_.report("reading the mesh",
                        static_cast<double>(scalars_.at - file_.begin()) / double(file_.size()));
        if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", path_);
      }
      ARETE_CHECK(readRecord(reading, record));
      if constexpr (Scalars::kIsText) skipSurplus();
    }
    end(reading);
    return {};
  }

  /// Makes room for the attributes of all records.
  void begin(Reading& reading) {
    PlyScheme& scheme = reading.scheme;
    findings_.surplusProperties += scheme.leftOut;
    reading.varies.resize(scheme.attributes.size());
    reading.to.resize(scheme.attributes.size());
    for (std::size_t a = 0; a < scheme.attributes.size(); ++a) {
      Attribute& attribute = scheme.attributes[a];
      if (attribute.components == 0) continue;
      attribute.values.resize(reading.element.count * attribute.elementBytes());
      reading.to[a] = attribute.values.data();
    }
    if (reading.isFace && !scheme.corners.empty()) corners_.emplace(std::move(scheme.corners), file_.size());
  }

  /// Skips the values that a line has beyond the properties of its record. Where there are fewer lines than
  /// records, several records share a line, and nothing is skipped.
  void skipSurplus() {
    const char* next = scalars_.at;
    while (next < scalars_.end && text::isBlank(*next)) ++next;
    if (next == scalars_.end || *next == '\n' || !everyRecordHasALine()) return;
    if (findings_.linesWithMore++ == 0) findings_.firstLineWithMore = text::lineOf(file_.begin(), next);
    scalars_.at = std::find(next, scalars_.end, '\n');
  }

  bool everyRecordHasALine() {
    if (!lines_) {
      lines_ = 0;
      const char* const begin = file_.begin() + header_.dataBegin;
      bool isEmpty = true;
      for (const char* at = begin; at < scalars_.end; ++at) {
        if (*at != '\n') {
          isEmpty = isEmpty && text::isBlank(*at);
        } else {
          *lines_ += isEmpty ? 0 : 1;
          isEmpty = true;
        }
      }
      *lines_ += isEmpty ? 0 : 1;
    }
    return *lines_ >= records_;
  }

  Status readRecord(Reading& reading, std::uint64_t record) {
    Vec3 position;
    std::optional<double> error;
    for (std::size_t p = 0; p < reading.scheme.roles.size(); ++p) {
      const PlyProperty& property = reading.element.properties[p];
      const PlyRole& role = reading.scheme.roles[p];
      if (property.isList) {
        ARETE_CHECK(readList(reading, property, role, record));
        continue;
      }
      if (role.kind == Kind::number) {
        if (!scalars_.copy(property.type, reading.to[role.attribute] + role.offset))
          return corruptRecord(reading.element, record, noValue(property));
        continue;
      }
      double value = 0;
      if (!scalars_.next(property.type, value))
        return corruptRecord(reading.element, record, noValue(property));
      switch (role.kind) {
        case Kind::x:
          position.x = value;
          break;
        case Kind::y:
          position.y = value;
          break;
        case Kind::z:
          position.z = value;
          break;
        case Kind::error:
          error = value;
          break;
        case Kind::textureNumber:
          takeTextureNumber(value);
          break;
        default:
          break;
      }
    }
    for (std::size_t a = 0; a < reading.to.size(); ++a)
      if (reading.to[a]) reading.to[a] += reading.scheme.attributes[a].elementBytes();
    if (reading.isFace) ARETE_CHECK(addFace(reading.element, record));
    // Each triangle of a polygon has the error of the polygon.
    if (error) errors_.resize(mesh_.triangles.size(), static_cast<float>(*error));
    if (reading.isVertex) mesh_.positions.push_back(position);
    return {};
  }

  Status addFace(const PlyElement& element, std::uint64_t record) {
    if (indices_.size() < 3 && findings_.smallFaces++ == 0)
      firstSmallFace_ = ofRecord(element, record, fmt::format("has {} corners", indices_.size()));
    std::span<const std::uint32_t> wedges;
    if (corners_ && indices_.size() >= 3) {
      const auto numbers = corners_->addFace(indices_, record);
      if (!numbers) return failure(numbers.error().code, numbers.error().message, path_);
      wedges = *numbers;
    }
    faces_.add(mesh_, indices_, wedges);
    if (corners_) corners_->clearValues();
    return {};
  }

  Status readList(Reading& reading, const PlyProperty& property, const PlyRole& role, std::uint64_t record) {
    const PlyElement& element = reading.element;
    double length = 0;
    if (!scalars_.next(property.countType, length)) return corruptRecord(element, record, noValue(property));
    if (!(length >= 0 && length == std::floor(length)))
      return corruptRecord(element, record, fmt::format("has a list of {} values", length));
    if (length > static_cast<double>((left() + 1) / Scalars::leastSize(property.type)))
      return corruptRecord(element, record,
                           fmt::format("has a list of {} values, more than the file can hold", length));
    const auto count = static_cast<std::uint64_t>(length);
    switch (role.kind) {
      case Kind::indices:
        return reading.isStrips ? readStrips(element, property, record, count)
                                : readCorners(element, property, record, count);
      case Kind::cornerList:
        return readValues(element, property, record, count, corners_->values(role.attribute));
      case Kind::list:
        return readAttribute(reading, property, role.attribute, record, count);
      default:
        return skipValues(element, property, record, count);
    }
  }

  Status readCorners(const PlyElement& element, const PlyProperty& property, std::uint64_t record,
                     std::uint64_t count) {
    indices_.clear();
    double wrong = 0;
    bool isWrong = false;
    const bool isWhole = scalars_.each(property.type, count, [&](double value) {
      isWrong = !isVertex(value);
      if (isWrong) wrong = value;
      if (!isWrong) indices_.push_back(static_cast<std::uint32_t>(value));
      return !isWrong;
    });
    if (isWrong) return corruptRecord(element, record, noVertex(wrong));
    if (!isWhole) return corruptRecord(element, record, noValue(property));
    return {};
  }

  /// Strips one behind the other, with -1 between them: each vertex makes a triangle with the two before it,
  /// every second one turned. Triangles that have a vertex twice only lead from one part to the next.
  Status readStrips(const PlyElement& element, const PlyProperty& property, std::uint64_t record,
                    std::uint64_t count) {
    const double restart = property.type == PlyType::uint8    ? std::numeric_limits<std::uint8_t>::max()
                           : property.type == PlyType::uint16 ? std::numeric_limits<std::uint16_t>::max()
                           : property.type == PlyType::uint32 ? std::numeric_limits<std::uint32_t>::max()
                                                              : -1.0;
    std::array<std::uint32_t, 2> before{};
    std::size_t inStrip = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      double value = 0;
      if (!scalars_.next(property.type, value)) return corruptRecord(element, record, noValue(property));
      if (value == -1 || (value == restart && !isVertex(value))) {
        inStrip = 0;
        continue;
      }
      if (!isVertex(value)) return corruptRecord(element, record, noVertex(value));
      const auto [a, b] = before;
      const auto c = static_cast<std::uint32_t>(value);
      if (inStrip >= 2 && a != b && b != c && c != a) {
        indices_ = inStrip % 2 == 0 ? std::vector{a, b, c} : std::vector{b, a, c};
        faces_.add(mesh_, indices_);
      }
      before = {b, c};
      ++inStrip;
    }
    return {};
  }

  Status readValues(const PlyElement& element, const PlyProperty& property, std::uint64_t record,
                    std::uint64_t count, std::vector<std::byte>& values) {
    const std::size_t size = sizeOf(property.type), old = values.size();
    values.resize(old + count * size);
    for (std::uint64_t i = 0; i < count; ++i)
      if (!scalars_.copy(property.type, values.data() + old + i * size))
        return corruptRecord(element, record, noValue(property));
    return {};
  }

  Status skipValues(const PlyElement& element, const PlyProperty& property, std::uint64_t record,
                    std::uint64_t count) {
    if (!scalars_.each(property.type, count, [](double) { return true; }))
      return corruptRecord(element, record, noValue(property));
    return {};
  }

  Status readAttribute(Reading& reading, const PlyProperty& property, std::size_t a, std::uint64_t record,
                       std::uint64_t count) {
    Attribute& attribute = reading.scheme.attributes[a];
    if (record == 0)
      attribute.components = static_cast<std::uint8_t>(std::min<std::uint64_t>(count, kMostComponents));
    if (count != attribute.components) {
      reading.varies[a] = true;
      attribute.values = {};
    }
    if (reading.varies[a]) return skipValues(reading.element, property, record, count);
    return readValues(reading.element, property, record, count, attribute.values);
  }

  /// The attributes of an element that was read go to the mesh: those of faces by face (MeshFaces).
  void end(Reading& reading) {
    for (std::size_t a = 0; a < reading.scheme.attributes.size(); ++a) {
      Attribute& attribute = reading.scheme.attributes[a];
      if (reading.varies[a]) {
        findings_.varyingLists.push_back(attribute.name);
        continue;
      }
      if (attribute.components == 0) continue;  // lists without values
      if (!reading.to[a]) giveMeaning(attribute);
      (reading.isVertex ? mesh_.vertexAttributes : mesh_.triangleAttributes).push_back(std::move(attribute));
    }
  }

  void takeTextureNumber(double number) {
    const bool isOne = number >= 0 && number < static_cast<double>(comments_.pictures.size()) &&
                       number == std::floor(number);
    if (!isOne && number != -1) ++findings_.badTextureNumbers;
    mesh_.materialOf.push_back(isOne ? static_cast<std::uint32_t>(number) : MeshAttributes::kNone);
  }

  /// A material for each picture. Without texnumber, faces have the first.
  void takeMaterials() {
    if (comments_.pictures.empty() || mesh_.triangles.empty()) return;
    for (const std::string& picture : comments_.pictures) {
      mesh_.materials.push_back({.name = plyMaterialName(picture)});
      mesh_.materials.back().textures.push_back({"baseColor", picture});
    }
    mesh_.materialOf.resize(faces_.size(), 0);
  }

  /// A property named `error` with negative or non-finite values is kept as an attribute of faces.
  static void keepOddErrors(MeshFile& file) {
    if (std::ranges::all_of(file.triangleErrors, [](float e) { return e >= 0 && std::isfinite(e); })) return;
    if (std::ranges::count(file.mesh.triangleAttributes, "error", &Attribute::name) == 0) {
      Attribute attribute{.name = "error"};
      const auto bytes = std::as_bytes(std::span(file.triangleErrors));
      attribute.values.assign(bytes.begin(), bytes.end());
      file.mesh.triangleAttributes.push_back(std::move(attribute));
    }
    file.triangleErrors.clear();
  }

  bool isVertex(double value) const {
    return value >= 0 && value < static_cast<double>(vertexCount_) && value == std::floor(value);
  }
  std::string noVertex(double value) const {
    return fmt::format("names vertex {} of {}", value, vertexCount_);
  }
  std::string noValue(const PlyProperty& property) const {
    return fmt::format("{} {}", left() == 0 ? "is cut off at" : "has no number for",
                       text::quotedToken(property.name));
  }

  const FileBytes& file_;
  const PlyHeader& header_;
  const PlyComments& comments_;
  const std::string& path_;
  const RunContext& context_;
  Scalars scalars_;
  std::uint64_t vertexCount_ = 0;
  bool hasStrips_ = false;
  std::uint64_t records_ = 0;           // of all elements that have properties
  std::optional<std::uint64_t> lines_;  // that are not empty, once counted
  PlyFindings findings_;
  std::string firstSmallFace_;
  SurfaceMesh mesh_;
  std::vector<float> errors_;
  MeshFaces faces_;
  std::optional<PlyCorners> corners_;
  std::vector<std::uint32_t> indices_;  // of the face that is read
};

}  // namespace arete
