// SPDX-License-Identifier: GPL-3.0-or-later
//
// own_renderer FILE.amt FRAMES OUT.pgm: flies across a terrain with a renderer that knows nothing of Arete
// but the buffers it receives: positions once, then what changes. The last frame is drawn, in grey, into
// OUT.pgm.
#include <arete/engine/morph/view_mesh.h>
#include <arete/io/store/amt/file.h>
#include <arete/terrain/locate/ground_height.h>
#include <arete/terrain/model/camera.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

int fail(const arete::Error& error) {
  std::cerr << error.describe() << "\n";
  return 1;
}

/// What would lie in a GPU's memory, and a picture of it by software.
struct Renderer {
  static constexpr int kWidth = 640, kHeight = 360;
  std::vector<std::array<float, 3>> vertices;           // relative to the mesh's origin
  std::vector<std::array<std::uint32_t, 3>> triangles;  // the index buffer

  /// Once.
  void upload(const arete::ViewMesh& mesh) {
    vertices = mesh.positions();
    triangles.assign(mesh.triangles().begin(), mesh.triangles().end());
  }

  /// Every frame. Returns the bytes that crossed the bus.
  std::size_t uploadChanges(const arete::ViewMesh& mesh) {
    std::size_t bytes = 0;
    triangles.resize(mesh.triangles().size());
    for (const auto& [first, count] : mesh.changedPlaces()) {
      std::copy_n(mesh.triangles().begin() + first, count, triangles.begin() + first);
      bytes += count * sizeof triangles[0];
    }
    for (const auto& [vertex, height] : mesh.heightChanges()) {
      vertices[vertex][2] = height;
      bytes += sizeof vertex + sizeof height;
    }
    return bytes;
  }

  /// A depth buffer and grey shades, black where there is no terrain. `eye` is relative to the mesh's origin:
  /// subtracted in double, so that it does not matter how large coordinates are. `mirror`: -1 where metric
  /// space is mirrored against the map.
  std::vector<unsigned char> draw(const arete::View& view, const arete::Vec3& eye, double mirror) const {
    std::vector<unsigned char> picture(std::size_t(kWidth) * kHeight, 0);
    std::vector<double> nearest(picture.size(), 0);  // 1 / depth
    const arete::Frustum::Planes axes = arete::Frustum(view).planes();
    const double focal = kHeight / (2 * axes.slopeY);
    const auto dot = [](const arete::Vec3& a, const arete::Vec3& b) {
      return a.x * b.x + a.y * b.y + a.z * b.z;
    };
    for (const auto& corners : triangles) {
      std::array<arete::Vec3, 3> p, s;  // from the eye; on the screen, with 1 / depth
      bool isBefore = true;
      for (int i = 0; i < 3; ++i) {
        const auto& v = vertices[corners[i]];
        p[i] = {v[0] - eye.x, v[1] - eye.y, v[2] - eye.z};
        const double depth = dot(p[i], axes.forward);
        isBefore = isBefore && depth > view.nearDistance;  // a real renderer clips
        s[i] = {kWidth / 2.0 + mirror * focal * dot(p[i], axes.right) / depth,
                kHeight / 2.0 - focal * dot(p[i], axes.up) / depth, 1 / depth};
      }
      if (!isBefore) continue;
      const arete::Vec3 a{p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z},
          b{p[2].x - p[0].x, p[2].y - p[0].y, p[2].z - p[0].z};
      const arete::Vec3 normal{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
      const double light = std::abs(0.5 * normal.x - 0.4 * normal.y + 0.77 * normal.z) /
                           std::sqrt(std::max(1e-30, dot(normal, normal)));
      const auto shade = static_cast<unsigned char>(40 + 210 * std::clamp(light, 0.0, 1.0));
      const double area = (s[1].x - s[0].x) * (s[2].y - s[0].y) - (s[2].x - s[0].x) * (s[1].y - s[0].y);
      if (area == 0) continue;
      const auto [left, right] = std::minmax({s[0].x, s[1].x, s[2].x});
      const auto [top, bottom] = std::minmax({s[0].y, s[1].y, s[2].y});
      const int x0 = int(std::clamp(left, 0.0, double(kWidth))),
                x1 = int(std::clamp(right + 1, 0.0, double(kWidth)));
      const int y0 = int(std::clamp(top, 0.0, double(kHeight))),
                y1 = int(std::clamp(bottom + 1, 0.0, double(kHeight)));
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
          const double px = x + 0.5, py = y + 0.5;
          const double w0 = ((s[1].x - px) * (s[2].y - py) - (s[2].x - px) * (s[1].y - py)) / area,
                       w1 = ((s[2].x - px) * (s[0].y - py) - (s[0].x - px) * (s[2].y - py)) / area;
          if (w0 < 0 || w1 < 0 || w0 + w1 > 1) continue;
          const double inverse = w0 * s[0].z + w1 * s[1].z + (1 - w0 - w1) * s[2].z;
          const std::size_t at = std::size_t(y) * kWidth + x;
          if (inverse <= nearest[at]) continue;
          nearest[at] = inverse;
          picture[at] = shade;
        }
    }
    return picture;
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: own_renderer FILE.amt FRAMES OUT.pgm\n";
    return 2;
  }
  const auto model = arete::loadAmt(argv[1]);
  if (!model) return fail(model.error());
  if (!model->isRaster) return fail({arete::ErrorCode::usage, "this example flies over rasters", argv[1]});
  const int frames = std::atoi(argv[2]);

