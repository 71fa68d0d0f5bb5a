// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/geopackage/geopackage.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <atomic>
#include <fstream>
#include <iterator>

#include "io/io_fixture.h"

namespace arete {
namespace {

using test::TemporaryFolder;

std::string bytesOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// One point with a text, a whole number and a real one.
Status fillOne(GDALDataset& dataset, const GdalErrors& errors, const std::string& crs = "EPSG:32611") {
  const auto layer = addLayer(dataset, "a", crs, wkbPoint, errors);
  if (!layer) return tl::unexpected(layer.error());
  PointAttributes values;
  values.columns = {{"t", PointAttributes::Kind::text},
                    {"i", PointAttributes::Kind::integer},
                    {"r", PointAttributes::Kind::real},
                    {"empty", PointAttributes::Kind::real}};
  for (const char* value : {"007", "-9007199254740993", "0.1", ""}) values.add(value);
  for (const auto& column : values.columns)
    if (!addField(**layer, column.name, column.kind)) return cannotBeWritten(errors);
  OGRFeature feature((*layer)->GetLayerDefn());
  int at = 0;
  setFields(feature, at, values, 0);
  EXPECT_EQ(at, 4);
  const OGRPoint point(1, 2);
  feature.SetGeometry(&point);
  if ((*layer)->CreateFeature(&feature) != OGRERR_NONE) return cannotBeWritten(errors);
  return {};
}

const OwnLayer kOurs{"a", {"t", "i"}};
constexpr ExistingFile kKeeps = ExistingFile::keepsOtherLayers;

Status writeOne(const std::string& path, ExistingFile existing = kKeeps, const RunContext& context = {}) {
  const auto fill = [](GDALDataset& dataset, GdalErrors& errors) { return fillOne(dataset, errors); };
  return writeGeoPackage(path, existing, kOurs, fill, context);
}

/// SQLite without GDAL, as other programs use the file.
class Sqlite {
 public:
  explicit Sqlite(const std::string& path) {
    EXPECT_EQ(sqlite3_open_v2(path.c_str(), &database_, SQLITE_OPEN_READWRITE, nullptr), SQLITE_OK);
  }
  ~Sqlite() { sqlite3_close_v2(database_); }
  Sqlite(const Sqlite&) = delete;
  Sqlite& operator=(const Sqlite&) = delete;

  void run(const char* statements) {
    char* error = nullptr;
    EXPECT_EQ(sqlite3_exec(database_, statements, nullptr, nullptr, &error), SQLITE_OK)
        << statements << error;
  }
  /// All values of all rows, with bars between.
  std::string ask(const char* query) {
    sqlite3_stmt* statement = nullptr;
    EXPECT_EQ(sqlite3_prepare_v2(database_, query, -1, &statement, nullptr), SQLITE_OK) << query;
    std::string text;
    while (sqlite3_step(statement) == SQLITE_ROW)
      for (int i = 0; i < sqlite3_column_count(statement); ++i) {
        const auto* value = sqlite3_column_text(statement, i);
        text += (value ? reinterpret_cast<const char*>(value) : "NULL") + std::string("|");
      }
    sqlite3_finalize(statement);
    return text;
  }

