"use strict";
// Plays the lives that the page holds. What lies in the data, and how: page.cpp, track_code.h,
// development_code.h. Times on the timeline are steps of the paper from the egg on; the moments at
// which a body is cut out of its embryo stand still in life and last CUT steps here.
(() => {
const { abs, atan2, ceil, cos, floor, hypot, log10, log2, max, min, round, sin, sqrt, PI } = Math;
const $ = (id) => document.getElementById(id);
const page = JSON.parse($("page").textContent);
const CUT = 60, BLEND = 40, PACE = 150;
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8];
const COLOURS = { area: "area ratio", phase: "phase", period: "period", speed: "speed",
  birth: "stage of birth", contact: "contact" };
const tell = (id, text) => { if ($(id).textContent !== text) $(id).textContent = text; };
const clamp = (v, low, high) => min(high, max(low, v));
const mix = (a, b, t) => a + (b - a) * t;
const smooth = (t) => t * t * (3 - 2 * t);
const at = (list, i) => { // of a list of numbers, between two of them as well
  const k = clamp(floor(i), 0, list.length - 1), n = min(k + 1, list.length - 1);
  return mix(list[k], list[n], clamp(i - k, 0, 1));
};

// ---- Reading ----

async function inflate(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
const inflateText = async (text) => new TextDecoder().decode(await inflate(text));

// Varints: numbers beyond 2^31 as well, so no bit operations.
class Numbers {
  constructor(bytes) { this.bytes = bytes; this.place = 0; }
  next() {
    let value = 0, scale = 1, byte;
    do {
      byte = this.bytes[this.place++];
      value += (byte & 127) * scale;
      scale *= 128;
    } while (byte > 127);
    return value;
  }
  signed() { const v = this.next(); return v % 2 ? -(v + 1) / 2 : v / 2; }
  coordinates(count) {
    const values = new Float64Array(count);
    let value = 0, slope = 0;
    for (let k = 0; k < count; ++k) {
      const difference = slope + this.signed();
      value += difference;
      slope = k ? difference : 0;
      values[k] = value * page.coordinate_step;
    }
    return values;
  }
}

// Chunks that were read lately, of all animats together; the oldest goes first.
const recent = new Map(), MOST_CHUNKS = 160;

// Points in frames, read chunk by chunk. first, last: of each point, the frames in which it is.
class Points {
  constructor(chunks, first, last) {
    this.chunks = chunks; this.first = first; this.last = last; this.loading = new Map();
  }
  chunk(c) {
    const key = this.chunks[c], known = recent.get(key);
    if (known) { recent.delete(key); recent.set(key, known); }
    return known;
  }
  load(c) {
    if (c < 0 || c >= this.chunks.length || this.chunk(c)) return null;
    if (!this.loading.has(c)) {
      this.loading.set(c, inflate(this.chunks[c]).then((bytes) => {
        const numbers = new Numbers(bytes), size = page.chunk_frames;
        recent.set(this.chunks[c], this.first.map((first, i) => {
          const from = max(first, c * size), count = min(this.last[i], (c + 1) * size) - from;
          return count > 0 ? { from, x: numbers.coordinates(count), y: numbers.coordinates(count) } : null;
        }));
        while (recent.size > MOST_CHUNKS) recent.delete(recent.keys().next().value);
        this.loading.delete(c);
        redraw();
      }));
    }
    return this.loading.get(c);
  }
  // True when all frames from a to b can be read now; else they will be.
  have(a, b) {
    let all = true;
    for (let c = floor(a / page.chunk_frames); c <= floor(b / page.chunk_frames); ++c) {
      if (this.load(c)) all = false;
    }
    return all;
  }
  frame(k) {
    const chunk = this.chunk(floor(k / page.chunk_frames));
    return (i) => { const part = chunk[i], j = k - part.from; return [part.x[j], part.y[j]]; };
  }
}

// A motion: where its nodes are at any frame (track_code.h, shown_at).
class Track {
  constructor(spec, nodes) {
    Object.assign(this, spec);
    this.kept = this.frames < 2 ? this.frames : floor((this.frames - 2) / this.every) + 2;
    this.points = new Points(spec.chunks, Array(nodes).fill(0), Array(nodes).fill(this.kept));
    this.nodes = nodes;
  }
  last() { return max(0, this.frames - 1); }
  at(frame) { // {x, y} in d; null while it is being read
    if (this.frames === 0) return null;
    const f = clamp(frame, 0, this.last()), end = this.kept - 1;
    const k = clamp(floor(f / this.every), 0, max(0, end - 1));
    const ks = [k - 1, k, k + 1, k + 2].map((j) => clamp(j, 0, end));
    if (!this.points.have(ks[0], ks[3])) return null;
    const ahead = ks[3] + 48;
    if (ahead <= end) this.points.load(floor(ahead / page.chunk_frames));
    const time = (j) => min(j * this.every, this.last());
    const [ta, tb, tc, td] = ks.map(time), w = tc - tb;
    const t = w ? (f - tb) / w : 0, s = 1 - t;
    const [a, b, c, d] = ks.map((j) => this.points.frame(j));
    const x = new Float64Array(this.nodes), y = new Float64Array(this.nodes);
    // Weights of the four frames.
    const g0 = tc - ta ? w / (tc - ta) : 0, g1 = td - tb ? w / (td - tb) : 0;
    const h1 = s * s * t * g0, h2 = t * t * s * g1;
    const p = [-h1, s * s * (1 + 2 * t) + h2, t * t * (1 + 2 * s) + h1, -h2];
    for (let i = 0; i < this.nodes; ++i) {
      const parts = [a(i), b(i), c(i), d(i)];
      for (let n = 0; n < 4; ++n) {
        x[i] += p[n] * parts[n][0];
        y[i] += p[n] * parts[n][1];
      }
    }
    return { x, y, frame: f };
  }
}

// A way of the middle, in d, and its mean over some time so that a camera does not sway with a gait.
class Way {
  constructor(spec) {
    const real = (list) => Float64Array.from(list, (v) => v * page.way_step);
    this.every = spec.every; this.x = real(spec.x); this.y = real(spec.y);
    this.calm = [this.x, this.y].map((list) => list.map((_, i) => {
      const reach = min(30, i, list.length - 1 - i);
      let sum = 0;
      for (let k = i - reach; k <= i + reach; ++k) sum += list[k];
      return sum / (2 * reach + 1);
    }));
    if (spec.half_x) this.half = [real(spec.half_x), real(spec.half_y)];
  }
  middle(frame) { return this.calm.map((list) => at(list, frame / this.every)); }
}

async function readDevelopment(spec, starts) {
  const cells = new Numbers(await inflate(spec.cells));
  const d = { frames: spec.frames, status: spec.status, way: new Way(spec.way), id: [], mother: [],
    first: [], last: [], born: [], links: [], changes: [] };
  for (let n = cells.next(), id = 0; n > 0; --n) {
    id += cells.next();
    d.id.push(id);
    d.mother.push(cells.next() - 1);
    const first = cells.next();
    d.first.push(first);
    d.last.push(first + cells.next());
    const birth = first + cells.signed();
    d.born.push(starts.filter((s) => s <= birth).length);
  }
  const links = new Numbers(await inflate(spec.links));
  for (let n = links.next(), i = 0; n > 0; --n) {
    i += links.next();
    const j = i + links.next(), first = links.next();
    d.links.push([i, j, first, first + links.next()]);
  }
  const signals = new Numbers(await inflate(spec.signals));
  for (let i = 0; i < d.id.length; ++i) {
    let frame = d.first[i], period = 0, phase = 0;
    d.changes.push(Array.from({ length: signals.next() }, () => {
      frame += signals.next(); period += signals.signed(); phase += signals.signed();
      return [frame, period * page.period_step, phase * page.phase_step];
    }));
  }
  d.points = new Points(spec.chunks, d.first, d.last);
  return d;
}

function area(x, y, [i, j, k]) {
  return 0.5 * ((x[j] - x[i]) * (y[k] - y[i]) - (x[k] - x[i]) * (y[j] - y[i]));
}

// Edges with one triangle, the body on their left.
function outlineOf(triangles) {
  const edges = new Set(triangles.flatMap(([i, j, k]) => [`${i},${j}`, `${j},${k}`, `${k},${i}`]));
  return [...edges].map((e) => e.split(",").map(Number)).filter(([i, j]) => !edges.has(`${j},${i}`));
}

async function readMotion(spec) {
  const motion = { ...spec, length: 0 };
  if (spec.status !== "ok") return motion;
  motion.text = await inflateText(spec.body);
  const body = JSON.parse(motion.text);
  const x = body.nodes.map((n) => n[0]), y = body.nodes.map((n) => n[1]);
  motion.x = x; motion.y = y;
  motion.triangles = body.triangles; motion.springs = body.springs;
  motion.period = body.period; motion.phase = body.phase;
  motion.rest = body.rest_area || body.triangles.map((t) => area(x, y, t));
  motion.outline = outlineOf(body.triangles);
  motion.born = spec.born.length ? spec.born : x.map(() => 0);
  motion.way = new Way(spec.way);
  motion.track = new Track(spec.track, x.length);
  motion.copies = spec.copies.map((copy) => new Track(copy, x.length));
  motion.reference = spec.reference && new Track(spec.reference, x.length);
  motion.length = motion.track.last() * motion.track.interval / page.paper_step;
  return motion;
}

// One animat: its motions, its development, and the parts of its life on the timeline.
const lives = [];
function life(a) {
  return lives[a] ??= (async () => {
    const spec = JSON.parse($(`life-${a}`).textContent);
    const motions = await Promise.all(spec.motions.map(readMotion));
    const development = spec.development && await readDevelopment(spec.development, spec.starts);
    const parts = [], animat = { ...spec, motions, development, parts, length: 0 };
    let step = 0;
    const add = (part) => {
      parts.push({ ...part, start: animat.length, life: animat, before: parts.at(-1) });
      animat.length += part.length;
    };
    for (const motion of motions) {
      if (development) {
        if (motion.stage > step || !parts.length) {
          add({ kind: "grow", name: step ? "metamorphosis" : "development", from: step, length: motion.stage - step });
        }
        step = motion.stage;
        add({ kind: "cut", name: motion.status === "ok" ? "body" : "no body", motion, from: step, length: CUT });
      }
      if (motion.status === "ok") add({ kind: "move", name: motion.name, motion, from: step, length: motion.length });
    }
    return animat;
  })();
}
const loaded = []; // [animat] the same once it is there

// ---- State ----

const state = { a: 0, t: 0, playing: false, direction: 1, loop: true, speed: 1, colour: "area", camera: "follow",
  zoo: false, trail: true, copies: true, reference: true, zoom: 1 };
let ownColour = false;
const SWITCHES = ["loop", "trail", "copies", "reference", "zoo"];

function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1));
  const number = (name, low, high) => {
    const value = parseFloat(given.get(name));
    if (Number.isFinite(value)) state[name] = clamp(value, low, high);
  };
  number("a", 0, page.lives - 1);
  state.a = floor(state.a);
  number("t", 0, 1e9);
  if (given.get("c") in COLOURS) { state.colour = given.get("c"); ownColour = true; }
  if (["follow", "stay", "path"].includes(given.get("v"))) state.camera = given.get("v");
  if (given.has("z")) state.zoo = given.get("z") === "1" && page.lives > 1;
}
function writeAddress() {
  let text = `#a=${state.a}&t=${round(state.t)}`;
  if (ownColour) text += `&c=${state.colour}`;
  if (state.camera !== "follow") text += `&v=${state.camera}`;
  if (state.zoo) text += "&z=1";
  if (text !== location.hash) history.replaceState(null, "", text);
}

