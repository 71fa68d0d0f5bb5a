// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of a closed surface whose pages come late: no hole, no crack, the same pixels as of the whole
// model where the cut is the same, and within the tolerance when the camera stands still. Other programs
// showed cracks between two resolutions, stayed coarse after some minutes of turning a model, and loaded its
// pictures again and again.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "surface/builder/build.h"
#include "surface/displacement/find_displacement.h"
#include "surface/mesh_with_everything.h"
#include "surface/painted_rock.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/frame_target.h"
#include "viewer/headless/headless.h"
#include "viewer/pages/paged_drawable.h"
#include "viewer/tiny_png.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 240, kHeight = 180;

/// A surface in a file in pages, and the same in memory.
class PagedFile {
 public:
  PagedFile(SurfaceModel model, const std::string& name)
      : path(fs::temp_directory_path() / ("arete-" + name + "-" + std::to_string(::getpid()) + ".amt")),
        whole(std::move(model)) {
    EXPECT_TRUE(writeSurfaceAmt(path.string(), whole, {}, {.isPaged = true}));
    const auto pages = file()->pagesFor({});
    for (const PageNeed& need : *pages) bytes += need.bytes.size();
  }
  ~PagedFile() { fs::remove(path); }
  PagedFile(const PagedFile&) = delete;
  PagedFile& operator=(const PagedFile&) = delete;

  Result<PagedSurfaceFile> file() const {
    ARETE_TRY(AmtContainer container, AmtContainer::open(path.string()));
    return PagedSurfaceFile::open(std::move(container));
  }
  Result<PagedSurface> drawable(std::uint64_t mostBytes = SurfacePages::kUsualBytes) const {
    ARETE_TRY(PagedSurfaceFile opened, file());
    ARETE_TRY(SurfacePages pages, SurfacePages::open(std::move(opened), mostBytes));
    auto subject = std::make_shared<PagedSurfaceSubject>(pages.outline(), ZUpFrame(*pages.outline()), Turn{},
                                                         whole.mt.vertexCount());
    return drawPaged(std::move(pages), std::move(subject));
  }

  fs::path path;
  SurfaceModel whole;
  std::uint64_t bytes = 0;
};

/// Four colours.
std::vector<std::byte> paint() {
  return test::tinyPng(2, {{250, 30, 30, 255}, {30, 250, 30, 255}, {40, 40, 240, 255}, {250, 240, 30, 255}});
}

const PagedFile& rock() {
  static const PagedFile file(*buildSurface(shapes::paintedRock(28'000, paint())), "rock");
  return file;
}

/// Around the middle, which is looked at.
Camera around(double azimuth, double pitch, double distance) {
  Camera camera{.azimuthDegrees = azimuth,
                .pitchDegrees = pitch,
                .verticalFieldOfViewDegrees = 40,
                .widthPixels = kWidth,
                .heightPixels = kHeight};
  const double a = azimuth * 3.14159265358979 / 180, p = pitch * 3.14159265358979 / 180;
  camera.xy = {-distance * std::sin(a) * std::cos(p), -distance * std::cos(a) * std::cos(p)};
  camera.height = -distance * std::sin(p);
  return camera;
}

/// From outside of the rock, whose middle is inside.
Camera onTheWay(int frame) {
  return around(7.0 * frame, -30 + frame % 60, 5 - 0.05 * (frame % 50));
}

/// What is turned away is left out, so that a crack shows the background.
ViewSettings unshaded() {
  ViewSettings settings;
  settings.look.coloring = Coloring::material;
  settings.look.isShaded = false;
  settings.look.surface.sides = SurfaceSides::front;
  return settings;
}

/// Pixels of the background that what is drawn has all around: a star-shaped rock has none.
int enclosedIn(const FrameTarget& target, const Drawable& drawable, const Camera& camera,
               const ViewSettings& settings) {
  const auto frame = drawable.frameOf(camera, settings);
  const std::vector<float> depths = target.depths(frame->drawnNear, frame->depthReach);
  std::vector<bool> isOutside(depths.size());
  std::vector<std::pair<int, int>> waiting;
  const auto reach = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= kWidth || y >= kHeight) return;
    const std::size_t i = std::size_t(y) * kWidth + std::size_t(x);
    if (isOutside[i] || std::isfinite(depths[i])) return;
    isOutside[i] = true;
    waiting.push_back({x, y});
  };
  for (int x = 0; x < kWidth; ++x) reach(x, 0), reach(x, kHeight - 1);
  for (int y = 0; y < kHeight; ++y) reach(0, y), reach(kWidth - 1, y);
  while (!waiting.empty()) {
    const auto [x, y] = waiting.back();
    waiting.pop_back();
    reach(x - 1, y), reach(x + 1, y), reach(x, y - 1), reach(x, y + 1);
  }
  int holes = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) holes += !isOutside[i] && !std::isfinite(depths[i]) ? 1 : 0;
  return holes;
}

