// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every command with every kept and generated hostile file: it ends in time, with one of the exit codes that
// the help lists for files and data, and says why in lines of its own. The sanitizers of a build watch all of
// it.
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "full_run.h"
#include "fuzz/hostile_amt.h"
#include "io/geo/dem/raster_writer.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"

namespace arete::fuzz {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

#ifdef ARETE_SANITIZED
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif
constexpr int kMillisecondsAllowed = kIsSanitized ? 60'000 : 20'000;

/// The short run is a sample of the long one: of every build, and of the sanitized one all.
bool isLong() {
  return kIsSanitized || test::isFull();
}

/// Commands for files of one kind. FILE stands for the file, OUT for the name of an output without extension.
struct Row {
  std::string_view folder;  ///< in tests/fuzz/corpus
  std::vector<std::string_view> commands;
  /// Too slow for each file: with every tenth, in a long run.
  std::vector<std::string_view> slow = {};
};

const std::vector<Row>& rows() {
  static const std::vector<Row> table = {
      {"amt",
       {"info FILE --json",
        "validate FILE --fronts 2",
        "extract FILE -o OUT.ply --max-error 1",
        "extract FILE -o OUT.ply --max-error 2 --fit triangles",
        "extract FILE -o OUT.obj --max-error 3 --fit error",
        "extract FILE -o OUT.stl --max-triangles 20 --certificate OUT.json",
        "extract FILE -o OUT.glb --max-error 2 --method saturated",
        "extract FILE -o OUT.2dm --max-error 0",
        "extract FILE -o OUT.gpkg --max-error 0.5 --region BOX --outside-error 5",
        "extract FILE -o OUT.ply --max-error 1 --region BOX --fit triangles",
        "extract FILE -o OUT.tif --max-error 1 --error-raster OUT_e.tif",
        "extract FILE -o OUT.ply --camera P1,9 --look 10,-20 --pixel-error 2",
        "extract FILE -o OUT.ply --deadline 20",
        "height FILE --at P1 --at P2 --at 1e300,7",
        "height FILE --at P1 --max-error 1 -o OUT.csv",
        "los FILE --from P1,5 --to P2,2 --method descent",
        "los FILE --from P1,5 --to P2,2 --method pyramid",
        "los FILE --from P1,5 --to P2,2 --method scan --frequency 900",
        "los FILE --from P1,5 --to P2,2 --method embree",
        "profile FILE --along P1,5:P2,2 -o OUT.csv",
        "viewshed FILE --observer P1,5 -o OUT.tif",
        "convert FILE -o OUT.amt --packed",
        "convert FILE -o OUT.amt"},
       {"view FILE --headless --screenshot OUT.png --size 64x48 --camera P1,40,10,-20"}},
      {"ply",
       {"convert FILE -o OUT.gpkg", "measure FILE dem.tif --expect 1", "measure FILE plain.ply --samples 50",
        "mesh info FILE --json", "mesh repair FILE -o OUT.obj --weld 0.1% --fill-holes 9 --split-sheets",
        "mesh crop FILE -o OUT.glb --box ,,,500090,,",
        "build FILE -o OUT.amt --as points --same-place first"}},
      {"obj",
       {"convert FILE -o OUT.glb", "measure FILE dem.tif --json", "measure plain.ply FILE --samples 50",
        "mesh info FILE", "mesh repair FILE -o OUT.ply --fill-holes 3",
        "mesh crop FILE -o OUT.off --box ,,,500090,, --whole"}},
      {"off",
       {"mesh info FILE --no-self-intersections", "mesh repair FILE -o OUT.stl --weld 0.5",
        "mesh crop FILE -o OUT.obj --box ,,,500090,,"}},
      {"stl",
       {"convert FILE -o OUT.2dm", "measure FILE dem.tif", "mesh info FILE --json",
        "mesh repair FILE -o OUT.gltf", "mesh crop FILE -o OUT.stl --box ,,,500090,,"}},
      {"glb",
       {"convert FILE -o OUT.ply", "measure FILE dem.tif", "mesh info FILE",
        "mesh repair FILE -o OUT.glb --split-sheets", "mesh crop FILE -o OUT.obj --box ,,,500090,,"}},
      {"gltf",
       {"mesh info FILE", "mesh repair FILE -o OUT.obj", "mesh crop FILE -o OUT.gltf --box ,,,500090,,"}},
      {"2dm",
       {"convert FILE -o OUT.stl", "measure FILE dem.tif", "mesh info FILE", "mesh repair FILE -o OUT.2dm",
        "mesh crop FILE -o OUT.2dm --box ,,,500090,,"}},
      {"points",
       {"build FILE -o OUT.amt", "height dem.amt --points FILE -o OUT.gpkg",
        "los dem.amt --from 500050,5199950,5 --points FILE -o OUT.csv --target-height 1",
        "build dem.tif -o OUT.amt --fixed FILE", "extract dem.amt -o OUT.ply --max-error 1 --region FILE",
        "viewshed dem.amt --observers FILE --observer-height 2 --mode count -o OUT.tif"}},
  };
  return table;
}

/// The process that runs the commands.
class Runner {
 public:
  explicit Runner(fs::path folder) : folder_(std::move(folder)) { start(); }
  ~Runner() { stop(); }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// Runs one. @return What is wrong with it; empty where nothing is.
  std::string run(const Words& words) {
    std::string line = fmt::format("{}\n", fmt::join(words, "\t"));
    if (write(to_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
      return again("cannot be started");
    pollfd ready{from_, POLLIN, 0};
    if (poll(&ready, 1, kMillisecondsAllowed) == 0) return again("does not end in time");
    std::array<char, 16> answer{};
    const ssize_t got = read(from_, answer.data(), answer.size() - 1);
    if (got <= 0) return again("ends the program");
    code_ = std::atoi(answer.data());
    return problemOf(code_);
  }
  /// Of the last command that ended.
  int code() const { return code_; }

 private:
  std::string said() const {
    std::ifstream in(folder_ / "err", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::string problemOf(int code) const {
    const std::string err = said();
    const bool lacksMemory = code == 1 && err.find("not enough memory") != err.npos;
    constexpr std::array<int, 5> kAllowed = {0, 2, 3, 4, 5};
    if (!lacksMemory && std::ranges::find(kAllowed, code) == kAllowed.end())
      return fmt::format("exit code {}: {}", code, err);
    for (std::size_t begin = 0; begin < err.size();) {
      const std::size_t end = std::min(err.find('\n', begin), err.size());
      const std::string_view line = std::string_view(err).substr(begin, end - begin);
      if (!line.starts_with("arete: ") && !line.starts_with("See arete"))
        return fmt::format("raw text: {}", err);
      begin = end + 1;
    }
    if (code != 0 && err.empty()) return fmt::format("exit code {} without a word", code);
    if (err.find("is a bug") != err.npos) return err;
    return {};
  }

  /// The problem, after a new process has taken the place of the old one.
  std::string again(std::string_view problem) {
    const int status = stop();
    std::string text =
        fmt::format("{}, {} {}: {}", problem, WIFSIGNALED(status) ? "signal" : "exit code",
                    WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), said().substr(0, 4000));
    start();
    return text;
  }

  void start() {
    std::array<int, 2> in{}, out{};
    ASSERT_TRUE(pipe2(in.data(), O_CLOEXEC) == 0 && pipe2(out.data(), O_CLOEXEC) == 0);
    child_ = fork();
    if (child_ == 0) {
      // The numbers of the pipes may be those that they are to get.
      const int input = fcntl(in[0], F_DUPFD, 10), output = fcntl(out[1], F_DUPFD, 10);
      if (chdir(folder_.c_str()) != 0 || dup2(input, STDIN_FILENO) < 0 || dup2(output, 3) < 0) _exit(99);
      close(input);
      close(output);
      if (!kIsSanitized) {  // sanitizers reserve terabytes of addresses
        const rlimit memory{std::uint64_t{16} << 30, std::uint64_t{16} << 30};
        setrlimit(RLIMIT_AS, &memory);
      }
      execl(ARETE_RUN_COMMANDS, ARETE_RUN_COMMANDS, nullptr);
      _exit(98);
    }
    close(in[0]);
    close(out[1]);
    to_ = in[1];
    from_ = out[0];
  }

  int stop() {
    close(to_);
    close(from_);
    // One that hangs is ended; one that has ended already keeps its status.
    kill(child_, SIGKILL);
    int status = 0;
    waitpid(child_, &status, 0);
    return status;
  }

  fs::path folder_;
  pid_t child_ = -1;
  int to_ = -1, from_ = -1, code_ = -1;
};

/// Two places on a model, as the commands take them, and a box around the first.
struct Places {
  std::array<Vec2, 2> at = {{{300, 300}, {600, 700}}};
  double reach = 100;

  static Places of(const fs::path& path) {
    Places places;
    const auto file = openAmt(path.string());
    if (!file) return places;
    const TerrainModel& model = file->model();
    if (model.isRaster) {
      places.at = {model.georeference.toSource(1.3, 1.2), model.georeference.toSource(4.4, 3.4)};
      places.reach = 2 * std::abs(model.georeference.geoTransform[1]);
      return places;
    }
    const MtArrays& arrays = model.mt.arrays();
    for (std::size_t i = 0; i < 2 && !arrays.rootTriangles.empty(); ++i) {
      Vec2 middle{};
      for (const std::uint32_t v : arrays.rootTriangles[i * (arrays.rootTriangles.size() - 1)]) {
        if (v >= arrays.vertices.plan.size()) return places;
        middle = {middle.x + arrays.vertices.plan[v].x / 3, middle.y + arrays.vertices.plan[v].y / 3};
      }
      places.at[i] = middle;
    }
    return places;
  }
  std::string text(std::size_t i) const { return fmt::format("{},{}", at[i].x, at[i].y); }
  std::string box() const {
    return fmt::format("{},{},{},{}", at[0].x - reach, at[0].y - reach, at[0].x + reach, at[0].y + reach);
  }
};

void replaceAll(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
    text.replace(at, from.size(), to);
}

Words wordsOf(std::string_view command, const fs::path& file, const Places& places) {
  Words words;
  while (!command.empty()) {
    const std::size_t end = std::min(command.find(' '), command.size());
    std::string word(command.substr(0, end));
    command.remove_prefix(std::min(end + 1, command.size()));
    if (word == "FILE") word = file.filename().string();
    if (word.starts_with("OUT")) word = "o" + word.substr(3);
    replaceAll(word, "P1", places.text(0));
    replaceAll(word, "P2", places.text(1));
    replaceAll(word, "BOX", places.box());
    words.push_back(std::move(word));
  }
  // How long a command takes should not depend on its neighbours.
  words.insert(words.end(), {"--threads", "1"});
  return words;
}

class Commands : public ::testing::Test {
 protected:
  void SetUp() override {
    signal(SIGPIPE, SIG_IGN);
    std::string pattern = (fs::temp_directory_path() / "arete-commands-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    const RasterHeightfield dem = rasterFamilies().front().make(9, 7, 1);
    ASSERT_TRUE(writeGeoTiff((folder_ / "dem.tif").string(), dem.columns, dem.rows, dem.heights,
                             dem.georeference, {}));
    const auto model = build(dem);
    ASSERT_TRUE(model && writeAmt((folder_ / "dem.amt").string(), *model, {}, {}));
    Runner runner(folder_);
    ASSERT_EQ(runner.run(wordsOf("extract dem.amt -o plain.ply --max-error 5", {}, {})), "");
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  /// Copies of the kept files, with the extension of their kind. In a short run every `step`-th.
  std::vector<fs::path> kept(std::string_view kind, std::size_t step) const {
    std::vector<fs::path> all, copies;
    for (const auto& entry : fs::directory_iterator(fs::path(ARETE_FUZZ_CORPUS) / kind))
      all.push_back(entry.path());
    std::ranges::sort(all);
    for (std::size_t i = 0; i < all.size(); i += isLong() ? 1 : step) {
      const std::string extension = kind == "points" ? "csv" : std::string(kind);
      const fs::path copy = folder_ / fmt::format("{}-{}.{}", kind, i, extension);
      fs::copy_file(all[i], copy);
      copies.push_back(copy);
      named_.emplace_back(copy.filename().string(), all[i].filename().string());
    }
    return copies;
  }

  void runAll(const Row& row, const std::vector<fs::path>& files) {
    Runner runner(folder_);
    for (std::size_t i = 0; i < files.size(); ++i) {
      const Places places = row.folder == "amt" ? Places::of(files[i]) : Places();
      std::vector<std::string_view> commands = row.commands;
      if (isLong() && i % 10 == 0) commands.insert(commands.end(), row.slow.begin(), row.slow.end());
      for (const std::string_view command : commands) {
        const Words words = wordsOf(command, files[i], places);
        EXPECT_EQ(runner.run(words), "") << fmt::format("{}", fmt::join(words, " ")) << "\n"
                                         << nameOf(files[i]);
      }
    }
  }

  std::string nameOf(const fs::path& file) const {
    for (const auto& [copy, name] : named_)
      if (copy == file.filename()) return name;
    return file.filename().string();
  }

  fs::path folder_;
  mutable std::vector<std::pair<std::string, std::string>> named_;
};

TEST_F(Commands, AnswerAboutSoundFiles) {
  // Otherwise the tests below might only test how commands refuse their own arguments.
  std::ofstream(folder_ / "sound.csv") << "x,y,z\n500050,5199950,1\n500100,5199950,2\n500050,5199900,3\n";
  Runner runner(folder_);
  for (const std::string_view text : {"convert plain.ply -o plain.obj", "convert plain.ply -o plain.stl",
                                      "convert plain.ply -o plain.glb", "convert plain.ply -o plain.2dm",
                                      "convert plain.ply -o plain.off", "convert plain.ply -o plain.gltf"})
    ASSERT_EQ(runner.run(wordsOf(text, {}, {})), "") << text;
  for (const Row& row : rows()) {
    const std::string name = row.folder == "amt"      ? "dem.amt"
                             : row.folder == "points" ? "sound.csv"
                                                      : fmt::format("plain.{}", row.folder);
    for (const std::string_view command : row.commands) {
      const Words words = wordsOf(command, name, Places::of(folder_ / "dem.amt"));
      EXPECT_EQ(runner.run(words), "") << fmt::format("{}", fmt::join(words, " "));
      const bool maySayNo =
          command.find("--expect") != command.npos || command.find("1e300") != command.npos ||
          command.find("--region FILE") != command.npos || command.find("--fixed") != command.npos;
      EXPECT_TRUE(runner.code() == 0 || maySayNo)
          << fmt::format("{}", fmt::join(words, " ")) << ": " << runner.code();
    }
  }
}

class CommandsByKeptFiles : public Commands, public ::testing::WithParamInterface<std::size_t> {};

TEST_P(CommandsByKeptFiles, EndWithASentence) {
  const Row& row = rows()[GetParam()];
  runAll(row, kept(row.folder, row.folder == "amt" ? 31 : 10));
}
INSTANTIATE_TEST_SUITE_P(EveryKind, CommandsByKeptFiles, ::testing::Range(std::size_t(0), rows().size()),
                         [](const auto& row) { return "kind_" + std::string(rows()[row.param].folder); });

class CommandsByHostileModels : public Commands, public ::testing::WithParamInterface<std::uint64_t> {};

TEST_P(CommandsByHostileModels, EndWithASentence) {
  const std::uint64_t seed = GetParam();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  runAll(rows().front(), writeHostileAmts(folder_, isLong() ? 100 : 8, seed));
}
INSTANTIATE_TEST_SUITE_P(Seeds, CommandsByHostileModels, ::testing::Values(1, 2, 3, 4));

}  // namespace
}  // namespace arete::fuzz
