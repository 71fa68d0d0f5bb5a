// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "engine/base/result.h"
#include "io/files/file_bytes.h"

namespace arete {

/// The bytes of a glTF's buffers: the chunk BIN of a GLB, a data URI in the JSON, or a file beside it. Each
/// is read when it is first used, and each file once.
///
/// A name in a glTF reaches only regular files in its own folder and below: other schemes, absolute paths and
/// paths with ".." are refused.
class GltfBuffers {
 public:
  /// @param folder Of the glTF; empty: no files beside it are read.
  /// @param chunk The chunk BIN of a GLB; must outlive this. Null data: there is none.
  GltfBuffers(std::filesystem::path folder, std::string_view chunk)
      : folder_(std::move(folder)), chunk_(chunk) {}

  /// @param number Of the buffer in the list of the JSON.
  /// @param buffer Its element.
  /// @return Valid as long as this.
  ///
  /// Errors, without a culprit: corrupt: no bytes, invalid base 64, fewer bytes than its byteLength.
  /// unsupported: a name that is not of a file below the folder. notFound, unreadable: the file, by its name.
  Result<std::string_view> bytesOf(std::uint64_t number, const nlohmann::json& buffer);

  static bool isDataUri(std::string_view uri) { return uri.starts_with("data:"); }
  /// The bytes of a data URI. Errors, without a culprit, a message that follows its owner: unsupported: it is
  /// not of base 64; corrupt.
  static Result<std::string> dataOf(std::string_view uri);

  /// How many bytes of files beside the glTF were read.
  std::uint64_t bytesBeside() const { return bytesBeside_; }

 private:
  Result<std::string_view> fileNamed(const std::string& uri);

  std::filesystem::path folder_;
  std::string_view chunk_;
  std::map<std::uint64_t, std::string> decoded_;  // data URIs, by buffer
  std::map<std::string, FileBytes> files_;        // by URI
  std::uint64_t bytesBeside_ = 0;
};

/// A URI with its escaped characters, "%20", as they are. What is no escape stays.
std::string percentDecoded(std::string_view uri);

}  // namespace arete
