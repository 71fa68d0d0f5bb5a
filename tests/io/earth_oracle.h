// SPDX-License-Identifier: GPL-3.0-or-later
//
// An Earth for tests that shares nothing with GeographicLib and PROJ: geodesics are integrated step by step,
// the transverse Mercator projection is Krueger's series and Newton's method against it.
#pragma once

#include <numbers>

namespace arete::test {

struct LonLat {
  long double lon = 0, lat = 0;  ///< radians
};

struct OracleEllipsoid {
  long double a = 6378137, inverseFlattening = 298.257223563L;  ///< 0 = sphere

  long double eccentricity2() const {
    const long double f = inverseFlattening > 0 ? 1 / inverseFlattening : 0;
    return f * (2 - f);
  }
  /// Radii of curvature at a latitude: along the meridian, and across it.
  long double meridional(long double lat) const;
  long double transverse(long double lat) const;
  /// Of the normal section in a direction (Euler).
  long double inDirection(long double lat, long double azimuth) const;
};

struct GeodesicPlace {
  LonLat place;
  long double azimuth = 0;  ///< radians, clockwise from north
};
/// Where a geodesic is after so many metres, by the fourth-order Runge-Kutta rule on its differential
/// equation (Clairaut). For lines of some hundred kilometres: within 1e-8 m.
GeodesicPlace alongGeodesic(const OracleEllipsoid& ellipsoid, GeodesicPlace from, long double metres);

struct OracleTransverseMercator {
  OracleEllipsoid ellipsoid;
  long double lat0 = 0, lon0 = 0;  ///< degrees
  long double scale = 0.9996L, falseEasting = 500000, falseNorthing = 0;

  struct EastNorth {
    long double east, north;
  };
  EastNorth forward(LonLat place) const;
  LonLat inverse(EastNorth at) const;
};

inline constexpr long double kDegree = std::numbers::pi_v<long double> / 180;

}  // namespace arete::test
