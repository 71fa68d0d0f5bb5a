// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/harness.h"
#include "io/formats/off/off.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const arete::fuzz::MemoryFile file;
  file.set({data, size});
  const auto mesh = arete::readOff(file.path(), arete::fuzz::oneThread());
  arete::fuzz::require(!mesh || mesh->mesh.validate(), "the attributes of a mesh fit it");
  arete::fuzz::useMesh(mesh);
  return 0;
}