Result<HeadlessView> viewOf(const PagedFile& file, const ViewSettings& settings, bool isPaged,
                            std::uint64_t mostBytes = SurfacePages::kUsualBytes) {
  return HeadlessView::create(
      {.widthPixels = kWidth, .heightPixels = kHeight, .samples = 1, .settings = settings},
      [&](Scene& scene) -> Status {
        if (isPaged) {
          ARETE_TRY(PagedSurface made, file.drawable(mostBytes));
          return scene.add(std::make_unique<PagedSurface>(std::move(made)));
        }
        ARETE_TRY(SurfaceDrawable made,
                  SurfaceDrawable::create(
                      file.whole, std::make_shared<SurfaceSubject>(file.whole, ZUpFrame(file.whole))));
        return scene.add(std::make_unique<SurfaceDrawable>(std::move(made)));
      });
}

/// Pixels in which two pictures differ by more than rounding.
int differing(const Image& a, const Image& b) {
  int differ = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const auto p = a.at(x, y), q = b.at(x, y);
      const int most = std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
      differ += most > 2 ? 1 : 0;
    }
  return differ;
}

TEST(PagedSurface, LeavesNoHoleAndNoCrackWhilePagesAreLate) {
  ARETE_NEEDS_OPENGL(context);
  Result<PagedSurface> drawable = rock().drawable(rock().bytes / 2);
  ASSERT_TRUE(drawable) << drawable.error().describe();
  const auto target = FrameTarget::create(kWidth, kHeight);
  ASSERT_TRUE(target);
  ViewSettings settings = unshaded();
  settings.pixels = 0.3;
  settings.pageBytes = 6000;
  bool wasLate = false;
  for (int frame = 0; frame < 50; ++frame) {
    SCOPED_TRACE(frame);
    const Camera camera = onTheWay(frame);
    ASSERT_TRUE(drawable->advance(camera, settings));
    const auto figures = drawable->cut(camera, settings);
    ASSERT_TRUE(figures) << figures.error().describe();
    ASSERT_TRUE(figures->pages);
    wasLate = wasLate || figures->pages->missingTriangles > 0;
    EXPECT_LE(figures->pages->residentBytes, rock().bytes / 2);
    target->begin();
    ASSERT_TRUE(drawable->draw(camera, settings));
    EXPECT_TRUE(drawable->isShown());
    EXPECT_EQ(enclosedIn(*target, *drawable, camera, settings), 0);
  }
  EXPECT_TRUE(wasLate) << "no page was late, so that nothing was tested";
}

