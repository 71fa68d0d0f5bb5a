// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/harness.h"
#include "io/formats/glb/glb.h"
#include "io/formats/glb/texture_transform.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const arete::fuzz::MemoryFile file;
  file.set({data, size});
  arete::Result<arete::MeshFile> mesh = arete::readGlb(file.path(), arete::fuzz::oneThread());
  arete::fuzz::useMesh(mesh);
  if (!mesh) return 0;
  arete::fuzz::require(mesh->mesh.validate().has_value(), "attributes fit the mesh");
  for (const std::string& sentence : arete::applyTextureTransforms(mesh->mesh))
    arete::fuzz::requireClear(arete::Error{arete::ErrorCode::invalidData, sentence, {}});
  arete::fuzz::require(mesh->mesh.validate().has_value(), "they fit it without transforms of textures");
  return 0;
}
