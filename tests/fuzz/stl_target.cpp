// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/harness.h"
#include "io/formats/stl/stl.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const arete::fuzz::MemoryFile file;
  file.set({data, size});
  arete::fuzz::useMesh(arete::readStl(file.path(), arete::fuzz::oneThread()));
  return 0;
}
