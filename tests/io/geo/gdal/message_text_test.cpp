// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/gdal/message_text.h"

#include <cpl_error.h>
#include <gtest/gtest.h>

#include "io/geo/gdal/support.h"
#include "sentences_of.h"

namespace arete {
namespace {

TEST(GdalMessage, LosesWhatDiffersFromRunToRunAndWhatIsSecret) {
  struct Case {
    const char* said;
    const char* shown;
  };
  for (const Case& c : {
           Case{"VSIFReadL(0x55620f8539e0,6*4) @ 20525 failed in HFAEntry().\nSuccess",
                "VSIFReadL(6*4) @ 20525 failed in HFAEntry()"},
           Case{"/vsimem/gpkg_read_tile_0x2cf50dd0, band 1: IReadBlock failed",
                "/vsimem/gpkg_read_tile, band 1: IReadBlock failed"},
           Case{"block 0x7ffd5c3a1b2c is bad", "block  is bad"},
           Case{"(0x55d0c0ffee00, 0x55d0c0ffee10)", "()"},
           Case{"colour 0xFF00FF and flags 0x1F stay", "colour 0xFF00FF and flags 0x1F stay"},
           Case{"one\r\ntwo\tthree...", "one  two three"},
           Case{"https://h/a?sig=secret: HTTP error code : 403", "https://h/a: HTTP error code : 403"},
           Case{"Success", "Success"},
           Case{"0x", "0x"},
           Case{"", ""},
       })
    EXPECT_EQ(gdalMessageText(c.said), c.shown);
  EXPECT_EQ(gdalMessageText(nullptr), "");
}

TEST(GdalErrors, MoveEachMessageOnceToTheWarnings) {
  GdalErrors errors;
  Warnings warnings = {{WarningCode::library, "GDAL: old"}};
  for (const char* said : {"old", "one", "two", "one", "read 0x55620f8539e0", "read 0x55620f8539f0"})
    CPLError(CE_Warning, CPLE_AppDefined, "%s", said);
  errors.moveTo(warnings);
  EXPECT_EQ(test::sentencesOf(warnings),
            (std::vector<std::string>{"GDAL: old", "GDAL: one", "GDAL: two", "GDAL: read"}));
  EXPECT_FALSE(errors.anyFailure());
  CPLError(CE_Failure, CPLE_AppDefined, "another");
  EXPECT_EQ(errors.firstFileFailure(), "");
  CPLError(CE_Failure, CPLE_FileIO, "cut");
  EXPECT_EQ(errors.firstFileFailure(), "cut");
  EXPECT_EQ(errors.firstFailure(), "another");
}

}  // namespace
}  // namespace arete