  auto mesh = arete::ViewMesh::create(model->mt);
  if (!mesh) return fail(mesh.error());
  Renderer renderer;
  renderer.upload(*mesh);

  const arete::GroundHeights heights(*model);
  arete::View view;
  double ground = 0;
  for (int frame = 0; frame < frames; ++frame) {
    // From the first sample towards the last, 200 units above the ground, or above the last ground that there
    // was.
    const double along = (frame + 0.5) / frames * 0.5;
    arete::Camera camera;
    camera.xy = model->toSource({along * (model->columns - 1), along * (model->rows - 1)});
    if (const auto found = heights.at(camera.xy)) ground = found->height;
    camera.height = ground + 200;
    camera.azimuthDegrees = 135;
    camera.pitchDegrees = -15;
    camera.widthPixels = Renderer::kWidth;
    camera.heightPixels = Renderer::kHeight;
    auto placed = arete::viewOf(camera, *model);
    if (!placed) return fail(placed.error());
    view = *placed;
    view.nearDistance = 1;

    const auto report = mesh->update(view, {.pixels = 1});
    if (!report) return fail(report.error());
    const std::size_t bytes = renderer.uploadChanges(*mesh);
    std::cout << "frame " << frame << ": " << report->triangles << " triangles within " << report->pixels
              << " pixels, " << report->refined << " refined, " << report->coarsened << " coarsened, "
              << report->moving << " vertices moving, " << bytes << " bytes, a jump of " << report->jumpPixels
              << " pixels\n";
  }

  // Kept by changes alone, the buffers are what they would be if all were uploaded now.
  Renderer again;
  again.upload(*mesh);
  if (again.vertices != renderer.vertices || again.triangles != renderer.triangles)
    return fail({arete::ErrorCode::brokenPromise, "the buffers differ from the mesh", "own_renderer"});

  const arete::Vec3 eye{view.eye.x - mesh->origin().x, view.eye.y - mesh->origin().y,
                        view.eye.z - mesh->origin().z};
  const std::vector<unsigned char> picture = renderer.draw(view, eye, model->isFlipped() ? -1 : 1);
  std::ofstream out(argv[3], std::ios::binary);
  out << "P5\n" << Renderer::kWidth << " " << Renderer::kHeight << "\n255\n";
  out.write(reinterpret_cast<const char*>(picture.data()), static_cast<std::streamsize>(picture.size()));
  if (!out.flush()) return fail({arete::ErrorCode::unreadable, "the picture could not be written", argv[3]});
}
