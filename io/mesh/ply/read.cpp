// SPDX-License-Identifier: GPL-3.0-or-later
//
// The header lists the elements: their counts of records and the properties of a record. The whole file is in
// memory. Before an element is read, its stated count is checked against the bytes that are left, since each
// record needs a minimum of bytes. Memory is reserved only then, so it is at most a small multiple of the
// file's size.
//
// Every scalar is read as a double, which holds all PLY types exactly. The three encodings differ only in how
// the next scalar is found; the reader is a template over that.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "io/file/file_bytes.h"
#include "io/file/text_scan.h"
#include "io/mesh/faces.h"
#include "io/mesh/ply/header.h"
#include "io/mesh/ply/ply.h"

namespace arete {

namespace {

constexpr std::uint64_t kRecordsPerCancelCheck = 1 << 16;
constexpr std::size_t kLongestName = 40;

template <class T, bool kSwap>
double scalarAt(const char* at) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if constexpr (kSwap) std::ranges::reverse(bytes);
  return static_cast<double>(std::bit_cast<T>(bytes));
}

/// The next scalar of a binary file.
template <std::endian kOrder>
struct BinaryScalars {
  static constexpr bool kSwap = kOrder != std::endian::native;
  const char* at;
  const char* end;

  /// The least number of bytes of a scalar.
  static std::size_t leastSize(PlyType type) { return sizeOf(type); }

  bool next(PlyType type, double& value) {
    const std::size_t size = sizeOf(type);
    if (static_cast<std::size_t>(end - at) < size) return false;
    switch (type) {
      case PlyType::int8:
        value = scalarAt<std::int8_t, kSwap>(at);
        break;
      case PlyType::uint8:
        value = scalarAt<std::uint8_t, kSwap>(at);
        break;
      case PlyType::int16:
        value = scalarAt<std::int16_t, kSwap>(at);
        break;
      case PlyType::uint16:
        value = scalarAt<std::uint16_t, kSwap>(at);
        break;
      case PlyType::int32:
        value = scalarAt<std::int32_t, kSwap>(at);
        break;
      case PlyType::uint32:
        value = scalarAt<std::uint32_t, kSwap>(at);
        break;
      case PlyType::float32:
        value = scalarAt<float, kSwap>(at);
        break;
      case PlyType::float64:
        value = scalarAt<double, kSwap>(at);
        break;
    }
    at += size;
    return true;
  }
};

/// The next scalar of an ascii file: the next token. Line breaks count as blanks, since some writers break
/// long records.
struct TextScalars {
  const char* at;
  const char* end;

  static std::size_t leastSize(PlyType) { return 2; }  // a digit and a blank before it

  bool next(PlyType, double& value) {
    while (at < end && text::isSpace(*at)) ++at;
    return at < end && text::scanNumber(at, end, value);
  }
};

template <class Scalars>
class PlyReader {
 public:
  PlyReader(const FileBytes& file, const PlyHeader& header, const std::string& path,
            const RunContext& context)
      : file_(file),
        header_(header),
        path_(path),
        context_(context),
        scalars_{file.begin() + header.dataBegin, file.end()} {}

  /// Fills the mesh and, if every face has one, the errors of `file`.
  Status readInto(MeshFile& file) {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") vertexCount_ = element.count;
      if (!element.properties.empty()) records_ += element.count;
    }
    for (const PlyElement& element : header_.elements)
      if (Status ok = readElement(element); !ok) return ok;
    file.mesh = std::move(mesh_);
    file.triangleErrors = std::move(errors_);
    if (recordsWithMore_ > 0)
      file.warnings.push_back(fmt::format(
          "{} lines have more values than the header states; these are left out (the first is line "
          "{})",
          recordsWithMore_, lineWithMore_));
    if (const Status ok = faces_.finish(file, context_); !ok)
      return failure(ok.error().code, ok.error().message, path_);
    return {};
  }

 private:
  enum class Role : std::uint8_t { skip, x, y, z, indices, error };

  tl::unexpected<Error> corrupt(std::string message) const {
    if constexpr (std::is_same_v<Scalars, TextScalars>)
      message += fmt::format(" (line {})", text::lineOf(file_.begin(), scalars_.at));
    return failure(ErrorCode::corrupt, std::move(message), path_);
  }
  tl::unexpected<Error> corruptRecord(const PlyElement& element, std::uint64_t record,
                                      std::string_view what) const {
    return corrupt(fmt::format("{} {} of {} {}", text::printable(element.name, kLongestName), record,
                               element.count, what));
  }
  std::size_t left() const { return static_cast<std::size_t>(scalars_.end - scalars_.at); }

