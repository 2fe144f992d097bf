// Puts the page of a plan together and links the cursor of all drawings.

// The kinds of what limits the machine: name of the colour, and words for the legend.
const KINDS = [
  ["waiting", "standing"], ["jerk", "jerk of an axis"], ["acceleration", "acceleration of an axis"],
  ["velocity", "velocity of an axis"], ["path", "greatest path velocity"], ["between", "between limits"],
  ["feed", "programmed feed"],
];
const kindOf = data.causes.map(({ kind }) => KINDS.findIndex(([name]) => name === kind));
const bySpeed = { ...colouring };
const byCause = {
  colours: () => KINDS.map(([name]) => colour(name)),
  step: (i) => kindOf[path.cause[i]] ?? 0,
};

function fillHeader() {
  const period = number(report.servo_period * 1e3, 4);
  const cycles = `${number(report.cycles, 9)} servo cycles of ${period} ms`;
  byId("about").textContent = [report.machine, cycles, `limits: ${report.limits_from}`].filter(Boolean).join("  \u00b7  ");
}

function fillFigures() {
  const add = (label, [value, of], note) => {
    const figure = element("div", "figure", element("span", "", label));
    figure.append(element("b", "", value, " ", element("small", "", of)), element("span", "", note));
    byId("figures").append(figure);
  };
  const { greatest_speed: speed, deviation } = report;
  const phase = (name) => report.phases.find((share) => share.name === name);
  add("Time", duration(report.time), `${report.time.toFixed(3)} s, ${duration(phase("standing").time).join(" ")} standing`);
  add("At feed", [number(100 * phase("at feed").share, 3), "%"], `${duration(phase("at feed").time).join(" ")} of the time`);
  const turning = phase("in corners and curves");
  add("Below feed in corners", [number(100 * turning.share, 3), "%"], `costs ${duration(turning.lost).join(" ")}`);
  add("Path length", [number(report.path_length, 6), unit], `${number(report.moves, 9)} moves`);
  add("Peak speed", [number(speed.value, 4), `${unit}/s`], `${number(speed.value * 60, 5)} ${unit}/min, line ${speed.line}`);
  const { planned, tightest } = deviation;
  const used = tightest ? `${number((100 * tightest.distance) / tightest.tolerance, 3)} % of P at most` : "";
  add("Off the program", length(planned.distance), [`line ${planned.line}`, used].filter(Boolean).join(", "));
  byId("figures").style.setProperty("--columns", 6);
}

function fillLegend() {
  byId("legend").replaceChildren();
  if (colouring.step === byCause.step) {
    const there = new Set(Array.from(path.cause, (cause) => kindOf[cause]));
    KINDS.forEach(([name, words], kind) => {
      if (!there.has(kind)) return;
      const entry = element("span", "swatch", words);
      entry.style.setProperty("--swatch", `var(--${name})`);
      byId("legend").append(entry);
    });
    return;
  }
  const marks = [0, 0.25, 0.5, 0.75, 1].map((share) => element("span", "", number(share * greatestSpeed, 3)));
  const scale = element("div", "scale", element("i"), element("div", "", ...marks));
  scale.append(`speed along the path (${unit}/s)`);
  byId("legend").append(scale);
}

function bar(share) {
  const made = element("span", "bar", element("i"));
  made.firstChild.style.width = `${Math.min(100, 100 * share)}%`;
  return made;
}

function fillTimes() {
  const rows = (shares) => shares.map((share) => {
    const name = element("span", share.cause === undefined ? "" : "swatch", share.name);
    if (share.cause !== undefined) name.style.setProperty("--swatch", `var(--${data.causes[share.cause].kind})`);
    return [name, share.time.toFixed(3), `${(100 * share.share).toFixed(1)} %`, bar(share.share), share.lost.toFixed(3)];
  });
  const headings = (first) => [first, "Time (s)", "", "", "Lost (s)"];
  byId("phases").append(table(headings("What it does"), rows(report.phases), [1, 2, 4]));
  byId("causes").append(table(headings("What keeps it from being faster"), rows(report.limited_by), [1, 2, 4]));
}

function fillPlaces() {
  if (!report.slowest.length) return;
  byId("slow").hidden = false;
  const rows = report.slowest.map((place) => [
    String(place.line), place.time.toFixed(3), place.lost.toFixed(4), number(place.least_speed, 4),
    `${(100 * place.least_share).toFixed(0)} %`, place.phase, place.cause,
    place.position.map((v) => v.toFixed(3).replace("-", "\u2212")).join(",  "), element("code", "", place.text),
  ]);
  const headings = ["Line", "at (s)", "Lost (s)", `Slowest (${unit}/s)`, "of the feed", "What it does", "Limited by", `X, Y, Z (${unit})`, "Program"];
  const made = table(headings, rows, [0, 1, 2, 3, 4]);
  byId("places").append(made);
  made.querySelectorAll("tbody tr").forEach((row, i) => row.addEventListener("click", () => {
    setTime(report.slowest[i].time);
    byId("path-title").scrollIntoView({ behavior: "smooth" });
  }));
}

function fillPeaks() {
  const rows = report.axes.flatMap((axis) => axis.peaks.map((peak, i) => [
    i ? "" : axis.letter, peak.quantity, number(peak.peak, 6), peak.limit === null ? "\u2013" : number(peak.limit, 6),
    rateUnit(axis.unit, peak.quantity), bar(peak.share ?? 0), peak.share === null ? "\u2013" : `${(peak.share * 100).toFixed(1)} %`,
    peak.time.toFixed(3), String(peak.line),
  ]));
  const headings = ["Axis", "Quantity", "Peak", "Limit", "Unit", "Share of the limit", "", "at (s)", "Line"];
  byId("peaks").append(table(headings, rows, [2, 3, 6, 7, 8], 3));
}

