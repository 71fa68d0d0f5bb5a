// SPDX-License-Identifier: GPL-3.0-or-later
//
// The integral of a quadratic function over a triangle is its area times 3/4 of the value in the middle and
// 1/12 of that at each corner.
#include "surface/error/samples.h"

namespace arete {
namespace {

constexpr double kMiddle = 0.75, kCorner = 1.0 / 12;

double areaOf(const SpaceTriangle& t) {
  return norm(cross(t[1] - t[0], t[2] - t[0])) / 2;
}

}  // namespace

SurfaceSamples::SurfaceSamples(const OriginalSurface& original)
    : original_(original),
      faceOf_(original.positions.size(), 0),
      areaOf_(original.positions.size(), 0),
      faceArea_(original.faces.size()) {
  for (auto f = static_cast<std::uint32_t>(original.faces.size()); f-- > 0;) {
    const double whole = areaOf(original.face(f));
    faceArea_[f] = static_cast<float>(whole * kMiddle);
    const auto area = static_cast<float>(whole * kCorner);
    for (const std::uint32_t v : original.faces[f]) {
      faceOf_[v] = f;
      areaOf_[v] += area;
    }
  }
}

void SurfaceSamples::append(const Piece& piece, std::vector<SurfaceSample>& samples) const {
  const SpaceTriangle face = original_.face(piece.face);
  if (piece.isWhole()) {
    for (std::size_t i = 0; i < 3; ++i)
      if (const std::uint32_t v = original_.faces[piece.face][i]; faceOf_[v] == piece.face)
        samples.push_back(
            {face[i], areaOf_[v], piece.face, {double(i == 0), double(i == 1), double(i == 2)}});
    constexpr double kThird = 1.0 / 3;
    samples.push_back(
        {(face[0] + face[1] + face[2]) / 3.0, faceArea_[piece.face], piece.face, {kThird, kThird, kThird}});
    return;
  }
  Vec3 middle;
  std::array<double, 3> shares{};
  for (const FacePoint& p : piece.polygon) {
    const Vec3 place = placeOf(p, face);
    middle = middle + place;
    const std::array<double, 3> here = sharesOf(p);
    for (std::size_t i = 0; i < 3; ++i) shares[i] += here[i] / double(piece.polygon.size());
    const int corner = p == wholeFace()[0] ? 0 : p == wholeFace()[1] ? 1 : p == wholeFace()[2] ? 2 : 3;
    if (corner == 3) continue;
    const std::uint32_t v = original_.faces[piece.face][static_cast<std::size_t>(corner)];
    if (faceOf_[v] == piece.face) samples.push_back({place, areaOf_[v], piece.face, here});
  }
  constexpr double kUnit = 1.0 / FacePoint::kOne;
  const double part = double(twiceArea(piece.polygon)) * kUnit * kUnit;
  samples.push_back(
      {middle / double(piece.polygon.size()), faceArea_[piece.face] * part, piece.face, shares});
}

}  // namespace arete
