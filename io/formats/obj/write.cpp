// SPDX-License-Identifier: GPL-3.0-or-later
//
// A "v" line for each vertex, "vt" and "vn" lines for the distinct values of wedges or vertices, then an "f"
// line for each triangle. The lines that say what the next faces belong to ("o", "g", "usemtl", "s") are
// written where that changes. Numbers have the shortest digits that give the same number of their type.
#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "io/files/file_writer.h"
#include "io/files/no_file.h"
#include "io/files/write_progress.h"
#include "io/formats/common/comments.h"
#include "io/formats/common/losses.h"
#include "io/formats/common/object_runs.h"
#include "io/formats/common/text_numbers.h"
#include "io/formats/common/text_reader.h"
#include "io/formats/obj/library_file.h"
#include "io/formats/obj/mtl.h"
#include "io/formats/obj/obj.h"
#include "io/formats/obj/vertices.h"

namespace arete {

namespace {

using Line = fmt::memory_buffer;

const Attribute* attributeNamed(const std::vector<Attribute>& attributes, std::string_view name, int fewest,
                                int most) {
  const auto found = std::ranges::find_if(attributes, [&](const Attribute& a) {
    return a.name == name && a.components >= fewest && a.components <= most;
  });
  return found == attributes.end() ? nullptr : &*found;
}

/// Appends " 0.5", with the digits of the attribute's type; what is not finite as 0.
void appendNumber(Line& line, double number, bool isFloat32) {
  if (!std::isfinite(number)) number = 0;
  if (isFloat32)
    fmt::format_to(std::back_inserter(line), FMT_COMPILE(" {}"), static_cast<float>(number));
  else
    fmt::format_to(std::back_inserter(line), FMT_COMPILE(" {}"), number);
}

/// The "vt" or "vn" lines of an attribute, and which of them the corners name.
class Values {
 public:
  /// @param attribute may be null: none.
  Values(const Attribute* attribute, bool isOfWedges, std::string_view keyword)
      : attribute_(attribute), isOfWedges_(isOfWedges) {
    if (!attribute) return;
    isFloat32_ = hasFloat32Digits(*attribute);
    const bool isNormal = keyword == "vn";
    std::unordered_map<std::string, std::uint32_t> known;
    indices_.resize(attribute->elementCount(), MeshAttributes::kNone);
    bool isAnyZero = false;
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      const std::string values = textOf(i, isNormal);
      if (isNormal && values == " 0 0 0") {
        isAnyZero = true;
        continue;
      }
      indices_[i] = add(known, values, keyword);
    }
    // A normal of zeros is the gap that a reader has filled, unless there is nothing else.
    if (isAnyZero && known.empty()) std::ranges::fill(indices_, add(known, " 0 0 0", keyword));
  }

  const std::string& text() const { return text_; }
  bool isLossy() const { return hasInfinite_; }

  /// 0: the corner names none.
  std::uint64_t indexOf(std::uint32_t vertex, std::uint32_t wedge) const {
    if (!attribute_) return 0;
    const std::uint32_t index = indices_[isOfWedges_ ? wedge : vertex];
    return index == MeshAttributes::kNone ? 0 : std::uint64_t{index} + 1;
  }

 private:
  std::string textOf(std::size_t element, bool isNormal) {
    Line line;
    const std::vector<double> numbers = attribute_->numbers(element);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double number = fractionOf(*attribute_, numbers[i]);
      hasInfinite_ = hasInfinite_ || !std::isfinite(number);
      const bool isTurned = i == 1 && !isNormal && attribute_->isFromTop;
      appendNumber(line, isTurned ? 1 - number : number, isFloat32_);
    }
    if (numbers.size() == 1) appendNumber(line, 0, true);
    std::string text = fmt::to_string(line);
    return isNormal && text.find_first_not_of(" -0") == std::string::npos ? " 0 0 0" : text;
  }