// ---- Colours: those of evolve/view/colour.cpp ----

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

// ---- Drawing ----

const canvas = $("stage"), ctx = canvas.getContext("2d");
const FONT = "13px system-ui, sans-serif";
let theme = {};
const dark = matchMedia("(prefers-color-scheme: dark)");
function readTheme() {
  theme = dark.matches
    ? { paper: "#15181d", ink: "#e7eaef", faint: "#a3abb8", edge: "#8b94a3", ground: "#8d8577", ghost: "#5fd08a" }
    : { paper: "#ffffff", ink: "#21262f", faint: "#6b727f", edge: "#21262f", ground: "#8d8577", ghost: "#0a7f3f" };
}

// A view of some rectangle of the canvas: middle and scale of the camera, turned by the slope.
class View {
  constructor(box, camera) {
    const c = cos(camera.turn), s = sin(camera.turn), k = camera.scale;
    this.box = box; this.camera = camera; this.pixel = 1 / k;
    this.m = [k * c, -k * s, -k * s, -k * c];
    this.e = box.x + box.w / 2 - this.m[0] * camera.x - this.m[2] * camera.y;
    this.f = box.y + box.h / 2 - this.m[1] * camera.x - this.m[3] * camera.y;
  }
  enter(g, ratio) { g.setTransform(...this.m.map((v) => v * ratio), this.e * ratio, this.f * ratio); }
  toScreen(x, y) { return [this.m[0] * x + this.m[2] * y + this.e, this.m[1] * x + this.m[3] * y + this.f]; }
}

