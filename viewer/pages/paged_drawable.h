// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "io/query/pages/resident_pages.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/pages/paged_subject.h"
#include "viewer/scene/drawable.h"

namespace arete {

/// Draws a terrain of which the pages are read that the camera needs. What is drawn is always a cut of a part
/// that covers the whole plan, so that a page that is late makes the picture coarser in its place, and leaves
/// neither a hole nor a crack. A part takes the place of another between two pictures; vertices that were on
/// the move are at rest or move anew after it.
///
/// Where a picture waits for its cut (ViewSettings::waits), advance() reads at most ViewSettings::pageBytes,
/// and pictures depend on the cameras before them alone. Else a thread of its own reads and unpacks, and
/// advance() takes what is done. In an OpenGL context that is current, for one camera at a time.
class PagedDrawable final : public Drawable {
 public:
  /// Errors: as TerrainDrawable::create().
  static Result<PagedDrawable> create(ResidentPages pages, std::shared_ptr<PagedSubject> subject,
                                      TerrainDrawable::Options options, const RunContext& context = {});
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
  void drawBackground(const ViewSettings& settings) override;
  bool isShown() const override;
  std::optional<double> drawnError(const Pick& pick, const Camera& camera, Vec2 pixel,
                                   const ViewSettings& settings) const override;
  bool keepsBudget(const ViewSettings& settings) const override;
  std::uint32_t capacity() const override;
  std::string deviceRefusal() const override;
  Warnings warnings() const override;

  /// What is drawn of the part at hand.
  const TerrainDrawable& shown() const;

 private:
  struct State;
  explicit PagedDrawable(std::unique_ptr<State> state);
  Status take(const ResidentPages::Step& step, const RunContext& context);

  std::unique_ptr<State> state_;
};

}  // namespace arete
