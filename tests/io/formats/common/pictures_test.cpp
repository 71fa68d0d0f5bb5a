// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/pictures.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "io/mesh_file_fixture.h"
#include "sentences_of.h"

namespace arete {
namespace {

using namespace test;

const std::string kPng = "\x89PNG\r\n\x1A\n rest", kJpeg = "\xFF\xD8\xFF rest", kOther = "other bytes";

std::vector<std::byte> bytesOf(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}
std::string textOf(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class Pictures : public MeshFileTest {
 protected:
  void SetUp() override {
    MeshFileTest::SetUp();
    fs::create_directories(in() / "maps");
    fs::create_directories(out());
  }
  fs::path in() const { return folder_ / "in"; }
  fs::path out() const { return folder_ / "out"; }

  std::string pathOf(const std::string& picture) const {
    const Result<PictureBytes> read = PictureSource(mesh_, in()).read(picture);
    return read ? read->path : read.error().message;
  }

  MeshAttributes mesh_;
};

TEST_F(Pictures, AreFoundByWhateverPathAMaterialHas) {
  put("in/wood.png", kPng);
  put("in/maps/Bark Of Oak.JPG", kJpeg);
  struct Case {
    const char *picture, *path;
  };
  for (const Case& c : {Case{"wood.png", "wood.png"}, Case{"./wood.png", "wood.png"},
                        Case{"maps/Bark Of Oak.JPG", "maps/Bark Of Oak.JPG"},
                        Case{"maps\\bark of oak.jpg", "maps/Bark Of Oak.JPG"},
                        Case{"MAPS//./bark of OAK.jpg", "maps/Bark Of Oak.JPG"},
                        Case{"maps/../wood.png", "wood.png"}, Case{"C:\\Users\\me\\Wood.png", "wood.png"},
                        Case{"/home/me/wood.png", "wood.png"}, Case{"../../other/wood.png", "wood.png"}})
    EXPECT_EQ(pathOf(c.picture), c.path) << c.picture;
  const Result<PictureBytes> read = PictureSource(mesh_, in()).read("maps\\bark of oak.jpg");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->name, "Bark Of Oak.JPG");
  EXPECT_EQ(read->mimeType, "image/jpeg");
  EXPECT_EQ(textOf(read->bytes), kJpeg);
}

TEST_F(Pictures, AreNeverReadFromElsewhere) {
  put("secret.png", kPng);
  fs::create_symlink(folder_ / "secret.png", in() / "link.png");
  fs::create_directory_symlink(folder_, in() / "up");
  fs::create_directories(in() / "folder.png");
  ASSERT_EQ(::mkfifo((in() / "pipe.png").c_str(), 0600), 0);
  for (const char* picture :
       {"../secret.png", "maps/../../secret.png", "link.png", "up/secret.png", "folder.png", "pipe.png",
        "missing.png", "", ".", "..", "maps/", "http://host/a.png", "file:///etc/passwd", "data:,x",
        "/dev/zero", "#0", "#", "#-1", "#99999999999999999999"}) {
    const Result<PictureBytes> read = PictureSource(mesh_, in()).read(picture);
    ASSERT_FALSE(read) << picture;
    EXPECT_EQ(read.error().culprit, picture);
  }
  EXPECT_FALSE(PictureSource(mesh_, "").read("wood.png"));
  // A link that stays below is a file like any other.
  put("in/wood.png", kPng);
  fs::create_symlink("../wood.png", in() / "maps" / "wood.png");
  EXPECT_EQ(pathOf("maps/wood.png"), "maps/wood.png");
}

TEST_F(Pictures, InsideTheMeshGetNamesThatFilesCanHave) {
  mesh_.pictures = {{"Wood", "image/png", bytesOf(kPng)},       {"wood.png", "", bytesOf(kPng)},
                    {"", "image/jpeg", bytesOf(kOther)},        {"../.a:b\n.jpg", "", bytesOf(kJpeg)},
                    {"dir/Wood 1.5", "image/x", bytesOf(kPng)}, {"wrong.png", "image/png", bytesOf(kJpeg)}};
  const std::vector<std::array<std::string, 2>> expected = {
      {"Wood.png", "image/png"},  {"wood-1.png", "image/png"},   {"picture.jpg", "image/jpeg"},
      {"a_b_.jpg", "image/jpeg"}, {"Wood 1.5.png", "image/png"}, {"wrong.png.jpg", "image/jpeg"}};
  const PictureSource source(mesh_, "");
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Result<PictureBytes> read = source.read("#" + std::to_string(i));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->name, expected[i][0]);
    EXPECT_EQ(read->mimeType, expected[i][1]);
    EXPECT_EQ(read->bytes, mesh_.pictures[i].bytes);
  }
}

