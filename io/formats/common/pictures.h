// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "io/formats/common/file.h"
#include "io/formats/common/files_beside.h"

namespace arete {

/// A picture that a material uses, as bytes.
struct PictureBytes {
  std::string name;      ///< of a file, without folders; of those inside the mesh no two are the same
  std::string path;      ///< below the mesh's folder, with '/', as it is there; inside the mesh: the name
  std::string mimeType;  ///< by its first bytes, else by its name: "image/png"; empty if neither says it
  std::vector<std::byte> bytes;
};

/// Reads the pictures that materials name (TextureUse::picture), from the mesh or from regular files in its
/// folder and below (io/formats/common/files_beside.h).
class PictureSource {
 public:
  /// @param mesh must outlive this.
  /// @param folder MeshFile::folder; empty: no files are read.
  PictureSource(const MeshAttributes& mesh, std::filesystem::path folder);

  /// Errors, with the name as culprit: notFound, unreadable; unsupported: a name that is refused.
  Result<PictureBytes> read(const std::string& picture) const;

 private:
  const MeshAttributes& mesh_;
  FilesBeside files_;
  std::vector<std::string> names_;  // of the pictures inside the mesh
};

/// Puts the pictures of a mesh beside the file that is written, below its folder as they were below that of
/// their mesh. A file of the same bytes is used as it is; one of other bytes is never overwritten: the new
/// one gets another name.
class PicturePlacer {
 public:
  /// @param source must outlive this.
  /// @param mesh the file that is written; a pipe or a device: nothing is placed.
  PicturePlacer(const PictureSource& source, std::filesystem::path mesh);

  /// @return The path to write in the mesh, relative to it, with '/'. Where the picture cannot be read or
  /// placed, what the material says, and a warning is kept; empty if that picture was inside the mesh.
  /// Errors: unreadable: the file cannot be written.
  Result<std::string> place(const std::string& picture);

  const std::vector<std::filesystem::path>& files() const { return files_; }  ///< that were written or used
  /// Each a noun, as in MeshWriteReport::lost.
  const Warnings& warnings() const { return warnings_; }

 private:
  Result<std::string> write(const PictureBytes& picture);

  const PictureSource& source_;
  std::filesystem::path mesh_;
  std::map<std::string, std::string> placed_;
  std::set<std::string> taken_;  // in lower case: some file systems tell no case apart
  std::vector<std::filesystem::path> files_;
  Warnings warnings_;
};

}  // namespace arete
