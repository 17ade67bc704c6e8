#include "evolve/app/text.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/bodies.h"

namespace metamorph::evolve {
namespace {

core::Outcome failed(core::Status status, int index, double value) {
  core::Outcome outcome;
  outcome.status = status;
  outcome.failed_step = 48;
  outcome.failed_index = index;
  outcome.failed_value = value;
  return outcome;
}

TEST(FailureText, NamesWhatFailedAndWhere) {
  const core::Body body = tests::strip_body(6);
  const auto text = [&](core::Status status, int index, double value) {
    return failure_text(failed(status, index, value), body);
  };
  const auto names = [](const auto& nodes) {
    std::string list;
    for (const core::Index n : nodes) list += (list.empty() ? "[" : ", ") + std::to_string(n);
    return list + "]";
  };
  EXPECT_EQ(text(core::Status::crossed, 3, 5),
            "failed at step 48: node 5 crossed edge " + names(body.springs[3]));
  EXPECT_EQ(text(core::Status::collapsed, 2, 0.04321),
            "failed at step 48: triangle " + names(body.triangles[2]) +
                " squeezed to 0.0432 of its area at rest");
  EXPECT_EQ(text(core::Status::inverted, 0, -0.1),
            "failed at step 48: triangle " + names(body.triangles[0]) + " turned inside out");
  EXPECT_EQ(text(core::Status::inverted, -1, -0.1),
            "failed at step 48: a triangle turned inside out");
  EXPECT_EQ(text(core::Status::speed, 4, 7.5),
            "failed at step 48: node 4 moved at 7.5 d per time unit");
  EXPECT_EQ(text(core::Status::non_finite, 4, 0), "failed at step 48: node 4 is no number");
  EXPECT_EQ(text(core::Status::step_too_large, -1, 0.25), "the largest step allowed is 0.25");
  EXPECT_EQ(text(core::Status::step_too_large, 2, 0.25),
            "the largest step allowed is 0.25, a quarter of the period of node 2");
}

TEST(FailureText, SaysNothingWhereTheStatusDoes) {
  for (const core::Status status : core::all_statuses) {
    const bool detailed = status >= core::Status::step_too_large;
    EXPECT_EQ(!failure_text(failed(status, 0, 0), tests::strip_body(6)).empty(), detailed)
        << core::name(status);
  }
}

TEST(WorkText, TellsWorkOfMoreThanTenMinutes) {
  EXPECT_EQ(work_text(2e11, 8.4e12, 1), "2e+11 steps per body, about 3 h 30 min on 1 thread");
  EXPECT_EQ(work_text(2e11, 8.4e12, 2), "2e+11 steps per body, about 1 h 45 min on 2 threads");
  EXPECT_EQ(work_text(1.2e4, 3.9e11, 1), "");
  EXPECT_EQ(work_text(0, 0, 1), "");
}

}  // namespace
}  // namespace metamorph::evolve
