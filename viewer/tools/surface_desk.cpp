// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers go into the command lines in the fewest digits that read back to the same double.
#include "viewer/tools/surface_desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/files/shell_text.h"
#include "surface/model/camera.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 7> kMethods = {"measured",    "qem",  "lindstrom-turk", "half-edge",
                                                 "vertex-pair", "face", "cluster"};

bool isModel(const std::string& file) {
  return fs::path(file).extension() == ".amt";
}

/// An option of a command line, as it stands in one.
std::string option(std::string_view composed) {
  return std::string(composed.substr(1));
}

/// The words between blanks; single quotes keep blanks.
CommandWords wordsOf(const std::string& text) {
  CommandWords words;
  bool isOpen = false, isQuoted = false;
  for (const char c : text) {
    if (c == '\'') {
      isQuoted = !isQuoted;
      if (!std::exchange(isOpen, true)) words.emplace_back();
    } else if (c == ' ' && !isQuoted) {
      isOpen = false;
    } else {
      if (!std::exchange(isOpen, true)) words.emplace_back();
      words.back() += c;
    }
  }
  return words;
}

/// The first line that a command has said.
std::string firstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::string numbered(const Vec3& p) {
  return fmt::format("{},{},{}", p.x, p.y, p.z);
}

/// Whether a command line can state this camera: it has no roll of its own.
bool isUpright(const SurfaceSubject& surface, const SurfaceCamera& stated, const View& drawn) {
  const Result<View> view = arete::viewOf(stated, surface.model());
  if (!view) return false;
  const View own = surface.upright().turnedBack(viewedBy(surface.pose({}), drawn));
  // What is up in a picture is up across the direction of the view.
  const auto across = [](const View& v) {
    const Vec3 ahead = v.forward * (1 / norm(v.forward));
    const Vec3 up = v.up - ahead * dot(v.up, ahead);
    return up * (1 / norm(up));
  };
  return norm(across(*view) - across(own)) < 1e-6;
}

}  // namespace

std::span<const char* const> decimationMethods() {
  return kMethods;
}

SurfaceDesk::SurfaceDesk(Start start, ObjectList& objects, Layers& layers, OverwriteQuestion& question)
    : start_(std::move(start)), objects_(objects), layers_(layers), question_(question) {}

