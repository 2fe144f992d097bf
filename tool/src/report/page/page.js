// Puts the page together and links the cursor of all drawings.

function fillHeader() {
  const period = number(report.servo_period * 1e3, 4);
  const parts = [report.machine, data.recording, `${number(report.rows, 9)} servo cycles of ${period} ms`];
  byId("about").textContent = parts.filter(Boolean).join("  \u00b7  ");
  const words = { pass: "Within all limits", incomplete: "Not all could be checked", fail: "Over a limit" };
  byId("verdict").textContent = words[report.verdict];
  byId("verdict").classList.add(report.verdict);
  byId("findings").classList.add(report.verdict);
  for (const finding of report.findings) {
    byId("findings").append(element("li", "", element("span", "", finding)));
  }
}

function fillFigures() {
  const add = (label, [value, of], note) => {
    const figure = element("div", "figure", element("span", "", label));
    figure.append(element("b", "", value, " ", element("small", "", of)), element("span", "", note));
    byId("figures").append(figure);
  };
  const { time, moves, greatest_speed: speed } = report;
  add("Time in motion", duration(time.in_motion), `${duration(time.standing).join(" ")} standing`);
  const count = moves.programmed === null ? "" : `${number(moves.programmed, 9)} moves programmed, `;
  add("Path length", [number(report.path_length, 6), unit], `${count}${number(moves.ids_seen, 9)} executed`);
  add("Peak speed", [number(speed.value, 4), `${unit}/s`], `${number(speed.value * 60, 5)} ${unit}/min, at ${number(speed.time, 6)}\u00a0s`);
  for (const quantity of ["acceleration", "jerk"]) {
    let worst = null;
    for (const joint of report.joints) {
      for (const peak of joint.peaks) {
        if (peak.quantity === quantity && peak.share !== null && (!worst || peak.share > worst.peak.share)) worst = { joint, peak };
      }
    }
    if (!worst) continue;
    const { joint, peak } = worst;
    const value = `${number(peak.peak, 5)} of ${number(peak.limit, 5)} ${rateUnit(joint.unit, quantity)}, ${joint.letter}`;
    add(`Peak ${quantity}`, [number(peak.share * 100, 4), "%"], value);
  }
  if (report.frame_changes.length) {
    const moved = Math.max(...report.frame_changes.map((c) => c.joint_movement));
    const text = moved > 2 * report.resolution ? `a joint moved by ${length(moved).join("\u00a0")}` : "no joint moved";
    add("Frame changes", [String(report.frame_changes.length), ""], text);
  }
  const found = report.path;
  if (found && found.result === "followed") {
    const passed = `points passed at ${length(found.programmed.distance).join("\u00a0")}`;
    add("Off the path", length(found.executed.distance), `${passed}, final error ${length(found.final_position_error).join("\u00a0")}`);
  } else if (found) {
    add("Off the path", ["> " + length(found.farther_than)[0], length(found.farther_than)[1]], `at ${number(found.place.time, 6)} s`);
  }
  const shown = byId("figures").children.length;
  byId("figures").style.setProperty("--columns", shown > 6 ? Math.ceil(shown / 2) : shown);
}

// Small powers of ten in print: 10\u207b\u00b9\u00b2.
function power(value) {
  const digits = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079";
  const exponent = Math.round(-Math.log10(value));
  return exponent <= 3 ? String(value) : `10\u207b${[...String(exponent)].map((d) => digits[d]).join("")}`;
}

function fillLegend() {
  const marks = [0, 0.25, 0.5, 0.75, 1].map((share) => element("span", "", number(share * greatestSpeed, 3)));
  const scale = element("div", "scale", element("i"), element("div", "", ...marks));
  scale.append(`executed path, speed (${unit}/s)`);
  byId("legend").append(scale);
  if (programmed.x.length === 0) return;
  byId("legend").append(element("span", "key", "programmed path"));
  if (programmed.rapid.includes(1)) byId("legend").append(element("span", "key rapid", "programmed, rapid"));
}

const JUDGEMENT = { within: ["within", "pass"], over: ["OVER", "fail"], unresolved: ["too few decimals", "incomplete"], not_limited: ["not limited", "quiet"] };

function fillPeaks() {
  const rows = [];
  for (const member of [...report.joints, ...report.axes]) {
    member.peaks.forEach((peak, i) => {
      const bar = element("span", "bar", element("i", peak.judgement === "over" ? "over" : ""));
      bar.firstChild.style.width = `${Math.min(100, 100 * (peak.share ?? 0))}%`;
      const [word, className] = JUDGEMENT[peak.judgement];
      const name = element("span", "", i ? "" : `${member.letter} `, element("span", "quiet", i ? "" : member.name));
      rows.push([
        name, peak.quantity, number(peak.peak, 6), peak.limit === null ? "\u2013" : number(peak.limit, 6),
        rateUnit(member.unit, peak.quantity), bar, peak.share === null ? "\u2013" : `${(peak.share * 100).toFixed(1)} %`,
        element("span", className, word), peak.time.toFixed(3), String(peak.line),
      ]);
    });
  }
  const headings = ["", "Quantity", "Peak", "Limit", "Unit", "Share of the limit", "", "", "at (s)", "Line"];
  byId("peaks").append(table(headings, rows, [2, 3, 6, 8, 9], 3));
}