// The camera that shows half sizes hx, hy (d) around x, y in a box.
function fit(box, x, y, hx, hy, turn) {
  const c = abs(cos(turn)), s = abs(sin(turn));
  const w = hx * c + hy * s + 1, h = hx * s + hy * c + 1;
  return { x, y, turn, scale: min(box.w / (2 * w), (box.h - 40) / (2 * h)) };
}

function cameraOf(part, local, box) {
  if (part.kind !== "move") {
    const way = part.life.development.way, frame = part.from + (part.kind === "grow" ? local : 0);
    const half = way.half.map((list) => max(3, at(list, frame / way.every + 3)));
    return fit(box, ...way.middle(frame), ...half, 0);
  }
  const { motion } = part, turn = motion.slope * PI / 180, way = motion.way;
  if (state.camera === "path") {
    const [xl, xh] = range(way.x), [yl, yh] = range(way.y);
    return fit(box, (xl + xh) / 2, (yl + yh) / 2, (xh - xl) / 2 + motion.half[0], (yh - yl) / 2 + motion.half[1], turn);
  }
  const frame = state.camera === "stay" ? 0 : local * page.paper_step / motion.track.interval;
  const [x, y] = state.camera === "stay" ? [way.x[0], way.y[0]] : way.middle(frame);
  return fit(box, x, y, ...motion.half, turn);
}

// Moves from the view of the part before into that of this one.
function blendedCamera(part, local, box) {
  const camera = cameraOf(part, local, box);
  if (part.before && local < BLEND) {
    const old = cameraOf(part.before, part.before.length, box), t = smooth(local / BLEND);
    for (const key of ["x", "y", "turn"]) camera[key] = mix(old[key], camera[key], t);
    camera.scale = old.scale ** (1 - t) * camera.scale ** t;
  }
  camera.scale *= state.zoom;
  return camera;
}

function pen(g, colour, width) { g.strokeStyle = colour; g.lineWidth = width; }

function polygon(path, points) {
  points.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
  path.closePath();
}

// What has the same colour is drawn at once.
function drawTiles(g, view, motion, now, kind) {
  const paths = new Map(), colours = nodeColours(motion, now, kind), p = (i) => [now.x[i], now.y[i]];
  const add = (colour, points) => {
    if (!paths.has(colour)) paths.set(colour, new Path2D());
    polygon(paths.get(colour), points);
  };
  motion.triangles.forEach((triangle, n) => {
    const [i, j, k] = triangle, corners = triangle.map(p);
    if (!colours) {
      add(pick(STRAIN, ((area(now.x, now.y, triangle) / motion.rest[n] - 1) / RANGE + 1) / 2), corners);
    } else if (colours[i] === colours[j] && colours[j] === colours[k]) {
      add(colours[i], corners);
    } else { // to each corner its share
      const half = (a, b) => [(now.x[a] + now.x[b]) / 2, (now.y[a] + now.y[b]) / 2];
      const centre = [0, 1].map((c) => corners.reduce((sum, corner) => sum + corner[c] / 3, 0));
      for (const [a, b, c] of [[i, j, k], [j, k, i], [k, i, j]]) add(colours[a], [p(a), half(a, b), centre, half(c, a)]);
    }
  });
  g.lineJoin = "round";
  g.lineWidth = 0.7 * view.pixel;
  for (const [colour, path] of paths) {
    g.fillStyle = g.strokeStyle = colour;
    g.fill(path);
    g.stroke(path); // no paper between tiles
  }
}

