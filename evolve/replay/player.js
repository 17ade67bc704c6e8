// What is shown and when: the moment, its address, the clock, and who is chosen.

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