  std::uint32_t add(std::unordered_map<std::string, std::uint32_t>& known, const std::string& values,
                    std::string_view keyword) {
    const auto [at, isNew] = known.emplace(values, static_cast<std::uint32_t>(known.size()));
    if (isNew) {
      text_ += keyword;
      text_ += values;
      text_ += '\n';
    }
    return at->second;
  }

  const Attribute* attribute_;
  bool isOfWedges_;
  bool hasInfinite_ = false;
  bool isFloat32_ = false;              // the digits
  std::vector<std::uint32_t> indices_;  // by element
  std::string text_;
};

std::uint32_t valueAt(const std::vector<std::uint32_t>& list, std::size_t t) {
  return list.empty() ? MeshAttributes::kNone : list[t];
}

/// The lines that say what the next faces belong to, but for their object.
class States {
 public:
  States(const MeshAttributes& mesh, std::span<const std::string> materials)
      : mesh_(mesh), materials_(materials) {
    smoothing_ = attributeNamed(mesh.triangleAttributes, "smoothing_group", 1, 1);
    if (smoothing_ && isFloat(smoothing_->type)) smoothing_ = nullptr;
    for (const std::string& name : mesh.groups) groups_.push_back(nameOnOneLine(name));
  }

  const Attribute* smoothing() const { return smoothing_; }

  /// The groups without triangles, for their names.
  std::string emptyGroups() const {
    std::vector<bool> isUsed(groups_.size());
    for (const std::uint32_t group : mesh_.groupOf)
      if (group != MeshAttributes::kNone) isUsed[group] = true;
    std::string text;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (!isUsed[g] && !groups_[g].empty()) text += fmt::format("g {}\n", groups_[g]);
    return text;
  }

  /// The lines before a triangle.
  void appendChanges(std::string& text, std::size_t t) {
    if (const std::uint32_t group = valueAt(mesh_.groupOf, t); group != group_)
      text += (group_ = group) == MeshAttributes::kNone ? "g\n" : fmt::format("g {}\n", groups_[group]);
    if (const std::uint32_t material = valueAt(mesh_.materialOf, t); material != material_)
      text += (material_ = material) == MeshAttributes::kNone
                  ? "usemtl\n"
                  : fmt::format("usemtl {}\n", materials_[material]);
    if (!smoothing_) return;
    if (const double group = smoothing_->numbers(t)[0]; group != smoothingGroup_)
      text += (smoothingGroup_ = group) == 0 ? "s off\n" : fmt::format("s {}\n", group);
  }

 private:
  const MeshAttributes& mesh_;
  std::span<const std::string> materials_;
  std::vector<std::string> groups_;
  const Attribute* smoothing_ = nullptr;
  std::uint32_t group_ = MeshAttributes::kNone, material_ = MeshAttributes::kNone;
  double smoothingGroup_ = 0;
};

/// What of the names of a mesh a line cannot hold.
void nameLostNames(const MeshAttributes& mesh, std::vector<std::string>& lost) {
  const auto isChanged = [](const std::string& name) { return nameOnOneLine(name) != name; };
  if (std::ranges::any_of(mesh.objects, isChanged) || std::ranges::any_of(mesh.groups, isChanged))
    lost.push_back("line breaks and blanks at the ends of names");
  std::set<std::string> names;
  for (const std::string& group : mesh.groups)
    if (const std::string name = nameOnOneLine(group); name.empty() || !names.insert(name).second) {
      lost.push_back("groups without a name of their own");
      return;
    }
}

/// Faces refer to the lines before them by number, so vertices and values are written first, each list as a
/// whole.
class ObjWriter {
 public:
  ObjWriter(MeshRef mesh, const std::filesystem::path& path, const MeshWriteOptions& options,
            const RunContext& context)
      : shape_(mesh.shape),
        mesh_(mesh.attributes),
        path_(path),
        options_(options),
        names_(mtlNames(mesh_.materials)),
        runs_(mesh),
        progress_(shape_.positions.size() + shape_.triangles.size(), path.string(), context) {}

