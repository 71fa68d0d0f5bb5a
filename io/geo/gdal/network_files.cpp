// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL's own handler returns what it got: a driver that does not check the number of bytes then decodes what
// its buffer held before. Here a read that cannot be answered in full is an error of GDAL (which ends a
// reading, see io/geo/dem/band_reader.h) and is recorded.
//
// A file is known after its first request, for its first piece. Pieces of 256 KiB are kept, the
// newest 128 of each file; where a read follows the one before, more pieces are requested at once, up to 32.
#include "io/geo/gdal/network_files.h"

#include <cpl_conv.h>
#include <cpl_http.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "io/geo/gdal/confined.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr std::string_view kPrefix = "/vsicurl/";  // GDAL keeps the pointer
constexpr std::string_view kCopies = "/vsimem/arete-network-";
constexpr std::uint64_t kPiece = std::uint64_t(1) << 18;
constexpr std::uint64_t kMostPieces = 32;
constexpr std::size_t kPiecesKept = 128;
constexpr const char* kMostBytes = "2147483647";
constexpr const char* kStallSeconds = "30";
constexpr double kLongestWaitSeconds = 30;
constexpr int kHttpNotFound = 404, kHttpGone = 410, kHttpForbidden = 403, kHttpBeyondEnd = 416;
constexpr int kCurlCannotResolve = 6, kCurlCannotConnect = 7;

thread_local const std::atomic<bool>* tCancel = nullptr;
thread_local std::shared_ptr<NetworkReading::State> tReading;

bool isCancelled() {
  return tCancel != nullptr && tCancel->load(std::memory_order_relaxed);
}

/// @return False when the wait was cut off.
bool waitSeconds(double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end) {
    if (isCancelled()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return !isCancelled();
}

std::optional<std::uint64_t> wholeNumber(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end == text.data()) return std::nullopt;
  return value;
}

/// The answer to one request.
struct Answer {
  int http = 0;  ///< the status, where it is an error
  int curl = 0;  ///< libcurl's code
  bool isRange = false;
  Bytes bytes;
  std::uint64_t length = 0;  ///< of the whole file
  std::string version;       ///< ETag and date
  std::string problem;       ///< empty: `bytes` are what was asked for
  double retryAfter = 0;     ///< seconds
};

struct ResultCloser {
  void operator()(CPLHTTPResult* result) const { CPLHTTPDestroyResult(result); }
};
using ResultPtr = std::unique_ptr<CPLHTTPResult, ResultCloser>;

/// A request of GDAL on a thread of its own: GDAL asks whether to go on only once an answer has begun, so a
/// server that says nothing can only be left waiting. The thread then ends by itself when its time is over;
/// it shares nothing with the others but this object.
struct Job {
  std::string url;
  CPLStringList options;
  std::atomic<bool> isAbandoned = false;
  std::mutex mutex;
  std::condition_variable isDone;
  bool done = false;
  ResultPtr result;

  static int keepGoing(double, const char*, void* job) {
    return static_cast<Job*>(job)->isAbandoned ? FALSE : TRUE;
  }
  void run() {
    const GdalErrors quiet;
    ResultPtr fetched(CPLHTTPFetchEx(url.c_str(), options.List(), keepGoing, this, nullptr, nullptr));
    const std::lock_guard lock(mutex);
    result = std::move(fetched);
    done = true;
    isDone.notify_one();
  }
};

/// @return Null if GDAL reads nothing over the network, or the request was cut off.
ResultPtr fetch(const std::string& url, const CPLStringList& options) {
  auto job = std::make_shared<Job>();
  job->url = url;
  job->options = options;
  std::thread([job] { job->run(); }).detach();
  std::unique_lock lock(job->mutex);
  while (!job->isDone.wait_for(lock, std::chrono::milliseconds(20), [&] { return job->done; }))
    if (isCancelled()) {
      job->isAbandoned = true;
      return nullptr;
    }
  return std::move(job->result);
}

