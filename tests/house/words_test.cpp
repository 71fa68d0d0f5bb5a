// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words of the sources and pages: no option of the command line in the library, and none of the words
// that lend data a mind. A small lexer keeps the comments and string literals of a C++ file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "house/house.h"

namespace arete::house {
namespace {

namespace fs = std::filesystem;

const fs::path kSources = ARETE_SOURCE_FOLDER;

/// Text of a file with the line that each character comes from.
struct Prose {
  std::string text;
  std::vector<int> lines;

  void add(char c, int line) {
    text += c;
    lines.push_back(line);
  }
};

enum class Kind { comments, strings };

/// Splits a C++ source into comments and string literals.
class Lexer {
 public:
  explicit Lexer(std::string source) : source_(std::move(source)) {}

  /// @return the text of that kind; a space between two pieces, so that a sentence over several lines is one.
  Prose take(Kind kind) {
    Prose prose;
    for (at_ = 0, line_ = 1; at_ < source_.size();) {
      if (startsWith("//")) {
        const bool isKept = kind == Kind::comments;
        while (at_ < source_.size() && source_[at_] != '\n') keep(prose, isKept && source_[at_] != '/');
        if (isKept) prose.add(' ', line_);
      } else if (startsWith("/*")) {
        const std::size_t end = std::min(source_.find("*/", at_), source_.size());
        while (at_ < end) keep(prose, kind == Kind::comments);
      } else if (startsWith("#include")) {
        while (at_ < source_.size() && source_[at_] != '\n') keep(prose, false);
      } else if (startsWith("R\"")) {
        const std::size_t open = source_.find('(', at_);
        const std::string close = ")" + source_.substr(at_ + 2, open - at_ - 2) + "\"";
        const std::size_t end = std::min(source_.find(close, at_), source_.size());
        while (at_ < end) keep(prose, kind == Kind::strings && at_ > open);
        for (std::size_t i = 0; i < close.size() && at_ < source_.size(); ++i) keep(prose, false);
      } else if (source_[at_] == '"') {
        keep(prose, false);
        while (at_ < source_.size() && source_[at_] != '"') {
          if (source_[at_] == '\\') keep(prose, false);
          if (at_ < source_.size()) keep(prose, kind == Kind::strings);
        }
        if (at_ < source_.size()) keep(prose, false);
        if (!isJoined()) prose.add('\n', line_);
      } else if (source_[at_] == '\'' && at_ + 2 < source_.size() && !isWordBefore()) {
        keep(prose, false);
        while (at_ < source_.size() && source_[at_] != '\'') {
          if (source_[at_] == '\\') keep(prose, false);
          if (at_ < source_.size()) keep(prose, false);
        }
        if (at_ < source_.size()) keep(prose, false);
      } else {
        keep(prose, false);
      }
    }
    return prose;
  }

 private:
  bool startsWith(std::string_view text) const { return source_.compare(at_, text.size(), text) == 0; }
  /// Whether the literal that ended here goes on in the next one.
  bool isJoined() const {
    const std::size_t next = source_.find_first_not_of(" \t\n", at_);
    return next != std::string::npos && source_[next] == '"';
  }
  /// 1'000 is a number, not a character.
  bool isWordBefore() const {
    return at_ > 0 && std::isalnum(static_cast<unsigned char>(source_[at_ - 1])) != 0;
  }
  void keep(Prose& prose, bool isKept) {
    if (isKept) prose.add(source_[at_], line_);
    line_ += source_[at_] == '\n' ? 1 : 0;
    ++at_;
  }

