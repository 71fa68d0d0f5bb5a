// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/view/window_script.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>

#include "cli/arguments/arguments.h"

namespace arete {
namespace {

/// Verbs, and how many words follow.
const std::map<std::string, std::size_t, std::less<>>& verbs() {
  static const std::map<std::string, std::size_t, std::less<>> all = {
      {"halve", 0},    {"error", 1}, {"triangles", 1}, {"save", 1},   {"box", 1},    {"crop", 1},
      {"decimate", 3}, {"drag", 1},  {"click", 1},     {"open", 1},   {"yes", 0},    {"no", 0},
      {"select", 1},   {"key", 0},   {"play", 0},      {"around", 0}, {"frames", 1}, {"screenshot", 0},
      {"free", 0},     {"press", 1}, {"color", 1}};
  return all;
}

/// How many numbers the first word of a verb has; 0: it has none.
std::size_t numbersOf(std::string_view verb) {
  if (verb == "box") return 6;
  if (verb == "drag") return 4;
  if (verb == "click") return 2;
  return verb == "error" || verb == "triangles" || verb == "frames" || verb == "select" ? 1 : 0;
}

std::vector<double> numbersIn(const std::string& word) {
  const auto numbers = parseNumbers("", word);
  return numbers ? *numbers : std::vector<double>();
}

}  // namespace

Result<WindowScript> WindowScript::read(const std::string& path) {
  std::ifstream file(path);
  if (!file) return failure(ErrorCode::notFound, "cannot be read", path);
  WindowScript script;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (words.empty() || words.front().starts_with('#')) continue;
    const auto verb = verbs().find(words.front());
    const bool isKnown = verb != verbs().end() && words.size() == verb->second + 1;
    const std::size_t wanted = numbersOf(words.front());
    if (!isKnown || (wanted > 0 && numbersIn(words[1]).size() != wanted))
      return failure(ErrorCode::usage, "names an action that a window does not have: " + line,
                     fmt::format("{}, line {}", path, number));
    script.lines_.push_back(std::move(words));
  }
  return script;
}

bool WindowScript::step(ViewerSession& s) {
  if (!s.message().empty() && s.message() != said_) {
    said_ = s.message();
    std::printf("%s\n", said_.c_str());
    std::fflush(stdout);
  }
  if (s.desk && s.desk->isRunning()) return true;
  if (--wait_ > 0) return true;
  if (next_ >= lines_.size()) return false;
  wait_ = 3;
  const std::vector<std::string>& words = lines_[next_++];
  act(words.front(), words, s);
  return true;
}

void WindowScript::act(const std::string& verb, const std::vector<std::string>& words, ViewerSession& s) {
  SurfaceDesk& desk = *s.desk;
  desk.fields.opens = false;
  const std::vector<double> n = words.size() > 1 ? numbersIn(words[1]) : std::vector<double>();
  if (verb == "halve") s.apply(Action::coarsen);
  if (verb == "error") s.say(s.objects->setLevel(HandLevel{.error = n[0]}));
  if (verb == "triangles") s.say(s.objects->setLevel(HandLevel{.triangles = std::uint32_t(n[0])}));
  if (verb == "save") {
    desk.fields.cut = words[1];
    std::printf("drawn: %u triangles\n", s.figures.triangles);
    s.say(desk.saveCut(s.rig.camera(), s.cutSettings));
  }
  if (verb == "box") {
    if (!desk.box()) desk.toggleBox();
    if (desk.box()) desk.box()->box = Box3{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
  }
  if (verb == "crop") {
    desk.fields.cropped = words[1];
    s.say(desk.crop());
  }
  if (verb == "decimate") {
    desk.fields.method = words[1];
    desk.fields.triangles = words[2];
    desk.fields.decimated = words[3];
    s.say(desk.decimate());
  }
  if (verb == "drag") {
    // Pressed where it begins, held where it ends, and let go.
    InputState held{.seconds = 0.01, .isOverPicture = true, .mouse = {n[0], n[1]}, .leftButton = true};
    s.step(held);
    held.mouse = {n[2], n[3]};
    held.mouseMoved = {n[2] - n[0], n[3] - n[1]};
    s.step(held);
    s.step({.seconds = 0.01, .isOverPicture = true, .mouse = {n[2], n[3]}});
  }
  if (verb == "click") s.click({n[0], n[1]});
  if (verb == "open") s.files.next = words[1];
  if (verb == "yes" || verb == "no") s.answer(verb == "yes");
  if (verb == "select") s.say(s.objects->select(std::size_t(n[0])));
  if (verb == "key") s.apply(Action::setKeyFrame);
  if (verb == "play") s.apply(Action::playFlight);
  if (verb == "free") s.apply(Action::toggleMode);
  if (verb == "around") s.flyAround();
  if (verb == "press")
    for (const KeyBinding& key : keyBindings())
      if (key.name == words[1]) s.apply(key.action);
  if (verb == "color") s.say(s.colorByInk(words[1]));
  if (verb == "frames") wait_ = int(n[0]);
  if (verb == "screenshot") s.apply(Action::screenshot);
}

}  // namespace arete