std::string headersFor(std::uint64_t first, std::uint64_t last) {
  const char* own = CPLGetConfigOption("GDAL_HTTP_HEADERS", "");
  return fmt::format("{}{}Range: bytes={}-{}\r\nAccept-Encoding: identity", own, *own ? "\r\n" : "", first,
                     last);
}

/// Fills in what the headers of an answer without an error say, and checks the bytes against it.
void checkAnswer(Answer& answer, const CPLStringList& headers, std::uint64_t first, std::uint64_t last) {
  const auto header = [&](const char* name) -> std::string_view {
    const char* value = headers.FetchNameValue(name);
    std::string_view text = value ? value : "";
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    return text;
  };
  answer.version = fmt::format("{} {}", header("ETag"), header("Last-Modified"));
  const std::string_view range = header("Content-Range");
  answer.isRange = !range.empty();
  const std::size_t got = answer.bytes.size();
  if (!answer.isRange) {
    // The server knows no ranges: this is the whole file.
    const auto stated = wholeNumber(header("Content-Length"));
    answer.length = stated.value_or(got);
    if (got != answer.length)
      answer.problem = fmt::format("the server sent {} of {} bytes", got, answer.length);
    return;
  }
  const std::size_t slash = range.find('/'), space = range.find(' ');
  const auto total = slash == range.npos ? std::nullopt : wholeNumber(range.substr(slash + 1));
  const auto start = space == range.npos ? std::nullopt : wholeNumber(range.substr(space + 1));
  if (!total || !start) {
    answer.problem = fmt::format("the server does not say how long the file is: '{}'", range);
    return;
  }
  answer.length = *total;
  const std::uint64_t wanted = std::min(last + 1, *total) - std::min(first, *total);
  if (*start != first || got != wanted)
    answer.problem = fmt::format("the server sent {} bytes from {} instead of {} bytes from {}", got, *start,
                                 wanted, first);
}

Answer requestOnce(const std::string& url, std::uint64_t first, std::uint64_t last) {
  CPLStringList options;
  options.SetNameValue("HEADERS", headersFor(first, last).c_str());
  options.SetNameValue("MAX_RETRY", "0");
  options.SetNameValue("MAX_FILE_SIZE", kMostBytes);
  if (!CPLGetConfigOption("GDAL_HTTP_LOW_SPEED_TIME", nullptr)) {
    options.SetNameValue("LOW_SPEED_TIME", kStallSeconds);
    options.SetNameValue("LOW_SPEED_LIMIT", "1");
  }
  if (!CPLGetConfigOption("GDAL_HTTP_CONNECTTIMEOUT", nullptr))
    options.SetNameValue("CONNECTTIMEOUT", kStallSeconds);
  const ResultPtr result = fetch(url, options);
  Answer answer;
  if (!result) {
    answer.problem = isCancelled() ? "reading was stopped" : "this GDAL reads nothing over the network";
    return answer;
  }
  answer.curl = result->nStatus;
  const CPLStringList headers(result->papszHeaders, false);
  const std::string_view said = result->pszErrBuf ? result->pszErrBuf : "";
  if (const std::size_t colon = said.find("HTTP error code : "); colon != said.npos) {
    answer.http = int(wholeNumber(said.substr(colon + std::strlen("HTTP error code : "))).value_or(0));
    answer.problem = fmt::format("the server answers {}", answer.http);
    if (const char* seconds = headers.FetchNameValue("Retry-After"))
      answer.retryAfter = std::min(CPLAtof(seconds), kLongestWaitSeconds);
    return answer;
  }
  if (answer.curl != 0 || !said.empty()) {
    answer.problem = said.empty() ? "the connection was lost" : std::string(said);
    return answer;
  }
  answer.bytes.assign(result->pabyData, result->pabyData + result->nDataLen);
  checkAnswer(answer, headers, first, last);
  return answer;
}

