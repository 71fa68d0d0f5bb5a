// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/quadric.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {
constexpr double kMostCondition = 1e8, kMostFlight = 2;
}

Quadric Quadric::ofPlane(const Vec3& point, const Vec3& n, double weight) {
  return ofLinear(n, -dot(n, point), weight);
}

Quadric Quadric::ofLinear(const Vec3& n, double d, double weight) {
  Quadric q;
  q.a_ = {weight * n.x * n.x, weight * n.x * n.y, weight * n.x * n.z,
          weight * n.y * n.y, weight * n.y * n.z, weight * n.z * n.z};
  q.b_ = weight * d * n;
  q.c_ = weight * d * d;
  return q;
}

Quadric& Quadric::operator+=(const Quadric& other) {
  for (std::size_t i = 0; i < a_.size(); ++i) a_[i] += other.a_[i];
  b_ = b_ + other.b_;
  c_ += other.c_;
  return *this;
}

Quadric Quadric::times(double factor) const {
  Quadric q = *this;
  for (double& a : q.a_) a *= factor;
  q.b_ = factor * q.b_;
  q.c_ *= factor;
  return q;
}

double Quadric::at(const Vec3& p) const {
  const Vec3 ap{a_[0] * p.x + a_[1] * p.y + a_[2] * p.z, a_[1] * p.x + a_[3] * p.y + a_[4] * p.z,
                a_[2] * p.x + a_[4] * p.y + a_[5] * p.z};
  return dot(p, ap) + 2 * dot(b_, p) + c_;
}

std::optional<Vec3> Quadric::least() const {
  const auto& m = a_;
  const std::array<double, 6> adjugate = {m[3] * m[5] - m[4] * m[4], m[2] * m[4] - m[1] * m[5],
                                          m[1] * m[4] - m[2] * m[3], m[0] * m[5] - m[2] * m[2],
                                          m[1] * m[2] - m[0] * m[4], m[0] * m[3] - m[1] * m[1]};
  const double determinant = m[0] * adjugate[0] + m[1] * adjugate[1] + m[2] * adjugate[2];
  const auto sizeOf = [](const std::array<double, 6>& s) {
    return std::sqrt(s[0] * s[0] + s[3] * s[3] + s[5] * s[5] + 2 * (s[1] * s[1] + s[2] * s[2] + s[4] * s[4]));
  };
  if (!(determinant > 0) || !(sizeOf(m) * sizeOf(adjugate) <= kMostCondition * determinant))
    return std::nullopt;
  const Vec3 v{-(adjugate[0] * b_.x + adjugate[1] * b_.y + adjugate[2] * b_.z) / determinant,
               -(adjugate[1] * b_.x + adjugate[3] * b_.y + adjugate[4] * b_.z) / determinant,
               -(adjugate[2] * b_.x + adjugate[4] * b_.y + adjugate[5] * b_.z) / determinant};
  return isFinite(v) ? std::optional(v) : std::nullopt;
}

std::optional<Vec3> Quadric::leastBetween(const Vec3& p, const Vec3& q) const {
  // A parabola over the share of q: its value at 0, at 1 and in the middle.
  const double begin = at(p), end = at(q), middle = at((p + q) / 2.0);
  const double bend = 2 * (begin + end - 2 * middle), rise = end - begin - bend;
  if (!(bend > 1e-12 * (std::fabs(begin) + std::fabs(end)))) return std::nullopt;
  return p + std::clamp(-rise / (2 * bend), 0.0, 1.0) * (q - p);
}

Vec3 placeFor(const Quadric& quadric, std::span<const Vec3> vertices) {
  Vec3 middle{0, 0, 0};
  for (const Vec3& v : vertices) middle = middle + v;
  middle = middle / static_cast<double>(vertices.size());
  double reach = 0;
  for (const Vec3& v : vertices) reach = std::max(reach, norm(v - middle));
  if (const auto least = quadric.least(); least && norm(*least - middle) <= kMostFlight * reach)
    return *least;
  std::optional<Vec3> best;
  const auto offer = [&](const Vec3& p) {
    if (!best || quadric.at(p) < quadric.at(*best)) best = p;
  };
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = i + 1; j < vertices.size(); ++j)
      if (const auto between = quadric.leastBetween(vertices[i], vertices[j])) offer(*between);
  if (best) return *best;
  offer(middle);
  for (const Vec3& v : vertices) offer(v);
  return *best;
}

}  // namespace arete
