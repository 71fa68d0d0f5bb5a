// SPDX-License-Identifier: GPL-3.0-or-later
//
// One buffer of a mebibyte and the system's write(), so that there is no second buffer and no error is lost:
// network file systems report a full disk at close(). What was written is read again before it replaces an
// older file, and compared by a hash.
#include "io/files/file_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

namespace arete {

// The library allocates the state of the hash, which it needs at an aligned address.
struct FileWriter::Hash {
  Hash() : state(XXH3_createState()) {
    if (!state) throw std::bad_alloc();
    XXH3_64bits_reset(state.get());
  }
  void add(const char* bytes, std::size_t count) { XXH3_64bits_update(state.get(), bytes, count); }
  std::uint64_t value() const { return XXH3_64bits_digest(state.get()); }

 private:
  struct Free {
    void operator()(XXH3_state_t* freed) const { XXH3_freeState(freed); }
  };
  std::unique_ptr<XXH3_state_t, Free> state;
};

// Standard output is duplicated, so that finish() can close it, and see the errors of that, without taking it
// from others.
Result<FileWriter> FileWriter::create(const std::filesystem::path& path) {
  std::optional<OutputFile> file;
  int descriptor = -1;
  if (path == kStandardOutput) {
    descriptor = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
  } else {
    ARETE_TRY(OutputFile created, OutputFile::create(path));
    file = std::move(created);
    descriptor = ::open(file->temporaryPath().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  }
  if (descriptor < 0)
    return failure(ErrorCode::unreadable,
                   fmt::format("cannot be written: {}", std::generic_category().message(errno)),
                   path.string());
  return FileWriter(path, std::move(file), descriptor);
}

// A target that is written in place, such as a pipe, cannot be read again, so it has no hash.
FileWriter::FileWriter(std::filesystem::path path, std::optional<OutputFile> file, int descriptor)
    : path_(std::move(path)),
      file_(std::move(file)),
      descriptor_(descriptor),
      hash_(file_ && !file_->isInPlace() ? new Hash : nullptr),
      buffer_(new char[kCapacity]) {}

FileWriter::FileWriter(FileWriter&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      error_(other.error_),
      hash_(std::move(other.hash_)),
      buffer_(std::move(other.buffer_)),
      used_(other.used_) {}

FileWriter::~FileWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

/// A call may write less than it is given, or be interrupted by a signal; both go on. The first error is kept
/// until finish(), and later bytes are dropped.
void FileWriter::toDisk(const char* bytes, std::size_t count) {
  while (count > 0 && error_ == 0) {
    const ssize_t written = ::write(descriptor_, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      error_ = errno;
      return;
    }
    if (hash_) hash_->add(bytes, static_cast<std::size_t>(written));
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

void FileWriter::flush() {
  toDisk(buffer_.get(), used_);
  used_ = 0;
}

void FileWriter::writeThrough(std::string_view bytes) {
  flush();
  toDisk(bytes.data(), bytes.size());
}

// The file replaces an older one only after closing and reading it again have both succeeded.
Status FileWriter::finish() {
  flush();
  if (::close(std::exchange(descriptor_, -1)) != 0 && error_ == 0) error_ = errno;
  if (error_ != 0)
    return failure(ErrorCode::unreadable,
                   fmt::format("cannot be written: {}", std::generic_category().message(error_)),
                   path_.string());
  if (!file_) return {};
  if (hash_) ARETE_CHECK(readBack());
  return file_->commit();
}

/// The buffer is free by now and serves for reading.
Status FileWriter::readBack() const {
  const auto unreadable = [&](const std::string& why) {
    return failure(ErrorCode::unreadable, "cannot be read after it was written: " + why, path_.string());
  };
  const int descriptor = ::open(file_->temporaryPath().c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return unreadable(std::generic_category().message(errno));
  Hash found;
  ssize_t got = 0;
  do {
    got = ::read(descriptor, buffer_.get(), kCapacity);
    if (got > 0) found.add(buffer_.get(), static_cast<std::size_t>(got));
  } while (got > 0 || (got < 0 && errno == EINTR));
  const int error = errno;
  ::close(descriptor);
  if (got < 0) return unreadable(std::generic_category().message(error));
  if (found.value() != hash_->value()) return unreadable("it holds other bytes");
  return {};
}

}  // namespace arete
