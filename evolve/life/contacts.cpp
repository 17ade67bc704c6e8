#include "evolve/life/contacts.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace metamorph::evolve {
namespace {

/// From node n to the segment between nodes i and j.
double distance(std::span<const double> x, std::span<const double> y, std::size_t n, std::size_t i,
                std::size_t j) {
  const double ex = x[j] - x[i], ey = y[j] - y[i], dx = x[n] - x[i], dy = y[n] - y[i];
  const double t = std::clamp((ex * dx + ey * dy) / (ex * ex + ey * ey), 0.0, 1.0);
  return std::hypot(dx - t * ex, dy - t * ey);
}

}  // namespace

std::vector<Contact> contacts_of(const Motion& motion, int frame) {
  const core::Body& body = motion.body;
  const auto& x = motion.track.x[static_cast<std::size_t>(frame)];
  const auto& y = motion.track.y[static_cast<std::size_t>(frame)];
  std::vector<Contact> contacts(x.size(), Contact::none);
  if (motion.scene.self_collision) {
    const double gap = motion.scene.collision_gap;
    const std::vector<std::array<core::Index, 2>> outline = core::outline_of(body.triangles);
    for (const auto& [node, ignored] : outline) {
      const auto n = static_cast<std::size_t>(node);
      for (const auto& [from, to] : outline) {
        if (from == node || to == node) continue;
        const auto i = static_cast<std::size_t>(from), j = static_cast<std::size_t>(to);
        const double now = distance(x, y, n, i, j);
        if (now < gap && now < squeezed * distance(body.x, body.y, n, i, j)) {
          contacts[n] = contacts[i] = contacts[j] = Contact::itself;
        }
      }
    }
  }
  if (motion.scene.ground) {
    for (std::size_t n = 0; n < x.size(); ++n) {
      if (y[n] < ground_reach) contacts[n] = Contact::ground;
    }
  }
  return contacts;
}

}  // namespace metamorph::evolve