bool isWorthRetrying(const Answer& answer) {
  constexpr int kPassing[] = {429, 500, 502, 503, 504};
  if (answer.http != 0)
    return std::find(std::begin(kPassing), std::end(kPassing), answer.http) != std::end(kPassing);
  return !answer.problem.empty() && answer.curl != kCurlCannotResolve && answer.curl != kCurlCannotConnect;
}

Answer request(const std::string& url, std::uint64_t first, std::uint64_t last) {
  const int retries = std::max(0, std::atoi(CPLGetConfigOption("GDAL_HTTP_MAX_RETRY", "4")));
  double delay = std::max(0.0, CPLAtof(CPLGetConfigOption("GDAL_HTTP_RETRY_DELAY", "0.25")));
  for (int attempt = 0;; ++attempt) {
    Answer answer = requestOnce(url, first, last);
    if (!isWorthRetrying(answer) || isCancelled()) return answer;
    if (attempt >= retries) {
      if (retries > 0) answer.problem += fmt::format(", {} times", retries + 1);
      return answer;
    }
    if (!waitSeconds(answer.retryAfter > 0 ? answer.retryAfter : std::min(delay, kLongestWaitSeconds)))
      return answer;
    delay *= 2;
  }
}

/// A file of the network, as its first answer describes it.
class RemoteFile {
 public:
  explicit RemoteFile(std::string url) : url_(std::move(url)) {
    Answer answer = request(url_, 0, kPiece - 1);
    if (answer.http == kHttpBeyondEnd) return;  // an empty file
    problem_ = answer.problem;
    isAbsent_ = answer.http == kHttpNotFound || answer.http == kHttpGone || answer.http == kHttpForbidden;
    length_ = answer.length;
    version_ = answer.version;
    if (!problem_.empty()) return;
    if (answer.isRange)
      keep(0, std::move(answer.bytes));
    else
      whole_ = std::move(answer.bytes);
  }

  const std::string& url() const { return url_; }
  const std::string& problem() const { return problem_; }
  bool isAbsent() const { return isAbsent_; }
  std::uint64_t length() const { return length_; }

  /// @return Why the bytes cannot be read; empty if they are in `target`. Precondition: within the file.
  std::string read(std::uint64_t offset, unsigned char* target, std::uint64_t count) {
    const std::lock_guard lock(mutex_);
    if (whole_) {
      std::memcpy(target, whole_->data() + offset, count);
      return {};
    }
    while (count > 0) {
      const std::uint64_t number = offset / kPiece, from = offset % kPiece;
      // A driver that takes no notice of a failure goes on reading: the server is not asked again.
      if (broken_.empty() && !pieces_.contains(number))
        broken_ = fetch(number, (from + count + kPiece - 1) / kPiece);
      if (!broken_.empty()) return broken_;
      const Bytes& piece = pieces_.at(number);
      const std::uint64_t part = std::min<std::uint64_t>(count, piece.size() - from);
      std::memcpy(target, piece.data() + from, part);
      target += part;
      offset += part;
      count -= part;
    }
    return {};
  }

  /// @return Why the file is not the one that was opened; empty if it is.
  std::string compare() {
    const std::lock_guard lock(mutex_);
    if (!problem_.empty() || length_ == 0) return {};
    const Answer answer = request(url_, 0, 0);
    return answer.problem.empty() ? difference(answer) : answer.problem;
  }

 private:
  std::string difference(const Answer& answer) const {
    if (answer.length != length_)
      return fmt::format("it had {} bytes and has {} now: it was replaced while it was read", length_,
                         answer.length);
    return answer.version == version_ ? "" : "it was replaced while it was read";
  }

  void keep(std::uint64_t number, Bytes bytes) {
    pieces_[number] = std::move(bytes);
    order_.push_back(number);
    if (order_.size() <= kPiecesKept) return;
    pieces_.erase(order_.front());
    order_.pop_front();
  }