  Result<MeshWriteReport> write() {
    const bool isFile = !isNoFile(path_);
    color_ = attributeNamed(mesh_.vertexAttributes, kColorName, 3, 4);
    const Attribute* const wedgeTexcoord = attributeNamed(mesh_.wedgeAttributes, kTexcoordName, 1, 3);
    const Attribute* const wedgeNormal = attributeNamed(mesh_.wedgeAttributes, kNormalName, 3, 3);
    const Attribute* const texcoord =
        wedgeTexcoord ? wedgeTexcoord : attributeNamed(mesh_.vertexAttributes, kTexcoordName, 1, 3);
    const Attribute* const normal =
        wedgeNormal ? wedgeNormal : attributeNamed(mesh_.vertexAttributes, kNormalName, 3, 3);
    const auto isWritten = [&](const Attribute& a) { return &a == color_ || &a == texcoord || &a == normal; };
    States states(mesh_, names_);
    report_.lost =
        lossesOf(mesh_, {.vertexAttribute = isWritten,
                         .wedgeAttribute = isWritten,
                         .triangleAttribute = [&](const Attribute& a) { return &a == states.smoothing(); },
                         .objects = true,
                         .groups = true,
                         .materials = isFile,
                         .pictures = isFile});
    std::string library;
    if (isFile && !mesh_.materials.empty()) {
      ARETE_TRY(ObjLibraryFile written, writeObjLibrary(mesh_, names_, path_, options_.pictureFolder));
      library = written.name;
      report_.filesBeside = std::move(written.filesBeside);
      report_.lost.insert(report_.lost.end(), written.lost.begin(), written.lost.end());
    }

    // Nothing of the mesh's own file is written before the library has been, whose name stands in it.
    ARETE_TRY(FileWriter file, FileWriter::create(path_));
    file.write(fmt::format("# {}\n", kMeshTextGenerator));
    file.write(meshComments(options_));
    if (!library.empty()) file.write(fmt::format("mtllib {}\n", library));
    if (!writeVertices(file)) return progress_.interrupted();
    const Values texcoords(texcoord, wedgeTexcoord != nullptr, "vt"),
        normals(normal, wedgeNormal != nullptr, "vn");
    file.write(texcoords.text());
    file.write(normals.text());
    // A mesh without anything but its shape is written by a loop of its own, which looks nothing up.
    const bool isPlain = !texcoord && !normal && mesh_.objects.empty() && mesh_.groups.empty() &&
                         mesh_.materials.empty() && mesh_.triangleAttributes.empty();
    if (!(isPlain ? writePlainFaces(file) : writeFaces(file, texcoords, normals, states)))
      return progress_.interrupted();
    file.write(fmt::format("# {}\n", kMeshTextEnd));
    ARETE_CHECK(file.finish());
    nameLosses(texcoords.isLossy() || normals.isLossy());
    return std::move(report_);
  }

 private:
  bool writeVertices(FileWriter& file) {
    char line[128];  // three doubles of at most 24 characters each
    Line color;
    for (std::size_t v = 0; v < shape_.positions.size(); ++v) {
      if (progress_.shouldStop()) return false;
      const Vec3& p = shape_.positions[v];
      char* end = fmt::format_to(line, FMT_COMPILE("v {} {} {}"), p.x, p.y, p.z);
      if (color_) {
        file.write({line, static_cast<std::size_t>(end - line)});
        color.clear();
        appendColor(color, v);
        color.push_back('\n');
        file.write({color.data(), color.size()});
        continue;
      }
      *end++ = '\n';
      file.write({line, static_cast<std::size_t>(end - line)});
    }
    return true;
  }

  /// Programs read the colours behind a vertex as sRGB between 0 and 1; what cannot be said so is counted as
  /// lost.
  void appendColor(Line& line, std::size_t vertex) {
    const std::vector<double> numbers = color_->numbers(vertex);
    for (std::size_t i = 0; i < 3; ++i) {
      const ObjColorNumber number = objColorNumber(*color_, numbers[i]);
      hasInfiniteColor_ = hasInfiniteColor_ || !std::isfinite(number.value);
      appendNumber(line, number.value, number.isFloat32);
    }
    if (numbers.size() == 4 && objAlphaOf(*color_, numbers[3]) != 1) isAlphaLost_ = true;
  }

