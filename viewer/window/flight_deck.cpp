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
    ARETE_TRY(Flight made, Flight::create(plan_, space_));
    flight_ = std::move(made);
  }
  return &*flight_;
}

Status FlightDeck::play() {
  ARETE_CHECK(flight());
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
  ARETE_TRY(FlightRead read, readFlight(path, dem, turns));
  ARETE_CHECK(Flight::create(read.plan, space_));
  setPlan(read.plan);
  return {};
}

}  // namespace arete