  std::string fetch(std::uint64_t number, std::uint64_t needed) {
    ahead_ = number == next_ ? std::min(2 * ahead_, kMostPieces) : 1;
    const std::uint64_t last = (length_ - 1) / kPiece;
    std::uint64_t end = number + std::clamp(needed, ahead_, kMostPieces);
    end = std::min(end, last + 1);
    for (std::uint64_t piece = number + 1; piece < end; ++piece)
      if (pieces_.contains(piece)) end = piece;
    const std::uint64_t first = number * kPiece, stop = std::min(end * kPiece, length_);
    const Answer answer = request(url_, first, stop - 1);
    if (!answer.problem.empty()) return answer.problem;
    if (std::string changed = difference(answer); !changed.empty()) return changed;
    if (!answer.isRange) return "the server sent the whole file instead of a part of it";
    for (std::uint64_t piece = number; piece < end; ++piece) {
      const std::uint64_t begin = piece * kPiece - first;
      keep(piece, Bytes(answer.bytes.begin() + std::ptrdiff_t(begin),
                        answer.bytes.begin() + std::ptrdiff_t(std::min(begin + kPiece, stop - first))));
    }
    next_ = end;
    return {};
  }

  std::string url_, problem_, version_, broken_;
  bool isAbsent_ = false;
  std::uint64_t length_ = 0;
  std::mutex mutex_;
  std::optional<Bytes> whole_;
  std::map<std::uint64_t, Bytes> pieces_;
  std::deque<std::uint64_t> order_;
  std::uint64_t next_ = 1, ahead_ = 1;
};

using RemoteFilePtr = std::shared_ptr<RemoteFile>;

}  // namespace

struct NetworkReading::State {
  std::map<std::string, RemoteFilePtr> files;
  std::string failed;  ///< the first failure, with its address
};

