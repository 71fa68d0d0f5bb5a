// SPDX-License-Identifier: GPL-3.0-or-later
//
// heights FILE.amt E: reads places "x y" from stdin, in the DEM's CRS, and writes "x y height" for each:
// within E of the finest surface, 0 for that surface itself.
#include <arete/io/store/amt/file.h>
#include <arete/terrain/locate/ground_height.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: heights FILE.amt E < places\n";
    return 2;
  }
  const double maxError = std::atof(argv[2]);
  const auto model = arete::loadAmt(argv[1]);
  if (!model) {
    std::cerr << model.error().describe() << "\n";
    return 1;
  }
  const arete::GroundHeights heights(*model);
  std::cout.precision(12);
  for (arete::Vec2 place; std::cin >> place.x >> place.y;) {
    std::cout << place.x << " " << place.y << " ";
    if (const auto found = heights.at(place, maxError))
      std::cout << found->height << "\n";
    else
      std::cout << "no terrain\n";
  }
}
