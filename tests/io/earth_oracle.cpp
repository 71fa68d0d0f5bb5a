// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/earth_oracle.h"

#include <array>
#include <cmath>

namespace arete::test {

long double OracleEllipsoid::meridional(long double lat) const {
  const long double e2 = eccentricity2(), w2 = 1 - e2 * std::sin(lat) * std::sin(lat);
  return a * (1 - e2) / (w2 * std::sqrt(w2));
}

long double OracleEllipsoid::transverse(long double lat) const {
  return a / std::sqrt(1 - eccentricity2() * std::sin(lat) * std::sin(lat));
}

long double OracleEllipsoid::inDirection(long double lat, long double azimuth) const {
  const long double c = std::cos(azimuth), s = std::sin(azimuth);
  return 1 / (c * c / meridional(lat) + s * s / transverse(lat));
}

GeodesicPlace alongGeodesic(const OracleEllipsoid& ellipsoid, GeodesicPlace from, long double metres) {
  using State = std::array<long double, 3>;  // longitude, latitude, azimuth
  const auto slope = [&](const State& at) {
    const long double n = ellipsoid.transverse(at[1]);
    return State{std::sin(at[2]) / (n * std::cos(at[1])), std::cos(at[2]) / ellipsoid.meridional(at[1]),
                 std::tan(at[1]) * std::sin(at[2]) / n};
  };
  const auto moved = [](const State& at, const State& by, long double h) {
    return State{at[0] + h * by[0], at[1] + h * by[1], at[2] + h * by[2]};
  };
  constexpr int kSteps = 60;
  const long double h = metres / kSteps;
  State at = {from.place.lon, from.place.lat, from.azimuth};
  for (int i = 0; i < kSteps; ++i) {
    const State a = slope(at), b = slope(moved(at, a, h / 2)), c = slope(moved(at, b, h / 2)),
                d = slope(moved(at, c, h));
    for (std::size_t j = 0; j < 3; ++j) at[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
  }
  return {{at[0], at[1]}, at[2]};
}

OracleTransverseMercator::EastNorth OracleTransverseMercator::forward(LonLat place) const {
  // Krueger 1912, to the sixth power of the third flattening ([Karney2011], equations 12 and 35).
  const long double f = 1 / ellipsoid.inverseFlattening, n = f / (2 - f), e = std::sqrt(f * (2 - f));
  const long double n2 = n * n, n3 = n2 * n, n4 = n2 * n2, n5 = n4 * n, n6 = n3 * n3;
  const std::array<long double, 6> alpha = {
      n / 2 - 2 * n2 / 3 + 5 * n3 / 16 + 41 * n4 / 180 - 127 * n5 / 288 + 7891 * n6 / 37800,
      13 * n2 / 48 - 3 * n3 / 5 + 557 * n4 / 1440 + 281 * n5 / 630 - 1983433 * n6 / 1935360,
      61 * n3 / 240 - 103 * n4 / 140 + 15061 * n5 / 26880 + 167603 * n6 / 181440,
      49561 * n4 / 161280 - 179 * n5 / 168 + 6601661 * n6 / 7257600,
      34729 * n5 / 80640 - 3418889 * n6 / 1995840,
      212378941 * n6 / 319334400};
  const long double radius = ellipsoid.a / (1 + n) * (1 + n2 / 4 + n4 / 64 + n6 / 256);
  const auto rectified = [&](long double lat, long double lon, long double& xi, long double& eta) {
    const long double s = std::sin(lat), t = std::sinh(std::atanh(s) - e * std::atanh(e * s));
    const long double x = std::atan2(t, std::cos(lon));
    const long double y = std::asinh(std::sin(lon) / std::hypot(t, std::cos(lon)));
    xi = x;
    eta = y;
    for (int j = 1; j <= 6; ++j) {
      xi += alpha[std::size_t(j - 1)] * std::sin(2 * j * x) * std::cosh(2 * j * y);
      eta += alpha[std::size_t(j - 1)] * std::cos(2 * j * x) * std::sinh(2 * j * y);
    }
  };
  long double xi0 = 0, eta0 = 0, xi = 0, eta = 0;
  rectified(lat0 * kDegree, 0, xi0, eta0);
  rectified(place.lat, place.lon - lon0 * kDegree, xi, eta);
  return {falseEasting + scale * radius * eta, falseNorthing + scale * radius * (xi - xi0)};
}

LonLat OracleTransverseMercator::inverse(EastNorth at) const {
  LonLat p = {lon0 * kDegree, lat0 * kDegree};
  for (int i = 0; i < 12; ++i) {
    constexpr long double kStep = 1e-7L;
    const EastNorth here = forward(p), east = forward({p.lon + kStep, p.lat}),
                    north = forward({p.lon, p.lat + kStep});
    const long double a = (east.east - here.east) / kStep, b = (north.east - here.east) / kStep,
                      c = (east.north - here.north) / kStep, d = (north.north - here.north) / kStep;
    const long double dx = at.east - here.east, dy = at.north - here.north, det = a * d - b * c;
    p.lon += (dx * d - dy * b) / det;
    p.lat += (dy * a - dx * c) / det;
  }
  return p;
}

}  // namespace arete::test
