#include "evolve/files/printable.h"

#include <gtest/gtest.h>

namespace metamorph::evolve {
namespace {

TEST(Printable, LeavesTextAsItIs) {
  for (const std::string text :
       {"", "a b.json", "\u00e9\u20ac\U0001F600", "\u00a0", "\U0010ffff"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, EscapesControls) {
  EXPECT_EQ(printable("a\nb\t\x1b[31m\x7f"), "a\\x0ab\\x09\\x1b[31m\\x7f");
  EXPECT_EQ(printable("\u0085\u009b"), "\\xc2\\x85\\xc2\\x9b");
}

// What is no character of UTF-8: ends early, starts in the middle, is longer than need be, half of
// a pair of UTF-16, or beyond the last code.
TEST(Printable, EscapesOtherBytes) {
  EXPECT_EQ(printable("b\xff.json"), "b\\xff.json");
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");
  EXPECT_EQ(printable("\x82 x"), "\\x82 x");
  EXPECT_EQ(printable("\xc0\xaf\xe0\x80\xaf"), "\\xc0\\xaf\\xe0\\x80\\xaf");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
}

}  // namespace
}  // namespace metamorph::evolve
