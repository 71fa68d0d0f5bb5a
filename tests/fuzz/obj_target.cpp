// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/harness.h"
#include "io/formats/obj/mtl.h"
#include "io/formats/obj/obj.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const arete::fuzz::MemoryFile file;
  file.set({data, size});
  arete::fuzz::useMesh(arete::readObj(file.path(), arete::fuzz::oneThread()));

  // The same bytes as a library of materials, which are written and read again.
  const arete::MtlMaterials library = arete::readMtl({reinterpret_cast<const char*>(data), size});
  arete::fuzz::requireClear(library.warnings);
  const auto same = [](const std::string& picture) -> arete::Result<std::string> { return picture; };
  const auto written = arete::mtlText(library.materials, arete::mtlNames(library.materials), same);
  arete::fuzz::require(written && arete::readMtl(written->text).materials.size() == library.materials.size(),
                       "an MTL that was read is written and read again");
  return 0;
}
