// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "viewer/gl/scene.h"

namespace arete {

/// The objects of a scene under the user's hand: one is selected, its level is chosen, and it may be shown
/// alone. Functions answer with a sentence for the user.
class ObjectList {
 public:
  /// Precondition: the scene has a model, and outlives this.
  explicit ObjectList(Scene& scene) : scene_(scene) {}

  std::size_t count() const { return scene_.drawables().size(); }
  std::size_t selected() const { return selected_; }
  std::string select(std::size_t object);
  /// The one after it, and after the last the first.
  std::string selectNext() { return select((selected_ + 1) % count()); }

  /// Twice or half the triangles that the selected one has now, by hand.
  std::string refine() { return multiply(2); }
  std::string coarsen() { return multiply(0.5); }
  /// Of the selected one; nothing: by the view again.
  std::string setLevel(const std::optional<HandLevel>& level);

  /// Shows the selected one alone, or all again as they were shown.
  std::string toggleAlone();
  bool isAlone() const { return !wasShown_.empty(); }

  std::optional<Turn> turn() const { return drawable().turn(); }
  void setTurn(const Turn& turn) { drawable().setTurn(turn); }

  ShownObject& object() { return scene_.objects()[selected_]; }
  ShownObject& object(std::size_t i) { return scene_.objects()[i]; }
  const Subject& subject() const { return drawable().subject(); }
  /// "rock"; of a model alone its kind.
  std::string nameOf(std::size_t i) const;
  /// Drawable::drawnError() of the object that was picked.
  std::optional<double> drawnError(const Pick& pick, const Camera& camera, Vec2 pixel,
                                   const ViewSettings& settings) const {
    return scene_.drawables()[pick.object]->drawnError(pick, camera, pixel, settings);
  }

 private:
  std::string multiply(double factor);
  Drawable& drawable() const { return *scene_.drawables()[selected_]; }

  Scene& scene_;
  std::size_t selected_ = 0;
  std::vector<bool> wasShown_;  // by object, while one is alone; else empty
};

}  // namespace arete
