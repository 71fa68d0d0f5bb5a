// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/network/network_address.h"

#include <cpl_conv.h>
#include <gtest/gtest.h>

namespace arete {
namespace {

TEST(NetworkAddress, IsTheNameOrBehindOptions) {
  EXPECT_EQ(networkAddress("http://h/a.tif?url=b&x=1")->url, "http://h/a.tif?url=b&x=1");
  const auto address = networkAddress(
      "?max_retry=7&retry_delay=0.5&use_head=no&list_dir=no&empty_dir=yes&pc_url_signing=no&Referer=a%26b"
      "&url=http%3A%2F%2Fh%2Fa.tif%3Fsig%3D1%26x");
  ASSERT_TRUE(address) << address.error().describe();
  EXPECT_EQ(address->url, "http://h/a.tif?sig=1&x");
  EXPECT_EQ(address->rules.retries, 7);
  EXPECT_EQ(address->rules.firstDelay, 0.5);
  ASSERT_EQ(address->options.size(), 1u);
  EXPECT_EQ(address->options[0], (std::pair<std::string, std::string>("REFERER", "a&b")));
}

TEST(NetworkAddress, TakesItsRulesFromTheOptionsOfGdal) {
  CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", "2");
  CPLSetConfigOption("GDAL_HTTP_RETRY_DELAY", "3");
  const auto address = networkAddress("http://h/a");
  CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", nullptr);
  CPLSetConfigOption("GDAL_HTTP_RETRY_DELAY", nullptr);
  EXPECT_EQ(address->rules.retries, 2);
  EXPECT_EQ(address->rules.firstDelay, 3);
}

TEST(NetworkAddress, NeedsAnAddressAndKnownOptions) {
  for (const char* name : {"?", "?max_retry=2", "?url=", "?pc_url_signing=yes&url=http%3A%2F%2Fh",
                           "?signed=1&url=http%3A%2F%2Fh"})
    EXPECT_FALSE(networkAddress(name)) << name;
}

}  // namespace
}  // namespace arete