  std::vector<Role> rolesOf(const PlyElement& element) const {
    std::vector<Role> roles;
    for (const PlyProperty& p : element.properties) {
      Role role = Role::skip;
      if (element.name == "vertex" && !p.isList)
        role = p.name == "x" ? Role::x : p.name == "y" ? Role::y : p.name == "z" ? Role::z : Role::skip;
      if (element.name == "face" && p.isList && (p.name == "vertex_indices" || p.name == "vertex_index"))
        role = Role::indices;
      if (element.name == "face" && !p.isList && p.name == "error") role = Role::error;
      roles.push_back(role);
    }
    return roles;
  }

  Status readElement(const PlyElement& element) {
    const std::vector<Role> roles = rolesOf(element);
    const auto has = [&](Role role) { return std::ranges::count(roles, role) == 1; };
    const bool isVertex = element.name == "vertex", isFace = element.name == "face";
    if (element.count == 0) return {};
    if (isVertex && !(has(Role::x) && has(Role::y) && has(Role::z)))
      return failure(ErrorCode::corrupt, "the vertices do not have exactly one x, y and z", path_);
    if (isFace && !has(Role::indices))
      return failure(ErrorCode::corrupt, "the faces do not have exactly one list of vertex_indices", path_);
    if (element.properties.empty()) return {};

    // A polygon has at least three corners, each of which takes bytes.
    std::size_t leastSize = 0;
    for (std::size_t p = 0; p < roles.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      leastSize += Scalars::leastSize(property.isList ? property.countType : property.type);
      if (roles[p] == Role::indices) leastSize += 3 * Scalars::leastSize(property.type);
    }
    // In a text, the first token needs no blank before it.
    if (element.count > (left() + 1) / leastSize)
      return corrupt(
          fmt::format("is truncated: {} records of element {} do not fit into the {} bytes that are left",
                      element.count, text::quotedToken(element.name), left()));
    if (isVertex) mesh_.positions.reserve(element.count);
    if (isFace) mesh_.triangles.reserve(element.count);

    for (std::uint64_t record = 0; record < element.count; ++record) {
      if (record % kRecordsPerCancelCheck == 0) {
        context_.report("reading the mesh",
                        static_cast<double>(scalars_.at - file_.begin()) / double(file_.size()));
        if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", path_);
      }
      if (Status ok = readRecord(element, roles, isVertex, record); !ok) return ok;
      if constexpr (std::is_same_v<Scalars, TextScalars>) skipSurplus();
    }
    return {};
  }

  /// Skips the values that a line has beyond the properties of its record. Where there are fewer lines than
  /// records, several records share a line, and nothing is skipped.
  void skipSurplus() {
    const char* next = scalars_.at;
    while (next < scalars_.end && text::isBlank(*next)) ++next;
    if (next == scalars_.end || *next == '\n' || !everyRecordHasALine()) return;
    if (recordsWithMore_++ == 0) lineWithMore_ = text::lineOf(file_.begin(), next);
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

  Status readRecord(const PlyElement& element, const std::vector<Role>& roles, bool isVertex,
                    std::uint64_t record) {
    Vec3 position;
    std::optional<double> error;
    for (std::size_t p = 0; p < roles.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.isList) {
        if (Status ok = readList(element, property, roles[p], record); !ok) return ok;
        continue;
      }
      double value = 0;
      if (!scalars_.next(property.type, value)) return corruptRecord(element, record, noValue(property));
      switch (roles[p]) {
        case Role::x:
          position.x = value;
          break;
        case Role::y:
          position.y = value;
          break;
        case Role::z:
          position.z = value;
          break;
        case Role::error:
          error = value;
          break;
        default:
          break;
      }
    }
    // Each triangle of a polygon has the error of the polygon.
    if (error) errors_.resize(mesh_.triangles.size(), static_cast<float>(*error));
    if (isVertex) {
      if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
        return corruptRecord(element, record, "has a coordinate that is not finite");
      mesh_.positions.push_back(position);
    }
    return {};
  }

  Status readList(const PlyElement& element, const PlyProperty& property, Role role, std::uint64_t record) {
    double length = 0;
    if (!scalars_.next(property.countType, length)) return corruptRecord(element, record, noValue(property));
    if (!(length >= 0 && length == std::floor(length)))
      return corruptRecord(element, record, fmt::format("has a list of {} values", length));
    if (length > static_cast<double>((left() + 1) / Scalars::leastSize(property.type)))
      return corruptRecord(element, record,
                           fmt::format("has a list of {} values, more than the file can hold", length));
    const auto count = static_cast<std::uint64_t>(length);
    if (role == Role::indices && count < 3)
      return corruptRecord(element, record, fmt::format("has {} corners", count));

    if (role == Role::indices) corners_.clear();
    for (std::uint64_t i = 0; i < count; ++i) {
      double value = 0;
      if (!scalars_.next(property.type, value)) return corruptRecord(element, record, noValue(property));
      if (role != Role::indices) continue;
      if (!(value >= 0 && value < static_cast<double>(vertexCount_) && value == std::floor(value)))
        return corruptRecord(element, record, fmt::format("names vertex {} of {}", value, vertexCount_));
      corners_.push_back(static_cast<std::uint32_t>(value));
    }
    if (role == Role::indices) faces_.add(mesh_, corners_);
    return {};
  }

