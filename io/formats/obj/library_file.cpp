// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/obj/library_file.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>
#include <utility>

#include "io/files/file_writer.h"
#include "io/files/output_file.h"
#include "io/files/text_scan.h"
#include "io/formats/common/pictures.h"
#include "io/formats/common/text_reader.h"
#include "io/formats/obj/mtl.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr int kMostNames = 10'000;

/// Whether a file begins with a line.
bool beginsWith(const fs::path& path, const std::string& line) {
  std::string start(line.size() + 1, '\0');
  std::ifstream stream(path, std::ios::binary);
  return stream.read(start.data(), static_cast<std::streamsize>(start.size())) && start == line + "\n";
}

/// A name that no file has, or one that belongs to the same OBJ.
Result<fs::path> freePath(const fs::path& obj, const std::string& firstLine) {
  for (int number = 0; number < kMostNames; ++number) {
    const std::string behind = number == 0 ? std::string() : fmt::format("-{}", number);
    const fs::path path = obj.parent_path() / fs::path(obj.stem().string() + behind + ".mtl");
    if (OutputGroup::placeOf(path) != path) continue;  // a picture that is to have the name
    std::error_code error;
    const fs::file_status status = fs::symlink_status(path, error);
    if (!fs::exists(status) || (fs::is_regular_file(status) && beginsWith(path, firstLine))) return path;
  }
  return failure(ErrorCode::unreadable,
                 fmt::format("cannot have a file of materials: {} other files have its name", kMostNames),
                 obj.string());
}

}  // namespace

Result<ObjLibraryFile> writeObjLibrary(const MeshAttributes& mesh, std::span<const std::string> names,
                                       const fs::path& obj, const fs::path& pictures) {
  const PictureSource source(mesh, pictures);
  PicturePlacer placer(source, obj);
  ARETE_TRY(MtlText mtl, mtlText(mesh.materials, names,
                                 [&](const std::string& picture) { return placer.place(picture); }));
  const std::string firstLine =
      fmt::format("# {}, for {}", kMeshTextGenerator, text::onOneLine(obj.filename().string()));
  // After the pictures: one of them may have the name.
  ARETE_TRY(const fs::path path, freePath(obj, firstLine));
  ARETE_TRY(FileWriter file, FileWriter::create(path));
  file.write(firstLine + "\n");
  file.write(mtl.text);
  ARETE_CHECK(file.finish());
  ObjLibraryFile written{
      .name = path.filename().string(), .filesBeside = {path}, .lost = std::move(mtl.lost)};
  written.filesBeside.insert(written.filesBeside.end(), placer.files().begin(), placer.files().end());
  written.lost.insert(written.lost.end(), placer.warnings().begin(), placer.warnings().end());
  return written;
}

}  // namespace arete
