// SPDX-License-Identifier: GPL-3.0-or-later
//
// Binary STL: a header of 80 bytes, the triangle count, then 50 bytes per triangle: normal and three corners
// as float32, and two bytes for what programs have made of them. The header is text padded with blanks. It
// must not begin with "solid", as an ASCII file does.
//
// ASCII STL: the facets of each object between "solid" and "endsolid".
#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/files/file_writer.h"
#include "io/files/write_progress.h"
#include "io/formats/common/comments.h"
#include "io/formats/common/flattened.h"
#include "io/formats/common/losses.h"
#include "io/formats/common/object_runs.h"
#include "io/formats/common/text_numbers.h"
#include "io/formats/stl/facet_colors.h"
#include "io/formats/stl/read_parts.h"
#include "io/formats/stl/stl.h"
#include "io/geo/crs/local_origin.h"

namespace arete {

static_assert(std::endian::native == std::endian::little, "a big-endian machine needs a byte swap here");

namespace {

std::string originHeader(const Vec3& origin) {
  return fmt::format("{}{} {} {}", kStlOriginKey, origin.x, origin.y, origin.z);
}

/// The unit normal of the triangle as written; 0, 0, 0 if the triangle has no area, as the format requires.
std::array<float, 3> normalOf(const std::array<Vec3, 3>& c) {
  const Vec3 a{c[1].x - c[0].x, c[1].y - c[0].y, c[1].z - c[0].z};
  const Vec3 b{c[2].x - c[0].x, c[2].y - c[0].y, c[2].z - c[0].z};
  const Vec3 n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  const double length = std::hypot(n.x, n.y, n.z);
  if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0};
  return {static_cast<float>(n.x / length), static_cast<float>(n.y / length),
          static_cast<float>(n.z / length)};
}

class StlWriter {
 public:
  StlWriter(MeshRef mesh, const std::filesystem::path& path, const MeshWriteOptions& options,
            const RunContext& context)
      : shape_(mesh.shape),
        mesh_(mesh.attributes),
        path_(path),
        options_(options),
        context_(context),
        runs_(mesh) {}

  // Only ASCII STL can hold several objects, so a mesh of several runs is written as that.
  Result<MeshWriteReport> write() {
    ARETE_CHECK(runs_.runs.size() > 1 ? writeAscii() : writeBinary());
    return std::move(report_);
  }

 private:
  tl::unexpected<Error> refuse(std::string message) const {
    return failure(ErrorCode::invalidData, std::move(message), path_.string());
  }
  tl::unexpected<Error> interrupted() const {
    return failure(ErrorCode::interrupted, "writing was interrupted", path_.string());
  }

  Status writeBinary() {
    if (shape_.triangles.size() > std::numeric_limits<std::uint32_t>::max())
      return refuse(
          fmt::format("{} triangles are more than the 32-bit count of an STL", shape_.triangles.size()));
    const std::string header = takeHeader();
    // Positions are checked before the file is created, so that a refusal leaves an older file alone.
    constexpr double kLargest = std::numeric_limits<float>::max();
    for (const Vec3& p : shape_.positions)
      if (!(std::abs(p.x - origin_.x) <= kLargest && std::abs(p.y - origin_.y) <= kLargest &&
            std::abs(p.z - origin_.z) <= kLargest))
        return refuse(fmt::format("the position {}, {}, {} does not fit 32-bit floats", p.x, p.y, p.z));
    findFacetAttribute();
    ARETE_TRY(FileWriter file, FileWriter::create(path_));

    file.write(header);
    putBytes(file.reserve(sizeof(std::uint32_t)), static_cast<std::uint32_t>(shape_.triangles.size()));
    for (std::size_t t = 0; t < shape_.triangles.size(); ++t) {
      if (t % kStlTrianglesPerCancelCheck == 0) {
        context_.report("writing the mesh",
                        static_cast<double>(t) / static_cast<double>(shape_.triangles.size()));
        if (context_.cancelled()) return interrupted();
      }
      // The normal is computed from the rounded corners: it belongs to the triangle that readers see.
      std::array<std::array<float, 3>, 3> rounded;
      std::array<Vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& p = shape_.positions[shape_.triangles[t][k]];
        rounded[k] = {static_cast<float>(p.x - origin_.x), static_cast<float>(p.y - origin_.y),
                      static_cast<float>(p.z - origin_.z)};
        corners[k] = {rounded[k][0], rounded[k][1], rounded[k][2]};
      }
      char* to = putBytes(file.reserve(kStlRecordSize), normalOf(corners));
      putBytes(putBytes(to, rounded), wordOf(t));
    }
    ARETE_CHECK(file.finish());
    flattened_ = countFlattened(shape_, [&](std::uint32_t v) {
      const Vec3& p = shape_.positions[v];
      return std::array<float, 3>{static_cast<float>(p.x - origin_.x), static_cast<float>(p.y - origin_.y),
                                  static_cast<float>(p.z - origin_.z)};
    });
    nameBinaryLosses();
    return {};
  }

