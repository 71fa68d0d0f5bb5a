// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/network/store_client.h"

#include <cpl_error.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

namespace arete {
namespace {

constexpr int kNoSuchFile = 404, kBeyondTheEnd = 416;

struct StoreFileCloser {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

class StoreClient final : public HttpClient {
 public:
  explicit StoreClient(std::string path) : path_(std::move(path)) {}

  HttpReply get(std::uint64_t first, std::uint64_t last) override {
    const HttpRange range{first, last};
    return std::move(getAll({&range, 1}).front());
  }

  std::vector<HttpReply> getAll(std::span<const HttpRange> ranges) override {
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    CPLErrorReset();
    std::vector<HttpReply> replies(ranges.size());
    const auto before = state();
    const std::unique_ptr<VSILFILE, StoreFileCloser> file(before ? VSIFOpenL(path_.c_str(), "rb") : nullptr);
    if (!file) return failed(std::move(replies), kNoSuchFile);
    std::vector<void*> targets;
    std::vector<vsi_l_offset> offsets;
    std::vector<size_t> sizes;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (ranges[i].first >= before->length) return failed(std::move(replies), kBeyondTheEnd);
      const std::uint64_t end = std::min(ranges[i].last + 1, before->length);
      replies[i].bytes.resize(std::size_t(end - ranges[i].first));
      replies[i].range = fmt::format("bytes {}-{}/{}", ranges[i].first, end - 1, before->length);
      replies[i].date = before->date;
      targets.push_back(replies[i].bytes.data());
      offsets.push_back(ranges[i].first);
      sizes.push_back(replies[i].bytes.size());
    }
    // GDAL's reading of one range tells short reads apart; its reading of several does not.
    const bool isRead = ranges.size() == 1
                            ? VSIFSeekL(file.get(), offsets[0], SEEK_SET) == 0 &&
                                  VSIFReadL(targets[0], 1, sizes[0], file.get()) == sizes[0]
                            : VSIFReadMultiRangeL(static_cast<int>(ranges.size()), targets.data(),
                                                  offsets.data(), sizes.data(), file.get()) == 0;
    if (!isRead) return failed(std::move(replies), 0);
    const auto after = state();
    if (!after || after->length != before->length || after->date != before->date)
      for (HttpReply& reply : replies) reply.date = "replaced while it was read";
    return replies;
  }

  void cancelBy(const std::atomic<bool>* cancel) override { cancel_ = cancel; }
  bool wait(double seconds) override {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end && !isCancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return !isCancelled();
  }
  bool isCancelled() const override {
    const std::atomic<bool>* const cancel = cancel_;
    return cancel != nullptr && cancel->load(std::memory_order_relaxed);
  }

 private:
  struct State {
    std::uint64_t length = 0;
    std::string date;
  };

  std::optional<State> state() const {
    VSICurlPartialClearCache(path_.c_str());
    VSIStatBufL status;
    if (VSIStatExL(path_.c_str(), &status,
                   VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG | VSI_STAT_SIZE_FLAG) != 0 ||
        !VSI_ISREG(status.st_mode))
      return std::nullopt;
    return State{static_cast<std::uint64_t>(status.st_size),
                 status.st_mtime > 0 ? fmt::format("{}", static_cast<long long>(status.st_mtime)) : ""};
  }

  static std::vector<HttpReply> failed(std::vector<HttpReply> replies, int status) {
    const std::string said = CPLGetLastErrorMsg();
    for (HttpReply& reply : replies) {
      reply = {};
      reply.status = said.empty() ? status : 0;
      reply.problem = !said.empty()             ? said
                      : status == kNoSuchFile   ? "GDAL finds no such file"
                      : status == kBeyondTheEnd ? "the file ends before"
                                                : "GDAL cannot read it";
      reply.isLasting = status != 0;
    }
    return replies;
  }

  std::string path_;
  std::atomic<const std::atomic<bool>*> cancel_ = nullptr;
};

}  // namespace

bool isStorePath(const std::string& path) {
  constexpr std::array<std::string_view, 8> kStores = {"/vsis3/",  "/vsigs/",    "/vsiaz/",      "/vsiadls/",
                                                       "/vsioss/", "/vsiswift/", "/vsiwebhdfs/", "/vsihdfs/"};
  return std::ranges::any_of(kStores, [&](std::string_view store) { return path.starts_with(store); });
}

std::shared_ptr<HttpClient> storeClient(std::string path) {
  return std::make_shared<StoreClient>(std::move(path));
}

}  // namespace arete
