// What stands around the picture: words, parts of life, controls, lineage; and what people do.

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
    const where = motion.ground ? `on ${motion.scene}` : `in ${motion.scene}`;
    text = `${motion.name} ${where}, step ${local.toFixed(0)} of ${motion.length.toFixed(0)} (${(local * page.paper_step).toFixed(1)} time units); ` +
      `${motion.distance.toFixed(2)} d in all` + (motion.outcome === "ok" ? "" : ` (${motion.outcome})`);
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
const replay = window.replay = { state, drawn: 0, life: fetchLife, whole: () => painted && !wanted, cellsAt, linksAt, signalsAt,
  seek: (a, t) => choose(a).then(() => seek(t)) };

readTheme();
readAddress();
connect();
choose(state.a);
