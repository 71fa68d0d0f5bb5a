// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "io/geo/gdal/support.h"

namespace arete {

/// Datasets, each derived from the one before it. Closes them from the last to the first, as GDAL requires.
class DatasetStack {
 public:
  DatasetStack() = default;
  DatasetStack(DatasetStack&&) noexcept = default;
  DatasetStack& operator=(DatasetStack&& other) noexcept {
    clear();
    datasets_ = std::move(other.datasets_);
    return *this;
  }
  ~DatasetStack() { clear(); }
  void push(GdalDatasetPtr dataset) { datasets_.push_back(std::move(dataset)); }
  bool isExpanded() const { return datasets_.size() > 1; }
  GDALDataset* first() const { return datasets_.front().get(); }
  GDALDataset* last() const { return datasets_.back().get(); }

 private:
  void clear() {
    while (!datasets_.empty()) datasets_.pop_back();
  }
  std::vector<GdalDatasetPtr> datasets_;
};

/// An opened image with its bands of colours and of transparency.
struct DrapeSource {
  DatasetStack opened;
  GdalDatasetPtr turned;     ///< the source shifted by whole turns; null: not shifted
  std::vector<int> colors;   ///< one band (grey) or three
  int alpha = 0;             ///< band of transparency; 0: none
  double coarser = 1;        ///< length of a pixel's side, in pixels of the file
  bool isStretched = false;  ///< the values are not 8-bit; their range is mapped to 8 bits
  /// Of a colour table: red, green, blue and opacity by the number of the class. NODATA is transparent.
  /// Empty: the values are colours.
  std::vector<std::array<std::uint8_t, 4>> classes;
  int classBand = 0;          ///< with classes: their band in the file
  bool readsNumbers = false;  ///< dataset() has the numbers of classes, not their colours

  /// Turns to the numbers of the classes, whose colours must not be mixed. Precondition: it has classes and
  /// nothing is derived from dataset() yet.
  void readNumbers() {
    readsNumbers = true;
    colors = {classBand};
    alpha = 0;
  }

  GDALDataset& dataset() const {
    if (turned) return *turned;
    return readsNumbers ? *opened.first() : *opened.last();
  }
};

/// Opens an image. A colour table is expanded to colours and given as classes, too; so are the colours of an
/// attribute table.
///
/// @param bands The bands that the user chose; empty: choose them as the file says.
///
/// Errors: notFound, unreadable, corrupt. usage: no such bands. unsupported: no band, complex numbers.
Result<DrapeSource> openDrapeSource(const std::string& path, const std::vector<int>& bands,
                                    Warnings& warnings);

/// Reopens an image at the coarsest overview whose pixels are at most `coarser` times those of the file.
/// Returns `source` if there is none, or if it has classes: an overview may hold means of their numbers.
Result<DrapeSource> openDrapeOverview(const std::string& path, DrapeSource source, double coarser);

}  // namespace arete