function fillAccuracy() {
  const found = report.path;
  if (!found) return;
  byId("accuracy").hidden = false;
  const point = (p) => p.map((v) => v.toFixed(4).replace("-", "\u2212")).join(",  ");
  const rows = [];
  if (found.result === "departed") {
    rows.push(["The executed path leaves the programmed path", "> " + length(found.farther_than).join(" "), "", found.place.time.toFixed(3), String(found.source_line)]);
  } else {
    const line = (far) => String(far.source_line) + (far.source_file ? ` of file ${far.source_file}` : "");
    const add = (text, far) => rows.push([text, length(far.distance).join(" "), point(far.point), far.time.toFixed(3), line(far)]);
    add("Executed path, farthest from the programmed path", found.executed);
    add("Programmed point, farthest from the executed path", found.programmed);
    rows.push(["Final position error", length(found.final_position_error).join(" "), "", "", ""]);
    if (found.not_reached > 0) rows.push(["Programmed path not reached", length(found.not_reached).join(" "), "", "", ""]);
    if (found.tolerance !== null) rows.push(["Tolerance", length(found.tolerance).join(" "), "", "", ""]);
  }
  byId("accuracy-table").append(table(["", "Distance", `X, Y, Z (${unit})`, "at (s)", "Source line"], rows, [1, 3, 4]));
}

function fillFrames() {
  if (!report.frame_changes.length) return;
  byId("frames").hidden = false;
  const rows = report.frame_changes.map((c) => [c.time.toFixed(3), String(c.line), number(c.axis_step, 6), number(c.joint_movement, 4)]);
  byId("frames-table").append(table(["at (s)", "Line", `Step of an axis (${unit})`, `Joint movement (${unit})`], rows, [0, 1, 2, 3]));
}

function fillListing() {
  if (!data.listing) return;
  byId("program").hidden = false;
  byId("program-name").textContent = data.listing.note;
  data.listing.lines.forEach((text, i) => {
    const item = element("li", "", text);
    item.setAttribute("value", i + 1);
    byId("listing").append(item);
  });
}

let marked = null;
function markLine(line) {
  const item = line > 0 && data.listing ? byId("listing").children[line - 1] : null;
  if (item === marked) return;
  if (marked) marked.classList.remove("current");
  marked = item || null;
  if (!item) return;
  item.classList.add("current");
  const list = byId("listing");
  const top = item.offsetTop - list.offsetTop;
  if (top < list.scrollTop || top > list.scrollTop + list.clientHeight - 40) list.scrollTop = top - list.clientHeight / 2;
}

function fillCursor(point) {
  const bar = byId("cursor");
  bar.hidden = !point;
  if (!point) return;
  const entry = (label, text) => element("span", "", element("em", "", label), text);
  const listed = data.listing ? (data.listing.by_source ? point.source : point.line) : 0;
  const shown = data.listing?.by_source ? point.source : point.line;
  bar.replaceChildren(
    entry("time", `${point.time.toFixed(3)} s`),
    entry("line", shown > 0 ? String(shown) : "\u2013"),
    ...["x", "y", "z"].map((axis) => entry(axis.toUpperCase(), point[axis].toFixed(3).replace("-", "\u2212"))),
    entry("speed", `${number(point.speed, 4)} ${unit}/s`),
    element("code", "", listed > 0 ? data.listing.lines[listed - 1] ?? "" : ""),
  );
  markLine(listed);
}

fillHeader();
fillFigures();
fillLegend();
fillPeaks();
fillAccuracy();
fillFrames();
fillListing();
byId("method").textContent =
  "Velocity, acceleration and jerk are the first, second and third difference of the recorded positions at the servo period. " +
  "The joints are the commanded positions after LinuxCNC\u2019s own interpolation, the axes are the output of the planner. " +
  "Distances are those of each recorded position from the exact lines and arcs of the program, and of its points from the recorded path, both passed in order. " +
  `Positions are recorded to ${power(report.resolution)} ${unit}.`;

let drawings = [];
function setTime(time) {
  const point = time === null ? null : locate(time);
  for (const drawing of drawings) drawing.show(point);
  fillCursor(point);
}
function redraw() {
  for (const drawing of drawings) drawing.draw();
}
const plan = makePlan(byId("plan"), setTime);
const space = makeSpace(byId("space"), setTime);
const columns = memberColumns(report.joints, data.profiles.joints);
if (data.profiles.distance) {
  const curves = [distanceCurve(data.profiles.distance, report.path.tolerance)];
  columns.push({ letter: "Path", name: "distance from the programmed path", curves });
}
drawings = [plan, space, ...makeProfiles(byId("profiles"), columns, setTime, (from, to) => {
  span.from = from;
  span.to = to;
  redraw();
})];
for (const button of document.querySelectorAll("[data-zoom]")) {
  button.addEventListener("click", () => plan.enlarge(Number(button.dataset.zoom)));
}
for (const holder of document.querySelectorAll(".canvas")) holder.addEventListener("pointerleave", () => setTime(null));
byId("listing").addEventListener("click", (event) => {
  const line = Number(event.target.closest("li")?.getAttribute("value"));
  const column = data.listing?.by_source ? path.source : path.line;
  const index = column.indexOf(line);
  if (line && index >= 0) setTime(path.time[index]);
});
window.addEventListener("resize", redraw);
for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", redraw);
redraw();
