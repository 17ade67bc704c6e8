// Colours, those of evolve/view/colour.cpp, and what they stand for.

const rgb = (r, g, b) => `rgb(${round(255 * r)},${round(255 * g)},${round(255 * b)})`;
const blend = (a, b, t) => a.map((v, i) => mix(v, b[i], t));
const pale = (colour) => rgb(...blend(colour, WHITE, 0.25));
const WHITE = [1, 1, 1], CONTRACTED = [0.16, 0.38, 0.76], EXPANDED = [0.83, 0.20, 0.18], RANGE = 0.4;
const BIRTH = [[0.33, 0.58, 0.84], [0.88, 0.38, 0.33], [0.87, 0.66, 0.24], [0.36, 0.67, 0.47], [0.58, 0.45, 0.74]];
const birthColour = (stage) => BIRTH[stage < BIRTH.length ? stage : 1 + (stage - 1) % 4];
const FREE = [0.88, 0.89, 0.91], ON_GROUND = [0.87, 0.56, 0.02], ON_ITSELF = [0.34, 0.25, 0.62];
const SCALE = [[0.27, 0.00, 0.33], [0.23, 0.32, 0.55], [0.13, 0.57, 0.55], [0.37, 0.79, 0.38], [0.99, 0.91, 0.14]];
function scaleColour(t) {
  const v = clamp(t, 0, 1) * 4, k = min(3, floor(v));
  return blend(SCALE[k], SCALE[k + 1], v - k);
}
function strainColour(ratio) {
  const strain = clamp((ratio - 1) / RANGE, -1, 1);
  return blend(WHITE, strain < 0 ? CONTRACTED : EXPANDED, abs(strain));
}
function phaseColour(phase) {
  const a = 0.125 * cos(phase), b = 0.125 * sin(phase), L = 0.74;
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3, m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3,
    s = (L - 0.0894841775 * a - 1.2914855480 * b) ** 3;
  const srgb = (v) => (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
  return [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s].map((v) => srgb(clamp(v, 0, 1)));
}
// In steps, so that what has one colour is drawn at once.
const table = (count, colour) => Array.from({ length: count + 1 }, (_, i) => rgb(...colour(i / count)));
const STRAIN = table(48, (t) => strainColour(1 + RANGE * (2 * t - 1)));
const PHASE = table(64, (t) => phaseColour(2 * PI * t));
const LINEAR = table(48, scaleColour);
const pick = (colours, t) => colours[round(clamp(t, 0, 1) * (colours.length - 1))];
const turn = (phase) => { const t = phase / (2 * PI); return t - floor(t); };

// Who touches the ground, or whose outline comes nearer to itself than it keeps from itself.
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
        if (now < motion.gap && now < 0.98 * gap(motion.x, motion.y)) touch[n] = touch[i] = touch[j] = 2;
      }
    }
  }
  if (motion.ground) y.forEach((v, i) => { if (v < 0.015) touch[i] = 1; });
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
