#include "evolve/film/timeline.h"

#include <algorithm>

namespace metamorph::evolve {
namespace {

Shot development(int from, int to) {
  return {Shot::Kind::development, from, to, -1, (to - from) * core::paper_step, 0};
}

Shot cut(const Motion& motion, int number) {
  return {Shot::Kind::cut, motion.stage, motion.stage, number, 0, 0};
}

/// As long as the scene says, also where the body failed on the way: lives stay in step.
Shot movement(const Motion& motion, int number) {
  return {Shot::Kind::motion,
          motion.stage,
          motion.stage,
          number,
          motion.scene.run_steps * core::paper_step,
          0};
}

}  // namespace

std::vector<Shot> shots_of(const Life& life, FilmKind kind, const std::string& trial) {
  std::vector<Shot> shots;
  if (kind == FilmKind::development) return {development(0, life.end)};
  int step = 0;
  for (std::size_t m = 0; m < life.motions.size(); ++m) {
    const Motion& motion = life.motions[m];
    if (!trial.empty() && motion.name != trial) continue;
    if (kind == FilmKind::life && motion.stage > step) {
      shots.push_back(development(step, motion.stage));
      step = motion.stage;
    }
    const int number = static_cast<int>(m);
    if (motion.stage >= 0) shots.push_back(cut(motion, number));
    if (motion.track.frame_count() > 0) shots.push_back(movement(motion, number));
  }
  return shots;
}

double length_of(const std::vector<Shot>& shots) {
  double length = 0;
  for (const Shot& shot : shots) length += shot.length;
  return length;
}

int cuts_of(const std::vector<Shot>& shots) {
  return static_cast<int>(std::count_if(shots.begin(), shots.end(),
                                        [](const Shot& s) { return s.kind == Shot::Kind::cut; }));
}

void set_seconds(std::vector<Shot>& shots, double speed, double cut) {
  for (Shot& shot : shots) {
    shot.seconds = shot.kind == Shot::Kind::cut ? cut : shot.length / speed;
  }
}

double seconds_of(const std::vector<Shot>& shots) {
  double seconds = 0;
  for (const Shot& shot : shots) seconds += shot.seconds;
  return seconds;
}

Moment moment_at(const std::vector<Shot>& shots, double second) {
  for (const Shot& shot : shots) {
    if (second < shot.seconds) return {shot, second / shot.seconds};
    second -= shot.seconds;
  }
  return {shots.back(), 1};
}

}  // namespace metamorph::evolve
