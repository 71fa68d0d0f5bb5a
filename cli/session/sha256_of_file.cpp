// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/session/sha256_of_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <new>
#include <system_error>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/files/open_plain.h"

namespace arete {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

tl::unexpected<Error> cannotBeRead(const std::string& path, int error) {
  return failure(error == ENOENT ? ErrorCode::notFound : ErrorCode::unreadable,
                 fmt::format("cannot be read: {}", std::generic_category().message(error)), path);
}

}  // namespace

Result<FileDigest> sha256OfFile(const std::string& path, const std::atomic<bool>* cancel) try {
  // O_NONBLOCK: opening a pipe does not wait for its writer.
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct ::stat before {
  }, after{};
  if (file.value < 0 || ::fstat(file.value, &before) != 0) return cannotBeRead(path, errno);
  if (!S_ISREG(before.st_mode))
    return failure(ErrorCode::unreadable, "is a folder, a pipe or a device", path);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  if (!digest || EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) != 1) throw std::bad_alloc();
  FileDigest result;
  std::vector<std::byte> piece(kPieceBytes);
  for (;;) {
    if (cancel != nullptr && *cancel)
      return failure(ErrorCode::interrupted, "the checksum was stopped", path);
    const ssize_t size = ::read(file.value, piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return cannotBeRead(path, errno);
    if (size == 0) break;
    EVP_DigestUpdate(digest.get(), piece.data(), static_cast<std::size_t>(size));
    result.bytes += static_cast<std::uint64_t>(size);
  }
  std::array<unsigned char, 32> sum = {};
  EVP_DigestFinal_ex(digest.get(), sum.data(), nullptr);
  result.sha256 = fmt::format("{:02x}", fmt::join(sum, ""));
  result.isStable = ::fstat(file.value, &after) == 0 && before.st_size == after.st_size &&
                    before.st_mtim.tv_sec == after.st_mtim.tv_sec &&
                    before.st_mtim.tv_nsec == after.st_mtim.tv_nsec &&
                    result.bytes == static_cast<std::uint64_t>(after.st_size);
  return result;
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
