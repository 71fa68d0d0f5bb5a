// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/common/file.h"

namespace arete {

/// The materials that an OBJ names, and the libraries (MTL) that it names for them.
class ObjMaterials {
 public:
  /// What "mtllib" states: one file or several, with blanks between them or in them.
  void addLibrary(std::string_view files);
  /// The number of the material that "usemtl" states; kNone: the name is empty, or one too many.
  std::uint32_t use(std::string_view name);

  /// Reads the libraries and fills mesh.materials: those of the libraries in their order, then those that no
  /// library has, by their names alone. mesh.materialOf is renumbered. Libraries are looked for as pictures
  /// are (io/formats/common/files_beside.h); one that is missing is a warning. Pictures are named relative to
  /// the OBJ.
  ///
  /// @param folder of the OBJ; empty: nothing is read.
  ///
  /// Errors, without a culprit: interrupted.
  Status finish(MeshFile& file, const std::filesystem::path& folder, const RunContext& context);

 private:
  std::set<std::string, std::less<>> isListed_;
  std::vector<std::string> libraries_;  // what the lines state, each once
  std::map<std::string, std::uint32_t, std::less<>> numbers_;
  std::vector<std::string> names_;  // by number
  std::uint64_t tooMany_ = 0;
};

}  // namespace arete