  std::string noValue(const PlyProperty& property) const {
    return fmt::format("{} {}", left() == 0 ? "is cut off at" : "has no number for",
                       text::quotedToken(property.name));
  }

  const FileBytes& file_;
  const PlyHeader& header_;
  const std::string& path_;
  const RunContext& context_;
  Scalars scalars_;
  std::uint64_t vertexCount_ = 0;
  std::uint64_t records_ = 0;           // of all elements that have properties
  std::optional<std::uint64_t> lines_;  // that are not empty, once counted
  std::uint64_t recordsWithMore_ = 0;
  std::size_t lineWithMore_ = 0;
  SurfaceMesh mesh_;
  std::vector<float> errors_;
  MeshFaces faces_;
  std::vector<std::uint32_t> corners_;
};

Status checkElements(const PlyHeader& header, const std::string& path) {
  const auto countOf = [&](std::string_view name) {
    return std::ranges::count_if(header.elements, [&](const PlyElement& e) { return e.name == name; });
  };
  for (const char* name : {"vertex", "face"})
    if (countOf(name) > 1)
      return failure(ErrorCode::corrupt, fmt::format("has two elements {}", text::quotedToken(name)), path);
  if (countOf("vertex") == 0) return failure(ErrorCode::corrupt, "has no element \"vertex\"", path);
  if (countOf("face") == 0)
    return failure(ErrorCode::unsupported,
                   countOf("tristrips") > 0
                       ? "has triangle strips, which Arete does not read; write it with faces"
                       : "has no element \"face\": it is a point cloud, not a mesh",
                   path);

  for (const PlyElement& element : header.elements)
    if (element.name == "vertex" && element.count >= std::numeric_limits<std::uint32_t>::max())
      return failure(ErrorCode::corrupt,
                     fmt::format("claims {} vertices, more than an index can name", element.count), path);
  return {};
}

/// Gives elements and properties the names that the reader knows where only upper and lower case differ:
/// "X" is "x", unless there is an "x" as well.
void useKnownNames(PlyHeader& header) {
  const auto rename = [](auto& named, std::initializer_list<std::string_view> known) {
    for (const std::string_view name : known) {
      if (std::ranges::any_of(named, [&](const auto& one) { return one.name == name; })) continue;
      for (auto& one : named)
        if (text::lowered(one.name) == name) one.name = name;
    }
  };
  rename(header.elements, {"vertex", "face", "tristrips"});
  for (PlyElement& element : header.elements) {
    if (element.name == "vertex") rename(element.properties, {"x", "y", "z"});
    if (element.name == "face") rename(element.properties, {"vertex_indices", "vertex_index", "error"});
  }
}

/// "crs X" sets `value` to X, and "crs+ Y" appends Y.
void takeComment(std::string_view comment, std::string_view key, std::string& value) {
  if (!comment.starts_with(key)) return;
  comment.remove_prefix(key.size());
  if (comment.starts_with(' '))
    value = comment.substr(1);
  else if (comment.starts_with("+ "))
    value += comment.substr(2);
}

}  // namespace

Result<MeshFile> readPly(const std::filesystem::path& path, const RunContext& context) {
  const std::string name = path.string();
  Result<FileBytes> file = FileBytes::read(path);
  if (!file) return tl::unexpected(file.error());
  // A text in UTF-16, or with a byte order mark.
  if (!file->view().starts_with("ply"))
    if (const Status ok = file->decodeText(path); !ok) return tl::unexpected(ok.error());
  Result<PlyHeader> header = parsePlyHeader(file->view(), name);
  if (!header) return tl::unexpected(header.error());
  // Carriage returns that end the lines of the data.
  if (header->format == PlyFormat::ascii)
    if (const Status ok = file->decodeText(path); !ok) return tl::unexpected(ok.error());
  useKnownNames(*header);
  if (const Status ok = checkElements(*header, name); !ok) return tl::unexpected(ok.error());

  MeshFile result;
  for (const std::string& comment : header->comments) {
    takeComment(comment, "crs", result.crsWkt);
    takeComment(comment, "vertical_unit", result.verticalUnit);
  }
  Status read = failure(ErrorCode::unsupported, "unknown encoding", name);
  switch (header->format) {
    case PlyFormat::ascii:
      read = PlyReader<TextScalars>(*file, *header, name, context).readInto(result);
      break;
    case PlyFormat::littleEndian:
      read = PlyReader<BinaryScalars<std::endian::little>>(*file, *header, name, context).readInto(result);
      break;
    case PlyFormat::bigEndian:
      read = PlyReader<BinaryScalars<std::endian::big>>(*file, *header, name, context).readInto(result);
      break;
  }
  if (!read) return tl::unexpected(read.error());
  return result;
}

}  // namespace arete
