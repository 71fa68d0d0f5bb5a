// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight/fresnel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arete {

double wavelengthMetres(double megahertz) {
  return 299.792458 / megahertz;
}

double fresnelRadius(double wavelength, double distance, double length) {
  return distance > 0 && distance < length ? std::sqrt(wavelength * distance * (length - distance) / length)
                                           : 0;
}

std::optional<FresnelClearance> leastFresnelClearance(const SightLine& line, const Profile& profile,
                                                      double wavelength) {
  const double length = line.length(), unit = line.heightUnitMetres();
  // Near an end below the ground the zone is arbitrarily narrow, and the fraction has no least value.
  constexpr double kBelowMetres = 1e-6;
  for (const ProfileVertex& v : profile.vertices)
    if ((v.distance <= 0 || v.distance >= length) &&
        (line.height(v.distance) - v.height) * unit < -kBelowMetres)
      return std::nullopt;
  std::optional<FresnelClearance> least;
  const auto fractionAt = [&](double s, double z) {
    const double radius = fresnelRadius(wavelength, s, length);
    return radius > 0 ? (line.height(s) - z) * unit / radius : std::numeric_limits<double>::infinity();
  };
  const auto take = [&](double s, double z) {
    const double fraction = fractionAt(s, z);
    if (std::isfinite(fraction) && !(least && least->fraction <= fraction))
      least = {fraction, {s, line.planAt(s), z, line.height(s)}};
  };
  for (const ProfileVertex& v : profile.vertices) take(v.distance, v.height);
  for (std::size_t i = 1; i < profile.vertices.size(); ++i) {
    const ProfileVertex &p = profile.vertices[i - 1], &q = profile.vertices[i];
    if (!q.isJoined || !(q.distance > p.distance)) continue;
    const double d = q.distance - p.distance, rise = (q.height - p.height) / d;
    const auto heightAt = [&](double s) { return p.height + rise * (s - p.distance); };
    // Most stretches need no search: the clearance is at least that of the ends less the line's sag, and the
    // radius is largest at the point nearest to half way.
    const double lowest = line.leastBound(p.distance, p.height, q.distance, q.height) * unit;
    const double widest = fresnelRadius(wavelength, std::clamp(length / 2, p.distance, q.distance), length);
    const double narrowest = std::min(fresnelRadius(wavelength, p.distance, length),
                                      fresnelRadius(wavelength, q.distance, length));
    if (least && lowest > least->fraction * (least->fraction > 0 ? widest : narrowest)) continue;
    constexpr double kGolden = 0.6180339887498949;
    double low = p.distance, high = q.distance;
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    double atA = fractionAt(a, heightAt(a)), atB = fractionAt(b, heightAt(b));
    for (int step = 0; step < 44; ++step) {
      if (atA <= atB) {
        high = b;
        b = a;
        atB = atA;
        a = high - kGolden * (high - low);
        atA = fractionAt(a, heightAt(a));
      } else {
        low = a;
        a = b;
        atA = atB;
        b = low + kGolden * (high - low);
        atB = fractionAt(b, heightAt(b));
      }
    }
    take(a, heightAt(a));
  }
  return least;
}

}  // namespace arete
