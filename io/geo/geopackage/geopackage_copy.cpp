// SPDX-License-Identifier: GPL-3.0-or-later
//
// One connection begins an immediate transaction, which keeps others from writing, and rolls back what a
// killed program has left in a journal. A second one is the source of SQLite's backup, which may not be in a
// transaction of its own. A file with a write-ahead log is set to a rollback journal first: this empties the
// log, and fails as long as another program has the file open, whose next changes would go to a log that is
// no longer the file's.
#include "io/geo/geopackage/geopackage_copy.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr int kWaitMilliseconds = 2000, kPagesAtOnce = 2048;

struct Closer {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
using Database = std::unique_ptr<sqlite3, Closer>;

Database openDatabase(const fs::path& path, int flags) {
  sqlite3* database = nullptr;
  sqlite3_open_v2(path.c_str(), &database, flags, nullptr);
  if (database) sqlite3_busy_timeout(database, kWaitMilliseconds);
  return Database(database);
}

/// The texts of the first column; ?1 stands for the name of the layer.
std::vector<std::string> textsOf(sqlite3* database, const std::string& query, const std::string& layer = {}) {
  sqlite3_stmt* statement = nullptr;
  std::vector<std::string> texts;
  if (sqlite3_prepare_v2(database, query.c_str(), -1, &statement, nullptr) == SQLITE_OK) {
    if (!layer.empty()) sqlite3_bind_text(statement, 1, layer.c_str(), -1, SQLITE_TRANSIENT);
    while (sqlite3_step(statement) == SQLITE_ROW) {
      const auto* text = sqlite3_column_text(statement, 0);
      texts.emplace_back(text ? reinterpret_cast<const char*>(text) : "");
    }
  }
  sqlite3_finalize(statement);
  return texts;
}

/// Empty where there is none.
std::string firstText(sqlite3* database, const char* query) {
  const std::vector<std::string> texts = textsOf(database, query);
  return texts.empty() ? std::string() : texts.front();
}

/// Whether a GeoPackage holds anything but the layer and what belongs to it.
bool holdsOthers(sqlite3* database, const std::string& layer) {
  const std::string ofLayer =
      " name NOT LIKE 'gpkg!_%' ESCAPE '!' AND name NOT LIKE 'sqlite!_%' ESCAPE '!' AND lower(name) <> "
      "lower(?1) AND "
      "lower(substr(name, 1, length(?1) + 7)) <> lower('rtree_' || ?1 || '_') AND lower(name) NOT IN "
      "(lower('trigger_insert_feature_count_' || ?1), lower('trigger_delete_feature_count_' || ?1))";
  if (!textsOf(database, "SELECT name FROM sqlite_master WHERE" + ofLayer, layer).empty()) return true;
  if (!textsOf(database, "SELECT table_name FROM gpkg_contents WHERE lower(table_name) <> lower(?1)", layer)
           .empty())
    return true;
  if (!textsOf(database,
               "SELECT id FROM gpkg_metadata WHERE id NOT IN (SELECT md_file_id FROM gpkg_metadata_reference "
               "WHERE lower(table_name) = lower(?1))",
               layer)
           .empty())
    return true;
  return !textsOf(database,
                  "SELECT reference_scope FROM gpkg_metadata_reference WHERE table_name IS NULL OR "
                  "lower(table_name) "
                  "<> lower(?1)",
                  layer)
              .empty();
}

tl::unexpected<Error> failureOf(sqlite3* database, const fs::path& path) {
  const int code = database ? sqlite3_errcode(database) & 0xFF : SQLITE_NOMEM;
  const std::string name = path.filename().string();
  if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT)
    return failure(ErrorCode::invalidData, "exists and is not a GeoPackage that could be added to",
                   path.string());
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED)
    return failure(ErrorCode::unreadable, "is being written to by another program", path.string());
  return failure(ErrorCode::unreadable,
                 fmt::format("cannot be added to: {}", database ? sqlite3_errmsg(database) : "no memory"),
                 path.string());
}

Status copyPages(sqlite3* from, sqlite3* to, const fs::path& original, const fs::path& copy,
                 const RunContext& context) {
  sqlite3_exec(to, "PRAGMA synchronous=OFF; PRAGMA journal_mode=OFF", nullptr, nullptr, nullptr);
  sqlite3_backup* backup = sqlite3_backup_init(to, "main", from, "main");
  if (!backup) return failureOf(to, copy);
  int code = SQLITE_OK;
  while (code == SQLITE_OK && !context.cancelled()) code = sqlite3_backup_step(backup, kPagesAtOnce);
  sqlite3_backup_finish(backup);
  if (code == SQLITE_DONE) return {};
  if (code == SQLITE_OK) return failure(ErrorCode::interrupted, "writing was interrupted");
  return code == SQLITE_BUSY || code == SQLITE_LOCKED ? failureOf(from, original) : failureOf(to, copy);
}

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

/// Whether there is a table of the layer's name.
bool hasTable(sqlite3* database, const OwnLayer& layer) {
  return !textsOf(database, "SELECT name FROM sqlite_master WHERE lower(name) = lower(?1)", layer.name)
              .empty();
}

