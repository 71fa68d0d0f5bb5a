// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// A layer that is to be written.
struct OwnLayer {
  std::string name;
  /// Fields that every such layer has, by which an older one is recognised.
  std::vector<std::string> fields;
};

/// A copy of a GeoPackage without an older layer of ours, to be added to and then renamed over the original.
/// No other program can write to the original as long as this lives.
class GeoPackageCopy {
 public:
  /// Copies everything that the original holds, page by page, what other programs have left in its journal or
  /// log included, and removes the table of the layer from the copy. Rows of other tables that refer to it
  /// stay.
  ///
  /// @param copy Does not exist yet. Gets the permissions of the original. Not made where the original holds
  /// nothing else: a new file has the same bytes each time.
  ///
  /// Errors: invalidData: the original is not a GeoPackage, or has a layer of that name with other fields.
  /// unreadable: another program writes to it, or keeps it open with a write-ahead log, which would be lost;
  /// it is read-only; the copy cannot be written. interrupted. O(size of the original).
  static Result<GeoPackageCopy> make(const std::filesystem::path& original, const std::filesystem::path& copy,
                                     const OwnLayer& layer, const RunContext& context);

  /// Whether the copy was made.
  bool isMade() const { return isMade_; }

  GeoPackageCopy(GeoPackageCopy&&) noexcept;
  GeoPackageCopy& operator=(GeoPackageCopy&&) noexcept;
  ~GeoPackageCopy();

 private:
  struct Lock;
  explicit GeoPackageCopy(std::unique_ptr<Lock> lock);

  std::unique_ptr<Lock> lock_;
  bool isMade_ = false;
};

}  // namespace arete
