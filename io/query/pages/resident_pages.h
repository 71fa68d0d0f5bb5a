// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/pages/paged_surface_file.h"
#include "io/store/amt/file.h"
#include "io/store/format/page_need.h"
#include "io/store/format/required_error.h"
#include "surface/model/surface_model.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What pictures ask of the pages of a model. Each requires at least the errors of the one before; null: the
/// same.
struct PageDemand {
  RequiredError needed;       ///< by the next picture
  RequiredError around = {};  ///< by pictures from places near by too
  RequiredError ahead = {};   ///< by pictures that are expected; it may lie elsewhere
};

/// The pages of a file in pages that are in memory, packed, within a budget of bytes; and a part of the model
/// that is made of them. Each step reads some pages that a demand needs and gives back those that were used
/// longest ago.
///
/// The part is always a multitriangulation in itself, with every ancestor of its nodes, so that each cut of
/// it covers the whole model: a page that is not there yet makes the cut coarser (Cut::missing) and never
/// leaves a hole. Where the budget or the bytes of a step do not allow the errors that are needed, the part
/// allows the least multiple of them, the same everywhere. Steps with one demand come to an end: to all
/// that is needed or, where the budget is too small for it, to the part that the budget and the demand alone
/// determine. No result depends on threads.
///
/// Not thread-safe: one thread at a time, and no other reads pages of the same open file meanwhile. The parts
/// are models of their own and stay valid.
///
/// Model: TerrainModel or SurfaceModel.
template <class Model>
class ResidentPages {
 public:
  using File = std::conditional_t<std::is_same_v<Model, TerrainModel>, AmtFile, PagedSurfaceFile>;
  static constexpr std::uint64_t kUsualBytes = std::uint64_t{64} << 20;
  /// The part of the beginning has about this many nodes at most.
  static constexpr std::uint64_t kOutlineNodes = 8000;

  /// Reads a part of some thousand nodes, the coarsest ones. Precondition: the file is in pages.
  ///
  /// @param mostBytes of pages in memory. The pages of the root are there even so.
  /// Errors: as File::read().
  static Result<ResidentPages> open(File file, std::uint64_t mostBytes = kUsualBytes,
                                    const RunContext& context = {});

  /// The part of the beginning, which stays.
  const std::shared_ptr<const Model>& outline() const { return outline_; }
  const File& file() const { return file_; }

  struct Step {
    std::shared_ptr<const Model> part;
    bool isNew = false;  ///< another part than after the step before
    /// The errors that the part allows are at most this multiple of the needed ones; 1: it has all that is
    /// needed. Infinite: nothing but the root is sure.
    double coarseness = 1;
    std::uint64_t pages = 0, bytes = 0;  ///< that this step read
    /// What the next picture needs and is not in memory after the step.
    std::uint64_t missingPages = 0, missingBytes = 0;
    std::uint64_t residentBytes = 0;  ///< after the step
    bool isDone = false;              ///< a further step for the same demand changes nothing
  };
  /// @param mostBytes that are read; where a single page has more, that page.
  /// Errors: as File::pagesFor() and File::read(). O(pages of the directory that the demand
  /// meets, times the logarithm of how much coarser the part has to be) and, where the part changes, O(part),
  /// parallel.
  Result<Step> step(const PageDemand& demand, std::uint64_t mostBytes, const RunContext& context = {});

 private:
  /// The beginning of a page in memory.
  struct Resident {
    std::span<const std::byte> bytes;
    std::uint64_t usedAt = 0;  ///< the last step that had a use for it
    std::uint64_t needed = 0;  ///< bytes of it that this step had a use for
  };
  /// One choice of a demand: its requirement, its pages, and what they weigh.
  struct Choice {
    RequiredError required;
    std::vector<PageNeed> pages;
    std::uint64_t bytes = 0, newBytes = 0;
    double coarseness = 1;
  };
  class Stepping;

  ResidentPages(File file, std::uint64_t mostBytes) : file_(std::move(file)), mostBytes_(mostBytes) {}
  std::uint64_t newBytesOf(const PageNeed& need) const;
  bool partHas(const std::vector<PageNeed>& pages) const;
  void makeRoom(std::uint64_t bytes);
  void shorten(std::uint64_t page, std::uint64_t kept);

  File file_;
  std::uint64_t mostBytes_, bytes_ = 0, now_ = 0;
  std::map<std::uint64_t, Resident> resident_;  // by page, which is the order of the file
  std::shared_ptr<const Model> outline_, part_;
  std::vector<PageNeed> partPages_;  // that part_ was made of
};

extern template class ResidentPages<TerrainModel>;
extern template class ResidentPages<SurfaceModel>;
using TerrainPages = ResidentPages<TerrainModel>;
using SurfacePages = ResidentPages<SurfaceModel>;

}  // namespace arete
