// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "io/formats/glb/buffers.h"

namespace arete {

class GltfDocument;

/// The bytes of a glTF's bufferViews, decompressed where they are compressed (EXT_meshopt_compression), and
/// the memory for what is decoded.
class GltfViews {
 public:
  GltfViews(std::filesystem::path folder, std::string_view chunk) : buffers_(std::move(folder), chunk) {}

  struct View {
    std::string_view bytes;
    std::uint64_t stride = 0;                ///< 0: none is stated
    std::shared_ptr<const void> owned = {};  ///< has the bytes, if they were decompressed
  };

  /// @param document The glTF of these views.
  /// @return Valid as long as this.
  ///
  /// Errors, without a culprit: those of GltfBuffers. corrupt: a missing view, one that is longer than its
  /// buffer or whose compressed bytes are damaged.
  Result<View> view(const GltfDocument& document, std::uint64_t number);

  /// Counts bytes that decoding is about to take. Errors: unsupported: they are far more than the bytes of
  /// the file and of its buffers.
  Status reserve(std::uint64_t bytes);
  /// How many more reserve() admits.
  std::uint64_t reservable() const;
  /// The size of the file and of the buffers beside it that were read.
  std::uint64_t sourceBytes() const { return fileBytes_ + buffers_.bytesBeside() + reserved_; }
  void setFileBytes(std::uint64_t bytes) { fileBytes_ = bytes; }

  /// Accessors that were put together from parts, by number.
  std::map<std::uint64_t, std::shared_ptr<const std::string>> sparse;

 private:
  Result<View> decompressed(const GltfDocument& document, std::uint64_t number,
                            const nlohmann::json& compression);

  GltfBuffers buffers_;
  std::uint64_t fileBytes_ = 0, reserved_ = 0;
  std::map<std::uint64_t, std::shared_ptr<const std::string>> decompressed_;  // by view
};

}  // namespace arete
