// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curved Earth, against places computed with GeographicLib's geocentric coordinates and projections (the
// viewer goes by PROJ), and against rays that are cut with the ellipsoid.
#include "viewer/scene/curved_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/mt/curved_mt.h"
#include "engine/mt/node_blocks.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/frame_target.h"
#include "viewer/true_earth.h"
#include "viewer/viewed_terrain.h"
#include "viewer/window/viewer_session.h"

namespace arete {
namespace {

using namespace test;

TEST(CurvedEarth, PlacesAndCamerasAreThoseOfTheEllipsoid) {
  for (const Map& map : maps()) {
    SCOPED_TRACE(map.name);
    const auto ground = CurvedGround::create(map.model);
    ASSERT_TRUE(ground) << ground.error().describe();
    const Space space(map);
    Random random(3);
    for (int i = 0; i < 50; ++i) {
      Camera camera = anyCamera(random, map.model);
      const Vec3 expected = space.in(map.centred(camera.xy, camera.height));
      const Vec3 got = ground->position(camera.xy, camera.height);
      ASSERT_LT(apart(got, expected), 1e-5);
      const Vec3 back = ground->source(got);
      ASSERT_NEAR(back.x, camera.xy.x, map.zone == 0 ? 1e-9 : 1e-4);
      ASSERT_NEAR(back.y, camera.xy.y, map.zone == 0 ? 1e-9 : 1e-4);
      ASSERT_NEAR(back.z, camera.height, 1e-6);
      const double middle = map.model.mt.arrays().metric.origin.z;
      ASSERT_LT(apart(ground->position(camera.xy, camera.height, 3),
                      space.in(map.centred(camera.xy, middle + 3 * (camera.height - middle)))),
                1e-5);

      const auto view = ground->viewOf(camera);
      ASSERT_TRUE(view);
      const TrueCamera truth(map, camera);
      const auto direction = [&](const Vec3& d) {
        return space.in(truth.here.centredOf(d)) - space.in(truth.here.at);
      };
      ASSERT_LT(apart(view->eye, expected), 1e-5);
      ASSERT_LT(apart(view->forward, direction(truth.forward)), 2e-6);
      ASSERT_LT(apart(view->up, direction(truth.up)), 2e-6);
    }
  }
}

TEST(CurvedEarth, ErrorsHoldAtEverySampleAndLaw6Holds) {
  for (const Map& map : maps())
    for (const double stretch : {1.0, 4.0}) {
      SCOPED_TRACE(std::string(map.name) + ", exaggerated " + std::to_string(stretch));
      const TerrainModel& model = map.model;
      const auto ground = CurvedGround::create(model);
      ASSERT_TRUE(ground);
      const auto made = ground->curvedMt(stretch);
      ASSERT_TRUE(made);
      const MultiTriangulation &mt = *made, &flat = model.mt;
      const MtArrays& a = mt.arrays();

      for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
        const NodeId node(n);
        const Sphere& ball = a.sphere[n];
        const Vec3 centre{ball.x, ball.y, ball.z};
        for (const std::uint32_t t : mt.floor(node)) ASSERT_LE(a.error[t], a.saturatedError[n]);
        const auto holds = [&](VertexId v) {
          return apart(centre, a.metric.toMetric(mt.position(v))) <= ball.radius;
        };
        ASSERT_TRUE(holds(mt.apex(node)));
        for (const std::uint32_t v : mt.link(node)) ASSERT_TRUE(holds(VertexId(v)));
        for (std::uint32_t i = 0; i < mt.ceilingSize(node); ++i) {
          const NodeId child = mt.remover(mt.slotTriangle(node, i));
          if (!child.isValid()) continue;
          const Sphere& c = a.sphere[child.index()];
          ASSERT_LE(a.saturatedError[child.index()], a.saturatedError[n]);
          ASSERT_LE(apart(centre, {c.x, c.y, c.z}) + c.radius, ball.radius);
        }
        for (const std::uint64_t entry : blockEntries(mt.nodeCount(), n)) {
          ASSERT_TRUE(holdsError(a, entry, n));
          ASSERT_TRUE(holdsSphere(a, entry, n));
        }
      }

      // Every sample that a triangle covers, of all triangles.
      const RasterHeightfield samples = model.rasterSamples();
      const double unit = a.metric.scale.z;
      double largest = 0;
      const auto check = [&](TriangleId t) {
        const auto corners = mt.corners(t);
        std::array<Vec2, 3> p;
        std::array<Vec3, 3> q;
        for (std::size_t i = 0; i < 3; ++i) {
          p[i] = flat.vertices().planPosition(VertexId(corners[i]));
          q[i] = a.metric.toMetric(mt.position(VertexId(corners[i])));
        }
        const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
        for (double row = std::min({p[0].y, p[1].y, p[2].y}); row <= std::max({p[0].y, p[1].y, p[2].y});
             ++row)
          for (double col = std::min({p[0].x, p[1].x, p[2].x}); col <= std::max({p[0].x, p[1].x, p[2].x});
               ++col) {
            const double u = ((p[2].x - p[1].x) * (row - p[1].y) - (p[2].y - p[1].y) * (col - p[1].x)) / area,
                         v = ((p[0].x - p[2].x) * (row - p[2].y) - (p[0].y - p[2].y) * (col - p[2].x)) / area,
                         w = 1 - u - v;
            if (u < 0 || v < 0 || w < 0) continue;
            const double h = samples.at(std::uint32_t(col), std::uint32_t(row));
            const Vec3 truth = ground->position(model.toSource({col, row}), h, stretch);
            const Vec3 there{u * q[0].x + v * q[1].x + w * q[2].x, u * q[0].y + v * q[1].y + w * q[2].y,
                             u * q[0].z + v * q[1].z + w * q[2].z};
            const double off = apart(truth, there) / unit, allowed = mt.error(t);
            ASSERT_LE(off, allowed + 1e-6) << "triangle " << t.index();
            if (flat.error(t) < 0.2 * allowed) largest = std::max(largest, off / allowed);
          }
      };
      for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
        ASSERT_NO_FATAL_FAILURE(check(TriangleId(t)));
      for (std::uint32_t n = 0; n < mt.nodeCount(); n += 3)
        for (std::uint32_t i = 0; i < mt.ceilingSize(NodeId(n)); ++i)
          ASSERT_NO_FATAL_FAILURE(check(mt.slotTriangle(NodeId(n), i)));
      std::cout << map.name << ": where curvature matters most, up to " << largest
                << " of the error is there\n";
    }
}

TEST(CurvedEarth, WithoutACrsItIsRefusedByName) {
  Map map = mapOf("none", 33, {400000, 5300000}, 30, 9, 9, [](double, double) { return 1.0; });
  map.model.georeference.crsWkt.clear();
  const auto ground = CurvedGround::create(map.model);
  ASSERT_FALSE(ground);
  EXPECT_EQ(ground.error().code, ErrorCode::usage);
  EXPECT_NE(ground.error().message.find("CRS"), std::string::npos);
}

/// A frame's depths, curved.
std::vector<float> depthsOf(TerrainDrawable& view, const Camera& camera, const ViewSettings& settings) {
  const auto target = FrameTarget::create(int(camera.widthPixels), int(camera.heightPixels));
  EXPECT_TRUE(target);
  EXPECT_TRUE(view.cut(camera, settings));
  target->begin();
  EXPECT_TRUE(view.draw(camera, settings));
  return target->depths(view.frameOf(camera, settings)->drawnNear);
}

TEST(CurvedEarth, TheSeaEndsAtItsHorizon) {
  ARETE_NEEDS_OPENGL(context);
  const Map map = mapOf("sea", 0, {10, 47.7}, 0.01, 101, 271, [](double, double) { return 0.0; });
  Result<TerrainDrawable> view = TerrainDrawable::create(map.model, {});
  ASSERT_TRUE(view);
  for (const double height : {100.0, 500.0, 2000.0})
    for (const CutPath path : {CutPath::device, CutPath::processor}) {
      SCOPED_TRACE(height);
      // The meridian's radius of curvature here.
      const double radius = 6367400, horizon = std::sqrt(2 * radius * height);
      const Camera camera{.xy = {10.5, 45.01},
                          .height = height,
                          .pitchDegrees = -horizon / radius / kRadians,
                          .verticalFieldOfViewDegrees = 1,
                          .widthPixels = 160,
                          .heightPixels = 200};
      ViewSettings settings;
      settings.path = path;
      settings.isCurved = true;
      settings.pixels = 1e-3;
      const std::vector<float> depths = depthsOf(*view, camera, settings);
      const TrueCamera truth(map, camera);
      double farthest = 0;
      int compared = 0, differing = 0, beyond = 0;
      for (int y = 0; y < 200; ++y)
        for (int x = 60; x < 100; ++x) {
          const double drawn = double(depths[std::size_t(y) * 160 + std::size_t(x)]),
                       expected = truth.depthOfEllipsoid(x, y);
          if (std::isfinite(drawn)) farthest = std::max(farthest, drawn);
          // Grazing, a pixel or a facet decides: a part of the horizon's distance is left out.
          if (std::isfinite(expected) && expected < 0.8 * horizon) {
            ++compared;
            differing += std::abs(drawn - expected) <= 0.01 * expected ? 0 : 1;
          } else if (!std::isfinite(expected) && !std::isfinite(truth.depthOfEllipsoid(x, y + 1))) {
            ++beyond;
            differing += std::isfinite(drawn) ? 1 : 0;
          }
        }
      EXPECT_GT(compared, 1000);
      EXPECT_GT(beyond, 1000);
      EXPECT_EQ(differing, 0) << "of " << compared << " and " << beyond;
      EXPECT_LE(farthest, 1.01 * horizon + 1500);  // a facet of the ground ends behind it
      EXPECT_GE(farthest, 0.85 * horizon);         // half a pixel below it
    }
}

TEST(CurvedEarth, AMountainBeyondTheHorizonIsHiddenToItsHeight) {
  ARETE_NEEDS_OPENGL(context);
  const double far = 2.3;  // degrees: 255 km
  const Map map = mapOf("mountain", 0, {10, 47.7}, 0.005, 201, 541, [&](double lon, double lat) {
    const double x = (lon - 10.5) * std::cos(45 * kRadians), y = lat - (45.01 + far);
    return 6000 * std::exp(-(x * x + y * y) / (2 * 0.06 * 0.06));
  });
  Result<TerrainDrawable> view = TerrainDrawable::create(map.model, {});
  ASSERT_TRUE(view);
  const Camera camera{.xy = {10.5, 45.01},
                      .height = 200,
                      .verticalFieldOfViewDegrees = 3,
                      .widthPixels = 200,
                      .heightPixels = 600};
  ViewSettings settings;
  settings.pixels = 0.02;
  double lowest[2] = {1e300, 1e300}, highest[2] = {0, 0};
  for (const bool isCurved : {true, false}) {
    settings.isCurved = isCurved;
    const std::vector<float> depths = depthsOf(*view, camera, settings);
    const TrueCamera truth(map, camera);
    for (int y = 0; y < 600; ++y) {
      const double depth = double(depths[std::size_t(y) * 200 + 100]);
      if (!std::isfinite(depth) || depth < 150000) continue;
      double lat = 0, lon = 0, height = 0;
      const Vec3 p = truth.at(100, y, depth);
      if (isCurved)
        wgs84().Reverse(p.x, p.y, p.z, lat, lon, height);
      else
        height = camera.height + depth * (300 - y - 0.5) / truth.focal;
      lowest[isCurved] = std::min(lowest[isCurved], height);
      highest[isCurved] = std::max(highest[isCurved], height);
    }
  }
  // The lowest place that is seen is on the near slope; its distance is between the foot's and the top's.
  const auto hidden = [](double metres) {
    const double radius = 6367400, beyond = metres - std::sqrt(2 * radius * 200);
    return beyond * beyond / (2 * radius);
  };
  const double top = far * 111140;
  EXPECT_GT(lowest[1], hidden(top - 9000) - 50);
  EXPECT_LT(lowest[1], hidden(top) + 50);
  EXPECT_GT(highest[1], 5900);
  EXPECT_LT(lowest[0], 50);
  std::cout << "curved: seen from " << lowest[1] << " m up; flat: from " << lowest[0] << " m\n";
}

/// What the device holds, in the space of a CurvedGround: by triangles, with places of the plan.
struct CurvedMesh {
  std::vector<Vec3> places;
  std::vector<Vec2> plan;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

CurvedMesh readCurved(const TerrainDrawable& view) {
  const TerrainOnGpu& t = view.terrain();
  const MetricFrame &metric = view.mt().arrays().metric, &flat = view.model().mt.arrays().metric;
  std::vector<float> positions(3 * std::size_t(t.vertices)), spots(positions.size()), rises(t.vertices);
  glGetNamedBufferSubData(t.positions, 0, GLsizeiptr(4 * positions.size()), positions.data());
  glGetNamedBufferSubData(t.places, 0, GLsizeiptr(4 * spots.size()), spots.data());
  glGetNamedBufferSubData(t.rises, 0, GLsizeiptr(4 * rises.size()), rises.data());
  CurvedMesh mesh;
  for (std::size_t v = 0; v < rises.size(); ++v) {
    mesh.places.push_back(
        {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2] + rises[v] * metric.scale.z});
    mesh.plan.push_back(
        {spots[3 * v] / flat.scale.x + flat.origin.x, spots[3 * v + 1] / flat.scale.y + flat.origin.y});
  }
  const DrawnFront front = view.front();
  std::array<std::uint32_t, 3> command = {3 * front.count, 1, 3 * front.first};
  if (front.indirect != 0) glGetNamedBufferSubData(front.indirect, 0, sizeof command, command.data());
  mesh.triangles.resize(command[0] / 3);
  glGetNamedBufferSubData(front.indices, GLintptr(4) * command[2], GLsizeiptr(12 * mesh.triangles.size()),
                          mesh.triangles.data());
  return mesh;
}

TEST(CurvedEarth, WhatIsDrawnKeepsItsPixelsAtEverySampleInSight) {
  ARETE_NEEDS_OPENGL(context);
  for (const Map& map : maps()) {
    SCOPED_TRACE(map.name);
    const TerrainModel& model = map.model;
    const RasterHeightfield samples = model.rasterSamples();
    const double middle = model.mt.arrays().metric.origin.z;
    Result<TerrainDrawable> view = TerrainDrawable::create(model, {});
    ASSERT_TRUE(view);
    const Space space(map);
    Random random(55);
    double largestPart = 0;
    std::size_t seen = 0;
    for (int i = 0; i < 12; ++i) {
      SCOPED_TRACE("seed 55, camera " + std::to_string(i));
      Camera camera = anyCamera(random, model);
      ViewSettings settings;
      settings.isCurved = true;
      settings.stretch = i < 8 ? 1 : 2;
      settings.pixels = random.between(0.5, 10);
      settings.isGeomorphed = i % 2 == 0;
      settings.path = i % 4 < 2 ? CutPath::device : CutPath::processor;
      const auto figures = view->cut(camera, settings);
      ASSERT_TRUE(figures) << figures.error().describe();
      ASSERT_TRUE(figures->isComplete);
      const auto exaggerated = [&](double h) { return middle + (h - middle) * settings.stretch; };
      camera.height = exaggerated(camera.height);
      const TrueCamera truth(map, camera);
      const CurvedMesh mesh = readCurved(*view);
      for (const auto& t : mesh.triangles) {
        const Vec2 &a = mesh.plan[t[0]], &b = mesh.plan[t[1]], &c = mesh.plan[t[2]];
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        for (int row = int(std::ceil(std::min({a.y, b.y, c.y}) - 1e-3));
             row <= std::max({a.y, b.y, c.y}) + 1e-3; ++row)
          for (int col = int(std::ceil(std::min({a.x, b.x, c.x}) - 1e-3));
               col <= std::max({a.x, b.x, c.x}) + 1e-3; ++col) {
            const double u = ((c.x - b.x) * (row - b.y) - (c.y - b.y) * (col - b.x)) / area,
                         v = ((a.x - c.x) * (row - c.y) - (a.y - c.y) * (col - c.x)) / area, w = 1 - u - v;
            if (u < -1e-4 || v < -1e-4 || w < -1e-4) continue;
            const double h = samples.at(std::uint32_t(col), std::uint32_t(row));
            const Vec3 s =
                truth.project(map.centred(model.toSource({double(col), double(row)}), exaggerated(h)));
            if (!truth.sees(s)) continue;
            const Vec3 &p = mesh.places[t[0]], &q = mesh.places[t[1]], &r = mesh.places[t[2]];
            const Vec3 drawn = truth.project(space.out(
                {u * p.x + v * q.x + w * r.x, u * p.y + v * q.y + w * r.y, u * p.z + v * q.z + w * r.z}));
            const double off = std::hypot(s.x - drawn.x, s.y - drawn.y);
            ASSERT_LE(off, settings.pixels + 0.05) << "sample " << col << ", " << row;
            largestPart = std::max(largestPart, off / settings.pixels);
            ++seen;
          }
      }
    }
    EXPECT_GT(seen, 5000u);
    EXPECT_GT(largestPart, 0.3) << "the test sees next to nothing";
    std::cout << map.name << ": " << seen << " samples, up to " << largestPart << " of the tolerance\n";
  }
}

TEST(CurvedEarth, BothPathsTakeTheSameCut) {
  ARETE_NEEDS_OPENGL(context);
  const Map& map = maps()[2];
  Result<TerrainDrawable> view = TerrainDrawable::create(map.model, {});
  ASSERT_TRUE(view);
  Random random(8);
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE("seed 8, camera " + std::to_string(i));
    const Camera camera = anyCamera(random, map.model);
    ViewSettings settings;
    settings.isCurved = true;
    settings.pixels = random.between(0.5, 4);
    const auto device = view->cut(camera, settings);
    ASSERT_TRUE(device);
    const CurvedMesh a = readCurved(*view);
    settings.path = CutPath::processor;
    const auto processor = view->cut(camera, settings);
    ASSERT_TRUE(processor);
    const CurvedMesh b = readCurved(*view);
    EXPECT_EQ(device->triangles, processor->triangles);
    EXPECT_EQ(device->moving, processor->moving);
    for (const auto& t : a.triangles)
      for (const std::uint32_t v : t) ASSERT_LT(apart(a.places[v], b.places[v]), 0.05);
  }
}

