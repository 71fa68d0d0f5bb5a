// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "io/query/pages/resident_pages.h"
#include "viewer/pages/paged_kind.h"
#include "viewer/scene/drawable.h"

namespace arete {

/// Draws a model of which the pages are read that the camera needs. What is drawn is always a cut of a part
/// that covers the whole model, so that a page that is late makes the picture coarser in its place, and
/// leaves neither a hole nor a crack. A part takes the place of another between two pictures; vertices that
/// were on the move are at rest or move anew after it.
///
/// Where a picture waits for its cut (ViewSettings::waits), advance() reads at most ViewSettings::pageBytes,
/// and pictures depend on the cameras before them alone. Else a thread of its own reads, unpacks and makes
/// parts ready, and advance() takes what is done. In an OpenGL context that is current, for one camera at a
/// time.
///
/// Model: TerrainModel or SurfaceModel.
template <class Model>
class PagedDrawable final : public Drawable {
 public:
  using Kind = PagedKind<Model>;
  using PagedSubject = typename Kind::PagedSubject;
  using Shown = typename Kind::Shown;

  /// @param shown draws the outline of the pages, as the subject has it.
  PagedDrawable(ResidentPages<Model> pages, std::shared_ptr<PagedSubject> subject, Shown shown);
  PagedDrawable(PagedDrawable&&) noexcept;
  PagedDrawable& operator=(PagedDrawable&&) noexcept;
  ~PagedDrawable() override;

  const Subject& subject() const override;
  Result<FrameView> frameOf(const Camera& camera, const ViewSettings& settings) const override;
  Status advance(const Camera& camera, const ViewSettings& settings, const RunContext& context = {}) override;
  /// Figures have the pages, and as their pixels the error of what is drawn: exactly where the picture waits,
  /// else a bound.
  Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings,
                           const RunContext& context = {}) override;
  Status draw(const Camera& camera, const ViewSettings& settings,
              std::span<const Layer> layers = {}) override;
  Status drawBlended(const Camera& camera, const ViewSettings& settings) override;
  void drawBackground(const ViewSettings& settings) override;
  bool isShown() const override;
  std::optional<double> drawnError(const Pick& pick, const Camera& camera, Vec2 pixel,
                                   const ViewSettings& settings) const override;
  std::optional<Turn> turn() const override;
  void setTurn(const Turn& turn) override;
  bool keepsBudget(const ViewSettings& settings) const override;
  std::uint32_t capacity() const override;
  std::string deviceRefusal() const override;
  Warnings warnings() const override;

  /// What is drawn of the part at hand.
  const Shown& shown() const;
  /// The part at hand.
  const Model& part() const;

 private:
  struct State;
  /// A step, and its part ready to be drawn where it is another one.
  struct Done {
    typename ResidentPages<Model>::Step step;
    std::optional<typename Kind::Ready> ready = {};
  };
  static Result<Done> stepOf(State& s, const PageDemand& demand, std::uint64_t mostBytes,
                             const PictureDemand& picture, const RunContext& context);
  void take(Done done, const RunContext& context);

  std::unique_ptr<State> state_;
};

extern template class PagedDrawable<TerrainModel>;
extern template class PagedDrawable<SurfaceModel>;
using PagedTerrain = PagedDrawable<TerrainModel>;
using PagedSurface = PagedDrawable<SurfaceModel>;

/// Errors: as TerrainDrawable::create().
Result<PagedTerrain> drawPaged(TerrainPages pages, std::shared_ptr<PagedTerrainSubject> subject,
                               TerrainDrawable::Options options, const RunContext& context = {});
/// Errors: as SurfaceDrawable::create().
Result<PagedSurface> drawPaged(SurfacePages pages, std::shared_ptr<PagedSurfaceSubject> subject);

}  // namespace arete
