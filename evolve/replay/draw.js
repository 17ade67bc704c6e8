// Draws a moment of a life, or of all lives of the page, into a canvas.

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

// Copies lie below the body, see-through; the reference above it, an outline that hides no colour.
function drawGhost(g, view, motion, now, isCopy) {
  pen(g, isCopy ? theme.faint : theme.ghost, max(0.08, 1.6 * view.pixel));
  if (isCopy) {
    const path = new Path2D();
    for (const t of motion.triangles) polygon(path, t.map((i) => [now.x[i], now.y[i]]));
    g.fillStyle = theme.faint;
    g.globalAlpha = 0.15;
    g.fill(path);
    g.globalAlpha = 0.5;
  }
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
const linksAt = (development, step) => development.links.filter(([, , from, to]) => from <= step && step < to);
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
  g.stroke(lines(linksAt(development, step), cells));
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
        if (there) drawGhost(g, view, motion, there, true); else whole &&= copy.frames === 0;
      }
    }
    if (now) drawBody(g, view, motion, now, kind); else whole = motion.track.frames === 0;
    if (state.reference && motion.reference) {
      const there = motion.reference.at(frame);
      if (there) drawGhost(g, view, motion, there); else whole &&= motion.reference.frames === 0;
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
