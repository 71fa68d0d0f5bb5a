// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "io/gdal/support.h"

namespace arete {

/// Datasets of which each is made of the one before: closed from the last to the first, as GDAL wants it.
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
  bool isLookedUp() const { return datasets_.size() > 1; }
  GDALDataset* first() const { return datasets_.front().get(); }
  GDALDataset* last() const { return datasets_.back().get(); }

 private:
  void clear() {
    while (!datasets_.empty()) datasets_.pop_back();
  }
  std::vector<GdalDatasetPtr> datasets_;
};

/// A picture as its file has it: which bands are its colours, which one hides it.
struct DrapeSource {
  DatasetStack opened;
  std::vector<int> colors;     ///< one band (grey) or three
  int alpha = 0;               ///< 0 = none
  double coarser = 1;          ///< pixels of the file along a side of one of these
  bool isExaggerated = false;  ///< not of 8 bits: to be brought to them

  GDALDataset& dataset() const { return *opened.last(); }
};

/// `bands`: those of a person; empty = as the file says. A colour table is looked up. Errors: those of
/// opening; usage (bands that are not there), unsupported (no band, complex numbers).
Result<DrapeSource> openDrapeSource(const std::string& path, const std::vector<int>& bands,
                                    std::vector<std::string>& warnings);

/// The same picture from the smallest of its overviews that has at least a pixel where `coarser` by `coarser`
/// pixels were; as it is, where it has none.
Result<DrapeSource> openDrapeOverview(const std::string& path, DrapeSource source, double coarser);

}  // namespace arete
