// SPDX-License-Identifier: GPL-3.0-or-later
// One allocation of a run fails, each in turn: the run answers as ever, or ends with a sentence.
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <tuple>

#include "cli/mesh_fixture.h"
#include "cli/session/faults.h"
#include "cli/session/memory_end.h"

namespace arete::cli_test {
namespace {

class MemoryEnd : public Cli {
 protected:
  struct Ended {
    int code = 0;
    std::string err;
  };
  /// The run of a line of arguments whose allocation of this number fails.
  Ended runFailing(const std::string& arguments, int number) const {
    const std::string line = "cd '" + path("") + "' && ARETE_FAIL_ALLOCATION=" + std::to_string(number) +
                             " LD_PRELOAD='" ARETE_FAIL_ALLOCATION "' '" ARETE_PROGRAM "' " + arguments +
                             " >out.txt 2>err.txt";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read("err.txt")};
  }
};

TEST_F(MemoryEnd, IsASentenceWhereverTheAllocationFails) {
#ifdef ARETE_SANITIZED
  GTEST_SKIP() << "a sanitizer has allocation functions of its own";
#endif
  write("tetrahedron.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  const std::string older = "what was there before";
  int failed = 0;
  for (const auto& [arguments, output, first, step] :
       {std::tuple{"convert tetrahedron.off -o t.glb --json", "t.glb", 1, 307},
        std::tuple{"build tetrahedron.off -o t.amt --json", "t.amt", 7, 997},
        std::tuple{"mesh info tetrahedron.off --json", "", 3, 601}}) {
    for (int number = first, quiet = 0; quiet < 3; number += step) {
      SCOPED_TRACE(std::string(arguments) + ", allocation " + std::to_string(number));
      if (*output) write(output, older);
      const Ended ended = runFailing(arguments, number);
      // Beyond the last allocation none fails any more.
      quiet = ended.code == 0 ? quiet + 1 : 0;
      if (ended.code != 0) ++failed;
      ASSERT_TRUE(ended.code == 0 || ended.code == 1 || ended.code == 3 || ended.code == 4)
          << ended.code << ended.err;
      if (ended.code != 0) {
        EXPECT_NE(ended.err.find("arete: "), std::string::npos) << ended.err;
      }
      for (const std::string& name : files()) EXPECT_NE(name.front(), '.') << "a temporary file is left";
      if (*output && ended.code != 0 && read(output) != older) {
        EXPECT_GT(read(output).size(), older.size()) << "the output is whole, or as it was";
      }
      ASSERT_LT(number, 100'000);
    }
  }
  EXPECT_GT(failed, 5);
}

/// As a library that does not look whether it got what it wanted to allocate.
void useNothing(int error) {
  prepareForLackOfMemory();
  prepareForFaults();
  volatile int* volatile nothing = nullptr;
  errno = error;
  nothing[3] = 1;
}

/// As a library that calls abort() instead.
void giveUp(int error) {
  prepareForLackOfMemory();
  prepareForFaults();
  errno = error;
  std::abort();
}

TEST(MemoryEndDeathTest, IsASentenceWhereALibraryUsesWhatItCouldNotAllocate) {
#ifdef ARETE_SANITIZED
  GTEST_SKIP() << "a sanitizer has handlers of its own";
#endif
  EXPECT_EXIT(useNothing(ENOMEM), ::testing::ExitedWithCode(1), "arete: there is not enough memory for this");
  EXPECT_EXIT(useNothing(0), ::testing::KilledBySignal(SIGSEGV), "");
  EXPECT_EXIT(giveUp(ENOMEM), ::testing::ExitedWithCode(1), "arete: there is not enough memory for this");
  EXPECT_EXIT(giveUp(0), ::testing::KilledBySignal(SIGABRT), "");
}

}  // namespace
}  // namespace arete::cli_test
