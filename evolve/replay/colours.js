// Colours, which the page brings from evolve/view/colour.cpp, and what they stand for.

const rgb = (r, g, b) => `rgb(${round(255 * r)},${round(255 * g)},${round(255 * b)})`;
const blend = (a, b, t) => a.map((v, i) => mix(v, b[i], t));
const pale = (colour) => rgb(...blend(colour, WHITE, 0.25));
const WHITE = [1, 1, 1];
const { range: RANGE, birth: BIRTH, free: FREE, ground: ON_GROUND, itself: ON_ITSELF } = page.colours;
const birthColour = (stage) => BIRTH[stage < BIRTH.length ? stage : 1 + (stage - 1) % (BIRTH.length - 1)];
const pick = (colours, t) => colours[round(clamp(t, 0, 1) * (colours.length - 1))];
const phaseColour = (phase) => pick(page.colours.phase, turn(phase));
const scaleColour = (t) => pick(page.colours.scale, t);
// In steps, so that what has one colour is drawn at once.
const [STRAIN, PHASE, LINEAR] = ["strain", "phase", "scale"].map((name) => page.colours[name].map((c) => rgb(...c)));
const turn = (phase) => { const t = phase / (2 * PI); return t - floor(t); };

// As contacts_of() of evolve/life/contacts.h.
function contacts(motion, x, y) {
  const touch = new Int8Array(x.length);
  if (motion.gap > 0) {
    for (const [n] of motion.outline) {
      for (const [i, j] of motion.outline) {
        if (i === n || j === n) continue;
        const gap = (px, py) => {
          const ex = px[j] - px[i], ey = py[j] - py[i], dx = px[n] - px[i], dy = py[n] - py[i];
          const t = clamp((ex * dx + ey * dy) / (ex * ex + ey * ey), 0, 1);
          return hypot(dx - t * ex, dy - t * ey);
        };
        const now = gap(x, y);
        if (now < motion.gap && now < page.squeezed * gap(motion.x, motion.y)) touch[n] = touch[i] = touch[j] = 2;
      }
    }
  }
  if (motion.ground) y.forEach((v, i) => { if (v < page.reach) touch[i] = 1; });
  return touch;
}

// The colour of each node of a body; null where triangles have theirs.
function nodeColours(motion, now, kind) {
  const [low, high] = range(motion.period);
  const touch = kind === "contact" && contacts(motion, now.x, now.y);
  switch (kind) {
    case "area": return null;
    case "phase": return motion.phase.map((v) => pick(PHASE, turn(v)));
    case "period": return motion.period.map((v) => pick(LINEAR, (v - low) / (high - low || 1)));
    case "speed": { // over two frames of the simulation, clipped to the run
      const from = clamp(now.frame - 1, 0, max(0, motion.track.last() - 2));
      const a = motion.track.at(from), b = motion.track.at(from + 2);
      return Array.from(now.x, (_, i) => pick(LINEAR, a && b
        ? hypot(b.x[i] - a.x[i], b.y[i] - a.y[i]) / (2 * motion.track.interval) / (motion.speed || 1) : 0));
    }
    case "birth": return motion.born.map((v) => pale(birthColour(v)));
    default: return Array.from(touch, (v) => rgb(...[FREE, ON_GROUND, ON_ITSELF][v]));
  }
}
const range = (list) => [min(...list), max(...list)];