function fillAccuracy() {
  const { planned, programmed: points, tightest, exact } = report.deviation;
  const rows = [];
  const add = (text, figure) => {
    if (!figure) return;
    const given = figure.tolerance === null ? "G64 without P" : figure.tolerance === 0 ? "exact" : length(figure.tolerance).join(" ");
    const share = figure.tolerance ? `${number((100 * figure.distance) / figure.tolerance, 3)} %` : "";
    rows.push([text, length(figure.distance).join(" "), given, share, String(figure.line)]);
  };
  add("Planned path, farthest from the program", planned);
  add("Programmed point, farthest from the planned path", points);
  add("Where the tolerance is used up most", tightest);
  add("In exact modes (G61, G61.1)", exact);
  byId("accuracy").append(table(["", "Distance", "Tolerance", "Used", "Line"], rows, [1, 2, 3, 4]));
}

const lineText = new Map(data.listing.lines);
function fillListing() {
  if (!data.listing.whole) return;
  byId("program").hidden = false;
  byId("program-name").textContent = report.program;
  for (const [line, text] of data.listing.lines) {
    const item = element("li", "", text);
    item.setAttribute("value", line);
    byId("listing").append(item);
  }
}

let marked = null;
function markLine(line) {
  const item = line > 0 && data.listing.whole ? byId("listing").children[line - 1] : null;
  if (item === marked) return;
  if (marked) marked.classList.remove("current");
  marked = item || null;
  if (!item) return;
  item.classList.add("current");
  const list = byId("listing");
  const top = item.offsetTop - list.offsetTop;
  if (top < list.scrollTop || top > list.scrollTop + list.clientHeight - 40) list.scrollTop = top - list.clientHeight / 2;
}

// What limits the machine at a time, of the point of the path that was kept last.
function causeAt(time) {
  let low = 0;
  let high = path.time.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (path.time[middle] < time) low = middle + 1;
    else high = middle;
  }
  return data.causes[path.cause[low]]?.name ?? "";
}

function fillCursor(point) {
  const bottom = byId("cursor");
  bottom.hidden = !point;
  if (!point) return;
  const entry = (label, text) => element("span", "", element("em", "", label), text);
  bottom.replaceChildren(
    entry("time", `${point.time.toFixed(3)} s`),
    entry("line", point.line > 0 ? String(point.line) : "\u2013"),
    ...["x", "y", "z"].map((axis) => entry(axis.toUpperCase(), point[axis].toFixed(3).replace("-", "\u2212"))),
    entry("speed", `${number(point.speed, 4)} ${unit}/s`),
    entry("limited by", causeAt(point.time)),
    element("code", "", lineText.get(point.line) ?? ""),
  );
  markLine(point.line);
}

let drawings = [];
function setTime(time) {
  const point = time === null ? null : locate(time);
  for (const drawing of drawings) drawing.show(point);
  fillCursor(point);
}
function redraw() {
  for (const drawing of drawings) drawing.draw();
}

fillHeader();
fillFigures();
fillLegend();
fillTimes();
fillPlaces();
fillPeaks();
fillAccuracy();
fillListing();
byId("method").textContent =
  "Planned with the library of blendtp, driven as LinuxCNC\u2019s servo thread drives it, one move handed over in each cycle, all overrides at 100 %. " +
  "Velocity, acceleration and jerk are the first, second and third difference of the planned positions at the servo period. " +
  "The time is that from the first motion to the last; lost is what would be saved if a stretch were run at the feed of its moves. " +
  `The drawn path is thinned out to ${number(path.x.length, 9)} points, the curves to ${number(bucketTime.length, 9)} spans of time with their least and greatest values.`;

const plan = makePlan(byId("plan"), setTime);
const space = makeSpace(byId("space"), setTime);
const columns = memberColumns(report.axes, data.profiles.axes);
columns.push({
  letter: "Path", name: "", curves: [
    { ...data.profiles.speed, title: `speed (${unit}/s)`, limit: null, unit: `${unit}/s`, oneSided: true },
    distanceCurve(data.profiles.distance, null),
  ],
});
drawings = [space, plan, ...makeProfiles(byId("profiles"), columns, setTime, (from, to) => {
  span.from = from;
  span.to = to;
  redraw();
})];
for (const button of document.querySelectorAll("[data-plan]")) {
  button.addEventListener("click", () => plan.enlarge(Number(button.dataset.plan)));
}
for (const button of document.querySelectorAll("[data-space]")) {
  button.addEventListener("click", () => space.enlarge(Number(button.dataset.space)));
}
for (const choice of document.querySelectorAll("[name=colours]")) {
  choice.addEventListener("change", () => {
    Object.assign(colouring, choice.value === "cause" ? byCause : bySpeed);
    fillLegend();
    redraw();
  });
}
for (const holder of document.querySelectorAll(".canvas")) holder.addEventListener("pointerleave", () => setTime(null));
byId("listing").addEventListener("click", (event) => {
  const line = Number(event.target.closest("li")?.getAttribute("value"));
  const index = path.line.indexOf(line);
  if (line && index >= 0) setTime(path.time[index]);
});
window.addEventListener("resize", redraw);
for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", redraw);
redraw();