function lines(pairs, now) {
  const path = new Path2D();
  for (const [i, j] of pairs) { path.moveTo(now.x[i], now.y[i]); path.lineTo(now.x[j], now.y[j]); }
  return path;
}

function drawBody(g, view, motion, now, kind) {
  drawTiles(g, view, motion, now, kind);
  if (view.camera.scale > 6) {
    pen(g, "rgba(33,38,47,0.28)", max(0.035, 0.4 * view.pixel));
    g.stroke(lines(motion.springs, now));
  }
  g.strokeStyle = theme.edge;
  g.lineCap = "round";
  g.lineWidth = max(0.1, view.pixel);
  g.stroke(lines(motion.outline, now));
}

function drawGhost(g, view, motion, now, colour, alpha) {
  g.globalAlpha = alpha;
  g.fillStyle = g.strokeStyle = colour;
  const path = new Path2D();
  for (const t of motion.triangles) polygon(path, t.map((i) => [now.x[i], now.y[i]]));
  g.fill(path);
  g.globalAlpha = min(1, 4 * alpha);
  g.lineWidth = max(0.08, 1.2 * view.pixel);
  g.stroke(lines(motion.outline, now));
  g.globalAlpha = 1;
}

function drawGround(g, view) {
  const { camera, box } = view, reach = hypot(box.w, box.h) / camera.scale;
  const left = camera.x - reach, right = camera.x + reach;
  const gap = 2 ** ceil(log2(14 * view.pixel)), size = min(0.6, gap) * 0.8;
  pen(g, theme.ground, max(0.05, 1.2 * view.pixel));
  g.beginPath();
  g.moveTo(left, 0); g.lineTo(right, 0);
  // Marks stay where they are: what passes over them can be seen to move.
  for (let x = floor(left / gap) * gap; x < right; x += gap) { g.moveTo(x, 0); g.lineTo(x - size, -size); }
  g.stroke();
}

function drawTrail(g, view, motion, frame) {
  const way = motion.way, end = frame / way.every;
  g.beginPath();
  for (let i = 0; i < end && i < way.x.length; ++i) g.lineTo(way.x[i], way.y[i]);
  g.lineTo(at(way.x, end), at(way.y, end));
  pen(g, theme.faint, 1.4 * view.pixel);
  g.stroke();
  g.fillStyle = theme.faint;
  g.beginPath();
  g.arc(way.x[0], way.y[0], 3 * view.pixel, 0, 7);
  g.fill();
}

// Cells at a step: their places, and of those that died lately where they were. Null while reading.
const FADE = 15;
function cellsAt(development, step) {
  if (!development.points.have(max(0, step - FADE), step)) return null;
  const x = [], y = [], there = [], gone = [];
  for (let i = 0; i < development.id.length; ++i) {
    const first = development.first[i], last = development.last[i];
    if (step < first || step >= last + FADE) continue;
    const frame = min(step, last - 1);
    [x[i], y[i]] = development.points.frame(frame)(i);
    (step < last ? there : gone).push(i);
  }
  return { x, y, there, gone };
}
function signalsAt(development, i, step) {
  let now = development.changes[i][0];
  for (const change of development.changes[i]) if (change[0] <= step) now = change; else break;
  return now;
}

const periodRange = (d) => d.range ??= range(d.changes.flat().map((c) => c[1]));
function cellColour(development, i, step, kind) {
  if (kind === "phase") return phaseColour(signalsAt(development, i, step)[2]);
  if (kind === "period") {
    const [low, high] = periodRange(development);
    return scaleColour((signalsAt(development, i, step)[1] - low) / (high - low || 1));
  }
  return birthColour(development.born[i]);
}

function drawEmbryo(g, view, development, step, kind, alpha) {
  const cells = cellsAt(development, step);
  if (!cells) return false;
  const line = max(0.05, 0.8 * view.pixel);
  for (const i of cells.gone) {
    const t = (step - development.last[i] + 1) / FADE;
    g.globalAlpha = alpha * (1 - t);
    pen(g, theme.faint, 2 * line);
    g.beginPath();
    g.arc(cells.x[i], cells.y[i], 0.5 * (1 - t), 0, 7);
    g.stroke();
  }
  for (const i of cells.there) {
    const colour = cellColour(development, i, step, kind), age = step - development.first[i];
    const radius = 0.5 * min(1, 0.4 + age / 10);
    g.globalAlpha = alpha;
    g.fillStyle = pale(colour);
    pen(g, rgb(...blend(colour, [0.13, 0.15, 0.19], 0.35)), line);
    g.beginPath();
    g.arc(cells.x[i], cells.y[i], max(0, radius - line / 2), 0, 7);
    g.fill();
    g.stroke();
  }
  g.globalAlpha = 0.55 * alpha;
  pen(g, theme.edge, line);
  g.stroke(lines(development.links.filter(([, , from, to]) => from <= step && step < to), cells));
  g.globalAlpha = 1;
  return true;
}

function partAt(animat, t) {
  const parts = animat.parts;
  let part = parts[0];
  for (const next of parts) if (next.start <= t) part = next;
  return [part, clamp(t - part.start, 0, part.length)];
}
const colourIn = (part) => (part.kind === "move" || ["phase", "period"].includes(state.colour) ? state.colour : "birth");