SurfaceDesk::~SurfaceDesk() {
  job_.cancel();
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

const SurfaceSubject* SurfaceDesk::surface() const {
  if (start_.program.empty() || objects_.selected() >= start_.files.size() || file().empty()) return nullptr;
  return dynamic_cast<const SurfaceSubject*>(&objects_.subject());
}

fs::path SurfaceDesk::temporary(const std::string& ending) {
  if (folder_.empty()) {
    std::string pattern = (fs::temp_directory_path() / "arete-window-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) return {};
    folder_ = pattern;
  }
  return folder_ / fmt::format("{}{}", objects_.selected(), ending);
}

std::string SurfaceDesk::modelFor(Order& order) {
  if (isModel(file())) return file();
  const fs::path made = temporary(".amt");
  std::error_code ignored;
  if (!fs::exists(made, ignored)) order.commands.push_back({"build", file(), "-o", made.string()});
  const std::string name = fs::path(file()).filename().replace_extension(".amt").string();
  order.told = fmt::format("arete build {} -o {} && ", shellQuoted(file()), shellQuoted(name));
  return made.string();
}

std::string SurfaceDesk::meshFor(Order& order) {
  if (!isModel(file())) return file();
  const fs::path made = temporary(".ply");
  std::error_code ignored;
  if (!fs::exists(made, ignored))
    order.commands.push_back({"extract", file(), "-o", made.string(), option(" --max-error"), "0"});
  const std::string name = fs::path(file()).filename().replace_extension(".ply").string();
  order.told =
      fmt::format("arete extract {} -o {} --max-error 0 && ", shellQuoted(file()), shellQuoted(name));
  return made.string();
}

std::string SurfaceDesk::saveCut(const Camera& camera, const ViewSettings& settings) {
  const SurfaceSubject* const shown = surface();
  if (!shown) return "a cut is saved of a surface with a file";
  const ShownObject& object = objects_.object();
  CommandWords request;
  if (object.level && object.level->triangles > 0) {
    // A budget below the coarsest cut shows that one.
    const std::uint32_t most = std::max(object.level->triangles, object.figures.triangles);
    request = {option(" --max-triangles"), std::to_string(most)};
  } else if (object.level) {
    request = {option(" --max-error"), fmt::format("{}", object.level->error)};
  } else {
    if (shown->isPlaced()) return "an object of a scene is saved at a level by hand: choose one first";
    // Where a budget ends a cut depends on the cuts before it, and no command has had these.
    if (settings.maxTriangles > 0)
      return "a cut within a budget is saved at a level by hand: choose its triangles in the section Surface";
    const Result<View> view = shown->viewOf(camera, settings);
    if (!view) return view.error().describe();
    const Vec3 eye = shown->space().position(camera);
    const Vec3 target = eye + shown->space().forward(lookOf(camera)) * shown->box().diagonal();
    SurfaceCamera stated{shown->inFile(eye), shown->inFile(target), camera.verticalFieldOfViewDegrees,
                         double(camera.widthPixels), double(camera.heightPixels)};
    stated.parallelHeight = camera.parallelHeight;
    if (!isUpright(*shown, stated, *view))
      return "no command can state what is up for this camera: turn it, or choose a level by hand";
    const double pixels = object.figures.pixels > 0 ? object.figures.pixels : settings.pixels;
    const bool isParallel = camera.parallelHeight > 0;
    request = {option(" --camera=") + numbered(stated.eye) + "," + numbered(stated.target) +
                   (isParallel ? "" : fmt::format(",{}", camera.verticalFieldOfViewDegrees)),
               option(" --viewport"), fmt::format("{}x{}", camera.widthPixels, camera.heightPixels),
               option(" --pixel-error"), fmt::format("{}", pixels)};
    if (isParallel) {
      request.push_back(option(" --parallel-height"));
      request.push_back(fmt::format("{}", camera.parallelHeight));
    }
  }
  Order order;
  const std::string model = modelFor(order);
  CommandWords command = {"extract", model, "-o", fields.cut};
  command.insert(command.end(), request.begin(), request.end());
  order.commands.push_back(command);
  order.output = fields.cut;
  if (!order.told.empty()) command[1] = fs::path(file()).filename().replace_extension(".amt").string();
  order.told += textOf(command);
  return begin(std::move(order));
}

std::string SurfaceDesk::crop() {
  if (!surface()) return "a surface with a file can be cropped";
  if (!box_) return "show the box first";
  Order order;
  const std::string mesh = meshFor(order);
  const Box3& b = box_->box;
  CommandWords command = {"mesh",         "crop",
                          mesh,           "-o",
                          fields.cropped, option(" --box=") + numbered(b.low) + "," + numbered(b.high)};
  if (fields.keepsWhole) command.push_back(option(" --whole"));
  order.commands.push_back(command);
  order.output = fields.cropped;
  if (!order.told.empty()) command[2] = fs::path(file()).filename().replace_extension(".ply").string();
  order.told += textOf(command);
  return begin(std::move(order));
}

std::string SurfaceDesk::decimate() {
  if (!surface()) return "a surface with a file can be decimated";
  Order order;
  const std::string mesh = meshFor(order);
  CommandWords command = {"mesh",       "decimate", mesh, "-o", fields.decimated, option(" --operator"),
                          fields.method};
  if (!fields.triangles.empty())
    command.insert(command.end(), {option(" --max-triangles"), fields.triangles});
  if (!fields.error.empty()) command.insert(command.end(), {option(" --max-error"), fields.error});
  const CommandWords more = wordsOf(fields.more);
  command.insert(command.end(), more.begin(), more.end());
  order.commands.push_back(command);
  order.output = fields.decimated;
  if (!order.told.empty()) command[2] = fs::path(file()).filename().replace_extension(".ply").string();
  order.told += textOf(command);
  return begin(std::move(order));
}

std::string SurfaceDesk::begin(Order order) {
  if (isRunning()) return "something is being made already: stop it first";
  if (order.output.empty()) return "type a name for the file first";
  // A command may read what was made of the file, and so would not know that it writes over it.
  std::error_code absent;
  for (const std::string& shown : start_.files)
    if (!shown.empty() && fs::equivalent(shown, order.output, absent))
      return order.output + " is the file that is shown: choose another name";
  waiting_ = std::move(order);
  if (!question_.mayDo(Saving::mesh, waiting_->output)) return {};
  return run();
}

std::string SurfaceDesk::confirmed() {
  return waiting_ ? run() : std::string();
}

std::string SurfaceDesk::run() {
  running_ = std::exchange(waiting_, std::nullopt);
  job_.start(start_.program, running_->commands);
  return running_->told;
}

void SurfaceDesk::cancel() {
  if (isRunning() && start_.log) start_.log("stopped: " + running_->told);
  job_.cancel();
  // What was stopped may have been what was made in between; it is made anew.
  running_.reset();
}

std::string SurfaceDesk::step() {
  if (box_ && boxOf_ != objects_.selected()) toggleBox();
  if (box_) layers_.put(CropBox::kLayer, box_->edges());
  for (std::size_t i = 0; i < objects_.count(); ++i)
    objects_.object(i).kept = box_ && i == boxOf_ ? std::optional(box_->kept()) : std::nullopt;
  auto done = job_.take();
  if (!done) return {};
  const Order order = *std::exchange(running_, std::nullopt);
  lastCommand_ = order.told;
  const std::string said = *done ? firstLine(**done) + "\n" + order.told : done->error().describe();
  if (start_.log) start_.log(*done ? order.told : order.told + ": " + said);
  if (*done && fields.opens) opened_ = order.output;
  return said;
}

void SurfaceDesk::toggleBox() {
  layers_.remove(CropBox::kLayer);
  if (std::exchange(box_, std::nullopt).has_value()) return;
  const SurfaceSubject* const shown = surface();
  if (!shown) return;
  box_.emplace(*shown);
  boxOf_ = objects_.selected();
}

}  // namespace arete
