// SPDX-License-Identifier: GPL-3.0-or-later
//
// A ball as a text, ball.obj, for the commands that take surfaces.
#pragma once

#include <cmath>
#include <sstream>
#include <string>

#include "cli/cli_fixture.h"

namespace arete::cli_test {

class Balls : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write("ball.obj", ball(24, 14));
  }
  /// A sphere of radius 1 with a texture whose seam runs from pole to pole.
  static std::string ball(int around, int rings) {
    std::ostringstream text;
    text << "mtllib ball.mtl\nv 0 0 1\nv 0 0 -1\nusemtl skin\n";
    for (int r = 0; r < rings; ++r)
      for (int c = 0; c < around; ++c) {
        const double u = 2 * M_PI * c / around, v = M_PI * (r + 1) / (rings + 1);
        text << "v " << std::sin(v) * std::cos(u) << ' ' << std::sin(v) * std::sin(u) << ' ' << std::cos(v)
             << '\n';
      }
    for (int r = 0; r < rings; ++r)
      for (int c = 0; c <= around; ++c)
        text << "vt " << double(c) / around << ' ' << double(r) / rings << '\n';
    text << "vt 0.5 0\nvt 0.5 1\n";
    const auto corner = [&](int r, int c) {
      return std::to_string(3 + r * around + c % around) + "/" + std::to_string(1 + r * (around + 1) + c);
    };
    const std::string north = "1/" + std::to_string(rings * (around + 1) + 1),
                      south = "2/" + std::to_string(rings * (around + 1) + 2);
    for (int c = 0; c < around; ++c) {
      text << "f " << north << ' ' << corner(0, c) << ' ' << corner(0, c + 1) << '\n';
      text << "f " << south << ' ' << corner(rings - 1, c + 1) << ' ' << corner(rings - 1, c) << '\n';
      for (int r = 0; r + 1 < rings; ++r)
        text << "f " << corner(r, c) << ' ' << corner(r + 1, c) << ' ' << corner(r + 1, c + 1) << ' '
             << corner(r, c + 1) << '\n';
    }
    return text.str();
  }
};

}  // namespace arete::cli_test