namespace {

void recordFailure(const RemoteFile& file, const std::string& problem) {
  const std::string sentence = fmt::format("{}: {}", file.url(), problem);
  if (tReading && tReading->failed.empty()) tReading->failed = sentence;
  CPLError(CE_Failure, CPLE_HttpResponse, "%s", sentence.c_str());
}

RemoteFilePtr remoteFile(const std::string& url) {
  if (tReading)
    if (const auto found = tReading->files.find(url); found != tReading->files.end()) return found->second;
  auto file = std::make_shared<RemoteFile>(url);
  // A file that is not there may be one of the many that a driver looks for beside its own.
  if (!file->problem().empty() && !file->isAbsent()) recordFailure(*file, file->problem());
  if (tReading) tReading->files[url] = file;
  return file;
}

/// A position in a file, as GDAL's callbacks have it.
struct Handle {
  RemoteFilePtr file;
  std::uint64_t at = 0;
  bool isAtEnd = false;
};

// No exception may pass through GDAL: the callbacks below end in a failure of GDAL instead.

void* openHandle(void*, const char* name, const char* access) try {
  if (std::strchr(access, 'r') == nullptr || std::strchr(access, '+') != nullptr) {
    errno = EACCES;
    return nullptr;
  }
  RemoteFilePtr file = remoteFile(name);
  if (!file->problem().empty()) {
    errno = file->isAbsent() ? ENOENT : EIO;
    return nullptr;
  }
  return new Handle{std::move(file)};
} catch (...) {
  errno = ENOMEM;
  return nullptr;
}

int statHandle(void*, const char* name, VSIStatBufL* status, int) try {
  const RemoteFilePtr file = remoteFile(name);
  if (!file->problem().empty()) {
    errno = ENOENT;
    return -1;
  }
  status->st_mode = S_IFREG | S_IRUSR;
  status->st_size = static_cast<decltype(status->st_size)>(file->length());
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
  h.at = whence == SEEK_SET ? offset : whence == SEEK_CUR ? h.at + offset : h.file->length() + offset;
  h.isAtEnd = false;
  return 0;
}

size_t readHandle(void* handle, void* buffer, size_t size, size_t count) try {
  auto& h = *static_cast<Handle*>(handle);
  const std::uint64_t wanted = std::uint64_t(size) * count, length = h.file->length();
  if (wanted == 0) return 0;
  const std::uint64_t there = h.at < length ? std::min(wanted, length - h.at) : 0;
  if (there < wanted) h.isAtEnd = true;
  if (there > 0) {
    if (const std::string problem = h.file->read(h.at, static_cast<unsigned char*>(buffer), there);
        !problem.empty()) {
      recordFailure(*h.file, problem);
      return 0;
    }
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

}  // namespace

void installNetworkFiles() {
  if (!CPLHTTPEnabled() || gdalIsConfined()) return;
  VSIFilesystemPluginCallbacksStruct* callbacks = VSIAllocFilesystemPluginCallbacksStruct();
  callbacks->open = openHandle;
  callbacks->stat = statHandle;
  callbacks->tell = tellHandle;
  callbacks->seek = seekHandle;
  callbacks->read = readHandle;
  callbacks->eof = isHandleAtEnd;
  callbacks->close = closeHandle;
  VSIInstallPluginHandler(kPrefix.data(), callbacks);
  VSIFreeFilesystemPluginCallbacksStruct(callbacks);
}

bool isNetworkPath(const std::string& path) {
  return path.find(kPrefix) != path.npos;
}

std::string networkPathOf(const std::string& path) {
  const bool isAddress = STARTS_WITH_CI(path.c_str(), "http://") || STARTS_WITH_CI(path.c_str(), "https://");
  return isAddress ? std::string(kPrefix) + path : path;
}

std::string pathWithoutNetcdf(const std::string& path) {
  if (!isNetworkPath(path)) return path;
  GDALDriverH driver = GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  if (!driver || !EQUAL(GDALGetDriverShortName(driver), "netCDF")) return path;
  const std::size_t begin = path.find("/vsi");
  std::size_t end = path.size();
  std::string variable;
  if (begin > 0) {  // NETCDF:"file":variable
    end = path.rfind(':');
    if (end <= begin + kPrefix.size()) return {};
    variable = path.substr(end);
    if (path[end - 1] == '"') --end;
  }
  const std::string file = path.substr(begin, end - begin);
  static std::atomic<unsigned> number = 0;
  const std::string folder = fmt::format("{}{}", kCopies, number++);
  const std::string copy = fmt::format("{}/{}", folder, CPLGetFilename(file.c_str()));
  const std::string failedBefore = tReading ? tReading->failed : "";
  if (VSIMkdir(folder.c_str(), 0700) != 0 || CPLCopyFile(copy.c_str(), file.c_str()) != 0 || isCancelled() ||
      (tReading && tReading->failed != failedBefore)) {
    removeNetworkCopy(copy);
    return {};
  }
  return begin > 0 ? fmt::format("NETCDF:\"{}\"{}", copy, variable) : copy;
}

void removeNetworkCopy(const std::string& description) {
  const std::size_t begin = description.find(kCopies);
  if (begin == description.npos) return;
  VSIRmdirRecursive(description.substr(begin, description.find('/', begin + kCopies.size()) - begin).c_str());
}

std::string networkProblem(const std::string& path) {
  if (!path.starts_with(kPrefix)) return {};
  const GdalErrors quiet;
  return remoteFile(path.substr(kPrefix.size()))->problem();
}

NetworkReading::NetworkReading(const std::atomic<bool>* cancel)
    : state_(tReading ? tReading : std::make_shared<State>()), cancelBefore_(tCancel), isInner_(tReading) {
  tReading = state_;
  if (cancel) tCancel = cancel;
}

NetworkReading::~NetworkReading() {
  tCancel = cancelBefore_;
  if (isInner_) return;
  tReading.reset();
}

Status NetworkReading::finish() {
  if (isCancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
  for (const auto& [url, file] : state_->files) {
    if (!state_->failed.empty()) break;
    if (const std::string problem = file->compare(); !problem.empty())
      state_->failed = fmt::format("{}: {}", url, problem);
  }
  if (isCancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
  if (!state_->failed.empty()) return failure(ErrorCode::unreadable, state_->failed);
  return {};
}

}  // namespace arete