  bool writePlainFaces(FileWriter& file) {
    char line[64];
    for (const auto& t : shape_.triangles) {
      if (progress_.shouldStop()) return false;
      const char* end = fmt::format_to(line, FMT_COMPILE("f {} {} {}\n"), std::uint64_t{t[0]} + 1,
                                       std::uint64_t{t[1]} + 1, std::uint64_t{t[2]} + 1);
      file.write({line, static_cast<std::size_t>(end - line)});
    }
    return true;
  }

  // A run of faces without an object follows one with a name only behind an "o" line without one, since an
  // object goes on until the next.
  bool writeFaces(FileWriter& file, const Values& texcoords, const Values& normals, States& states) {
    for (const ObjectRun& run : runs_.runs) {
      if (run.object != MeshAttributes::kNone)
        file.write(objectLine(mesh_.objects[run.object]));
      else if (run.first > 0)
        file.write(objectLine({}));
      for (std::size_t t = run.first; t < run.end; ++t) {
        if (progress_.shouldStop()) return false;
        writeFace(file, t, texcoords, normals, states);
      }
    }
    file.write(states.emptyGroups());
    return true;
  }

  static std::string objectLine(const std::string& name) {
    const std::string text = nameOnOneLine(name);
    return text.empty() ? "o\n" : fmt::format("o {}\n", text);
  }

  // A line for each state that changes comes before the face. Numbers begin at 1, and 0 stands for a value
  // that is not there.
  void writeFace(FileWriter& file, std::size_t t, const Values& texcoords, const Values& normals,
                 States& states) {
    changes_.clear();
    states.appendChanges(changes_, t);
    file.write(changes_);
    face_.clear();
    face_.push_back('f');
    const auto to = std::back_inserter(face_);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = shape_.triangles[t][k],
                          w = mesh_.hasWedges() ? mesh_.wedges[t][k] : MeshAttributes::kNone;
      const std::uint64_t vertex = std::uint64_t{v} + 1, texcoord = texcoords.indexOf(v, w),
                          normal = normals.indexOf(v, w);
      if (texcoord == 0 && normal == 0)
        fmt::format_to(to, FMT_COMPILE(" {}"), vertex);
      else if (normal == 0)
        fmt::format_to(to, FMT_COMPILE(" {}/{}"), vertex, texcoord);
      else if (texcoord == 0)
        fmt::format_to(to, FMT_COMPILE(" {}//{}"), vertex, normal);
      else
        fmt::format_to(to, FMT_COMPILE(" {}/{}/{}"), vertex, texcoord, normal);
    }
    face_.push_back('\n');
    file.write({face_.data(), face_.size()});
  }

  void nameLosses(bool isAnyInfinite) {
    std::vector<std::string>& lost = report_.lost;
    nameLostNames(mesh_, lost);
    if (runs_.areDivided) lost.push_back("objects whose faces are apart in the file");
    if (runs_.isAnyBehind) lost.push_back("faces of no object behind those of one");
    if (isAlphaLost_) lost.push_back("alpha of vertex colours");
    if (isAnyInfinite || hasInfiniteColor_) lost.push_back("attributes that are not finite");
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (names_[i] != mesh_.materials[i].name) {
        lost.push_back("names of materials that are empty, have line breaks or are there twice");
        return;
      }
  }

  const TriangleMesh& shape_;
  const MeshAttributes& mesh_;
  const std::filesystem::path& path_;
  const MeshWriteOptions& options_;
  std::vector<std::string> names_;  // of materials
  ObjectRuns runs_;
  WriteProgress progress_;
  const Attribute* color_ = nullptr;
  bool isAlphaLost_ = false, hasInfiniteColor_ = false;
  Line face_;
  std::string changes_;
  MeshWriteReport report_;
};

}  // namespace

Result<MeshWriteReport> writeObj(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  if (const Status ok = mesh.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  return ObjWriter(mesh, path, options, context).write();
}

}  // namespace arete
