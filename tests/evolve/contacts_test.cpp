// What a body touches, as pictures show it.

#include "evolve/life/contacts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;

/// A square of two triangles beside a third one, of which the free corner is node 4.
///     3---2
///     | \ | \   (two triangles of the square, one beside it)
///     0---1-4     at rest node 4 lies 1 to the right of node 1
Motion motion_of(std::vector<double> x, std::vector<double> y) {
  Motion motion;
  motion.body.x = {0, 1, 1, 0, 2};
  motion.body.y = {1, 1, 2, 2, 1};
  motion.body.triangles = {{0, 1, 3}, {1, 2, 3}, {1, 4, 2}};
  motion.track.interval = 0.2;
  motion.track.x = {std::move(x)};
  motion.track.y = {std::move(y)};
  return motion;
}

TEST(Contacts, AreNoneWhereThereIsNoGroundAndNothingIsNear) {
  const Motion motion = motion_of({0, 1, 1, 0, 2}, {0, 0, 1, 1, 0});
  EXPECT_THAT(contacts_of(motion, 0), ElementsAre(Contact::none, Contact::none, Contact::none,
                                                  Contact::none, Contact::none));
}

TEST(Contacts, WithTheGroundBeginJustAboveIt) {
  Motion motion = motion_of({0, 1, 1, 0, 2}, {0, 0.99 * ground_reach, 1, 1, 1.01 * ground_reach});
  motion.scene.ground = true;
  EXPECT_THAT(contacts_of(motion, 0), ElementsAre(Contact::ground, Contact::ground, Contact::none,
                                                  Contact::none, Contact::none));
}

// Node 4 comes down on the edge from 0 to 1 from below, and touches that edge with both its ends.
TEST(Contacts, WithItselfAreANodeAndTheEdgeItComesNear) {
  Motion motion = motion_of({0, 1, 1, 0, 0.5}, {0, 0, 1, 1, -0.1});
  motion.scene.self_collision = true;
  motion.scene.collision_gap = 0.11;
  EXPECT_THAT(contacts_of(motion, 0), ElementsAre(Contact::itself, Contact::itself, Contact::none,
                                                  Contact::none, Contact::itself));
  motion.scene.collision_gap = 0.09;
  EXPECT_THAT(contacts_of(motion, 0), testing::Each(Contact::none));
}

// A scene that keeps cells farther apart than neighbours are at rest does not make them touch.
TEST(Contacts, WithItselfAreNotWhatIsNearAtRest) {
  Motion motion = motion_of({0, 1, 1, 0, 2}, {1, 1, 2, 2, 1});
  motion.scene.self_collision = true;
  motion.scene.collision_gap = 1.5;
  EXPECT_THAT(contacts_of(motion, 0), testing::Each(Contact::none));
}

}  // namespace
}  // namespace metamorph::evolve
