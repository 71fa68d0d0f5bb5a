// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// A file that appears under its name complete or not at all. It is written under a temporary name in the
/// same folder; commit() renames it. Without commit() the destructor removes it, so after an error, an
/// exception or Ctrl-C (which sets a flag that makes functions return) no file is left and an older file of
/// that name is unchanged.
///
/// Any writer can write the temporary file: a FileWriter, GDAL, a memory map. The temporary name is unique
/// across processes and keeps the extension, which GDAL drivers check. create() does not create the file,
/// because some drivers refuse to overwrite. commit() renames GDAL's side file ("<name>.aux.xml") too.
///
/// An existing target that is not a regular file (/dev/null, a pipe) is written in place. If the target is a
/// symbolic link, the file that it points to, which need not exist, is replaced and the link stays. What
/// killed runs have left in the folder is removed. A file that gets its name is listed (written_files.h).
class OutputFile {
 public:
  /// Errors: notFound: the folder does not exist. unreadable: the folder is not writable, or `path` is a
  /// folder.
  static Result<OutputFile> create(const std::filesystem::path& path);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// The path to write to. Close the file before commit().
  const std::filesystem::path& temporaryPath() const { return temporary_; }
  /// States what is removed beside the file when it gets its name: side files of an older one, by what
  /// follows its name (".ovr").
  void removeBeside(std::vector<std::string> suffixes) { stale_ = std::move(suffixes); }
  /// States that the new file holds what the older one of its name held, too.
  void addsToOlder() { isAddedTo_ = true; }
  /// Whether an existing target that is no regular file is written in place.
  bool isInPlace() const { return inPlace_; }
  /// The path given to create().
  const std::filesystem::path& path() const { return path_; }

  /// Renames the temporary file to its final name, or leaves that to the OutputGroup of this thread. At most
  /// once.
  ///
  /// Errors: unreadable, with the path as culprit: there is no temporary file, or renaming failed; with the
  /// input as culprit: a watched file was changed (io/files/watched_files.h). The temporary file is then
  /// removed.
  Status commit();

 private:
  friend class OutputGroup;
  OutputFile() = default;
  Status rename();
  void discard() noexcept;

  std::filesystem::path path_;
  std::filesystem::path target_;     // path_ with links resolved
  std::filesystem::path temporary_;  // empty once committed or moved from
  std::vector<std::string> stale_;
  bool inPlace_ = false, isAddedTo_ = false;
};

/// Outputs that belong together: a mesh and the files beside it, or a file that is read back before it
/// replaces an older one. While a group lives, the files that its thread commits keep their temporary names.
/// commit() renames them in the order in which they were committed; without it none appears. Groups nest: an
/// inner one hands its files to the outer one.
///
/// Of a file committed twice in a group the later one counts. If a file cannot be renamed, those renamed
/// before it get their older content back, where the file system has hard links.
class OutputGroup {
 public:
  OutputGroup() noexcept;
  OutputGroup(const OutputGroup&) = delete;
  OutputGroup& operator=(const OutputGroup&) = delete;
  ~OutputGroup();

  /// Errors: those of OutputFile::commit().
  Status commit();

  /// Where the file of this name is to be read: under its temporary name, if a group of this thread holds it;
  /// else `path` itself.
  static std::filesystem::path placeOf(const std::filesystem::path& path);

 private:
  friend class OutputFile;
  void add(OutputFile file);

  OutputGroup* outer_;
  std::vector<OutputFile> files_;
};

}  // namespace arete
