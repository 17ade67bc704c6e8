#include "evolve/files/input_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;

TEST(InputError, TellsEveryFaultInALineOfItsOwn) {
  FaultList faults("body.json");
  EXPECT_TRUE(faults.empty());
  EXPECT_NO_THROW(faults.throw_if_any());
  faults.add("period[3]", "-1", "a number > 0");
  faults.add("phase", "missing", "an array of numbers");
  faults.add("", "", "one object");
  try {
    faults.throw_if_any();
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.lines(),
                ElementsAre("body.json: period[3]: -1: expected a number > 0",
                            "body.json: phase: missing: expected an array of numbers",
                            "body.json: expected one object"));
    EXPECT_STREQ(error.what(),
                 "body.json: period[3]: -1: expected a number > 0\n"
                 "body.json: phase: missing: expected an array of numbers\n"
                 "body.json: expected one object");
  }
}

TEST(InputError, LongValuesAreCutBetweenCharactersAndStayOnOneLine) {
  FaultList faults("f");
  faults.add("key", std::string(59, 'a') + "\u00e4bc", "less");
  faults.add("key", "two\nlines\t", "one");
  EXPECT_THAT(faults.lines(), ElementsAre("f: key: " + std::string(59, 'a') + "...: expected less",
                                          "f: key: two?lines?: expected one"));
}

}  // namespace
}  // namespace metamorph::evolve