TEST_F(Pictures, ArePlacedBelowTheNewMeshAsTheyWereBelowTheOld) {
  put("in/wood.png", kPng);
  put("in/maps/oak.jpg", kJpeg);
  mesh_.pictures = {{"inside", "image/png", bytesOf(kPng + "2")}};
  const PictureSource source(mesh_, in());
  PicturePlacer placer(source, out() / "a.obj");
  EXPECT_EQ(placer.place("wood.png").value(), "wood.png");
  EXPECT_EQ(placer.place("maps\\OAK.jpg").value(), "maps/oak.jpg");
  EXPECT_EQ(placer.place("#0").value(), "inside.png");
  EXPECT_EQ(placer.place("wood.png").value(), "wood.png");
  EXPECT_EQ(contents(out() / "wood.png"), kPng);
  EXPECT_EQ(contents(out() / "maps/oak.jpg"), kJpeg);
  EXPECT_EQ(contents(out() / "inside.png"), kPng + "2");
  EXPECT_EQ(placer.files().size(), 3u);
  EXPECT_TRUE(placer.warnings().empty());
}

TEST_F(Pictures, OfAnotherModelAreNeverOverwritten) {
  put("in/wood.png", kPng);
  put("out/wood.png", kOther);
  put("out/wood-1.png", kOther + "1");
  fs::create_symlink(folder_ / "nothing.png", out() / "wood-2.png");
  for (int run = 0; run < 2; ++run) {  // the second one finds its own
    const PictureSource source(mesh_, in());
    PicturePlacer placer(source, out() / "a.obj");
    EXPECT_EQ(placer.place("wood.png").value(), "wood-3.png");
    EXPECT_EQ(placer.files(), std::vector<fs::path>{out() / "wood-3.png"});
  }
  EXPECT_EQ(contents(out() / "wood.png"), kOther);
  EXPECT_EQ(contents(out() / "wood-1.png"), kOther + "1");
  EXPECT_FALSE(fs::exists(folder_ / "nothing.png"));
}

TEST_F(Pictures, StayWhereTheyAreIfTheMeshIsWrittenBesideItsSource) {
  put("in/maps/Oak.JPG", kJpeg);
  put("in/.hidden.png", kPng);
  const PictureSource source(mesh_, in());
  PicturePlacer placer(source, in() / "b.ply");
  EXPECT_EQ(placer.place("maps/oak.jpg").value(), "maps/Oak.JPG");
  EXPECT_EQ(placer.place(".hidden.png").value(), ".hidden.png");
  EXPECT_EQ(placer.files().size(), 2u);
  EXPECT_EQ(std::distance(fs::recursive_directory_iterator(in()), {}), 3);
}

TEST_F(Pictures, AreNeitherHiddenNorTheMeshItself) {
  put("in/.profile", kPng);
  put("in/a.obj", kPng);
  put("out/a.obj", kPng);
  const PictureSource source(mesh_, in());
  PicturePlacer placer(source, out() / "A.OBJ");
  EXPECT_EQ(placer.place(".profile").value(), "profile");
  EXPECT_EQ(placer.place("a.obj").value(), "a-1.obj");
}

TEST_F(Pictures, ThatDifferInCaseAloneGetNamesThatDifferMore) {
  put("in/wood.png", kPng);
  mesh_.pictures = {{"WOOD.png", "image/png", bytesOf(kPng + "2")}};
  const PictureSource source(mesh_, in());
  PicturePlacer placer(source, out() / "a.obj");
  EXPECT_EQ(placer.place("wood.png").value(), "wood.png");
  EXPECT_EQ(placer.place("#0").value(), "WOOD-1.png");
}

TEST_F(Pictures, ThatCannotBeReadKeepTheirNameWithAWarning) {
  mesh_.pictures = {{"inside", "image/png", bytesOf(kPng)}};
  const PictureSource source(mesh_, in());
  PicturePlacer placer(source, out() / "a.obj");
  EXPECT_EQ(placer.place("maps\\none.png").value(), "maps\\none.png");
  EXPECT_EQ(placer.place("maps\\none.png").value(), "maps\\none.png");
  EXPECT_EQ(placer.place("#7").value(), "");
  EXPECT_EQ(test::sentencesOf(placer.warnings()),
            (std::vector<std::string>{"the picture \"maps\\none.png\", which does not exist",
                                      "the picture \"#7\", which is no picture of the mesh"}));
  PicturePlacer pipe(source, "/dev/null");
  EXPECT_EQ(pipe.place("#0").value(), "");
  EXPECT_EQ(pipe.warnings().size(), 1u);
  EXPECT_TRUE(pipe.files().empty());
}

}  // namespace
}  // namespace arete
