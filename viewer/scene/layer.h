// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/base/vec.h"
#include "viewer/color/rgb.h"

namespace arete {

class DrapeOnGpu;
class SpaceContent;

/// What the colours of a layer mean; may be empty.
struct Legend {
  enum class Mark { area, line, point };
  struct Entry {
    Rgba color{};
    std::string label;
    Mark mark = Mark::area;
  };
  std::string title;
  std::vector<Entry> entries;
};

/// A picture in pixels over the plan of a terrain: (u, v) = plan * scale + shift, v downwards from its first
/// row; transparent where alpha is 0.
struct PlanPicture {
  int width = 0, height = 0;
  std::vector<Rgba> rgba;
  Vec2 scale, shift;
  bool isArea = false;  ///< one colour that fades at its rim: smooth, with nothing beyond the edges
};

/// Lines where the heights of a terrain are multiples of an interval, in the unit of heights, > 0.
struct Contours {
  static constexpr Rgb kInk = {82, 51, 26};  ///< of the lines, their heights and their legend
  double interval = 1;
};

/// Vertices in the metric space of the scene's first model, heights as they are: pairs are the ends of lines.
struct SpaceVertices {
  struct Vertex {
    Vec3 place;
    Rgba color{};
  };
  std::vector<Vertex> vertices;
  bool isAlwaysSeen = false;  ///< also behind the models

  void addLine(const Vec3& from, const Vec3& to, const Rgba& color) {
    for (const Vec3& place : {from, to}) vertices.push_back({place, color});
  }
};

/// Something drawn over the models of a scene. Drapes, overlays and contours are painted on the ground, in
/// their order; everything else stands in space and is drawn after the models.
struct Layer {
  using Drape = std::shared_ptr<const DrapeOnGpu>;
  using Overlay = std::shared_ptr<const PlanPicture>;
  using Drawn = std::shared_ptr<SpaceContent>;

  std::string name;  ///< each has its own
  std::variant<Drape, Overlay, Contours, SpaceVertices, Drawn> content;
  double opacity = 1;  ///< 0 to 1
  bool isVisible = true;
  Legend legend = {};

  bool isOnGround() const { return content.index() < 3; }
  /// "a drape", "an overlay", "contours", "lines", or as its content calls itself.
  std::string_view kind() const;
};

/// The layers of a scene, the lowest first.
class Layers {
 public:
  /// How many layers on the ground a picture can have.
  static constexpr std::size_t kMostOnGround = 4;

  /// Lays something on top of the others, or gives the layer of that name new content: its place in the
  /// order, its opacity and whether it is visible stay.
  Layer& put(const std::string& name, decltype(Layer::content) content);
  void remove(std::string_view name);
  /// Null where there is none of that name. Valid until a layer is added or removed.
  Layer* find(std::string_view name);
  const Layer* find(std::string_view name) const { return const_cast<Layers*>(this)->find(name); }
  /// One place up (nearer to the eye), or down. Precondition: index < size.
  void move(std::size_t index, bool isUp);

  std::vector<Layer>& list() { return list_; }
  const std::vector<Layer>& list() const { return list_; }

 private:
  std::vector<Layer> list_;
};

}  // namespace arete
