// What is the report's own on its page.

function fillVerdict() {
  const words = { pass: "Within all limits", incomplete: "Not all could be checked", fail: "Over a limit" };
  document.querySelector("header").append(element("p", `verdict ${report.verdict}`, words[report.verdict]));
  const findings = report.findings.map((finding) => element("li", "", element("span", "", finding)));
  const list = element("ul", report.verdict, ...findings);
  list.id = "findings";
  byId("figures").before(list);
}

function fillFigures() {
  const { time, moves, greatest_speed: speed } = report;
  addFigure("Time in motion", duration(time.in_motion), `${duration(time.standing).join(" ")} standing`);
  const count = moves.programmed === null ? "" : `${number(moves.programmed, 9)} moves programmed, `;
  addFigure("Path length", [number(report.path_length, 6), unit], `${count}${number(moves.ids_seen, 9)} executed`);
  addFigure("Peak speed", [number(speed.value, 4), `${unit}/s`], `${number(speed.value * 60, 5)} ${unit}/min, at ${number(speed.time, 6)}\u00a0s`);
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
    addFigure(`Peak ${quantity}`, [number(peak.share * 100, 4), "%"], value);
  }
  if (report.frame_changes.length) {
    const moved = Math.max(...report.frame_changes.map((c) => c.joint_movement));
    const text = moved > 2 * report.resolution ? `a joint moved by ${length(moved).join("\u00a0")}` : "no joint moved";
    addFigure("Frame changes", [String(report.frame_changes.length), ""], text);
  }
  const found = report.path;
  if (found && found.result === "followed") {
    const passed = `points passed at ${length(found.programmed.distance).join("\u00a0")}`;
    addFigure("Off the path", length(found.executed.distance), `${passed}, final error ${length(found.final_position_error).join("\u00a0")}`);
  } else if (found) {
    addFigure("Off the path", ["> " + length(found.farther_than)[0], length(found.farther_than)[1]], `at ${number(found.place.time, 6)} s`);
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
  byId("legend").append(speedScale("executed path, speed"));
  if (programmed.x.length === 0) return;
  byId("legend").append(element("span", "key", "programmed path"));
  if (programmed.rapid.includes(1)) byId("legend").append(element("span", "key rapid", "programmed, rapid"));
}

const JUDGEMENT = { within: ["within", "pass"], over: ["OVER", "fail"], unresolved: ["too few decimals", "incomplete"], not_limited: ["not limited", "quiet"] };

function fillPeaks() {
  const rows = [];
  for (const member of [...report.joints, ...report.axes]) {
    member.peaks.forEach((peak, i) => {
      const [word, className] = JUDGEMENT[peak.judgement];
      const name = element("span", "", i ? "" : `${member.letter} `, element("span", "quiet", i ? "" : member.name));
      rows.push([
        name, ...peakCells(peak, member.unit),
        element("span", className, word), fixed(peak.time, 3), String(peak.line),
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
  const point = (p) => p.map((v) => fixed(v, 4)).join(",  ");
  const rows = [];
  if (found.result === "departed") {
    rows.push(["The executed path leaves the programmed path", "> " + length(found.farther_than).join(" "), "", fixed(found.place.time, 3), String(found.source_line)]);
  } else {
    const line = (far) => String(far.source_line) + (far.source_file ? ` of file ${far.source_file}` : "");
    const add = (text, far) => rows.push([text, length(far.distance).join(" "), point(far.point), fixed(far.time, 3), line(far)]);
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
  const rows = report.frame_changes.map((c) => [fixed(c.time, 3), String(c.line), number(c.axis_step, 6), number(c.joint_movement, 4)]);
  byId("frames-table").append(table(["at (s)", "Line", `Step of an axis (${unit})`, `Joint movement (${unit})`], rows, [0, 1, 2, 3]));
}

// The lines of the listing are those of the source or those of the recording.
const lines = data.listing?.by_source ? path.source : path.line;
function describe(point) {
  const line = data.listing?.by_source ? point.source : point.line;
  return { line, text: data.listing?.lines[line - 1] ?? "", more: [] };
}

fillAbout([report.machine, data.recording, cycles(report.rows)]);
fillVerdict();
fillFigures();
fillLegend();
fillPeaks();
fillAccuracy();
fillFrames();
if (data.listing) fillListing(data.listing.note, data.listing.lines.map((text, i) => [i + 1, text]));
byId("method").textContent =
  "Velocity, acceleration and jerk are the first, second and third difference of the recorded positions at the servo period. " +
  "The joints are the commanded positions after LinuxCNC\u2019s own interpolation, the axes are the output of the planner. " +
  "Distances are those of each recorded position from the exact lines and arcs of the program, and of its points from the recorded path, both passed in order. " +
  `Positions are recorded to ${power(report.resolution)} ${unit}.`;

const columns = memberColumns(report.joints, data.profiles.joints);
if (data.profiles.distance) {
  const curves = [distanceCurve(data.profiles.distance, report.path.tolerance)];
  columns.push({ letter: "Path", name: "distance from the programmed path", curves });
}
drawPage(columns, lines, describe);
