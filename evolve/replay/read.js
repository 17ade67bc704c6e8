// Plays the lives that the page holds. What lies in the data, and how: page.cpp, track_code.h,
// development_code.h. Times on the timeline are steps of the paper from the egg on; the moments at
// which a body is cut out of its embryo stand still in life and last CUT steps here.
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