/// Whether the table of the layer's name is an older answer of the same kind: one of features with these
/// fields.
bool isOlder(sqlite3* database, const OwnLayer& layer) {
  const std::vector<std::string> columns =
      textsOf(database, "SELECT name FROM pragma_table_info(?1)", layer.name);
  const std::vector<std::string> kinds = textsOf(
      database, "SELECT data_type FROM gpkg_contents WHERE lower(table_name) = lower(?1)", layer.name);
  return kinds == std::vector<std::string>{"features"} &&
         std::ranges::all_of(layer.fields, [&](const auto& field) {
           return std::ranges::find(columns, field) != columns.end();
         });
}

/// Removes the table of the layer, its index, and what the tables of the format say of it.
Status removeTable(sqlite3* database, const OwnLayer& layer, const fs::path& copy) {
  const auto run = [&](const std::string& statement) {
    return sqlite3_exec(database, statement.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
  };
  bool isRemoved = run("PRAGMA foreign_keys=OFF") && run("BEGIN");
  for (const std::string& index : textsOf(database,
                                          "SELECT name FROM sqlite_master WHERE lower(substr(name, 1, "
                                          "length(?1) + 7)) = lower('rtree_' || ?1 || "
                                          "'_') AND sql LIKE 'CREATE VIRTUAL TABLE%'",
                                          layer.name))
    isRemoved = isRemoved && run("DROP TABLE " + quoted(index));
  isRemoved = isRemoved && run("DROP TABLE " + quoted(layer.name));
  const std::string ofLayer =
      "SELECT md_file_id FROM gpkg_metadata_reference WHERE lower(table_name) = lower(?1)";
  for (const std::string& id : textsOf(database, ofLayer, layer.name))
    isRemoved = isRemoved && run("DELETE FROM gpkg_metadata WHERE id = " + id);
  for (const char* table : {"gpkg_extensions", "gpkg_ogr_contents", "gpkg_geometry_columns",
                            "gpkg_metadata_reference", "gpkg_contents"}) {
    if (textsOf(database, "SELECT name FROM sqlite_master WHERE name = ?1", table).empty()) continue;
    sqlite3_stmt* statement = nullptr;
    const std::string query = fmt::format("DELETE FROM {} WHERE lower(table_name) = lower(?1)", table);
    isRemoved =
        isRemoved && sqlite3_prepare_v2(database, query.c_str(), -1, &statement, nullptr) == SQLITE_OK;
    sqlite3_bind_text(statement, 1, layer.name.c_str(), -1, SQLITE_TRANSIENT);
    isRemoved = isRemoved && sqlite3_step(statement) == SQLITE_DONE;
    sqlite3_finalize(statement);
  }
  isRemoved = isRemoved && run("COMMIT");
  return isRemoved ? Status() : Status(failureOf(database, copy));
}

}  // namespace

struct GeoPackageCopy::Lock {
  Database database;
  ~Lock() { sqlite3_exec(database.get(), "ROLLBACK", nullptr, nullptr, nullptr); }
};

GeoPackageCopy::GeoPackageCopy(std::unique_ptr<Lock> lock) : lock_(std::move(lock)) {}
GeoPackageCopy::GeoPackageCopy(GeoPackageCopy&&) noexcept = default;
GeoPackageCopy& GeoPackageCopy::operator=(GeoPackageCopy&&) noexcept = default;
GeoPackageCopy::~GeoPackageCopy() = default;

Result<GeoPackageCopy> GeoPackageCopy::make(const fs::path& original, const fs::path& copy,
                                            const OwnLayer& layer, const RunContext& context) {
  auto lock = std::unique_ptr<Lock>(new Lock{openDatabase(original, SQLITE_OPEN_READWRITE)});
  sqlite3* const database = lock->database.get();
  const auto run = [&](const char* statement) {
    return database && sqlite3_exec(database, statement, nullptr, nullptr, nullptr) == SQLITE_OK;
  };
  if (!run("SELECT count(*) FROM sqlite_master")) return failureOf(database, original);
  if (firstText(database, "SELECT 1 FROM sqlite_master WHERE name = 'gpkg_contents'").empty())
    return failure(ErrorCode::invalidData, "exists and is not a GeoPackage that could be added to",
                   original.string());
  if (firstText(database, "PRAGMA journal_mode") == "wal" &&
      firstText(database, "PRAGMA journal_mode=DELETE") != "delete")
    return failure(ErrorCode::unreadable, "is open in another program; close it there, or name another file",
                   original.string());
  if (!run("BEGIN IMMEDIATE")) return failureOf(database, original);
  const bool hasOlder = hasTable(database, layer);
  if (hasOlder && !isOlder(database, layer))
    return failure(
        ErrorCode::invalidData,
        fmt::format("has a layer '{}' with other columns, which is not replaced; rename it, or name "
                    "another file",
                    layer.name),
        original.string());
  GeoPackageCopy result(std::move(lock));
  if (!holdsOthers(database, layer.name)) return result;
  const Database from = openDatabase(original, SQLITE_OPEN_READONLY),
                 to = openDatabase(copy, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  if (!from) return failureOf(nullptr, original);
  if (!to || sqlite3_errcode(to.get()) != SQLITE_OK) return failureOf(to.get(), copy);
  ARETE_CHECK(copyPages(from.get(), to.get(), original, copy, context));
  std::error_code ignored;
  fs::permissions(copy, fs::status(original, ignored).permissions(), ignored);
  if (hasOlder) ARETE_CHECK(removeTable(to.get(), layer, copy));
  result.isMade_ = true;
  return result;
}

}  // namespace arete
