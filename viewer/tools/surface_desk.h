// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viewer/objects/object_list.h"
#include "viewer/panel/overwrite_question.h"
#include "viewer/scene/layer.h"
#include "viewer/tools/command_job.h"
#include "viewer/tools/crop_box.h"

namespace arete {

/// What a user makes of the file of the surface that is selected: saves the cut that is shown, crops,
/// decimates. Each is a command of the program, run in the background: the file has the bytes of that command
/// by itself, and the sentence that tells of it says which one it was. Without OpenGL. Not movable.
///
/// Functions that do something answer with a sentence for the user; empty: there is nothing to say yet.
class SurfaceDesk {
 public:
  struct Start {
    std::string program = {};             ///< its path; empty: nothing can be made
    std::vector<std::string> files = {};  ///< by object; empty of a terrain
    /// Called with each command that has been done, and what came of it. May be empty.
    std::function<void(const std::string&)> log = {};
  };
  /// Precondition: objects, layers and question outlive this.
  SurfaceDesk(Start start, ObjectList& objects, Layers& layers, OverwriteQuestion& question);
  ~SurfaceDesk();
  SurfaceDesk(const SurfaceDesk&) = delete;
  SurfaceDesk& operator=(const SurfaceDesk&) = delete;

  /// What the fields of the panel hold. Names as typed, relative to where the program runs.
  struct Fields {
    std::string cut = "cut.ply", cropped = "cropped.ply", decimated = "decimated.ply";
    bool keepsWhole = false;  ///< triangles that touch the box are not cut
    std::string method = "measured";
    std::string triangles = "50%", error = {};  ///< as the command takes them; empty: not stated
    std::string more = {};                      ///< further options of the command
    bool opens = true;                          ///< a result is shown next
  } fields;

  /// The surface that is selected, if it has a file.
  const SurfaceSubject* surface() const;

  /// Writes what is drawn: by the level that is chosen by hand; else by the camera and the tolerance.
  ///
  /// @param camera,settings of the cut that is shown
  std::string saveCut(const Camera& camera, const ViewSettings& settings);
  std::string crop();
  std::string decimate();
  /// Does what the question asked for.
  std::string confirmed();
  void cancel();
  bool isRunning() const { return job_.isRunning(); }
  BackgroundWork<std::string>::Progress progress() const { return job_.progress(); }
  /// Takes in what is done, and lays the box.
  std::string step();

  /// The line of the last command that has ended; empty: none has.
  const std::string& lastCommand() const { return lastCommand_; }

  /// Shows the box of the selected surface, or takes it away.
  void toggleBox();
  std::optional<CropBox>& box() { return box_; }
  const std::optional<CropBox>& box() const { return box_; }

  /// What is to be shown next, once: a result where `fields.opens`.
  std::optional<std::string> takeOpened() { return std::exchange(opened_, std::nullopt); }

 private:
  struct Order {
    std::vector<CommandWords> commands;
    std::string output;
    std::string told;  ///< the command line as the user would type it
  };
  std::string begin(Order order);
  std::string run();
  const std::string& file() const { return start_.files[objects_.selected()]; }
  /// Commands that make a model or a mesh of the file, where it is the other; and the path of it.
  std::string modelFor(Order& order);
  std::string meshFor(Order& order);
  std::filesystem::path temporary(const std::string& ending);

  Start start_;
  ObjectList& objects_;
  Layers& layers_;
  OverwriteQuestion& question_;
  CommandJob job_;
  std::optional<Order> waiting_, running_;
  std::optional<CropBox> box_;
  std::size_t boxOf_ = 0;
  std::optional<std::string> opened_;
  std::string lastCommand_;
  std::filesystem::path folder_;  // holds the files that commands make; empty until the first one runs
};

/// The methods of `mesh decimate`, as its option names them.
std::span<const char* const> decimationMethods();

}  // namespace arete
