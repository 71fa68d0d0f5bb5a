// SPDX-License-Identifier: GPL-3.0-or-later
//
// One pass over the text, line by line. "v", "vt", "vn" and "f" lines are scanned by hand. A line that ends
// in a backslash continues in the next one (these only: in comments and names a backslash is a backslash). A
// face may name vertices that come later, so the largest index is kept with its line and checked at the end;
// what it names of texture coordinates and normals is sorted out by ObjCorners, and materials by
// ObjMaterials.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/counted.h"
#include "io/files/file_bytes.h"
#include "io/files/text_scan.h"
#include "io/formats/common/text_reader.h"
#include "io/formats/obj/corners.h"
#include "io/formats/obj/libraries.h"
#include "io/formats/obj/obj.h"
#include "io/formats/obj/vertices.h"

namespace arete {

namespace {

/// What the faces of a file have in common until another line changes it: the object, group, material,
/// smoothing group. Listed by face from the first face on that has one.
template <class Value>
class State {
 public:
  State(std::vector<Value>& byFace, Value none) : byFace_(byFace), none_(none), now_(none) {}
  void set(Value value) { now_ = value; }
  /// Call for every face, with its number.
  void takeFace(std::uint64_t face) {
    if (byFace_.empty() && now_ == none_) return;
    byFace_.resize(face, none_);
    byFace_.push_back(now_);
  }

