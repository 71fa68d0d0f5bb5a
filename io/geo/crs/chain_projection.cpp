// SPDX-License-Identifier: GPL-3.0-or-later
//
// An edge is bisected until its image is straight: at its quarters, because the image of an edge that is
// symmetric about its middle deviates to both sides and not there. x is compared modulo a turn, and an edge
// that reaches over more than a quarter of a turn is always bisected, so each step tells which way round it
// leads. The sum of the steps of a ring is 0, or a whole turn if it encloses a pole.
#include "io/geo/crs/chain_projection.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

/// After so many bisections an edge is taken as it is: near a pole longitudes change without end.
constexpr int kMostBisections = 20;
/// An edge that deviates by this part of its length after them is torn by a seam.
constexpr double kTorn = 0.05;
/// Rounding of a projection, in parts of the coordinates.
constexpr double kRounding = 1e-11;

class Projector {
 public:
  explicit Projector(const ChainProjection& projection) : p_(projection) {}

  bool begin(Vec2 source) {
    const auto first = p_.forward(source);
    if (!first) return false;
    result.assign(1, *first);
    last_ = *first;
    return true;
  }

  /// Appends the vertices behind a, up to b.
  bool add(Vec2 a, Vec2 b) {
    const auto end = p_.forward(b);
    return end && edge(a, b, last_, *end, 0);
  }

  std::vector<Vec2> result;

 private:
  double way(double from, double to) const {
    const double x = to - from;
    return p_.turn > 0 ? x - p_.turn * std::round(x / p_.turn) : x;
  }

  bool edge(Vec2 a, Vec2 b, Vec2 imageA, Vec2 imageB, int depth) {
    const Vec2 along{way(imageA.x, imageB.x), imageB.y - imageA.y};
    const double length = std::hypot(along.x, along.y);
    double deviation = 0;
    Vec2 middle = a, imageOfMiddle = imageA;
    for (const double t : {0.25, 0.5, 0.75}) {
      const Vec2 at = (1 - t) * a + t * b;
      const auto image = p_.forward(at);
      if (!image) return false;
      deviation = std::max(
          deviation, std::hypot(way(imageA.x, image->x) - t * along.x, image->y - imageA.y - t * along.y));
      if (t == 0.5) {
        middle = at;
        imageOfMiddle = *image;
      }
    }
    const double size = std::hypot(b.x - a.x, b.y - a.y);
    // Below the rounding of projections no bend can be told: edges shorter than a millimetre are straight.
    const double rounding = kRounding * (std::abs(imageA.x) + std::abs(imageA.y));
    const double tolerance =
        std::max(std::min(p_.bend, size > 0 ? p_.deviation / size : p_.bend) * length, rounding);
    const bool isShort = p_.turn == 0 || std::abs(along.x) <= p_.turn / 4;
    if ((deviation <= tolerance && isShort) || depth == kMostBisections) {
      if (p_.turn == 0 && deviation > std::max(kTorn * length, tolerance)) return false;
      const Vec2 from = result.back();
      result.push_back({from.x + along.x, imageB.y});
      // Without a turn, or where none was made, the vertex is the image itself, to the last bit.
      if (std::abs(result.back().x - imageB.x) < 1e-9 * std::abs(p_.turn) || p_.turn == 0)
        result.back().x = imageB.x;
      last_ = imageB;
      return true;
    }
    return edge(a, middle, imageA, imageOfMiddle, depth + 1) &&
           edge(middle, b, imageOfMiddle, imageB, depth + 1);
  }

  const ChainProjection& p_;
  Vec2 last_;
};

bool isInside(const std::vector<Vec2>& ring, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if ((ring[i].y > p.y) != (ring[j].y > p.y) &&
        p.x < (ring[j].x - ring[i].x) * (p.y - ring[i].y) / (ring[j].y - ring[i].y) + ring[i].x)
      inside = !inside;
  return inside;
}

/// y of the pole that a ring encloses.
double enclosedPole(const std::vector<Vec2>& ring, const std::vector<Vec2>& image,
                    const ChainProjection& projection) {
  for (const double y : {projection.pole, -projection.pole})
    if (const auto there = projection.back ? projection.back({image[0].x, y}) : std::nullopt;
        there && isInside(ring, *there))
      return y;
  // The pole is on the ring.
  const Vec2 nearest = *std::ranges::max_element(image, {}, [](Vec2 p) { return std::abs(p.y); });
  return std::copysign(projection.pole, nearest.y);
}

}  // namespace

std::optional<std::vector<Vec2>> projectLine(const std::vector<Vec2>& line,
                                             const ChainProjection& projection) {
  Projector projector(projection);
  if (line.empty() || !projector.begin(line[0])) return std::nullopt;
  for (std::size_t i = 1; i < line.size(); ++i)
    if (!projector.add(line[i - 1], line[i])) return std::nullopt;
  return std::move(projector.result);
}

std::optional<std::vector<Vec2>> projectRing(const std::vector<Vec2>& ring,
                                             const ChainProjection& projection) {
  std::vector<Vec2> closed = ring;
  closed.push_back(ring[0]);
  auto image = projectLine(closed, projection);
  if (!image) return image;
  const double winding = image->back().x - image->front().x;
  const Vec2 first = image->front();
  image->pop_back();
  if (projection.turn > 0 && std::abs(winding) > projection.turn / 2) {
    const double y = enclosedPole(ring, *image, projection);
    image->push_back({first.x + winding, first.y});
    image->push_back({first.x + winding, y});
    image->push_back({first.x, y});
  }
  return image;
}

}  // namespace arete