  std::string source_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::string textOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Prose wholeText(const std::string& text) {
  Prose prose;
  int line = 1;
  for (const char c : text) {
    prose.add(c == '\n' ? ' ' : c, line);
    line += c == '\n' ? 1 : 0;
  }
  return prose;
}

/// "line: match", for each match of a pattern.
std::vector<std::string> matchesIn(const Prose& prose, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator match(prose.text.begin(), prose.text.end(), pattern), end; match != end;
       ++match) {
    if (match->size() > 1 && (*match)[1].matched && match->str().ends_with("none")) continue;
    found.push_back(
        fmt::format("{}: {}", prose.lines[static_cast<std::size_t>(match->position(0))], match->str()));
  }
  return found;
}

/// An option of this command line: two hyphens and a word (--filters.* are PDAL's).
const std::regex& optionPattern() {
  static const std::regex pattern("--(?!filters\\.)[a-z][a-z0-9-]*");
  return pattern;
}

/// Words that make data think. "is none of" and "there is none" are plain English: the latter is the first
/// group.
const std::regex& wordPattern() {
  static const std::regex pattern(
      "\\b(there\\s+)?(nobody|whoever|foresees?|wishes|(is|are)\\s+told|asks\\s+for|shall|is\\s+none(?!\\s+"
      "of))\\b",
      std::regex::icase);
  return pattern;
}

std::vector<fs::path> sourcesOf(const std::vector<std::string>& layers) {
  std::vector<fs::path> files;
  for (const std::string& layer : layers)
    for (const auto& entry : fs::recursive_directory_iterator(kSources / layer))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
        files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> files = {kSources / "README.md", kSources / "ARCHITECTURE.md",
                                 kSources / "CONTRIBUTING.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kSources / "docs"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string nameOf(const fs::path& file) {
  return fs::relative(file, kSources).string();
}

/// Whether a literal is part of a command line that the library composes: the one that a certificate tells
/// its readers to run.
bool isOfACommandLine(std::string_view literal) {
  return literal.starts_with(" --") || literal.starts_with("arete ");
}

/// "line: option", for each option in a string literal that is not part of a command line.
std::vector<std::string> optionsNamedIn(const Prose& strings) {
  std::vector<std::string> found;
  for (std::size_t begin = 0; begin < strings.text.size();) {
    const std::size_t end = std::min(strings.text.find('\n', begin), strings.text.size());
    const auto first = strings.lines.begin();
    const Prose literal{strings.text.substr(begin, end - begin),
                        {first + std::ptrdiff_t(begin), first + std::ptrdiff_t(end)}};
    if (!isOfACommandLine(literal.text))
      for (std::string& match : matchesIn(literal, optionPattern())) found.push_back(std::move(match));
    begin = end + 1;
  }
  return found;
}

TEST(Words, OfTheLibraryNameNoOptionOfTheCommandLine) {
  for (const fs::path& file :
       sourcesOf({"engine", "measure", "surface", "terrain", "io", "gis", "python", "viewer"})) {
    for (const std::string& match : optionsNamedIn(Lexer(textOf(file)).take(Kind::strings)))
      ADD_FAILURE() << nameOf(file) << ":" << match;
  }
}

TEST(Words, OfSourcesLendDataNoMind) {
  for (const fs::path& file :
       sourcesOf({"engine", "measure", "surface", "terrain", "io", "gis", "python", "viewer", "cli"})) {
    for (const Kind kind : {Kind::comments, Kind::strings})
      for (const std::string& match : matchesIn(Lexer(textOf(file)).take(kind), wordPattern()))
        ADD_FAILURE() << nameOf(file) << ":" << match;
  }
}

TEST(Words, OfPagesLendDataNoMind) {
  for (const fs::path& file : pages())
    for (const std::string& match : matchesIn(wholeText(textOf(file)), wordPattern()))
      ADD_FAILURE() << nameOf(file) << ":" << match;
}

/// A number with a noun and a verb that are right for several only, as in "{} faces are left out", which
/// counted() of engine/base/counted.h words for one as well. Not where the number is one of many in any case:
/// "{} points are more than can be numbered".
const std::regex& unagreedPattern() {
  static const std::regex pattern(
      "\\{[^{}]*\\} (?:of (?:its|the|\\{[^{}]*\\}) )?(?:(?!(?:the|that|have|are|do|is|has|of)\\b)[a-z]+ "
      "){0,3}[a-z]+s "
      "(?:(?:have|are|do|lie|stand|repeat|need|cross|differ|occur|meet)\\b(?! (?:more|larger|already) ))");
  return pattern;
}

/// Whether the number is never one there, or no number: the sentence for one stands beside it, or the count
/// is of bytes of a file that was made.
bool isOfMany(std::string_view match) {
  constexpr const char* kMany[] = {"} points lie",          "} points have",      "} nodes are",
                                   "} more attributes are", "} samples are",      "} of its vertices are",
                                   "} files have",          "} other files have", "} bytes do",
                                   "} bytes are",           "} bytes that are",   "} slots do"};
  const auto isIn = [&](std::string_view known) { return match.find(known) != match.npos; };
  return std::ranges::any_of(kMany, isIn);
}

TEST(Words, AgreeWithTheirNumbers) {
  for (const fs::path& file :
       sourcesOf({"engine", "measure", "surface", "terrain", "io", "gis", "python", "viewer", "cli"}))
    for (const std::string& match : matchesIn(Lexer(textOf(file)).take(Kind::strings), unagreedPattern()))
      if (!isOfMany(match)) ADD_FAILURE() << nameOf(file) << ":" << match;
}

TEST(Words, OfNumbersAreFoundWhereOneWouldBeWrong) {
  const auto found = [](const char* text) { return !matchesIn(wholeText(text), unagreedPattern()).empty(); };
  for (const char* wrong :
       {"{} faces are left out", "{} of its faces have no colour", "{} valid samples are in none",
        "{:.3} points have no height", "{} of {} vertices do not have it"})
    EXPECT_TRUE(found(wrong)) << wrong;
  for (const char* right : {"{} are left out", "{} triangles are more than can be measured",
                            "a triangle of {} faces", "{} {} left out", "in {} bytes"})
    EXPECT_FALSE(found(right)) << right;
}

/// A habit of these sources that a stranger stumbles over, and how often comments and sentences may have it:
/// as often as on the day that it was counted. The number only falls.
struct Habit {
  const char* pattern;
  std::size_t budget;
};

TEST(Words, OfHabitsThatAreHardToReadBecomeFewer) {
  constexpr Habit kHabits[] = {{"\\b(those|that) of\\b", 461},
                               {"\\bas of\\b", 9},
                               {"\\bis no [a-z]+", 124},
                               {"\\bso many\\b", 33},
                               {"\\bOf (a|an|the) [a-z]+: ", 9}};
  std::vector<Prose> texts;
  for (const fs::path& file :
       sourcesOf({"engine", "measure", "surface", "terrain", "io", "gis", "python", "viewer", "cli"}))
    for (const Kind kind : {Kind::comments, Kind::strings}) texts.push_back(Lexer(textOf(file)).take(kind));
  for (const Habit& habit : kHabits) {
    const std::regex pattern(habit.pattern);
    std::size_t count = 0;
    for (const Prose& text : texts) count += matchesIn(text, pattern).size();
    EXPECT_LE(count, habit.budget) << habit.pattern << ": write a sentence with a subject";
  }
}

// The test itself, on planted text.

TEST(Lexer, KeepsCommentsApartFromStrings) {
  const std::string source =
      "// one\nint a = 1'000; const char* b = \"two // three\"; /* four\nfive */ char c = '\"';  // six "
      "\"x\"\n";
  const std::string comments = Lexer(source).take(Kind::comments).text;
  for (const char* word : {"one", "four", "five", "six"})
    EXPECT_NE(comments.find(word), std::string::npos) << word;
  EXPECT_EQ(comments.find("two"), std::string::npos);
  const std::string strings = Lexer(source).take(Kind::strings).text;
  EXPECT_EQ(strings, "two // three\n");
}

TEST(Lexer, JoinsLiteralsThatStandSideBySide) {
  EXPECT_EQ(Lexer("f(\"is \"\n  \"none\", \"x\")").take(Kind::strings).text, "is none\nx\n");
}

TEST(Lexer, TakesRawStringsAndEscapesAndNoIncludes) {
  const std::string source = "#include \"a--b.h\"\nR\"x(raw \" text)x\" \"an \\\"escape\\\"\"";
  const std::string strings = Lexer(source).take(Kind::strings).text;
  EXPECT_NE(strings.find("raw \" text"), std::string::npos) << strings;
  EXPECT_NE(strings.find("an \"escape\""), std::string::npos) << strings;
  EXPECT_EQ(strings.find("a--b"), std::string::npos) << strings;
}

TEST(Lexer, NamesTheLineOfAMatchThatGoesOverLines) {
  const Prose prose =
      Lexer("int a;\n// what the reader is\n// told, or the one nobody asks\n").take(Kind::comments);
  EXPECT_EQ(matchesIn(prose, wordPattern()), (std::vector<std::string>{"2: is  told", "3: nobody"}));
}

TEST(Lexer, FindsOptionsAndLeavesHyphensAlone) {
  const auto found = [](const char* text) { return matchesIn(wholeText(text), optionPattern()); };
  EXPECT_EQ(found("say --max-error 5"), std::vector<std::string>{"1: --max-error"});
  for (const char* text : {"a - b", "a -- b", "x-y", "-5", "--"}) EXPECT_TRUE(found(text).empty()) << text;
}

TEST(Lexer, LeavesComposedCommandLinesAlone) {
  const auto found = [](const std::string& source) {
    return optionsNamedIn(Lexer(source).take(Kind::strings));
  };
  for (const char* source : {"f(\" --band {}\")", "f(\"arete measure {} \" \"--expect {}\")"})
    EXPECT_TRUE(found(source).empty()) << source;
  EXPECT_EQ(found("f(\" --a\");\nf(\"state --b\",\n  \"--c\")"),
            (std::vector<std::string>{"2: --b", "3: --c"}));
}

TEST(Lexer, FindsWordsAndLeavesPlainEnglishAlone) {
  const auto found = [](const char* text) { return matchesIn(wholeText(text), wordPattern()).size(); };
  for (const char* text :
       {"Nobody", "a root that is none", "shall be", "the reader is told", "asks for", "it foresees"})
    EXPECT_EQ(found(text), 1u) << text;
  for (const char* text : {"'x' is none of a, b", "shallow", "the option tells", "asked for", "marshall"})
    EXPECT_EQ(found(text), 0u) << text;
}

}  // namespace
}  // namespace arete::house