 private:
  std::vector<Value>& byFace_;
  Value none_, now_;
};

class ObjReader final : public MeshTextReader {
 public:
  ObjReader(const FileBytes& file, const std::filesystem::path& path, const RunContext& context)
      : MeshTextReader(file, path.string(), context), context_(context) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error))
      folder_ = path.has_parent_path() ? path.parent_path() : ".";
  }

 private:
  Status readLine() override {
    while (at() < end() && text::isBlank(*at())) ++at();
    if (at() == end() || *at() == '\n') return {};
    const char* word = at();
    if (*at() == '#') {
      at() = lineEnd();
      takeComment(std::string_view(word + 1, static_cast<std::size_t>(at() - word - 1)));
      return {};
    }
    while (at() < end() && !text::isSpace(*at())) ++at();
    const std::string_view keyword(word, static_cast<std::size_t>(at() - word));
    if (keyword == "v") return readVertex(word);
    if (keyword == "f" || keyword == "fo") return readFace(word);
    if (keyword == "vt") return readTexcoord(word);
    if (keyword == "vn") return readNormal(word);
    if (!isKeyword(keyword))
      return corrupt(word, fmt::format("begins with {}: unknown OBJ keyword", text::quotedToken(keyword)));
    readStatement(keyword);
    at() = lineEnd();
    return {};
  }

  /// A statement of names.
  void readStatement(std::string_view keyword) {
    const char* from = at();
    const char* to = lineEnd();
    while (from < to && text::isBlank(*from)) ++from;
    while (to > from && text::isBlank(to[-1])) --to;
    const std::string_view rest(from, static_cast<std::size_t>(to - from));
    if (keyword == "o") {
      object_.set(static_cast<std::uint32_t>(mesh().mesh.objects.size()));
      mesh().mesh.objects.emplace_back(rest);
    } else if (keyword == "g") {
      group_.set(groupNamed(rest));
    } else if (keyword == "s") {
      smoothing_.set(smoothingGroup(rest));
    } else if (keyword == "usemtl") {
      material_.set(materials_.use(rest));
    } else if (keyword == "mtllib") {
      materials_.addLibrary(rest);
    } else {
      leaveOut(keyword);
    }
  }

  std::uint32_t groupNamed(std::string_view name) {
    if (name.empty()) return MeshAttributes::kNone;
    auto& groups = mesh().mesh.groups;
    const auto known = groups_.find(name);
    if (known != groups_.end()) return known->second;
    const auto number = static_cast<std::uint32_t>(groups.size());
    groups.emplace_back(name);
    groups_.emplace(name, number);
    return number;
  }

  static std::int32_t smoothingGroup(std::string_view text) {
    std::int32_t group = 0;
    const auto [behind, error] = std::from_chars(text.data(), text.data() + text.size(), group);
    if (error == std::errc{}) return group;
    return text == "on" ? 1 : 0;
  }

  /// Moves to the next word of the line. False at its end.
  bool toNextWord() {
    const char*& p = at();
    while (p < end()) {
      if (text::isBlank(*p)) {
        ++p;
        continue;
      }
      if (*p == '\\') {
        const char* next = p + 1;
        if (next < end() && *next == '\r') ++next;
        if (next < end() && *next == '\n') {
          p = next + 1;
          continue;
        }
      }
      // Some writers put comments behind the numbers.
      return *p != '\n' && *p != '#';
    }
    return false;
  }

  tl::unexpected<Error> refuseNumber(const char* line) const {
    return corrupt(line, "has a coordinate that is not finite");
  }

  Status readVertex(const char* line) {
    double xyz[3];
    for (double& value : xyz)
      if (!toNextWord() || !text::scanNumber(at(), end(), value))
        return corrupt(line, "is a vertex without three numbers");
    if (!std::isfinite(xyz[0]) || !std::isfinite(xyz[1]) || !std::isfinite(xyz[2])) {
      // No fault unless a face uses it; an earlier one may.
      const auto vertex = static_cast<std::int64_t>(mesh().mesh.positions.size());
      if (largestIndex_ > vertex) return refuseNumber(line);
      unusable_.emplace(vertex, line);
    }
    // A weight or a colour may follow.
    std::array<double, 8> more;
    std::size_t count = 0;
    for (double value; toNextWord();) {
      if (!text::scanNumber(at(), end(), value))
        return corrupt(line, "is a vertex with a value that is not a number");
      if (count < more.size()) more[count++] = value;
    }
    if (count > 0 || hasExtras_) {
      hasExtras_ = true;
      extras_.add(mesh().mesh.positions.size(), {more.data(), count});
    }
    mesh().mesh.positions.push_back({xyz[0], xyz[1], xyz[2]});
    at() = lineEnd();
    return {};
  }

  /// Reads a number as exporters write it: "-nan(ind)" and "1.#QNAN" too. What is not finite is 0.
  bool readLooseNumber(double& value) {
    const char* const from = at();
    if (text::scanNumber(at(), end(), value)) {
      notFinite_ += !std::isfinite(value);
      if (!std::isfinite(value)) value = 0;
      return true;
    }
    while (at() < end() && !text::isSpace(*at())) ++at();
    const std::string word = text::lowered({from, static_cast<std::size_t>(at() - from)});
    ++notFinite_;
    value = 0;
    return word.find("nan") != std::string::npos || word.find("#i") != std::string::npos ||
           word.find("inf") != std::string::npos;
  }

  Status readTexcoord(const char* line) {
    std::array<double, 3> uvw;
    std::size_t count = 0;
    for (; count < uvw.size() && toNextWord(); ++count)
      if (!readLooseNumber(uvw[count])) return corrupt(line, "has texture coordinates that are no numbers");
    if (count == 0) return corrupt(line, "has no texture coordinates");
    if (corners_.texcoordCount() == MeshAttributes::kNone)
      return unsupported("holds more texture coordinates than an index can name");
    corners_.addTexcoord({uvw.data(), count});
    at() = lineEnd();
    return {};
  }

  Status readNormal(const char* line) {
    std::array<double, 3> xyz;
    for (double& value : xyz)
      if (!toNextWord() || !readLooseNumber(value)) return corrupt(line, "is a normal without three numbers");
    if (corners_.normalCount() == MeshAttributes::kNone)
      return unsupported("holds more normals than an index can name");
    corners_.addNormal(xyz);
    at() = lineEnd();
    return {};
  }

  /// Reads "/b" or "/c" of a corner; where it names none, or none of those so far, `to` is
  /// MeshAttributes::kNone or beyond.
  bool readSecondIndex(std::uint32_t known, std::uint32_t& to) {
    const char*& p = at();
    to = MeshAttributes::kNone;
    if (p == end() || *p != '/') return true;
    ++p;
    if (p == end() || text::isSpace(*p) || *p == '/') return true;
    std::int64_t index = 0;
    const auto [behind, error] = std::from_chars(p, end(), index);
    if (error == std::errc::invalid_argument) return false;
    p = behind;
    if (error != std::errc{}) index = std::numeric_limits<std::int64_t>::max();
    if (index < 0) index = index < -std::int64_t{known} ? MeshAttributes::kNone : index + known + 1;
    // 0 is what some exporters write for none.
    if (index > 0)
      to = static_cast<std::uint32_t>(std::min<std::int64_t>(index - 1, MeshAttributes::kNone - 1));
    return true;
  }

  Status readFace(const char* line) {
    faceCorners_.clear();
    bool namesMore = false;
    while (toNextWord()) {
      const char*& p = at();
      std::int64_t index = 0;
      const auto [behind, error] = std::from_chars(p, end(), index);
      if (error != std::errc{}) return corrupt(line, "is a face with a corner that is not a number");
      p = behind;
      ObjCorners::Corner corner;
      if (!readSecondIndex(corners_.texcoordCount(), corner.texcoord) ||
          !readSecondIndex(corners_.normalCount(), corner.normal) || (p < end() && !text::isSpace(*p)))
        return corrupt(line, "is a face with a corner that is not of the form a/b/c");
      const auto known = static_cast<std::int64_t>(mesh().mesh.positions.size());
      // A negative index counts back from the last vertex so far.
      if (index < 0) index += known + 1;
      if (index < 1 || index > std::int64_t(std::numeric_limits<std::uint32_t>::max()))
        return corrupt(line, "is a face with a vertex index out of range");
      if (const auto found = unusable_.find(index - 1); found != unusable_.end())
        return refuseNumber(found->second);
      if (index > largestIndex_) {
        largestIndex_ = index;
        largestIndexLine_ = line;
      }
      corner.vertex = static_cast<std::uint32_t>(index - 1);
      namesMore =
          namesMore || corner.texcoord != MeshAttributes::kNone || corner.normal != MeshAttributes::kNone;
      faceCorners_.push_back(corner);
    }
    // A face with fewer than three corners is counted but gets no triangle; addFace() numbers it like the
    // others.
    if (faceCorners_.size() < 3 && shortFaces_++ == 0) firstShortFace_ = faces().size() + 1;
    addFace(namesMore);
    at() = lineEnd();
    return corners_.wedgeCount() < MeshAttributes::kNone
               ? Status()
               : unsupported("holds more corners than an index can name");
  }

  void addFace(bool namesMore) {
    const std::uint64_t face = faces().size();
    object_.takeFace(face);
    group_.takeFace(face);
    material_.takeFace(face);
    smoothing_.takeFace(face);
    // The first corner that names more than a vertex gives wedges to all faces, those before it included.
    if (namesMore && !corners_.hasWedges()) corners_.begin(mesh().mesh);
    vertices_.clear();
    wedges_.clear();
    for (const ObjCorners::Corner& corner : faceCorners_) {
      vertices_.push_back(corner.vertex);
      if (corners_.hasWedges() && faceCorners_.size() > 2) wedges_.push_back(corners_.wedgeOf(corner));
    }
    faces().add(mesh().mesh, vertices_, wedges_);
  }

  Status finish() override {
    MeshFile& file = mesh();
    const TriangleMesh& read = file.mesh;
    if (largestIndex_ > std::int64_t(read.positions.size()))
      return corrupt(largestIndexLine_,
                     fmt::format("names vertex {} of {}", largestIndex_, read.positions.size()));
    // A mesh without content is valid only in a file that Arete has written.
    if (!isOurs() && read.positions.empty()) return failure(ErrorCode::corrupt, "holds no vertex", path());
    if (read.triangles.empty() && !unusable_.empty()) return refuseNumber(unusable_.begin()->second);
    if (!isOurs() && read.triangles.empty()) return unsupported("holds no face");
    if (read.positions.size() >= std::numeric_limits<std::uint32_t>::max())
      return unsupported("holds more vertices than an index can name");
    if (hasExtras_) extras_.finish(file);
    corners_.finish(file);
    if (!smoothingOf_.empty()) addSmoothing();
    warn();
    if (const Status ok = materials_.finish(file, folder_, context_); !ok)
      return failure(ok.error().code, ok.error().message, path());
    return {};
  }

  void addSmoothing() {
    Attribute groups{.name = "smoothing_group", .type = ScalarType::int32};
    const auto* const first = reinterpret_cast<const std::byte*>(smoothingOf_.data());
    groups.values.assign(first, first + smoothingOf_.size() * sizeof(std::int32_t));
    mesh().mesh.triangleAttributes.push_back(std::move(groups));
  }

  void warn() {
    Warnings& warnings = mesh().warnings;
    if (shortFaces_ > 0)
      warnings.push_back(
          {WarningCode::omitted, fmt::format("{} of its {} {} fewer than three corners and {} left out (the "
                                             "first is face {})",
                                             shortFaces_, counted(faces().size(), "face", "faces"),
                                             agreeing(shortFaces_, "has", "have"),
                                             agreeing(shortFaces_, "is", "are"), firstShortFace_)});
    if (notFinite_ > 0)
      warnings.push_back(
          {WarningCode::completed,
           counted(notFinite_, "number of texture coordinates and normals is not finite and counts as 0",
                   "numbers of texture coordinates and normals are not finite and count as 0")});
    warnOfLeftOut("statements");
  }

  const RunContext& context_;
  std::filesystem::path folder_;
  ObjVertexExtras extras_;
  bool hasExtras_ = false;
  ObjCorners corners_;
  ObjMaterials materials_;
  std::vector<ObjCorners::Corner> faceCorners_;  // of the face that is being read
  std::vector<std::uint32_t> vertices_, wedges_;
  std::map<std::string, std::uint32_t, std::less<>> groups_;
  std::vector<std::int32_t> smoothingOf_;
  State<std::uint32_t> object_{mesh().mesh.objectOf, MeshAttributes::kNone},
      group_{mesh().mesh.groupOf, MeshAttributes::kNone},
      material_{mesh().mesh.materialOf, MeshAttributes::kNone};
  State<std::int32_t> smoothing_{smoothingOf_, 0};
  std::uint64_t notFinite_ = 0, shortFaces_ = 0, firstShortFace_ = 0;
  std::int64_t largestIndex_ = 0;
  std::map<std::int64_t, const char*> unusable_;  // by vertex, from 0: lines with numbers that are not finite
  const char* largestIndexLine_ = nullptr;
};

}  // namespace

Result<MeshFile> readObj(const std::filesystem::path& path, const RunContext& context) {
  ARETE_TRY(const FileBytes file, FileBytes::readText(path));
  return ObjReader(file, path, context).read();
}

}  // namespace arete
