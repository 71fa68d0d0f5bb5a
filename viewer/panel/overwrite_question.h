// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace arete {

/// What a window writes on a wish of its user.
enum class Saving {
  flight,  ///< a file
  frames,  ///< a folder of frame_00000.png and so on
  mesh,    ///< a file that a command writes
};

/// What would be lost by writing, as a sentence with its path; empty where nothing would: "flight.json
/// exists", "frames holds 240 frames". A path that cannot be looked at counts as free: writing it says why it
/// fails. A folder where a file is to be, or a file where a folder is to be, is not overwritten, and counts
/// as free too. O(files in the folder).
std::string lostBySaving(Saving saving, const std::filesystem::path& path);

/// The path, or if there is such a file, the first of "name-2.png", "name-3.png" ... that is free.
std::filesystem::path freePath(const std::filesystem::path& path);

/// Asks before something is overwritten: a wish to save that would lose something waits for an answer, and
/// the window goes on meanwhile. Without OpenGL, so that tests can use it.
class OverwriteQuestion {
 public:
  struct Wish {
    Saving saving = Saving::flight;
    std::filesystem::path path;
  };

  /// Takes a wish. A wish replaces one that waits.
  ///
  /// @return whether it may be done at once. Else it waits, and sentence() asks.
  bool mayDo(Saving saving, const std::filesystem::path& path);
  bool isWaiting() const { return wish_.has_value(); }
  /// "flight.json exists. Overwrite it?"; empty if nothing waits.
  const std::string& sentence() const { return sentence_; }
  /// The answer "yes": what is to be done now. Nothing if nothing waits.
  std::optional<Wish> yes();
  /// The answer "no".
  void no();

 private:
  std::optional<Wish> wish_;
  std::string sentence_;
};

}  // namespace arete
