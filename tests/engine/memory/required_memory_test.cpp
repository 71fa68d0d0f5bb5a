// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/memory/required_memory.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/base/memory_refusal.h"

namespace arete {
namespace {

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;

/// A budget of this process, as long as a test.
class Budget {
 public:
  explicit Budget(std::uint64_t bytes) { setMemoryBudget(bytes); }
  ~Budget() { setMemoryBudget(0); }
};

Status failed() {
  try {
    requireMemory(300 * kMebibyte, "ask for less");
  } catch (...) {
    return caughtFailure("a file");
  }
  return {};
}

TEST(RequiredMemory, WithoutABudgetIsThatOfTheMachine) {
  EXPECT_EQ(memoryBudget(), 0u);
  EXPECT_TRUE(checkBudget(std::uint64_t{1} << 60));
  EXPECT_NO_THROW(requireMemory(1));
  EXPECT_THROW(requireMemory(std::uint64_t{1} << 60), std::bad_alloc);
}

TEST(RequiredMemory, ThatExceedsTheBudgetIsRefusedWithASentence) {
  const Budget budget(200 * kMebibyte);
  EXPECT_TRUE(checkBudget(50 * kMebibyte));
  const Status status = checkBudget(300 * kMebibyte, "ask for less");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::outOfMemory);
  const std::string& sentence = status.error().message;
  EXPECT_EQ(sentence.find("needs about 314.6 MB of memory, and "), 0u) << sentence;
  EXPECT_NE(sentence.find(" of the 209.7 MB of `memory` are left: ask for less"), std::string::npos)
      << sentence;
}

TEST(RequiredMemory, ThatIsRefusedByAnExceptionBecomesTheSameError) {
  const Budget budget(200 * kMebibyte);
  const Status status = failed();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::outOfMemory);
  EXPECT_EQ(status.error().culprit, "a file");
  EXPECT_EQ(status.error().message.find("needs about "), 0u) << status.error().message;
}

TEST(RequiredMemory, IsHeldAgainstWhatIsResidentAndNotAgainstWhatIsReserved) {
  const Budget budget(400 * kMebibyte);
  const std::uint64_t before = memoryInUse();
  std::vector<char> taken;
  taken.reserve(100 * kMebibyte);
  EXPECT_LT(memoryInUse(), before + 20 * kMebibyte);
  taken.assign(100 * kMebibyte, 1);
  EXPECT_GE(memoryInUse() + 60 * kMebibyte, before + 100 * kMebibyte);
  EXPECT_FALSE(checkBudget(400 * kMebibyte));
}

TEST(RequiredMemory, ThatIsTakenWithoutAQuestionIsLimitedToo) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer maps memory of its own";
#endif
  const Budget budget(100 * kMebibyte);
  EXPECT_THROW(std::vector<char>(std::size_t{8} << 30), std::bad_alloc);
  allowReserved(std::uint64_t{16} << 30);
  EXPECT_NO_THROW(std::vector<char>().reserve(std::size_t{8} << 30));
}

TEST(MemoryRefusal, KeepsASentenceOfAnyLength) {
  EXPECT_STREQ(MemoryRefusal("short").what(), "short");
  EXPECT_EQ(std::string(MemoryRefusal(std::string(5000, 'x')).what()), std::string(383, 'x'));
}

}  // namespace
}  // namespace arete
