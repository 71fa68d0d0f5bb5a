// SPDX-License-Identifier: GPL-3.0-or-later
//
// The argument and --output are two options of the parser that write to one text: which of them was stated
// decides what is checked. What a shell makes of `*.ply` must not cost a file: an argument that exists and
// looks like the input is not replaced.
#include "cli/session/output_argument.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOutputArgument = "OUTPUT";
/// Options that write the answer as well, so that a command may do without its output.
constexpr std::array kOtherOutputs = {"--polygons", "--png"};

std::string lowered(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : static_cast<char>(c);
  });
  return text;
}

/// Whether a file is this program's: its formats name the program near their beginning.
bool isOwnOutput(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(4096, '\0');
  file.read(begin.data(), std::streamsize(begin.size()));
  return lowered(begin).find("arete") != std::string::npos;
}

/// Whether an output by position may be a second input, which `arete convert *.ply` has: a file of another
/// name that exists, has the ending of the input, and was not written by this program.
bool mayBeAnInput(const CLI::App& command, const std::string& output) {
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() || option->count() == 0 || option->get_name() == kOutputArgument) continue;
    const fs::path input = option->results().front();
    std::error_code ignored;
    return lowered(input.extension().string()) == lowered(fs::path(output).extension().string()) &&
           fs::exists(output, ignored) && !fs::equivalent(input, output, ignored) && !isOwnOutput(output);
  }
  return false;
}

}  // namespace

void addOutputArgument(CLI::App& command, std::string& path, std::vector<std::string> extensions) {
  const std::string known = fmt::format("{}", fmt::join(extensions, ", "));
  const auto check = [&command, extensions = std::move(extensions), known](std::string& text) -> std::string {
    const std::string name = lowered(text);
    const bool isKnown = std::ranges::any_of(extensions, [&](const std::string& extension) {
      return name.size() > extension.size() && name.ends_with(extension);
    });
    if (isKnown) return {};
    // All words are known by now: with --output this one is too many.
    if (command.get_option("--output")->count() > 0)
      throw CLI::ExtrasError(command.get_name(), std::vector<std::string>{text});
    return fmt::format("'{}' does not end in {}; an output of another name is stated with --output", text,
                       known);
  };
  command
      .add_option(kOutputArgument, path,
                  "Output, instead of --output, where its name ends in a format that is written")
      ->check(CLI::Validator(check, ""))
      ->type_name("");
}

bool hasOutputArgument(const CLI::App& command) {
  return command.get_option_no_throw(kOutputArgument) != nullptr;
}

void requireOneOutput(const CLI::App& command) {
  if (!hasOutputArgument(command)) return;
  const CLI::Option& argument = *command.get_option(kOutputArgument);
  const CLI::Option& option = *command.get_option("--output");
  if (argument.count() == 0 && option.count() == 0) {
    std::vector<std::string> others;
    bool hasOther = false;
    for (const char* name : kOtherOutputs) {
      const CLI::Option* other = command.get_option_no_throw(name);
      if (other == nullptr) continue;
      others.emplace_back(name);
      hasOther = hasOther || other->count() > 0;
    }
    if (others.empty()) throw CLI::RequiredError("--output");
    if (!hasOther)
      throw CLI::ValidationError(fmt::format("--output is required, or {}", fmt::join(others, " or ")));
  }
  if (argument.count() > 0 && option.count() > 0)
    throw CLI::ValidationError(fmt::format("there are two outputs, {} and --output {}",
                                           argument.results().front(), option.results().front()));
  if (argument.count() > 0 && mayBeAnInput(command, argument.results().front()))
    throw CLI::ValidationError(
        fmt::format("{} exists and may be a second input, and there is one; --output {} replaces it",
                    argument.results().front(), argument.results().front()));
}

}  // namespace arete
