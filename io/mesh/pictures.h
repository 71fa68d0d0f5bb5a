// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/mesh/file.h"

namespace arete {

/// A picture that a material uses, as bytes.
struct PictureBytes {
  std::string name;      ///< of a file, without folders; unique among the pictures of the mesh
  std::string mimeType;  ///< by its first bytes, else by its name: "image/png"
  std::vector<std::byte> bytes;
};

/// Reads the pictures that materials name (TextureUse::picture), from the mesh or from files. A path names
/// only regular files in the mesh's folder and below: absolute paths, "..", links that lead out of it and
/// other schemes are refused.
/// '\\' counts as '/'; where no file has a name, one that differs in case alone will do.
class PictureSource {
 public:
  /// @param mesh must outlive this.
  /// @param folder MeshFile::folder; empty: no files are read.
  PictureSource(const MeshAttributes& mesh, std::filesystem::path folder);

  /// Errors, with the name as culprit: notFound, unreadable; unsupported: a name that is refused.
  Result<PictureBytes> read(const std::string& picture) const;

 private:
  const MeshAttributes& mesh_;
  std::filesystem::path folder_;
};

/// Puts the pictures of a mesh beside the file that is written. A file of the same bytes is used as it is;
/// one of other bytes is never overwritten: the new one gets another name.
class PicturePlacer {
 public:
  /// @param mesh the file that is written; a pipe or a device: nothing is placed.
  PicturePlacer(const PictureSource& source, const std::filesystem::path& mesh);

  /// @return the path to write in the mesh, relative to it, with '/'. Where the picture cannot be read, what
  /// the material says, and a warning is kept. Errors: unreadable: the file cannot be written.
  Result<std::string> place(const std::string& picture);

  const std::vector<std::filesystem::path>& files() const { return files_; }  ///< that were written or used
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  const PictureSource& source_;
  std::filesystem::path mesh_;
  std::map<std::string, std::string> placed_;
  std::vector<std::filesystem::path> files_;
  std::vector<std::string> warnings_;
};

}  // namespace arete
