// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/text/address_text.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

TEST(AddressText, LosesQueriesPasswordsAndFragments) {
  struct Case {
    const char* text;
    const char* shown;
  };
  for (const Case& c : {
           Case{"https://h/a.tif?X-Amz-Signature=5&X-Amz-Credential=AKIA%2F20", "https://h/a.tif"},
           Case{"https://h/a.tif?sv=2022&sig=a%2Bb%3D", "https://h/a.tif"},
           Case{"HTTPS://h/a.tif?token=x", "HTTPS://h/a.tif"},
           Case{"http://h:8080/p/a.tif#page?x=1", "http://h:8080/p/a.tif"},
           Case{"https://user:secret@h/a.tif", "https://h/a.tif"},
           Case{"https://user:se@cret@h/a@b.tif?k=v", "https://h/a@b.tif"},
           Case{"ftp://user:secret@h/a.tif", "ftp://h/a.tif"},
           Case{"https://h?key=1", "https://h"},
           Case{"https://h/a.tif?", "https://h/a.tif"},
           Case{"/vsicurl/https://h/a.tif?sig=1", "/vsicurl/https://h/a.tif"},
           Case{"/vsizip//vsicurl/https://h/a.zip?sig=1/in.tif", "/vsizip//vsicurl/https://h/a.zip"},
           Case{"/vsizip/{/vsicurl/https://h/a.zip?sig=1}/in.tif",
                "/vsizip/{/vsicurl/https://h/a.zip}/in.tif"},
           Case{"/vsicurl?max_retry=2&url=https%3A%2F%2Fh%2Fa.tif%3Fsig%3D1&use_head=no",
                "/vsicurl/https://h/a.tif"},
           Case{"/vsicurl?secret=1", "/vsicurl/"},
           Case{"https://h/a.tif?a=https://other/b?c=d", "https://h/a.tif"},
           Case{"a file.tif", "a file.tif"},
           Case{"what? no address: a?b=c", "what? no address: a?b=c"},
           Case{"/data/odd?name.tif", "/data/odd?name.tif"},
           Case{"s3 bucket/a.tif?x", "s3 bucket/a.tif?x"},
           Case{"", ""},
       }) {
    EXPECT_EQ(withoutQueries(c.text), c.shown);
    EXPECT_EQ(nameWithoutQuery(c.text), c.shown) << "as a name";
  }
}

TEST(AddressText, LeavesTheSentenceAroundAnAddress) {
  EXPECT_EQ(withoutQueries("arete: https://h/a.tif?sig=1: cannot be read: https://h/b?t=2 answers 404."),
            "arete: https://h/a.tif: cannot be read: https://h/b answers 404.");
  EXPECT_EQ(withoutQueries("'https://h/a?sig=1' and \"https://u:p@h/b\", (https://h/c?d)!"),
            "'https://h/a' and \"https://h/b\", (https://h/c)!");
  EXPECT_EQ(withoutQueries("is it https://h/a?"), "is it https://h/a");
}

TEST(AddressText, OfANameEndsNowhereElse) {
  EXPECT_EQ(nameWithoutQuery("https://h/a.tif?filter='x y'&key=secret"), "https://h/a.tif");
  EXPECT_EQ(nameWithoutQuery("https://h/with blanks.tif?sig=1"), "https://h/with blanks.tif");
}

}  // namespace
}  // namespace arete