// One animat in a rectangle of the canvas; false while its data are being read.
function drawAnimat(g, ratio, animat, t, box) {
  const [part, local] = partAt(animat, t), { motion } = part;
  const view = new View(box, blendedCamera(part, local, box)), kind = colourIn(part);
  const step = floor(part.from + (part.kind === "grow" ? local : 0));
  g.save();
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.beginPath();
  g.rect(box.x, box.y, box.w, box.h);
  g.clip();
  view.enter(g, ratio);
  let whole = true;
  if (part.kind === "grow") whole = drawEmbryo(g, view, animat.development, step, kind, 1);
  if (part.kind === "cut") {
    const t1 = motion.status === "ok" ? smooth(local / CUT) : 0;
    whole = drawEmbryo(g, view, animat.development, step, kind, 1 - t1);
    if (t1 > 0) {
      g.globalAlpha = t1;
      drawBody(g, view, motion, motion, kind);
      g.globalAlpha = 1;
    }
  }
  if (part.kind === "move") {
    const frame = local * page.paper_step / motion.track.interval, now = motion.track.at(frame);
    if (motion.ground) drawGround(g, view);
    if (state.trail && motion.way.x.length) drawTrail(g, view, motion, frame);
    if (state.copies) {
      for (const copy of motion.copies) {
        const there = copy.at(frame);
        if (there) drawGhost(g, view, motion, there, theme.faint, 0.12); else whole &&= copy.frames === 0;
      }
    }
    if (now) drawBody(g, view, motion, now, kind); else whole = motion.track.frames === 0;
    if (state.reference && motion.reference) {
      const there = motion.reference.at(frame);
      if (there) drawGhost(g, view, motion, there, theme.ghost, 0.1); else whole &&= motion.reference.frames === 0;
    }
  }
  g.restore();
  return [whole, view, part, local];
}

function drawRuler(g, view) {
  const { box, camera } = view, most = box.w / 4 / camera.scale;
  const power = 10 ** floor(log10(most)), length = [5, 2, 1].find((n) => n * power <= most) * power;
  const x = box.x + 14, y = box.y + box.h - 16, w = length * camera.scale;
  g.strokeStyle = g.fillStyle = theme.ink;
  g.lineWidth = 2;
  g.beginPath();
  g.moveTo(x, y - 4); g.lineTo(x, y); g.lineTo(x + w, y); g.lineTo(x + w, y - 4);
  g.stroke();
  g.font = FONT;
  g.textAlign = "left";
  g.fillText(`${+length.toPrecision(2)} d`, x + w + 6, y + 2);
}

// What the colours of a part mean: a bar with its ends, or fields.
function legendOf(part) {
  const kind = colourIn(part), { motion } = part;
  const bar = (title, colours, low, high) => ({ title, bar: colours, low, high });
  const periods = () => (part.kind === "move" ? range(motion.period) : periodRange(part.life.development)).map(round);
  switch (kind) {
    case "area": return bar("area / area at rest", STRAIN, `${1 - RANGE} contracted`, `${1 + RANGE} expanded`);
    case "phase": return bar("phase", PHASE, "0", "2\u03c0");
    case "period": return bar("period, time units", LINEAR, ...periods());
    case "speed": return bar("speed, d per time unit", LINEAR, "0", `${motion.speed.toPrecision(2)}`);
    case "birth": return { title: "cells born in", fields: Array.from({ length: part.life.starts.length + 1 }, (_, i) =>
      [["larva", "metamorphosis"][i] ?? `stage ${i + 1}`, pale(birthColour(i))]) };
    default: return { title: "touches", fields: [["nothing", rgb(...FREE)], ["itself", rgb(...ON_ITSELF)],
      ...(motion.ground ? [["ground", rgb(...ON_GROUND)]] : [])] };
  }
}
function drawLegend(g, box, legend) {
  const right = box.x + box.w - 12, y = box.y + 12;
  g.font = FONT;
  g.fillStyle = theme.ink;
  g.textAlign = "right";
  g.fillText(legend.title, right, y + 10);
  if (legend.bar) {
    const w = min(230, box.w * 0.6), n = legend.bar.length;
    legend.bar.forEach((colour, i) => {
      g.fillStyle = colour;
      g.fillRect(right - w + w * i / n, y + 16, w / n + 0.5, 10);
    });
    pen(g, theme.faint, 1);
    g.strokeRect(right - w, y + 16, w, 10);
    g.fillStyle = theme.ink;
    g.fillText(legend.high, right, y + 40);
    g.textAlign = "left";
    g.fillText(legend.low, right - w, y + 40);
    return;
  }
  let x = right;
  for (const [name, colour] of [...legend.fields].reverse()) {
    g.fillStyle = theme.ink;
    g.textAlign = "right";
    g.fillText(name, x, y + 28);
    x -= g.measureText(name).width + 16;
    g.fillStyle = colour;
    pen(g, theme.faint, 1);
    g.fillRect(x, y + 18, 11, 11);
    g.strokeRect(x, y + 18, 11, 11);
    x -= 12;
  }
}

