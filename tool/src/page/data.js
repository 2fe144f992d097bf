// The data of the page, colours and number formats.

const data = JSON.parse(document.getElementById("data").textContent);
const report = data.report;

// Columns are little-endian 32-bit numbers in base64.
function decode(text, Kind) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const read = Kind === Int32Array ? "getInt32" : "getFloat32";
  return Kind.from({ length: bytes.length / 4 }, (_, i) => view[read](4 * i, true));
}

const path = {};
for (const name of ["time", "x", "y", "z", "speed"]) path[name] = decode(data.path[name], Float32Array);
for (const name of ["line", "source", "cause", "rapid"]) path[name] = decode(data.path[name] ?? "", Int32Array);
const programmed = {};
for (const name of ["x", "y", "z"]) programmed[name] = decode(data.programmed[name], Float32Array);
programmed.rapid = decode(data.programmed.rapid, Int32Array);
const bucketTime = decode(data.profiles.time, Float32Array);
const endTime = data.profiles.end;

const unit = report.length_unit;
const speedUnit = data.speed_unit ?? `${unit}/s`;
const greatestSpeed = Math.max(report.greatest_speed.value, 1e-9);

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}

// The colours of the speed scale, slow to fast, in steps fine enough to look continuous.
const SPEED_STEPS = 32;
function speedColours() {
  const stops = [0, 1, 2, 3, 4].map((i) => colour("speed-" + i).match(/[0-9a-f]{2}/gi).map((h) => parseInt(h, 16)));
  return Array.from({ length: SPEED_STEPS }, (_, i) => {
    const at = (i / (SPEED_STEPS - 1)) * 4;
    const low = Math.min(3, Math.floor(at));
    const mixed = stops[low].map((c, k) => Math.round(c + (at - low) * (stops[low + 1][k] - c)));
    return `rgb(${mixed})`;
  });
}
function speedStep(speed) {
  return Math.max(0, Math.min(SPEED_STEPS - 1, Math.floor((speed / greatestSpeed) * SPEED_STEPS)));
}

// How the path is coloured: a list of colours, and the colour of the stroke that ends at a point. The first colours are
// drawn on top.
const colouring = { colours: speedColours, step: (i) => speedStep((path.speed[i - 1] + path.speed[i]) / 2) };

// At most `digits` significant digits, thin groups of thousands, a real minus sign.
function number(value, digits = 5) {
  if (value === 0 || Math.abs(value) < 1e-12) return "0";
  const decimals = Math.max(0, Math.min(9, digits - Math.floor(Math.log10(Math.abs(value))) - 1));
  let text = Math.abs(value).toFixed(decimals);
  if (text.includes(".")) text = text.replace(/\.?0+$/, "");
  const [whole, fraction] = text.split(".");
  const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
  return (value < 0 ? "\u2212" : "") + grouped + (fraction ? "." + fraction : "");
}

// A length, or an angle, as [number, unit]: small lengths in micrometres.
function length(value, measure = unit) {
  if (measure !== "mm") return [fixed(value, 6), measure];
  if (value >= 0.1) return [number(value, value < 1 ? 3 : 5), "mm"];
  return [value < 1e-8 ? "0" : number(value * 1e3, 3), "\u00b5m"];
}

const SUPERSCRIPT = { velocity: "", acceleration: "\u00b2", jerk: "\u00b3" };
function rateUnit(lengthUnit, quantity) {
  return `${lengthUnit === "deg" ? "\u00b0" : lengthUnit}/s${SUPERSCRIPT[quantity]}`;
}

function duration(seconds) {
  if (seconds < 60) return [number(seconds, 5), "s"];
  return [`${Math.floor(seconds / 60)}:${fixed(seconds % 60, 1).padStart(4, "0")}`, "min"];
}

// Round numbers that divide low..high into about `count` parts.
function ticks(low, high, count) {
  const raw = (high - low) / Math.max(1, count);
  if (!(raw > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; i++) found.push(i * step);
  return found;
}

// An element with a class, text and children.
function element(name, className, ...children) {
  const made = document.createElement(name);
  if (className) made.className = className;
  made.append(...children);
  return made;
}

// Two canvases on top of each other: the drawing, and the cursor that moves over it.
function layers(holder) {
  const canvases = [element("canvas"), element("canvas")];
  holder.append(...canvases);
  const prepare = (canvas) => {
    const ratio = window.devicePixelRatio || 1;
    const { width, height } = holder.getBoundingClientRect();
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.font = "12px system-ui, 'Segoe UI', 'Noto Sans', 'Liberation Sans', sans-serif";
    context.lineJoin = "round";
    return { context, width, height };
  };
  return { base: () => prepare(canvases[0]), overlay: () => prepare(canvases[1]) };
}

// The position on the path at a time: index of the sample before it and the share of the way on.
function locate(time) {
  let low = 0;
  let high = path.time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (path.time[middle] <= time) low = middle;
    else high = middle;
  }
  const span = path.time[high] - path.time[low];
  const share = span > 0 ? Math.max(0, Math.min(1, (time - path.time[low]) / span)) : 0;
  const mix = (column) => column[low] + share * (column[high] - column[low]);
  const nearest = share >= 1 ? high : low;
  return {
    time, x: mix(path.x), y: mix(path.y), z: mix(path.z), speed: mix(path.speed),
    line: path.line[nearest], source: path.source[nearest],
  };
}
