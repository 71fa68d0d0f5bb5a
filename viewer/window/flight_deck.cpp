// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flight is created from the keys when it is first needed, and discarded when they change.
#include "viewer/window/flight_deck.h"

#include <utility>

#include "viewer/camera/flight_json.h"

namespace arete {

void FlightDeck::setPlan(const FlightPlan& plan) {
  plan_ = plan;
  flight_.reset();
  stop();
}

void FlightDeck::addKey(const Camera& camera) {
  if (!plan_.speed && !plan_.duration) plan_.speed = usualSpeed_;
  plan_.keys.push_back(camera);
  flight_.reset();
  stop();
}

void FlightDeck::removeKey(std::size_t index) {
  plan_.keys.erase(plan_.keys.begin() + std::ptrdiff_t(index));
  flight_.reset();
  stop();
}

void FlightDeck::clear() {
  setPlan({});
}

Result<const Flight*> FlightDeck::flight() {
  if (!flight_) {
    Result<Flight> made = Flight::create(plan_, space_);
    if (!made) return tl::unexpected(made.error());
    flight_ = std::move(*made);
  }
  return &*flight_;
}

Status FlightDeck::play() {
  const Result<const Flight*> made = flight();
  if (!made) return tl::unexpected(made.error());
  time_ = 0;
  return {};
}

std::optional<Camera> FlightDeck::advance(double seconds) {
  if (!time_ || !flight_) return std::nullopt;
  *time_ += seconds;
  const Camera camera = flight_->at(*time_);
  if (!plan_.isClosed && *time_ >= flight_->duration()) stop();
  return camera;
}

Status FlightDeck::save(const std::filesystem::path& path, const Georeference& dem) const {
  if (plan_.keys.empty()) return failure(ErrorCode::usage, "there is no key frame to save yet (K sets one)");
  return writeFlight(path, plan_, dem);
}

Status FlightDeck::load(const std::filesystem::path& path, const Georeference& dem,
                        const LongitudeTurns& turns) {
  Result<FlightRead> read = readFlight(path, dem, turns);
  if (!read) return tl::unexpected(read.error());
  const Result<Flight> made = Flight::create(read->plan, space_);
  if (!made) return tl::unexpected(made.error());
  setPlan(read->plan);
  return {};
}

}  // namespace arete
