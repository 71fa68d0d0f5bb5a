// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/surface_file.h"

namespace arete {

/// An open file in pages of a surface, with what ResidentPages needs of it under the names that AmtFile has.
/// Cheap to copy but for the directory. Thread-safe: it is only read.
class PagedSurfaceFile {
 public:
  /// Errors: unsupported: the file is of terrain, or not in pages; as surfaceFacts().
  static Result<PagedSurfaceFile> open(AmtContainer container);

  const std::string& path() const { return container_.path(); }
  const AmtContainer& container() const { return container_; }
  /// What its metadata says.
  const SurfaceFacts& facts() const { return facts_; }
  /// As AmtFile::errorBeyond().
  double errorBeyond(std::uint64_t nodes) const;
  /// As AmtFile::pagesFor(). Errors: as there.
  Result<std::vector<PageNeed>> pagesFor(const RequiredError& wanted, const RunContext& context = {}) const {
    return surfacePagesFor(container_, wanted, context);
  }
  /// The model, or the part that the options require. Errors: as loadSurfaceAmt().
  Result<SurfaceModel> read(const AmtReadOptions& options = {}, const RunContext& context = {}) const {
    return loadSurfaceAmt(container_, options, context);
  }

 private:
  PagedSurfaceFile(AmtContainer container, SurfaceFacts facts)
      : container_(std::move(container)), facts_(std::move(facts)) {}

  AmtContainer container_;
  SurfaceFacts facts_;
};

}  // namespace arete