function direction(part) { // of a motion as a whole, as it is seen; null: there is none
  if (part.kind !== "move" || part.motion.way.x.length < 2) return null;
  const { way, ground, slope } = part.motion;
  const dx = way.x.at(-1) - way.x[0], dy = ground ? 0 : way.y.at(-1) - way.y[0];
  const angle = atan2(dy, dx) + slope * PI / 180;
  return hypot(dx, dy) < 0.1 ? null : [cos(angle), -sin(angle)];
}
function drawArrow(g, box, [dx, dy]) {
  const x = box.x + box.w / 2 + dx * box.w * 0.36, y = box.y + box.h / 2 + dy * box.h * 0.36;
  const s = clamp(min(box.w, box.h) / 10, 8, 26);
  g.fillStyle = theme.ink;
  g.beginPath();
  for (const [along, across] of [[-1, 0.15], [0.3, 0.15], [0.3, 0.5], [1, 0], [0.3, -0.5], [0.3, -0.15], [-1, -0.15]]) {
    g.lineTo(x + s * (along * dx - across * dy), y + s * (along * dy + across * dx));
  }
  g.fill();
}

function zooBoxes(w, h) {
  const columns = clamp(round(sqrt(page.lives * w / h * 0.8)), 1, page.lives), rows = ceil(page.lives / columns);
  return Array.from({ length: page.lives }, (_, a) => ({ a, x: a % columns * w / columns, w: w / columns,
    y: floor(a / columns) * h / rows, h: h / rows }));
}
function drawZoo(g, ratio, w, h) {
  let whole = true;
  for (const box of zooBoxes(w, h)) {
    const animat = loaded[box.a];
    if (!animat) { whole = false; fetchLife(box.a); continue; }
    const [done, , part] = drawAnimat(g, ratio, animat, state.t, box);
    whole &&= done;
    const arrow = direction(part);
    if (arrow) drawArrow(g, box, arrow);
    g.font = FONT;
    g.textAlign = "left";
    g.fillStyle = theme.ink;
    g.fillText(nameOf(box.a), box.x + 6, box.y + 15, box.w - 12);
    pen(g, theme.faint, box.a === state.a ? 2 : 0.3);
    g.strokeRect(box.x + 1, box.y + 1, box.w - 2, box.h - 2);
  }
  return whole;
}

// Draws a whole picture into a canvas of w by h; false while something is being read.
function paint(g, ratio, w, h) {
  const animat = loaded[state.a];
  if (!animat) return false;
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.globalAlpha = 1;
  g.fillStyle = theme.paper;
  g.fillRect(0, 0, w, h);
  if (state.zoo) return drawZoo(g, ratio, w, h);
  const box = { x: 0, y: 0, w, h }, [whole, view, part] = drawAnimat(g, ratio, animat, state.t, box);
  drawRuler(g, view);
  const legend = legendOf(part);
  drawLegend(g, box, legend);
  tell("legend", `${legend.title}: ` + (legend.bar ? `${legend.low} to ${legend.high}` : legend.fields.map(([name]) => name).join(", ")));
  return whole;
}

let painted = false, wanted = false;
function redraw() {
  if (wanted) return;
  wanted = true;
  requestAnimationFrame(frame);
}
function draw() {
  const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
  const pw = round(w * ratio), ph = round(h * ratio);
  if (canvas.width !== pw || canvas.height !== ph) { canvas.width = pw; canvas.height = ph; }
  painted = paint(ctx, ratio, w, h);
  if (painted && !replay.drawn) replay.drawn = performance.now();
  tellNow();
}

// ---- Time ----

let before = 0;
function frame(now) {
  wanted = false;
  const animat = loaded[state.a];
  if (state.playing && animat) {
    // While something is being read the clock waits.
    if (painted) state.t += state.direction * state.speed * PACE * min(0.1, (now - before) / 1000);
    const end = animat.length;
    if (state.t > end || state.t < 0) {
      if (state.loop) state.t = state.t < 0 ? end : 0;
      else { state.t = clamp(state.t, 0, end); setPlaying(false); }
    }
  }
  before = now;
  draw();
  if (state.playing) redraw();
}
function setPlaying(playing, direction = state.direction) {
  state.playing = playing;
  state.direction = direction;
  const animat = loaded[state.a];
  if (playing && animat && !state.loop) {
    if (direction > 0 && state.t >= animat.length) state.t = 0;
    if (direction < 0 && state.t <= 0) state.t = animat.length;
  }
  if (!playing) writeAddress();
  before = performance.now();
  showControls();
  redraw();
}
function seek(t) {
  state.t = clamp(t, 0, loaded[state.a]?.length ?? 1e9);
  if (!state.playing) writeAddress();
  redraw();
}

function fetchLife(a) {
  return life(a).then((animat) => {
    if (loaded[a] !== animat) redraw();
    return (loaded[a] = animat);
  });
}
async function choose(a) {
  state.a = a;
  await fetchLife(a);
  if (state.a === a) showAnimat();
}

// ---- What stands around the picture ----

const place = (a) => { // what its data say of an animat without reading them all
  places[a] ??= JSON.parse($(`life-${a}`).textContent, (key, value) =>
    (["development", "motions", "genome"].includes(key) ? undefined : value));
  return places[a];
};
const places = [];
function nameOf(a) {
  const { run, generation, eq6, heading } = place(a);
  return run < 0 ? heading : `${page.runs.length > 1 ? page.runs[run].name + ": " : ""}gen ${generation}, ${eq6.toFixed(2)} d`;
}

