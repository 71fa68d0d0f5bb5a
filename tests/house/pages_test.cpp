// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the pages say about the sources: the papers that they cite and the rooms that they list.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "house/house.h"

namespace arete::house {
namespace {

namespace fs = std::filesystem;

const fs::path kPagesRoot = ARETE_SOURCE_FOLDER;
const fs::path kBibliography = kPagesRoot / "docs" / "bibliography.md";

std::string contentOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The keys in brackets within a text, as [Karney2013]. An index of an array, `a[N2000]`, is no key.
std::set<std::string> keysIn(const std::string& text) {
  static const std::regex pattern("(?:^|[^A-Za-z0-9_\\]])\\[((?:de)?[A-Z][A-Za-z]+[0-9]{4}[a-z]?)\\]");
  std::set<std::string> keys;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    keys.insert((*match)[1]);
  return keys;
}

/// The keys of the entries of a bibliography, in order: each entry begins a line, as **[Karney2013]**.
std::vector<std::string> entriesOf(const std::string& bibliography) {
  static const std::regex pattern("(?:^|\n)\\*\\*\\[(\\w+)\\]\\*\\*");
  std::vector<std::string> keys;
  for (std::sregex_iterator match(bibliography.begin(), bibliography.end(), pattern), end; match != end;
       ++match)
    keys.push_back((*match)[1]);
  return keys;
}

/// The sources, tests and pages, but for the bibliography and this test.
std::vector<fs::path> citingFiles() {
  std::vector<fs::path> files = {kPagesRoot / "README.md", kPagesRoot / "ARCHITECTURE.md"};
  for (const char* folder : {"engine", "measure", "surface", "terrain", "io", "gis", "python", "viewer",
                             "cli", "datasets", "bench", "tests", "docs"})
    for (const auto& entry : fs::recursive_directory_iterator(kPagesRoot / folder)) {
      const fs::path& file = entry.path();
      const bool isText = file.extension() == ".h" || file.extension() == ".cpp" || file.extension() == ".md";
      if (isText && file != kBibliography && file.filename() != "pages_test.cpp") files.push_back(file);
    }
  return files;
}

TEST(Bibliography, HasEveryCitedPaper) {
  const std::vector<std::string> entries = entriesOf(contentOf(kBibliography));
  ASSERT_GT(entries.size(), 20u);
  for (const fs::path& file : citingFiles())
    for (const std::string& key : keysIn(contentOf(file)))
      EXPECT_TRUE(std::ranges::count(entries, key) == 1)
          << fs::relative(file, kPagesRoot).string() << " cites [" << key << "]";
}

TEST(Bibliography, HasNoPaperThatIsNotCited) {
  std::set<std::string> cited;
  for (const fs::path& file : citingFiles()) cited.merge(keysIn(contentOf(file)));
  for (const std::string& key : entriesOf(contentOf(kBibliography))) EXPECT_TRUE(cited.contains(key)) << key;
}

TEST(Bibliography, IsSortedByKey) {
  std::vector<std::string> keys = entriesOf(contentOf(kBibliography));
  for (std::string& key : keys)
    std::ranges::transform(key, key.begin(), [](unsigned char c) { return std::tolower(c); });
  EXPECT_EQ(std::ranges::adjacent_find(keys, std::ranges::greater_equal()), keys.end())
      << *std::ranges::adjacent_find(keys, std::ranges::greater_equal());
}

TEST(Bibliography, KeysAreFoundInCommentsAndNotInIndices) {
  EXPECT_EQ(keysIn("/// by [deBergDobrindt1995], [Karney2013]; a[N2000] [x1990] [Key90]\n[Duda2013]"),
            (std::set<std::string>{"deBergDobrindt1995", "Karney2013", "Duda2013"}));
  EXPECT_EQ(entriesOf("**[A2000]** x\n\n**[B2001]** y [C2002]"),
            (std::vector<std::string>{"A2000", "B2001"}));
}

/// The folders of the repository that hold what people write: no builds, no inputs of the fuzzers.
const std::vector<std::string> kFolders = {"engine",   "measure", "surface", "terrain",  "io",
                                           "gis",      "python",  "viewer",  "cli",      "tests",
                                           "datasets", "bench",   "cmake",   "examples", "docs"};

/// The names of all files, with and without their folders.
std::set<std::string> fileNames() {
  std::set<std::string> names;
  for (const std::string& folder : kFolders)
    for (const auto& entry : fs::recursive_directory_iterator(kPagesRoot / folder)) {
      names.insert(fs::relative(entry.path(), kPagesRoot).string());
      names.insert(entry.path().filename().string());
    }
  return names;
}

/// The files that a comment names: "engine/cut/cut.h", or "cut.h" alone.
std::set<std::string> filesNamedIn(const std::string& comment) {
  static const std::regex pattern(
      "(?:^|[^A-Za-z0-9_/.<\"*-])((?:[a-z0-9_]+/)*[a-z0-9_-]*[a-z0-9]\\.(?:h|cpp|md|py|cmake))\\b");
  std::set<std::string> files;
  for (std::sregex_iterator match(comment.begin(), comment.end(), pattern), end; match != end; ++match)
    files.insert((*match)[1]);
  return files;
}

TEST(Comments, NameFilesThatExist) {
  const std::set<std::string> names = fileNames();
  for (const std::string& folder : kFolders)
    for (const auto& entry : fs::recursive_directory_iterator(kPagesRoot / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      if (entry.path().parent_path() == kPagesRoot / "tests" / "house") continue;  // they name planted files
      std::ifstream stream(entry.path());
      int number = 0;
      for (std::string line; std::getline(stream, line);) {
        ++number;
        const std::size_t comment = line.find("//");
        if (comment == std::string::npos || line.starts_with("#include")) continue;
        for (const std::string& file : filesNamedIn(line.substr(comment)))
          EXPECT_TRUE(names.contains(file))
              << fs::relative(entry.path(), kPagesRoot).string() << ":" << number << ": there is no " << file;
      }
    }
}

TEST(Comments, AreReadForTheFilesThatTheyName) {
  EXPECT_EQ(filesNamedIn("// see cut.h, engine/cut/front.cpp (docs/topics/amt-format.md), <vector.h>, *.cpp"),
            (std::set<std::string>{"cut.h", "engine/cut/front.cpp", "docs/topics/amt-format.md"}));
}

// ARCHITECTURE.md has one line for each room, with the sentence that its CMakeLists.txt begins with.
TEST(Architecture, ListsEveryRoomWithItsSentence) {
  const std::string page = contentOf(kPagesRoot / "ARCHITECTURE.md");
  for (const auto& [room, declared] : readRooms(ARETE_ROOMS)) {
    std::ifstream stream(kPagesRoot / room / "CMakeLists.txt");
    std::string line;
    std::getline(stream, line);
    const std::string start = "# " + room + ": ";
    ASSERT_TRUE(line.starts_with(start)) << room << "/CMakeLists.txt begins with: " << line;
    const std::string row = fmt::format("| {} | {} |", room, line.substr(start.size()));
    EXPECT_NE(page.find(row), std::string::npos) << "ARCHITECTURE.md lacks: " << row;
  }
}

TEST(Architecture, ListsNoRoomThatDoesNotExist) {
  const std::string page = contentOf(kPagesRoot / "ARCHITECTURE.md");
  const Rooms rooms = readRooms(ARETE_ROOMS);
  static const std::regex pattern("\n\\| ([a-z0-9]+(?:/[a-z0-9]+)+) \\|");
  for (std::sregex_iterator match(page.begin(), page.end(), pattern), end; match != end; ++match)
    EXPECT_TRUE(rooms.contains((*match)[1])) << (*match)[1];
}

// A decision says what was decided, whether it holds, and no more than that.
TEST(Decisions, AreShortAndHaveAStatusAndALineInTheList) {
  const std::string list = contentOf(kPagesRoot / "docs" / "decisions" / "README.md");
  for (const auto& entry : fs::directory_iterator(kPagesRoot / "docs" / "decisions")) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md") continue;
    const std::string text = contentOf(entry.path());
    EXPECT_NE(text.find("\nStatus: "), std::string::npos) << name;
    std::istringstream words(text);
    EXPECT_LE(std::distance(std::istream_iterator<std::string>(words), {}), 400) << name;
    EXPECT_NE(list.find("(" + name + ")"), std::string::npos) << name << " is not in the list";
  }
}

}  // namespace
}  // namespace arete::house