 private:
  sqlite3* database_ = nullptr;
};

/// What a project of others holds: a table of features, its style, metadata, a trigger, a view, and a table
/// that refers to our rows.
constexpr const char* kOthers =
    "CREATE TABLE huts (fid INTEGER PRIMARY KEY, geom POINT, name TEXT);"
    "INSERT INTO gpkg_contents (table_name, data_type, identifier, srs_id) VALUES "
    "('huts','features','huts',4326);"
    "INSERT INTO gpkg_geometry_columns VALUES ('huts','geom','POINT',4326,0,0);"
    "INSERT INTO huts (name) VALUES ('a'), ('b');"
    "CREATE TABLE layer_styles (id INTEGER PRIMARY KEY, f_table_name TEXT, styleQML TEXT);"
    "INSERT INTO layer_styles (f_table_name, styleQML) VALUES ('huts','<x/>'), ('a','<ours/>');"
    "CREATE TABLE log (what TEXT);"
    "CREATE TRIGGER watch AFTER UPDATE ON huts BEGIN INSERT INTO log VALUES (new.name); END;"
    "CREATE TABLE notes (a_fid INTEGER REFERENCES a(fid) ON DELETE CASCADE, note TEXT);"
    "INSERT INTO notes VALUES (1, 'on ours');"
    "CREATE VIEW names AS SELECT name FROM huts;"
    "CREATE TABLE gpkg_metadata (id INTEGER PRIMARY KEY, md_scope TEXT, md_standard_uri TEXT, mime_type "
    "TEXT, "
    "metadata TEXT);"
    "INSERT INTO gpkg_metadata VALUES (1, 'dataset', 'http://x', 'text/xml', '<m/>');"
    "PRAGMA user_version = 10301;";

/// What kOthers put there.
std::string othersOf(const std::string& path) {
  Sqlite database(path);
  std::string all;
  for (const char* query :
       {"SELECT * FROM huts", "SELECT * FROM layer_styles",
        "SELECT sql FROM sqlite_master WHERE name = 'watch'", "SELECT * FROM notes", "SELECT * FROM names",
        "SELECT * FROM gpkg_metadata WHERE id = 1", "SELECT * FROM log",
        "SELECT table_name, srs_id FROM gpkg_contents WHERE table_name = 'huts'",
        "SELECT * FROM gpkg_geometry_columns WHERE table_name = 'huts'", "PRAGMA user_version",
        "PRAGMA application_id"})
    all += database.ask(query) + "\n";
  return all;
}

TEST(GeoPackage, KeepsWhatOthersPutIntoIt) {
  const TemporaryFolder folder;
  const std::string path = folder.file("project.gpkg");
  ASSERT_TRUE(writeOne(path));
  Sqlite(path).run(kOthers);
  const std::string before = othersOf(path);
  for (int times = 0; times < 2; ++times) {
    const Status written = writeOne(path);
    ASSERT_TRUE(written) << written.error().describe();
    EXPECT_EQ(othersOf(path), before);
    EXPECT_EQ(Sqlite(path).ask("SELECT count(*), max(t) FROM a"), "1|007|")
        << "ours is replaced, not doubled";
    EXPECT_EQ(Sqlite(path).ask("PRAGMA integrity_check"), "ok|");
  }
  Sqlite(path).run("UPDATE huts SET name = 'c' WHERE fid = 1");
  EXPECT_EQ(Sqlite(path).ask("SELECT what FROM log"), "c|") << "the trigger lives";
  ASSERT_TRUE(writeOne(path, ExistingFile::isReplaced));
  EXPECT_EQ(Sqlite(path).ask("SELECT table_name FROM gpkg_contents"), "a|");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(GeoPackage, RefusesWhatItWouldDestroyAndLeavesItAsItWas) {
  const TemporaryFolder folder;
  const std::string path = folder.file("project.gpkg");
  ASSERT_TRUE(writeOne(path));
  Sqlite(path).run("ALTER TABLE a RENAME COLUMN t TO other");
  const std::string before = bytesOf(path);
  EXPECT_EQ(writeOne(path).error().code, ErrorCode::invalidData) << "a layer of that name is somebody else's";
  EXPECT_TRUE(bytesOf(path) == before);
  for (const char* content : {"not a database", "SQLite format 3"}) {
    const std::string other = folder.write("other.gpkg", content);
    EXPECT_EQ(writeOne(other).error().code, ErrorCode::invalidData) << content;
    EXPECT_EQ(bytesOf(other), content);
    EXPECT_TRUE(writeOne(other, ExistingFile::isReplaced)) << content;
  }
  EXPECT_TRUE(writeOne(folder.write("empty.gpkg", ""))) << "as mktemp makes it";
  EXPECT_EQ(folder.count(), 3u);
}

TEST(GeoPackage, IsWholeAfterAnInterruption) {
  const TemporaryFolder folder;
  const std::string path = folder.file("project.gpkg");
  ASSERT_TRUE(writeOne(path));
  Sqlite(path).run(kOthers);
  const std::string before = bytesOf(path);
  std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  EXPECT_EQ(writeOne(path, kKeeps, context).error().code, ErrorCode::interrupted);
  const auto fails = [](GDALDataset& dataset, GdalErrors& errors) -> Status {
    if (Status filled = fillOne(dataset, errors); !filled) return filled;
    return failure(ErrorCode::interrupted, "stopped");
  };
  EXPECT_EQ(writeGeoPackage(path, kKeeps, kOurs, fails, {}).error().code, ErrorCode::interrupted);
  EXPECT_TRUE(bytesOf(path) == before);
  EXPECT_EQ(folder.count(), 1u);
}

TEST(GeoPackage, WaitsForNobodyWhoHoldsIt) {
  const TemporaryFolder folder;
  const std::string path = folder.file("project.gpkg");
  ASSERT_TRUE(writeOne(path));
  {
    Sqlite writer(path);
    writer.run("BEGIN IMMEDIATE");
    EXPECT_EQ(writeOne(path).error().code, ErrorCode::unreadable);
  }
  {
    // As QGIS keeps it open: rows that are in the log only would be lost.
    Sqlite open(path);
    open.run("PRAGMA journal_mode=WAL; CREATE TABLE mine (x); INSERT INTO mine VALUES (7);");
    EXPECT_EQ(writeOne(path).error().code, ErrorCode::unreadable);
    EXPECT_EQ(open.ask("SELECT x FROM mine"), "7|");
  }
  const Status written = writeOne(path);
  ASSERT_TRUE(written) << written.error().describe();
  EXPECT_EQ(Sqlite(path).ask("SELECT x FROM mine"), "7|");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(GeoPackage, KeepsEveryValueAndLeavesEmptyOnesUnset) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.gpkg");
  const Status written = writeOne(path);
  ASSERT_TRUE(written) << written.error().describe();
  const GdalDatasetPtr dataset = openGdal(path, GDAL_OF_VECTOR);
  ASSERT_NE(dataset, nullptr);
  OGRLayer& layer = *dataset->GetLayer(0);
  const OGRFeatureUniquePtr feature(layer.GetNextFeature());
  ASSERT_NE(feature, nullptr);
  EXPECT_STREQ(feature->GetFieldAsString("t"), "007");
  EXPECT_EQ(feature->GetFieldAsInteger64("i"), -9007199254740993) << "beyond the whole numbers of a double";
  EXPECT_EQ(feature->GetFieldAsDouble("r"), 0.1);
  EXPECT_FALSE(feature->IsFieldSetAndNotNull(feature->GetFieldIndex("empty")));
  EXPECT_NE(layer.GetSpatialRef(), nullptr);
}

TEST(GeoPackage, IsTheSameBytesOnAnyDay) {
  const TemporaryFolder folder;
  std::string first;
  for (const char* name : {"a.gpkg", "b.gpkg"}) {
    ASSERT_TRUE(writeOne(folder.file(name)));
    if (first.empty()) first = bytesOf(folder.file(name));
    EXPECT_TRUE(bytesOf(folder.file(name)) == first);
  }
  EXPECT_NE(first.find("1970-01-01T00:00:00"), std::string::npos);
  EXPECT_EQ(folder.count(), 2u) << "no journal stays";
}

TEST(GeoPackage, IsNotThereIfItCouldNotBeFilled) {
  const TemporaryFolder folder;
  const auto fails = [](GDALDataset&, GdalErrors&) -> Status {
    return failure(ErrorCode::interrupted, "stopped");
  };
  EXPECT_EQ(writeGeoPackage(folder.file("a.gpkg"), kKeeps, kOurs, fails, {}).error().code,
            ErrorCode::interrupted);
  const auto nonsense = [](GDALDataset& dataset, GdalErrors& errors) {
    return fillOne(dataset, errors, "gibberish");
  };
  EXPECT_EQ(writeGeoPackage(folder.file("a.gpkg"), kKeeps, kOurs, nonsense, {}).error().code,
            ErrorCode::invalidData);
  EXPECT_EQ(writeGeoPackage(folder.file("no/a.gpkg"), kKeeps, kOurs, fails, {}).error().code,
            ErrorCode::notFound);
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace arete