function tellNow() {
  const animat = loaded[state.a];
  if (!animat) return;
  const [part, local] = partAt(animat, state.t), { motion } = part;
  let text;
  if (part.kind === "move") {
    const where = motion.ground ? `on ${motion.scene}` : `in ${motion.scene}`, failed = motion.outcome !== "ok";
    text = `${motion.name} ${where}, step ${local.toFixed(0)} of ${motion.length.toFixed(0)} (${(local * page.paper_step).toFixed(1)} time units); ` +
      (failed ? `failed: ${motion.outcome}` : `${motion.distance.toFixed(2)} d in all`);
  } else {
    const d = animat.development, step = floor(part.from + (part.kind === "grow" ? local : 0));
    let alive = 0, died = 0;
    for (let i = 0; i < d.id.length; ++i) {
      if (d.first[i] <= step && step < d.last[i]) ++alive;
      if (d.last[i] <= step) ++died;
    }
    text = `${part.name}, step ${step} of ${d.frames - 1}: ${alive} cell${alive === 1 ? "" : "s"}, ${died} died`;
    if (!alive && d.status !== "ok") text += ` (${d.status})`;
    if (part.kind === "cut") {
      text = motion.status === "ok" ? `${motion.name}: its body is cut out, ${motion.x.length} nodes, ${motion.springs.length} springs`
        : `${motion.name}: no body (${motion.status})`;
    }
  }
  tell("now", text);
  $("seek").value = round(state.t);
  $("seek").setAttribute("aria-valuetext", text);
  animat.parts.forEach((other, i) => $("parts").children[i]?.toggleAttribute("aria-current", other === part));
}

function showControls() {
  const pressed = (id, on) => $(id).setAttribute("aria-pressed", on);
  pressed("play", state.playing && state.direction > 0);
  pressed("reverse", state.playing && state.direction < 0);
  $("play").textContent = state.playing && state.direction > 0 ? "\u275a\u275a" : "\u25b6";
  $("play").setAttribute("aria-label", state.playing && state.direction > 0 ? "Pause" : "Play");
  for (const key of SWITCHES) pressed(key, state[key]);
  $("speed").value = state.speed;
  $("colour").value = state.colour;
  $("camera").value = state.camera;
  $("animat").value = state.a;
}

function showAnimat() {
  const animat = loaded[state.a];
  state.t = clamp(state.t, 0, animat.length);
  $("heading").textContent = document.title = animat.heading;
  $("seek").max = floor(animat.length);
  $("parts").replaceChildren(...animat.parts.map((part) => {
    const button = document.createElement("button");
    button.className = part.kind;
    button.style.flexGrow = max(part.length, animat.length / 30);
    button.textContent = button.title = part.name;
    button.onclick = () => seek(part.start);
    return button;
  }));
  const bodies = animat.motions.filter((motion) => motion.status === "ok");
  $("copies").hidden = !bodies.some((motion) => motion.copies.length);
  $("reference").hidden = !bodies.some((motion) => motion.reference);
  $("genome").disabled = !animat.genome;
  $("body").disabled = !bodies.length;
  showHistory(animat);
  showControls();
  if (!state.playing) writeAddress();
  redraw();
}

function element(tag, attributes) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

// The fitness of the animat's run, the generations that are in the page, and its ancestors.
let siblings = [];
function showHistory(animat) {
  const run = page.runs[animat.run];
  $("history").hidden = !run;
  if (!run) return;
  siblings = Array.from({ length: page.lives }, (_, a) => a).filter((a) => place(a).run === animat.run)
    .sort((a, b) => place(a).generation - place(b).generation);
  const top = max(...run.fitness.map(([best]) => best), 1e-9), last = max(1, run.fitness.length - 1);
  const x = (g) => 5 + 590 * g / last, y = (v) => 115 - 105 * v / top;
  const curve = (k) => run.fitness.map((values, g) => `${x(g).toFixed(1)},${y(values[k]).toFixed(1)}`).join(" ");
  const mark = (g, name) => element("line", { x1: x(g), x2: x(g), y1: 0, y2: 120, class: name });
  $("curve").replaceChildren(...siblings.map((a) => mark(place(a).generation, "")), mark(animat.generation, "here"),
    element("polyline", { points: curve(1), class: "mean" }), element("polyline", { points: curve(0) }));
  $("curve").onclick = (event) => {
    const box = $("curve").getBoundingClientRect(), g = ((event.clientX - box.left) / box.width * 600 - 5) / 590 * last;
    choose(siblings.reduce((best, a) => (abs(place(a).generation - g) < abs(place(best).generation - g) ? a : best)));
  };
  $("generation").max = siblings.length - 1;
  $("generation").value = siblings.indexOf(state.a);
  $("generation").hidden = siblings.length < 2;
  $("curve-words").textContent = `${run.name}: best (blue) and mean (grey) fitness, eq 6, of ${run.fitness.length} generations, ` +
    `up to ${top.toFixed(2)} d; vertical lines: the ${siblings.length} in this page`;
  const known = new Map(run.ancestors.map(([id, ...rest]) => [id, rest]));
  const inPage = new Map(siblings.map((a) => [place(a).individual, a]));
  const items = [];
  for (let id = animat.individual; known.has(id);) {
    const [generation, eq6, parent, other] = known.get(id), item = document.createElement("li");
    let text = `generation ${generation}: individual ${id}, ${eq6.toFixed(2)} d`;
    if (other >= 0) text += `, crossed with ${other}`;
    const a = inPage.get(id);
    if (a === undefined) item.textContent = text;
    else {
      const button = document.createElement("button");
      button.textContent = text + (a === state.a ? " (shown)" : "");
      button.onclick = () => choose(a);
      item.append(button);
    }
    items.push(item);
    id = parent;
  }
  $("ancestors").replaceChildren(...items);
}

// ---- What people do ----

