// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "io/geo/gdal/crs_addresses.h"

namespace arete {

/// Registers GDAL's drivers on the first call. Thread-safe.
void registerGdal();

struct GdalDatasetCloser {
  void operator()(GDALDataset* dataset) const;
};
using GdalDatasetPtr = std::unique_ptr<GDALDataset, GdalDatasetCloser>;

/// Collects the messages of GDAL on this thread during its lifetime, instead of printing them
/// (io/geo/gdal/message_text.h says what they lose). Scopes nest; the innermost collects. Meanwhile the CRS
/// of a file is not fetched from an address.
class GdalErrors {
 public:
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  bool anyFailure() const;
  /// The first failure, which is the cause: GDAL reports consequences later. Empty if there was none.
  std::string firstFailure() const;
  /// The first failure to read bytes that should be there (CPLE_FileIO). Empty if there was none.
  std::string firstFileFailure() const;
  /// The first message that is at least a warning. Empty if there was none.
  std::string firstMessage() const;
  /// Appends the messages so far to `warnings` (the first few distinct ones that are not there yet) and
  /// clears them here.
  void moveTo(Warnings& warnings);
  void clear() { messages_.clear(); }

 private:
  struct Message {
    CPLErr severity;
    CPLErrorNum number;
    std::string text;
  };

  static void CPL_STDCALL collect(CPLErr severity, CPLErrorNum number, const char* message);

  NoCrsAddresses noAddresses_;
  std::vector<Message> messages_;
};

/// Opens for reading. A file makes no schema be fetched (of GML; a person may allow it by GDAL's option
/// GML_DOWNLOAD_WFS_SCHEMA).
///
/// @param flags GDAL_OF_RASTER or GDAL_OF_VECTOR.
/// @param options "NAME=value", as the driver takes them.
/// @return Null if GDAL cannot open it.
GdalDatasetPtr openGdal(const std::string& path, unsigned flags,
                        const std::vector<std::string>& options = {});

/// @return An error for a pipe, a socket or a device: opening one may block, and no format can be read from
/// one.
std::optional<Error> findPipeProblem(const std::string& path);

/// Checks that a path can be read as a file.
///
/// @return An error for a pipe, a folder, an empty file or a missing permission. Nothing if the file can be
/// read, or if the path is not a file name, as GDAL's connection strings.
std::optional<Error> findInputProblem(const std::string& path);

/// The reason why `path` could not be opened: the one of findInputProblem(), a missing file, or GDAL's
/// message.
///
/// @param kind Completes "is not a ...": "raster".
Error explainOpenFailure(const std::string& path, std::string_view kind, const GdalErrors& errors);

/// @return True for GDAL's driver "XYZ", which identifies any text of numbers as a raster. False for null.
bool isTextDriver(GDALDriverH driver);

/// @return True for a path in one of GDAL's virtual file systems ("/vsizip/...", "/vsicurl/...").
bool isVirtualPath(std::string_view path);

}  // namespace arete
