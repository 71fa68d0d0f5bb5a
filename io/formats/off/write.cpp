// SPDX-License-Identifier: GPL-3.0-or-later
//
// The keyword, the counts, a line per vertex, then a line per triangle. CRS and unit are comments. Every
// number has the shortest digits that give it back; a color that is a float has a point, since without one it
// would be a byte.
#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "io/files/file_writer.h"
#include "io/files/write_progress.h"
#include "io/formats/common/colors.h"
#include "io/formats/common/comments.h"
#include "io/formats/common/losses.h"
#include "io/formats/common/text_numbers.h"
#include "io/formats/common/text_reader.h"
#include "io/formats/off/keyword.h"
#include "io/formats/off/off.h"

namespace arete {

namespace {

bool isNormal(const Attribute& a) {
  return a.name == kNormalName && a.meaning == AttributeMeaning::normal && a.components == 3;
}
bool isColor(const Attribute& a) {
  return a.name == kColorName && a.meaning == AttributeMeaning::color &&
         (a.components == 3 || a.components == 4) &&
         (isFloat(a.type) || a.type == ScalarType::uint8 || a.type == ScalarType::uint16);
}
bool isTexcoord(const Attribute& a) {
  return a.name == kTexcoordName && a.meaning == AttributeMeaning::textureCoords && a.components == 2;
}

/// The attributes of vertices or faces of which an OFF has a place.
struct OffAttributes {
  const Attribute* normal = nullptr;
  const Attribute* color = nullptr;
  const Attribute* texcoord = nullptr;

  explicit OffAttributes(const std::vector<Attribute>& attributes) {
    for (const Attribute& a : attributes) {
      if (isNormal(a)) normal = &a;
      if (isColor(a)) color = &a;
      if (isTexcoord(a)) texcoord = &a;
    }
  }
};

/// A line, put together number by number.
class Line {
 public:
  void put(double number) { fmt::format_to(std::back_inserter(text_), FMT_COMPILE("{} "), number); }
  void put(float number) { fmt::format_to(std::back_inserter(text_), FMT_COMPILE("{} "), number); }
  void put(std::uint32_t number) { fmt::format_to(std::back_inserter(text_), FMT_COMPILE("{} "), number); }

  /// The element as fractions, with the shortest digits of float32 or of doubles.
  void putVector(const Attribute& attribute, std::size_t element, bool isFloat32) {
    const std::vector<double> numbers = attribute.numbers(element);
    for (std::size_t c = 0; c < numbers.size(); ++c) {
      const double fraction = fractionOf(attribute, numbers[c]);
      const double number = c == 1 && attribute.isFromTop ? 1 - fraction : fraction;
      if (isFloat32)
        put(static_cast<float>(number));
      else
        put(number);
    }
  }

  /// @param withAlpha adds one where the color has none.
  void putColor(const Attribute& color, std::size_t element, bool withAlpha) {
    std::vector<double> numbers = color.numbers(element);
    const bool areBytes = color.type == ScalarType::uint8;
    if (!areBytes)
      for (double& number : numbers) number = fractionOf(color, number);
    if (withAlpha && numbers.size() == 3) numbers.push_back(areBytes ? 255 : 1);
    for (const double number : numbers) {
      const std::size_t begin = text_.size();
      if (areBytes)
        put(static_cast<std::uint32_t>(number));
      else if (color.type == ScalarType::float32)
        put(static_cast<float>(number));
      else
        put(number);
      const std::string_view digits(text_.data() + begin, text_.size() - begin);
      if (areBytes || digits.find_first_of(".en") != std::string_view::npos) continue;
      text_.resize(text_.size() - 1);
      text_.append(std::string_view(".0 "));
    }
  }

  /// The line with its end, without the last blank. Call clear() before the next.
  std::string_view whole() {
    text_[text_.size() - 1] = '\n';
    return {text_.data(), text_.size()};
  }
  void clear() { text_.clear(); }

 private:
  fmt::memory_buffer text_;
};

/// The colors as sRGB.
const Attribute* asSrgb(const Attribute* color, std::optional<Attribute>& converted, bool& isRounded) {
  if (!color || color->colorSpace != ColorSpace::linear) return color;
  converted = toSrgb8(*color, isRounded);
  return &*converted;
}

}  // namespace

Result<MeshWriteReport> writeOff(MeshRef written, const std::filesystem::path& path,
                                 const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  if (const Status ok = written.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  ARETE_TRY(FileWriter file, FileWriter::create(path));

  OffAttributes vertices(written.attributes.vertexAttributes), faces(written.attributes.triangleAttributes);
  std::optional<Attribute> vertexColor, faceColor;
  bool isRounded = false;
  vertices.color = asSrgb(vertices.color, vertexColor, isRounded);
  faces.color = asSrgb(faces.color, faceColor, isRounded);

  file.write(fmt::format("{}{}{}OFF\n# {}\n", vertices.texcoord ? "ST" : "", vertices.color ? "C" : "",
                         vertices.normal ? "N" : "", kMeshTextGenerator));
  if (vertices.color && vertices.color->components == 3) file.write(fmt::format("# {}\n", kOffWithoutAlpha));
  file.write(meshComments(options));
  file.write(fmt::format("{} {} 0\n", mesh.positions.size(), mesh.triangles.size()));

  WriteProgress progress(mesh.positions.size() + mesh.triangles.size(), path.string(), context);
  Line line;
  const bool hasFloat32Normals = vertices.normal && hasFloat32Digits(*vertices.normal);
  const bool hasFloat32Texcoords = vertices.texcoord && hasFloat32Digits(*vertices.texcoord);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (progress.shouldStop()) return progress.interrupted();
    line.clear();
    const Vec3& p = mesh.positions[v];
    for (const double coordinate : {p.x, p.y, p.z}) line.put(coordinate);
    if (vertices.normal) line.putVector(*vertices.normal, v, hasFloat32Normals);
    if (vertices.color) line.putColor(*vertices.color, v, true);
    if (vertices.texcoord) line.putVector(*vertices.texcoord, v, hasFloat32Texcoords);
    file.write(line.whole());
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (progress.shouldStop()) return progress.interrupted();
    line.clear();
    line.put(3u);
    for (const std::uint32_t corner : mesh.triangles[t]) line.put(corner);
    if (faces.color) line.putColor(*faces.color, t, false);
    file.write(line.whole());
  }
  file.write(fmt::format("# {}\n", kMeshTextEnd));
  ARETE_CHECK(file.finish());

  MeshWriteReport report;
  report.lost = lossesOf(
      written.attributes,
      {.vertexAttribute = [](const Attribute& a) { return isNormal(a) || isColor(a) || isTexcoord(a); },
       .triangleAttribute = isColor});
  if (isRounded) report.lost.push_back("colours finer than 8 bits");
  return report;
}

}  // namespace arete
