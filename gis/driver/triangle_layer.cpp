// SPDX-License-Identifier: GPL-3.0-or-later
#include "gis/driver/triangle_layer.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>

#include "engine/base/caught_failure.h"
#include "gis/driver/gdal_errors.h"

namespace arete {

PlacedTriangles PlacedTriangles::sorted(TriangleMesh mesh, std::span<const std::uint32_t> ids,
                                        std::span<const float> errors) {
  // The features are sorted by id, so that GetFeature() finds one by bisection.
  std::vector<std::uint32_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t t) { return ids[t]; });
  PlacedTriangles placed;
  placed.mesh.positions = std::move(mesh.positions);
  for (const std::uint32_t t : order) {
    placed.mesh.triangles.push_back(mesh.triangles[t]);
    placed.ids.push_back(ids[t]);
    placed.errors.push_back(errors[t]);
  }
  return placed;
}

TriangleLayer::TriangleLayer(const std::string& name, const OGRSpatialReference& crs, Take take)
    : take_(std::move(take)), definition_(new OGRFeatureDefn(name.c_str())) {
  definition_->Reference();
  SetDescription(name.c_str());
  definition_->SetGeomType(wkbPolygon25D);
  if (!crs.IsEmpty()) {
    // The definition counts references, and the caller's object may go before it does: it gets a copy.
    OGRSpatialReference* const own = crs.Clone();
    definition_->GetGeomFieldDefn(0)->SetSpatialRef(own);
    own->Release();
  }
  OGRFieldDefn error("error", OFTReal);
  definition_->AddFieldDefn(&error);
}

TriangleLayer::~TriangleLayer() {
  definition_->Release();
}

const PlacedTriangles* TriangleLayer::triangles() {
  // The triangles are computed at the first question. A failure is reported once and leaves the layer empty.
  if (!triangles_ && !hasFailed_) {
    Result<PlacedTriangles> taken = [&]() -> Result<PlacedTriangles> {
      try {
        return take_();
      } catch (...) {
        return caughtFailure();
      }
    }();
    if (taken) {
      triangles_ = std::move(*taken);
    } else {
      hasFailed_ = true;
      reportError(taken.error());
    }
  }
  return triangles_ ? &*triangles_ : nullptr;
}

OGRFeature* TriangleLayer::feature(const PlacedTriangles& from, std::size_t number) const {
  auto ring = std::make_unique<OGRLinearRing>();
  for (const std::size_t i : {0, 1, 2, 0}) {
    const Vec3& p = from.mesh.positions[from.mesh.triangles[number][i]];
    ring->addPoint(p.x, p.y, p.z);
  }
  auto polygon = std::make_unique<OGRPolygon>();
  polygon->addRingDirectly(ring.release());
  polygon->assignSpatialReference(definition_->GetGeomFieldDefn(0)->GetSpatialRef());
  auto feature = std::make_unique<OGRFeature>(definition_);
  feature->SetFID(from.ids[number]);
  feature->SetField(0, double(from.errors[number]));
  feature->SetGeometryDirectly(polygon.release());
  return feature.release();
}

bool TriangleLayer::mayBeWanted(const PlacedTriangles& from, std::size_t number) const {
  // Boxes are compared before any geometry is made, because a small filter leaves most triangles out.
  if (m_poFilterGeom == nullptr) return true;
  OGREnvelope box;
  for (const std::uint32_t v : from.mesh.triangles[number])
    box.Merge(from.mesh.positions[v].x, from.mesh.positions[v].y);
  return m_sFilterEnvelope.Intersects(box) != FALSE;
}

OGRFeature* TriangleLayer::GetNextFeature() {
  const PlacedTriangles* const all = triangles();
  if (all == nullptr) return nullptr;
  while (next_ < all->ids.size()) {
    const std::size_t number = next_++;
    if (!mayBeWanted(*all, number)) continue;
    std::unique_ptr<OGRFeature> one(feature(*all, number));
    if ((m_poFilterGeom == nullptr || FilterGeometry(one->GetGeometryRef()) != FALSE) &&
        (m_poAttrQuery == nullptr || m_poAttrQuery->Evaluate(one.get()) != FALSE))
      return one.release();
  }
  return nullptr;
}

OGRFeature* TriangleLayer::GetFeature(GIntBig id) {
  const PlacedTriangles* const all = triangles();
  if (all == nullptr || id < 0 || id > std::numeric_limits<std::uint32_t>::max()) return nullptr;
  const auto found = std::ranges::lower_bound(all->ids, static_cast<std::uint32_t>(id));
  if (found == all->ids.end() || *found != static_cast<std::uint32_t>(id)) return nullptr;
  return feature(*all, static_cast<std::size_t>(found - all->ids.begin()));
}

GIntBig TriangleLayer::GetFeatureCount(int force) {
  // Without a filter the number is known; with one, OGR counts the features.
  if (m_poFilterGeom != nullptr || m_poAttrQuery != nullptr) return OGRLayer::GetFeatureCount(force);
  const PlacedTriangles* const all = triangles();
  return all == nullptr ? 0 : static_cast<GIntBig>(all->ids.size());
}

OGRErr TriangleLayer::GetExtent(OGREnvelope* extent, int) {
  *extent = OGREnvelope();  // callers pass memory as it is
  const PlacedTriangles* const all = triangles();
  if (all == nullptr || all->ids.empty()) return OGRERR_FAILURE;
  for (const auto& triangle : all->mesh.triangles)
    for (const std::uint32_t v : triangle) extent->Merge(all->mesh.positions[v].x, all->mesh.positions[v].y);
  return OGRERR_NONE;
}

int TriangleLayer::TestCapability(const char* what) {
  if (EQUAL(what, OLCFastFeatureCount)) return m_poFilterGeom == nullptr && m_poAttrQuery == nullptr;
  return EQUAL(what, OLCRandomRead) || EQUAL(what, OLCFastGetExtent) || EQUAL(what, OLCStringsAsUTF8);
}

}  // namespace arete
