// SPDX-License-Identifier: GPL-3.0-or-later
//
// first FILE.amt E OUT: a model of terrain or a surface, cut within E of its source, as a mesh. The least
// that a program can say; README.md has it in six lines.
#include <arete/arete.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: first FILE.amt E OUT\n";
    return 2;
  }
  const auto model = arete::open(argv[1]);
  if (!model) return std::cerr << model.error().describe() << "\n", 1;
  const auto tin = arete::cut(*model, {.maxError = std::atof(argv[2])});
  if (!tin) return std::cerr << tin.error().describe() << "\n", 1;
  const auto written = arete::write(*tin, argv[3]);
  if (!written) return std::cerr << written.error().describe() << "\n", 1;
  std::cout << tin->mesh.triangles.size() << " triangles within " << tin->error << " " << tin->verticalUnit
            << "\n";
}
