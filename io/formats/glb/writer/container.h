// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/files/file_writer.h"
#include "io/formats/glb/base64.h"

namespace arete {

static_assert(std::endian::native == std::endian::little, "a big-endian machine needs a byte swap here");

/// Where the bytes of the buffer go: into the file, or in base 64. Counts them, reports progress and sees a
/// cancellation.
class ByteSink {
 public:
  /// @param size Of the whole buffer.
  ByteSink(FileWriter& file, bool isText, std::uint64_t size, const RunContext& context)
      : file_(file), isText_(isText), size_(size), context_(context) {}

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    write({reinterpret_cast<const char*>(&value), sizeof value});
  }
  void write(std::string_view bytes) {
    written_ += bytes.size();
    if (!isText_) return file_.write(bytes);
    base64_.add(bytes, text_);
    if (text_.size() >= kTextAtOnce) writeText();
  }
  void zeros(std::size_t count) {
    for (; count > 0; --count) put('\0');
  }
  void finish() {
    base64_.finish(text_);
    writeText();
  }

  /// To be called from time to time. False if the work was cancelled.
  bool goesOn() const {
    context_.report("writing the mesh", static_cast<double>(written_) / static_cast<double>(size_));
    return !context_.cancelled();
  }
  std::uint64_t written() const { return written_; }

 private:
  static constexpr std::size_t kTextAtOnce = 1 << 16;
  void writeText() {
    file_.write(text_);
    text_.clear();
  }

  FileWriter& file_;
  bool isText_;
  std::uint64_t size_, written_ = 0;
  const RunContext& context_;
  Base64Writer base64_;
  std::string text_;
};

/// What a glTF holds: its JSON, and the bytes of its one buffer.
struct GltfContent {
  nlohmann::ordered_json document;  ///< "buffers", if there are any, come last
  std::uint64_t bufferSize = 0;
  /// Writes bufferSize bytes. False if it was cancelled.
  std::function<bool(ByteSink&)> writeBuffer;
};

/// Writes a GLB, or JSON with the buffer in base 64.
///
/// Errors: those of FileWriter. invalidData: more than 4 GiB. interrupted.
Status writeContainer(GltfContent content, const std::filesystem::path& path, bool asText,
                      const RunContext& context);

}  // namespace arete