TEST(CurvedEarth, TwoMapsOfTheSameGroundLookTheSame) {
  ARETE_NEEDS_OPENGL(context);
  // On the central meridian of zone 33 the map's north is true north.
  const auto smooth = [](double lon, double lat) {
    return 1200 + 900 * std::sin(9 * lon) * std::cos(11 * lat);
  };
  const Map lonLat = mapOf("lon/lat", 0, {14, 47.5}, 0.01, 201, 201, smooth);
  const Map utm = mapOf("UTM", 33, {425000, 5262000}, 1000, 151, 221, smooth);
  std::vector<float> depths[2];
  for (const Map* map : {&lonLat, &utm}) {
    Result<TerrainDrawable> view = TerrainDrawable::create(map->model, {});
    ASSERT_TRUE(view);
    const Camera camera{.xy = map->xy({15, 45.8}),
                        .height = 3000,
                        .pitchDegrees = -4,
                        .verticalFieldOfViewDegrees = 12,
                        .widthPixels = 240,
                        .heightPixels = 160};
    ViewSettings settings;
    settings.isCurved = true;
    settings.pixels = 0.05;
    depths[map->zone == 0 ? 0 : 1] = depthsOf(*view, camera, settings);
  }
  int seen = 0, agreeing = 0;
  for (std::size_t i = 0; i < depths[0].size(); ++i) {
    const double a = double(depths[0][i]), b = double(depths[1][i]);
    if (!std::isfinite(a) && !std::isfinite(b)) continue;
    ++seen;
    agreeing += std::abs(a - b) <= 0.01 * a ? 1 : 0;
  }
  EXPECT_GT(seen, 10000);
  EXPECT_GE(agreeing, 0.97 * seen) << "of " << seen;
}

