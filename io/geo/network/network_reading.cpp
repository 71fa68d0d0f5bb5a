// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/network/network_reading.h"

#include <cpl_error.h>

#include <map>
#include <utility>

#include "io/geo/network/gdal_http.h"
#include "io/geo/network/network_address.h"
#include "io/geo/network/network_path.h"
#include "io/geo/network/served_files.h"

namespace arete {

struct NetworkReading::State {
  std::map<std::string, std::shared_ptr<const RemoteFile>> files;
  std::optional<Error> failed;  ///< the first failure, with its address
};

namespace {

thread_local std::shared_ptr<NetworkReading::State> tReading;

/// In place of a client, where an address cannot be understood.
class NoClient final : public HttpClient {
 public:
  explicit NoClient(std::string problem) : problem_(std::move(problem)) {}
  HttpReply get(std::uint64_t, std::uint64_t) override {
    HttpReply reply;
    reply.problem = problem_;
    reply.isLasting = true;
    return reply;
  }
  bool wait(double) override { return false; }
  bool isCancelled() const override { return false; }

 private:
  std::string problem_;
};

std::shared_ptr<const RemoteFile> openRemote(const std::string& name) {
  Result<NetworkAddress> address = networkAddress(name);
  if (!address)
    return std::make_shared<RemoteFile>("/vsicurl" + name,
                                        std::make_shared<NoClient>(address.error().message), RetryRules{});
  return std::make_shared<RemoteFile>(address->url, gdalHttpClient(*address), address->rules);
}

}  // namespace

std::shared_ptr<const RemoteFile> remoteFile(const std::string& name) {
  if (tReading)
    if (const auto found = tReading->files.find(name); found != tReading->files.end()) return found->second;
  auto file = openRemote(name);
  // A file that is not there may be one of the many that a driver looks for beside its own.
  if (file->problem() && !file->isAbsent()) recordNetworkFailure(*file->problem());
  if (tReading) tReading->files[name] = file;
  return file;
}

void recordNetworkFailure(const Error& error) {
  if (tReading && !tReading->failed) tReading->failed = error;
  CPLError(CE_Failure, CPLE_HttpResponse, "%s", error.describe().c_str());
}

std::optional<Error> networkProblem(const std::string& path) {
  const std::string& own = servedName();
  const std::size_t at = own.empty() ? path.npos : path.find(own);
  if (at == path.npos) return std::nullopt;
  const std::string rest = path.substr(at + own.size());
  const std::string name = rest.starts_with('/') ? rest.substr(1) : rest;
  if (at == 0) {
    if (!name.starts_with('?') && !beginsWithAddress(name)) return std::nullopt;
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    return remoteFile(name)->problem();
  }
  if (!tReading) return std::nullopt;
  for (const auto& [read, file] : tReading->files)
    if (name.starts_with(read) && file->problem())
      return Error{file->problem()->code, file->problem()->describe(), {}};
  return std::nullopt;
}

std::optional<Error> firstNetworkFailure() {
  return tReading ? tReading->failed : std::nullopt;
}

NetworkReading::NetworkReading(const std::atomic<bool>* cancel)
    : state_(tReading ? tReading : std::make_shared<State>()),
      cancelBefore_(requestCancel()),
      isInner_(tReading) {
  tReading = state_;
  if (cancel) setRequestCancel(cancel);
}

NetworkReading::~NetworkReading() {
  setRequestCancel(cancelBefore_);
  if (isInner_) return;
  tReading.reset();
}

Status NetworkReading::finish() {
  if (requestsAreCancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
  for (const auto& [name, file] : state_->files) {
    if (state_->failed) break;
    if (const Status same = file->compare(); !same) state_->failed = same.error();
  }
  if (requestsAreCancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
  if (state_->failed) return failure(ErrorCode::unreadable, state_->failed->describe());
  return {};
}

}  // namespace arete