TEST(PagedSurface, IsWithinTheToleranceWhenTheCameraStandsStillHoweverLongItTurned) {
  ARETE_NEEDS_OPENGL(context);
  Result<PagedSurface> drawable = rock().drawable(rock().bytes);
  ASSERT_TRUE(drawable) << drawable.error().describe();
  ViewSettings settings = unshaded();
  settings.pageBytes = 20'000;
  for (int turns = 0; turns < 4; ++turns) {
    for (int frame = 0; frame < 25; ++frame) {
      const Camera camera = onTheWay(31 * turns + frame);
      ASSERT_TRUE(drawable->advance(camera, settings));
      ASSERT_TRUE(drawable->cut(camera, settings));
    }
    const Camera still = around(40.0 * turns, -20, 2.2);
    settings.pixels = 0.5;
    double pixels = 0;
    for (int frame = 0; frame < 80; ++frame) {
      ASSERT_TRUE(drawable->advance(still, settings));
      const auto figures = drawable->cut(still, settings);
      ASSERT_TRUE(figures);
      pixels = figures->pixels;
      if (figures->pages->missingTriangles == 0 && figures->pages->bytes == 0) break;
    }
    EXPECT_EQ(pixels, settings.pixels);
  }
}

TEST(PagedSurface, DrawsThePixelsOfTheWholeModelWhereTheCutIsTheSame) {
  ARETE_NEEDS_OPENGL(probe);
  SurfaceModel displaced = *buildSurface(shapes::everything(true, 40));
  displaced.displacement = *findDisplacement(displaced);
  const PagedFile moved(std::move(displaced), "moved");
  const PagedFile everything(*buildSurface(shapes::everything(false, 60)), "everything");
  for (const PagedFile* const file : {&rock(), &moved, &everything}) {
    SCOPED_TRACE(file->path.string());
    ViewSettings settings = unshaded();
    settings.look.surface.sides = SurfaceSides::both;
    Result<HeadlessView> paged = viewOf(*file, settings, true), whole = viewOf(*file, settings, false);
    ASSERT_TRUE(paged && whole);
    const double diagonal = file->whole.diagonal;
    for (const double error : {0.02, 0.004, 0.001, 0.0}) {
      SCOPED_TRACE(error);
      for (HeadlessView* const view : {&*paged, &*whole})
        view->scene().objects().front().level = HandLevel{.error = error * diagonal};
      const Camera camera = around(200, -35, 1.3 * diagonal);
      const auto a = paged->draw(camera), b = whole->draw(camera);
      ASSERT_TRUE(a && b);
      EXPECT_EQ(a->triangles, b->triangles);
      EXPECT_EQ(a->pages->missingTriangles, 0u);
      EXPECT_EQ(differing(paged->image(), whole->image()), 0);
    }
  }
}

TEST(PagedSurface, IsNoFartherFromTheWholeModelsPictureThanTheTolerance) {
  ARETE_NEEDS_OPENGL(probe);
  ViewSettings settings = unshaded();
  settings.look.surface.hasTextures = false;
  settings.pixels = 0.5;
  Result<HeadlessView> paged = viewOf(rock(), settings, true), whole = viewOf(rock(), settings, false);
  ASSERT_TRUE(paged && whole);
  for (const double azimuth : {10.0, 100.0, 260.0}) {
    SCOPED_TRACE(azimuth);
    const Camera camera = around(azimuth, -25, 3);
    ASSERT_TRUE(paged->draw(camera));
    ASSERT_TRUE(whole->draw(camera));
    EXPECT_LT(differing(paged->image(), whole->image()), kWidth * kHeight / 50);
  }
}

TEST(PagedSurface, SendsThePicturesOfItsMaterialsOnce) {
  ARETE_NEEDS_OPENGL(context);
  Result<PagedSurface> drawable = rock().drawable();
  ASSERT_TRUE(drawable) << drawable.error().describe();
  const auto textureNow = [&] {
    return drawable->shown().assets()->materials.materials()[0].pictures[DrawnPicture::color].texture;
  };
  const GLuint texture = textureNow();
  EXPECT_NE(texture, 0u);
  EXPECT_TRUE(drawable->warnings().empty());
  const SurfaceModel* before = &drawable->part();
  ViewSettings settings = unshaded();
  settings.pixels = 0.2;
  for (int frame = 0; frame < 3; ++frame) {
    const Camera camera = around(120.0 * frame, -20, 1.6);
    ASSERT_TRUE(drawable->advance(camera, settings));
    ASSERT_TRUE(drawable->cut(camera, settings));
    EXPECT_EQ(textureNow(), texture);
  }
  EXPECT_NE(&drawable->part(), before) << "no other part was drawn";
}