TEST(CurvedEarth, AClickFindsWhatIsAtThePixel) {
  for (const Map& map : maps()) {
    SCOPED_TRACE(map.name + std::string(", seed 9"));
    const auto ground = CurvedGround::create(map.model);
    ASSERT_TRUE(ground);
    const TerrainSubject subject(map.model);
    const GroundHeights& heights = *subject.heights();
    Random random(9);
    int found = 0;
    for (int i = 0; i < 60; ++i) {
      const Camera camera = anyCamera(random, map.model);
      const Vec2 pixel{random.between(0, camera.widthPixels), random.between(0, camera.heightPixels)};
      const auto pick = subject.pick(camera, pixel, {.isCurved = true});
      if (!pick) continue;
      ++found;
      const auto there = heights.at(pick->xy);
      ASSERT_TRUE(there);
      EXPECT_NEAR(there->height, pick->height, 1e-3);
      const TrueCamera truth(map, camera);
      const Vec3 place = map.centred(pick->xy, pick->height), s = truth.project(place);
      // A few centimetres of the chord, and what they are seen under.
      const double allowed = 0.05 + 0.3 * truth.focal / s.z;
      EXPECT_NEAR(s.x, pixel.x, allowed);
      EXPECT_NEAR(s.y, pixel.y, allowed);
      // Nothing of the terrain is before it.
      const Vec3 eye = truth.here.at;
      for (int k = 1; k < 500; ++k) {
        const double part = k / 500.0;
        const Vec3 p{eye.x + part * (place.x - eye.x), eye.y + part * (place.y - eye.y),
                     eye.z + part * (place.z - eye.z)};
        const Space space(map);
        const Vec3 source = ground->source(space.in(p));
        const auto below = heights.at({source.x, source.y});
        if (below) {
          EXPECT_GT(source.z, below->height - 0.5);
        }
      }
    }
    EXPECT_GT(found, 10);
  }
}

