// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL's callbacks know a file by its name behind the prefix, and a handle by a pointer: a source of bytes
// and a position in it. A failed read is an error of GDAL and of the reading
// (io/geo/network/network_reading.h): some drivers take no notice of the number of bytes that they got.
#include "io/geo/network/served_files.h"

#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "io/files/byte_source.h"
#include "io/geo/network/network_path.h"
#include "io/geo/network/network_reading.h"
#include "io/geo/network/virtual_text.h"

namespace arete {
namespace {

std::atomic<bool> areServedFilesForbidden = false;

/// A file of another of GDAL's file systems.
class OtherFile final : public ByteSource {
 public:
  explicit OtherFile(const std::string& name) : name_(name), file_(VSIFOpenL(name.c_str(), "rb")) {
    if (!file_) return;
    VSIFSeekL(file_, 0, SEEK_END);
    size_ = VSIFTellL(file_);
  }
  ~OtherFile() override {
    if (file_) VSIFCloseL(file_);
  }
  bool isOpen() const { return file_ != nullptr; }

  std::uint64_t size() const override { return size_; }
  Status read(std::uint64_t offset, std::span<std::byte> target) const override {
    const std::lock_guard lock(mutex_);
    if (VSIFSeekL(file_, offset, SEEK_SET) == 0 &&
        VSIFReadL(target.data(), 1, target.size(), file_) == target.size())
      return {};
    return failure(ErrorCode::unreadable, "cannot be read as a whole", name_);
  }

 private:
  std::string name_;
  mutable std::mutex mutex_;
  VSILFILE* file_;
  std::uint64_t size_ = 0;
};

/// A source of the bytes, or the reason why it cannot be opened.
struct Served {
  std::shared_ptr<const ByteSource> source;
  int error = 0;  ///< as in errno
};

Served servedBytes(const std::string& name, const std::string& path) {
  Served served;
  if (name.starts_with('?') || beginsWithAddress(name)) {
    const auto file = remoteFile(name);
    if (file->problem()) return {nullptr, file->isAbsent() ? ENOENT : EIO};
    served.source = file;
  } else {
    const auto file = std::make_shared<OtherFile>(name);
    if (!file->isOpen()) return {nullptr, ENOENT};
    served.source = file;
  }
  if (const std::optional<std::string> text = servedVirtualText(*served.source, path)) {
    const auto bytes = std::as_bytes(std::span(*text));
    served.source = std::make_shared<MemoryBytes>(std::vector<std::byte>(bytes.begin(), bytes.end()));
  }
  return served;
}

/// The two forms of a name: behind "/vsiarete/", and behind "/vsiarete?".
Served servedBytesOf(const void* isQuery, const char* name) {
  return isQuery ? servedBytes(std::string("?") + name, servedName() + "?" + name)
                 : servedBytes(name, servedName() + "/" + name);
}

/// A position in a source, as GDAL's callbacks have it.
struct Handle {
  std::shared_ptr<const ByteSource> source;
  std::uint64_t at = 0;
  bool isAtEnd = false;
};

// No exception may pass through GDAL: the callbacks below end in a failure of GDAL instead.

void* openHandle(void* isQuery, const char* name, const char* access) try {
  if (std::strchr(access, 'r') == nullptr || std::strchr(access, '+') != nullptr) {
    errno = EACCES;
    return nullptr;
  }
  Served served = servedBytesOf(isQuery, name);
  errno = served.error;
  return served.source ? new Handle{std::move(served.source)} : nullptr;
} catch (...) {
  errno = ENOMEM;
  return nullptr;
}

int statHandle(void* isQuery, const char* name, VSIStatBufL* status, int flags) try {
  if (!isQuery && !beginsWithAddress(name))
    if (const int found = VSIStatExL(name, status, flags); found != 0 || !VSI_ISREG(status->st_mode))
      return found;
  const Served served = servedBytesOf(isQuery, name);
  if (!served.source) {
    errno = ENOENT;
    return -1;
  }
  status->st_mode = S_IFREG | S_IRUSR;
  status->st_size = static_cast<decltype(status->st_size)>(served.source->size());
  return 0;
} catch (...) {
  errno = ENOMEM;
  return -1;
}

vsi_l_offset tellHandle(void* handle) {
  return static_cast<Handle*>(handle)->at;
}

int seekHandle(void* handle, vsi_l_offset offset, int whence) {
  auto& h = *static_cast<Handle*>(handle);
  h.at = whence == SEEK_SET ? offset : whence == SEEK_CUR ? h.at + offset : h.source->size() + offset;
  h.isAtEnd = false;
  return 0;
}

size_t readHandle(void* handle, void* buffer, size_t size, size_t count) try {
  auto& h = *static_cast<Handle*>(handle);
  const std::uint64_t wanted = std::uint64_t(size) * count, length = h.source->size();
  if (wanted == 0) return 0;
  const std::uint64_t there = h.at < length ? std::min(wanted, length - h.at) : 0;
  if (there < wanted) h.isAtEnd = true;
  if (const Status read = h.source->read(h.at, {static_cast<std::byte*>(buffer), std::size_t(there)});
      there > 0 && !read) {
    recordNetworkFailure(read.error());
    return 0;
  }
  h.at += there;
  return std::size_t(there / size);
} catch (...) {
  CPLError(CE_Failure, CPLE_OutOfMemory, "out of memory");
  return 0;
}

int isHandleAtEnd(void* handle) {
  return static_cast<Handle*>(handle)->isAtEnd ? 1 : 0;
}

int closeHandle(void* handle) {
  delete static_cast<Handle*>(handle);
  return 0;
}

/// @return The first name that no other library in the process has taken.
std::string freeName() {
  char** prefixes = VSIGetFileSystemsPrefixes();
  std::string name = "/vsiarete";
  for (int number = 2; CSLFindString(prefixes, (name + "/").c_str()) >= 0; ++number)
    name = fmt::format("/vsiarete{}", number);
  CSLDestroy(prefixes);
  return name;
}

std::string installServedFiles() {
  if (!CPLHTTPEnabled()) return {};
  std::string name = freeName();
  // GDAL keeps the pointers to the prefixes, as long as the process lives.
  static const std::string& ofNames = *new std::string(name + "/");
  static std::string& ofOptions = *new std::string(name + "?");
  VSIFilesystemPluginCallbacksStruct* callbacks = VSIAllocFilesystemPluginCallbacksStruct();
  callbacks->open = openHandle;
  callbacks->stat = statHandle;
  callbacks->tell = tellHandle;
  callbacks->seek = seekHandle;
  callbacks->read = readHandle;
  callbacks->eof = isHandleAtEnd;
  callbacks->close = closeHandle;
  VSIInstallPluginHandler(ofNames.c_str(), callbacks);
  callbacks->pUserData = &ofOptions;
  VSIInstallPluginHandler(ofOptions.c_str(), callbacks);
  VSIFreeFilesystemPluginCallbacksStruct(callbacks);
  return name;
}

}  // namespace

const std::string& servedName() {
  // Not destroyed at the end of the process, where files may still be closed.
  static const std::string& nothing = *new std::string();
  if (areServedFilesForbidden) return nothing;
  static const std::string& name = *new std::string(installServedFiles());
  return name;
}

void forbidServedFiles() {
  areServedFilesForbidden = true;
}

}  // namespace arete