  /// Chooses the origin too.
  std::string takeHeader() {
    const bool hasOrigin = options_.up == MeshUp::z || options_.origin.has_value();
    std::string header;
    if (options_.metresAbout) {
      header = fmt::format("{}{}", kStlMetresKey, metresAboutText(*options_.metresAbout));
      // A number that is cut off would be another place.
      if (header.size() > kStlHeaderSize) header = "STL of arete";
    } else if (hasOrigin) {
      origin_ = options_.origin.value_or(localOrigin(shape_.positions));
      header = originHeader(origin_);
      if (header.size() > kStlHeaderSize) {
        origin_ = {std::round(origin_.x), std::round(origin_.y), std::round(origin_.z)};
        header = originHeader(origin_);
      }
    } else if (!mesh_.objects.empty()) {
      const std::string name = nameOnOneLine(mesh_.objects[0]);
      header = (std::string(kStlObjectKey) + name).substr(0, kStlHeaderSize);
      isNameHeld_ =
          header.size() == kStlObjectKey.size() + mesh_.objects[0].size() && name == mesh_.objects[0];
    } else {
      header = "STL of arete";
    }
    header.resize(kStlHeaderSize, ' ');
    return header;
  }

  // A column with the words of the file goes back unchanged, and takes precedence over colours, which would
  // be packed into the same two bytes.
  void findFacetAttribute() {
    for (const Attribute& a : mesh_.triangleAttributes) {
      if (a.name == "attribute" && a.type == ScalarType::uint16 && a.components == 1) words_ = &a;
      if (a.name == kColorName && a.meaning == AttributeMeaning::color &&
          a.colorSpace != ColorSpace::linear && a.components >= 3 && a.components <= 4)
        colors_ = &a;
    }
    if (words_) colors_ = nullptr;
  }

  std::uint16_t wordOf(std::size_t triangle) {
    if (words_) return static_cast<std::uint16_t>(words_->numbers(triangle)[0]);
    if (!colors_) return 0;
    std::vector<double> color = colors_->numbers(triangle);
    for (double& number : color) number = fractionOf(*colors_, number);
    isAlphaLost_ = isAlphaLost_ || (color.size() == 4 && color[3] != 1);
    return facetWord(color, isColorRounded_);
  }

  /// What the format could not hold is listed for the user, and only where this mesh has it.
  void nameBinaryLosses() {
    report_.lost = lossesOf(
        mesh_, {.triangleAttribute = [&](const Attribute& a) { return &a == words_ || &a == colors_; },
                .objects = isNameHeld_});
    if (isColorRounded_) report_.lost.push_back("colours of faces finer than 5 bits");
    if (isAlphaLost_) report_.lost.push_back("alpha of the colours of faces");
    if (flattened_ > 0) report_.lost.push_back(flattenedLoss(flattened_));
  }

  // A run without an object has no name; the ASCII format takes a bare "solid". The lists of what is lost
  // follow the file, as the file itself has succeeded by then.
  Status writeAscii() {
    WriteProgress progress(shape_.triangles.size() + runs_.runs.size(), path_.string(), context_);
    ARETE_TRY(FileWriter file, FileWriter::create(path_));
    for (const ObjectRun& run : runs_.runs) {
      if (progress.shouldStop()) return interrupted();
      const std::string name =
          run.object == MeshAttributes::kNone ? std::string() : nameOnOneLine(mesh_.objects[run.object]);
      const std::string behind = name.empty() ? "\n" : " " + name + "\n";
      file.write("solid" + behind);
      for (std::size_t t = run.first; t < run.end; ++t) {
        if (progress.shouldStop()) return interrupted();
        writeFacet(file, t);
      }
      file.write("endsolid" + behind);
    }
    ARETE_CHECK(file.finish());
    report_.lost = lossesOf(mesh_, {.objects = true});
    if (std::ranges::any_of(mesh_.objects,
                            [](const std::string& name) { return nameOnOneLine(name) != name; }))
      report_.lost.push_back("line breaks and blanks at the ends of names");
    if (runs_.areDivided) report_.lost.push_back("objects whose faces are apart in the file");
    if (std::ranges::any_of(runs_.runs,
                            [](const ObjectRun& run) { return run.object == MeshAttributes::kNone; }))
      report_.lost.push_back("faces of no object");
    return {};
  }

  /// Numbers have the shortest digits that give the same number, so ASCII keeps doubles to the bit.
  void writeFacet(FileWriter& file, std::size_t t) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = shape_.positions[shape_.triangles[t][k]];
    const std::array<float, 3> n = normalOf(corners);
    facet_.clear();
    const auto to = std::back_inserter(facet_);
    fmt::format_to(to, FMT_COMPILE(" facet normal {} {} {}\n  outer loop\n"), n[0], n[1], n[2]);
    for (const Vec3& p : corners) fmt::format_to(to, FMT_COMPILE("   vertex {} {} {}\n"), p.x, p.y, p.z);
    fmt::format_to(to, FMT_COMPILE("  endloop\n endfacet\n"));
    file.write({facet_.data(), facet_.size()});
  }

  const TriangleMesh& shape_;
  const MeshAttributes& mesh_;
  const std::filesystem::path& path_;
  const MeshWriteOptions& options_;
  const RunContext& context_;
  ObjectRuns runs_;
  Vec3 origin_;
  const Attribute* words_ = nullptr;
  const Attribute* colors_ = nullptr;
  std::uint64_t flattened_ = 0;
  bool isNameHeld_ = false, isColorRounded_ = false, isAlphaLost_ = false;
  fmt::memory_buffer facet_;
  MeshWriteReport report_;
};

}  // namespace

Result<MeshWriteReport> writeStl(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  if (const Status ok = mesh.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  return StlWriter(mesh, path, options, context).write();
}

}  // namespace arete
