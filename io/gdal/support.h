// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// Registers GDAL's drivers, once in the life of the program. Safe from any thread.
void registerGdal();

struct GdalDatasetCloser {
  void operator()(GDALDataset* dataset) const { GDALClose(GDALDataset::ToHandle(dataset)); }
};
using GdalDatasetPtr = std::unique_ptr<GDALDataset, GdalDatasetCloser>;

/// While it lives, what GDAL has to say on this thread is collected here instead of being printed.
/// Scopes nest; the innermost collects.
class GdalErrors {
 public:
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  bool anyFailure() const;
  /// The first failure: GDAL reports the cause first and its consequences after. Empty if there was none.
  std::string firstFailure() const;
  /// Everything said so far, as warnings (the first few, repetitions once), and forgotten here.
  void moveTo(std::vector<std::string>& warnings);
  void clear() { messages_.clear(); }

 private:
  static void CPL_STDCALL collect(CPLErr severity, CPLErrorNum number, const char* message);
  std::vector<std::pair<CPLErr, std::string>> messages_;
};

/// Opens for reading; null if GDAL cannot. `flags`: GDAL_OF_RASTER or GDAL_OF_VECTOR.
GdalDatasetPtr openGdal(const std::string& path, unsigned flags);

/// The folder, the empty file or the missing permission that keeps `path` from being read as a file; nothing
/// if it can be, or if it is no file name but one of GDAL's connection strings.
std::optional<Error> findInputProblem(const std::string& path);

/// Why `path` could not be opened, as a sentence: what findInputProblem() says, that nothing of that name is
/// there, or what GDAL had to say. `kind` completes "is not a ...", for instance "raster".
Error explainOpenFailure(const std::string& path, std::string_view kind, const GdalErrors& errors);

/// Whether it is GDAL's "XYZ", which takes any text of numbers for a raster. Null is none.
bool isTextDriver(GDALDriverH driver);

/// The names of GDAL's virtual file systems ("/vsizip/...", "/vsicurl/...").
bool isVirtualPath(std::string_view path);

}  // namespace arete