function save(name, data) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([data]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
const fileName = (what) => `${loaded[state.a].heading.replace(/[^A-Za-z0-9]+/g, "-").slice(0, 60)}-${what}`;
const actions = {
  play: () => setPlaying(!(state.playing && state.direction > 0), 1),
  reverse: () => setPlaying(!(state.playing && state.direction < 0), -1),
  step: (n) => { setPlaying(false); seek(round(state.t) + n); },
  part: (n) => {
    const { parts } = loaded[state.a], now = parts.indexOf(partAt(loaded[state.a], state.t)[0]);
    seek(parts[clamp(n < 0 && state.t > parts[now].start ? now : now + n, 0, parts.length - 1)].start);
  },
  speed: (n) => { state.speed = SPEEDS[clamp(SPEEDS.indexOf(state.speed) + n, 0, SPEEDS.length - 1)]; },
  next: (key, values, n = 1) => { state[key] = values[(values.indexOf(state[key]) + n) % values.length]; },
  flip: (key) => { state[key] = !state[key]; },
  zoom: (factor) => { state.zoom = clamp(state.zoom * factor, 0.2, 20); },
  animat: (n) => choose((state.a + n + page.lives) % page.lives),
};
function changed() { showControls(); if (!state.playing) writeAddress(); redraw(); }

function connect() {
  for (const speed of SPEEDS) $("speed").add(new Option(`${speed}\u00d7`, speed));
  for (const [kind, name] of Object.entries(COLOURS)) $("colour").add(new Option(name, kind));
  for (let a = 0; a < page.lives; ++a) $("animat").add(new Option(nameOf(a), a));
  $("choice").hidden = page.lives < 2;
  $("command").textContent = page.command;
  $("play").onclick = actions.play;
  $("reverse").onclick = actions.reverse;
  $("back").onclick = () => actions.step(-1);
  $("forth").onclick = () => actions.step(1);
  $("before").onclick = () => actions.animat(-1);
  $("after").onclick = () => actions.animat(1);
  $("animat").onchange = () => choose(+$("animat").value);
  $("seek").oninput = () => seek(+$("seek").value);
  $("generation").oninput = () => choose(siblings[+$("generation").value]);
  for (const key of SWITCHES) $(key).onclick = () => { actions.flip(key); changed(); };
  $("speed").onchange = () => { state.speed = +$("speed").value; changed(); };
  $("colour").onchange = () => { state.colour = $("colour").value; ownColour = true; changed(); };
  $("camera").onchange = () => { state.camera = $("camera").value; changed(); };
  $("genome").onclick = async () => save(fileName("genome.json"), await inflateText(loaded[state.a].genome));
  $("body").onclick = () => { // of the motion shown, else of the last one before it
    const animat = loaded[state.a], bodies = animat.parts.filter((part) => part.motion?.status === "ok");
    const part = bodies.filter((one) => one.start <= state.t).at(-1) ?? bodies[0];
    save(fileName(`${part.motion.name}.json`), part.motion.text);
  };
  $("picture").onclick = () => canvas.toBlob((blob) => save(fileName(`${round(state.t)}.png`), blob));

  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const typed = event.target.tagName, { key } = event;
    if (typed === "SELECT" || (event.target.id === "generation" && key.startsWith("Arrow"))) return;
    if (key === " " && (typed === "BUTTON" || typed === "SUMMARY")) return;
    const far = event.shiftKey ? 10 : 1, cameras = ["follow", "stay", "path"];
    const keys = { " ": actions.play, ArrowLeft: () => actions.step(-far), ArrowRight: () => actions.step(far),
      Home: () => seek(0), End: () => seek(loaded[state.a].length), "[": () => actions.part(-1), "]": () => actions.part(1),
      r: actions.reverse, l: () => actions.flip("loop"), ",": () => actions.speed(-1), ".": () => actions.speed(1),
      c: () => { ownColour = true; actions.next("colour", Object.keys(COLOURS)); }, v: () => actions.next("camera", cameras),
      t: () => actions.flip("trail"), z: () => { if (page.lives > 1) actions.flip("zoo"); },
      ArrowUp: () => actions.animat(-1), ArrowDown: () => actions.animat(1), "+": () => actions.zoom(1.25), "-": () => actions.zoom(0.8) };
    if (!keys[key] || !loaded[state.a]) return;
    event.preventDefault();
    keys[key]();
    changed();
  });

  // A stroke seeks, a tap plays; in the zoo it chooses. Two fingers are the browser's, to zoom.
  let stroke = null;
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    stroke = { x: event.offsetX, t: state.t, moved: false };
  };
  canvas.onpointermove = (event) => {
    if (!stroke) return;
    const way = event.offsetX - stroke.x;
    stroke.moved ||= abs(way) > 6;
    if (stroke.moved) seek(stroke.t + way * 2);
  };
  canvas.onpointercancel = () => { stroke = null; };
  canvas.onpointerup = ({ offsetX: x, offsetY: y }) => {
    const tap = stroke && !stroke.moved;
    stroke = null;
    if (!tap) return;
    if (!state.zoo) { actions.play(); return; }
    const box = zooBoxes(canvas.clientWidth, canvas.clientHeight).find((one) =>
      x >= one.x && x < one.x + one.w && y >= one.y && y < one.y + one.h);
    if (box) { state.zoo = false; choose(box.a); }
  };
  addEventListener("hashchange", () => { readAddress(); choose(state.a); });
  addEventListener("resize", redraw);
  dark.addEventListener("change", () => { readTheme(); redraw(); });
}

// For whoever drives the page.
const replay = window.replay = { state, drawn: 0, life: fetchLife, whole: () => painted && !wanted, cellsAt, signalsAt,
  seek: (a, t) => choose(a).then(() => seek(t)) };

readTheme();
readAddress();
connect();
choose(state.a);
})();
