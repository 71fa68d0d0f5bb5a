// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// How far a surface lies from the reference: z_surface - z_reference stays within [-below, above].
struct SignedBound {
  double below = 0;
  double above = 0;

  void include(double difference) {
    if (difference > above) above = difference;
    if (-difference > below) below = -difference;
  }
  void include(const SignedBound& other) {
    if (other.above > above) above = other.above;
    if (other.below > below) below = other.below;
  }
};

}  // namespace arete