TEST(CurvedEarth, AMarkIsDrawnWhereTheClickWas) {
  for (const Map& map : maps()) {
    SCOPED_TRACE(map.name);
    ViewerSession::Start start;
    start.camera = Camera{.xy = map.model.toSource({0.5 * map.model.columns, 0.5 * map.model.rows}),
                          .height = 20000,
                          .azimuthDegrees = 30,
                          .pitchDegrees = -20};
    start.settings.isCurved = true;
    start.settings.stretch = 2;
    test::ViewedTerrain viewed(map.model, start);
    ViewerSession& session = viewed.session;
    const Camera& camera = session.rig.camera();
    const Vec2 pixel{0.3 * camera.widthPixels, 0.7 * camera.heightPixels};
    session.click(pixel);
    ASSERT_EQ(session.tools->picks.size(), 1u) << session.message();
    const auto mark =
        pixelOf(session.subject, session.rig.camera(), session.tools->picks[0].metric, session.settings);
    ASSERT_TRUE(mark);
    EXPECT_NEAR(mark->x, pixel.x, 0.1);
    EXPECT_NEAR(mark->y, pixel.y, 0.1);
  }
}

TEST(CurvedEarth, MovingVerticesKeepTheColoursOfTheirHeights) {
  ARETE_NEEDS_OPENGL(context);
  // Seen from so far away, a vertex on its way is kilometres from its own place: chords sag, hills do not.
  const Map map = mapOf("continent", 0, {-20, 60}, 0.5, 81, 81, [](double lon, double lat) {
    return 500 * std::sin(0.2 * lon) * std::cos(0.2 * lat);
  });
  Result<TerrainDrawable> view = TerrainDrawable::create(map.model, {});
  ASSERT_TRUE(view);
  const Camera camera{
      .xy = {0, 40}, .height = 4e6, .pitchDegrees = -90, .widthPixels = 200, .heightPixels = 200};
  for (const CutPath path : {CutPath::device, CutPath::processor}) {
    Image pictures[2];
    for (const bool isGeomorphed : {false, true}) {
      const auto target = FrameTarget::create(200, 200);
      ASSERT_TRUE(target);
      ViewSettings settings;
      settings.path = path;
      settings.isCurved = true;
      settings.isGeomorphed = isGeomorphed;
      settings.look.isShaded = false;
      const auto figures = view->cut(camera, settings);
      ASSERT_TRUE(figures) << figures.error().describe();
      if (isGeomorphed) {
        EXPECT_GT(figures->moving, 0u);
      }
      target->begin();
      ASSERT_TRUE(view->draw(camera, settings));
      pictures[isGeomorphed ? 1 : 0] = target->image();
    }
    double apartInAll = 0;
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x)
        apartInAll += std::abs(double(pictures[0].at(x, y).r) - double(pictures[1].at(x, y).r));
    EXPECT_LT(apartInAll / (200 * 200), 3) << "of 255, in the mean";
  }
}

TEST(CurvedEarth, ItCanBeSwitchedAtAnyTimeEvenWhereTheCutIsFrozen) {
  ARETE_NEEDS_OPENGL(context);
  const Map& map = maps()[0];
  Result<TerrainDrawable> view = TerrainDrawable::create(map.model, {});
  ASSERT_TRUE(view);
  Random random(9);
  const Camera camera = anyCamera(random, map.model, 160, 120);
  for (const CutPath path : {CutPath::device, CutPath::processor}) {
    ViewSettings flat;
    flat.path = path;
    ViewSettings curved = flat;
    curved.isCurved = true;
    const std::vector<float> before = depthsOf(*view, camera, flat), after = depthsOf(*view, camera, curved);
    EXPECT_NE(before, after);
    EXPECT_EQ(depthsOf(*view, camera, flat), before);
    // A draw alone.
    const auto target = FrameTarget::create(160, 120);
    target->begin();
    ASSERT_TRUE(view->draw(camera, curved));
    EXPECT_EQ(target->depths(view->frameOf(camera, curved)->drawnNear), after);
    curved.stretch = 3;
    EXPECT_NE(depthsOf(*view, camera, curved), after);
  }
}

}  // namespace
}  // namespace arete