TEST(PagedSurface, GivesTheSamePicturesForAnyNumberOfThreads) {
  ARETE_NEEDS_OPENGL(probe);
  std::vector<std::vector<Image>> pictures(2);
  for (const int i : {0, 1}) {
    ViewSettings settings;
    settings.look.coloring = Coloring::material;
    settings.pageBytes = 15'000;
    Result<HeadlessView> view = viewOf(rock(), settings, true, rock().bytes / 2);
    ASSERT_TRUE(view) << view.error().describe();
    for (int frame = 0; frame < 12; ++frame) {
      ASSERT_TRUE(view->draw(onTheWay(frame), {.progress = {}, .threads = i == 0 ? 1 : 3}));
      pictures[std::size_t(i)].push_back(view->image());
    }
  }
  for (std::size_t frame = 0; frame < pictures[0].size(); ++frame)
    EXPECT_TRUE(pictures[0][frame].pixels == pictures[1][frame].pixels) << frame;
}

TEST(PagedSurface, ReadsInTheBackgroundWhereAPictureDoesNotWait) {
  ARETE_NEEDS_OPENGL(context);
  Result<PagedSurface> drawable = rock().drawable();
  ASSERT_TRUE(drawable) << drawable.error().describe();
  ViewSettings settings = unshaded();
  settings.waits = false;
  settings.pixels = 0.5;
  const auto target = FrameTarget::create(kWidth, kHeight);
  ASSERT_TRUE(target);
  bool isThere = false;
  for (int frame = 0; frame < 3000 && !isThere; ++frame) {
    const Camera camera = around(std::min(frame, 40), -20, 2.5);
    ASSERT_TRUE(drawable->advance(camera, settings));
    const auto figures = drawable->cut(camera, settings);
    ASSERT_TRUE(figures) << figures.error().describe();
    target->begin();
    ASSERT_TRUE(drawable->draw(camera, settings));
    ASSERT_EQ(enclosedIn(*target, *drawable, camera, settings), 0) << frame;
    isThere = frame > 40 && figures->pixels == settings.pixels && figures->pages->missingPages == 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_TRUE(isThere);
}

TEST(PagedSurface, HasPicksOnThePartThatIsDrawnWithABoundThatSaysSo) {
  ARETE_NEEDS_OPENGL(context);
  Result<PagedSurface> drawable = rock().drawable();
  ASSERT_TRUE(drawable) << drawable.error().describe();
  const Camera camera = around(30, -20, 3);
  const Subject& subject = drawable->subject();
  const auto coarse = subject.pick(camera, {kWidth / 2.0, kHeight / 2.0}, {});
  ASSERT_TRUE(coarse);
  EXPECT_GT(coarse->finestError, 0);
  EXPECT_EQ(subject.boundAt(*coarse, 0), coarse->finestError);
  ViewSettings settings = unshaded();
  settings.level = HandLevel{.error = 0};
  ASSERT_TRUE(drawable->advance(camera, settings));
  const auto fine = subject.pick(camera, {kWidth / 2.0, kHeight / 2.0}, {});
  ASSERT_TRUE(fine);
  EXPECT_EQ(fine->finestError, 0);
  EXPECT_EQ(subject.boundAt(*fine, 0), 0);
  const SurfaceSubject whole(rock().whole, ZUpFrame(rock().whole));
  const auto there = whole.pick(camera, {kWidth / 2.0, kHeight / 2.0}, {});
  ASSERT_TRUE(there);
  EXPECT_NEAR(norm(fine->metric - there->metric), 0, 1e-6);
  EXPECT_EQ(subject.facts().vertices, rock().whole.mt.vertexCount());
  EXPECT_EQ(subject.facts().triangles, rock().whole.finestTriangles());
}

TEST(PagedSurface, HasTheWholeModelInItsBoxAlsoWhereThatIsTurned) {
  const auto pages = SurfacePages::open(*rock().file(), 100'000);
  ASSERT_TRUE(pages);
  const ZUpFrame upright(*pages->outline());
  PagedSurfaceSubject subject(pages->outline(), upright, Turn{}, 0);
  for (const Turn& turn : {Turn{}, Turn{.heading = 40, .pitch = 20, .roll = 10}}) {
    Placement placement = subject.placement();
    placement.turn = turn;
    subject.place(placement);
    const MetricBox box = subject.box();
    const Similarity pose = subject.pose({});
    for (std::uint32_t v = 0; v < rock().whole.mt.vertexCount(); ++v) {
      const Vec3 p = pose(upright.fromFile(rock().whole.mt.position(VertexId(v))));
      ASSERT_TRUE(p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x &&
                  p.y <= box.high.y && p.z <= box.high.z);
    }
  }
}

TEST(PagedSurface, CanBeTurned) {
  ARETE_NEEDS_OPENGL(probe);
  const ViewSettings settings = unshaded();
  Result<HeadlessView> paged = viewOf(rock(), settings, true), whole = viewOf(rock(), settings, false);
  ASSERT_TRUE(paged && whole);
  for (HeadlessView* const view : {&*paged, &*whole}) {
    ASSERT_TRUE(view->scene().drawables().front()->turn());
    view->scene().drawables().front()->setTurn(Turn{.heading = 70, .pitch = -30, .roll = 5});
    view->scene().objects().front().level = HandLevel{.error = 0.001 * rock().whole.diagonal};
    ASSERT_TRUE(view->draw(around(0, -10, 3)));
  }
  // The middle of the part's box is not quite that of the whole's, about which it turns.
  EXPECT_LT(differing(paged->image(), whole->image()), kWidth * kHeight / 20);
}

TEST(PagedSurface, RefusesInksWhichCompareWithTheWholeModel) {
  ARETE_NEEDS_OPENGL(context);
  Result<PagedSurface> drawable = rock().drawable();
  ASSERT_TRUE(drawable) << drawable.error().describe();
  EXPECT_TRUE(drawable->subject().inks().empty());
  ViewSettings settings = unshaded();
  settings.look.coloring = Coloring::ink;
  settings.look.ink = "charts";
  const auto figures = drawable->cut(around(0, -20, 3), settings);
  ASSERT_FALSE(figures);
  EXPECT_NE(figures.error().describe().find("read whole"), std::string::npos);
}

TEST(PagedSurface, NamesADamagedPageInsteadOfDrawingIt) {
  ARETE_NEEDS_OPENGL(context);
  const PagedFile copy(rock().whole, "damaged");
  const AmtContainer container = *AmtContainer::open(copy.path.string());
  const AmtChunk nodes = *container.find(amt_tag::kPackedNodes);
  {
    std::fstream file(copy.path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(std::streamoff(nodes.offset + nodes.bytes - 3));
    file.put('\x55');
    file.seekp(std::streamoff(nodes.offset + nodes.bytes - 4));
    file.put('\x55');
  }
  for (const bool waits : {true, false}) {
    Result<PagedSurface> drawable = copy.drawable();
    ASSERT_TRUE(drawable) << drawable.error().describe();
    ViewSettings settings = unshaded();
    settings.waits = waits;
    settings.level = HandLevel{.error = 0};
    const Camera camera = around(0, -20, 3);
    Status advanced = drawable->advance(camera, settings);
    for (int frame = 0; frame < 2000 && advanced && !waits; ++frame) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      advanced = drawable->advance(camera, settings);
    }
    ASSERT_FALSE(advanced) << waits;
    EXPECT_EQ(advanced.error().code, ErrorCode::corrupt);
    EXPECT_NE(advanced.error().message.find("page "), std::string::npos) << advanced.error().message;
  }
}

}  // namespace
}  // namespace arete
