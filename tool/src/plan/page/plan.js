// What is the plan's own on its page.

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

function fillFigures() {
  const { greatest_speed: speed, deviation } = report;
  const phase = (name) => report.phases.find((share) => share.name === name);
  addFigure("Time", duration(report.time), `${fixed(report.time, 3)} s, ${duration(phase("standing").time).join(" ")} standing`);
  addFigure("At feed", [number(100 * phase("at feed").share, 3), "%"], `${duration(phase("at feed").time).join(" ")} of the time`);
  const turning = phase("in corners and curves");
  addFigure("Below feed in corners", [number(100 * turning.share, 3), "%"], `costs ${duration(turning.lost).join(" ")}`);
  addFigure("Path length", [number(report.path_length, 6), unit], `${number(report.moves, 9)} moves`);
  addFigure("Peak speed", [number(speed.value, 4), `${speed.unit}/s`], `${number(speed.value * 60, 5)} ${speed.unit}/min, line ${speed.line}`);
  const { planned, tightest } = deviation;
  const used = tightest ? `${number((100 * tightest.distance) / tightest.tolerance, 3)} % of P at most` : "";
  addFigure("Off the program", length(planned.distance, deviation.unit), [`line ${planned.line}`, used, data.advice].filter(Boolean).join(", "));
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
  byId("legend").append(speedScale("speed along the path"));
}

function fillTimes() {
  const rows = (shares) => shares.map((share) => {
    const name = element("span", share.cause === undefined ? "" : "swatch", share.name);
    if (share.cause !== undefined) name.style.setProperty("--swatch", `var(--${data.causes[share.cause].kind})`);
    return [name, fixed(share.time, 3), `${fixed(100 * share.share, 1)} %`, bar(share.share), fixed(share.lost, 3)];
  });
  const headings = (first) => [first, "Time (s)", "", "", "Lost (s)"];
  byId("phases").append(table(headings("What it does"), rows(report.phases), [1, 2, 4]));
  byId("causes").append(table(headings("What keeps it from being faster"), rows(report.limited_by), [1, 2, 4]));
}

const text = (place) => place.of_program ? element("code", "", place.text) : "in a subroutine's file";

function fillPlaces() {
  if (!report.slowest.length) return;
  byId("slow").hidden = false;
  const units = new Set(report.slowest.map((place) => place.speed_unit));
  const slowest = units.size > 1 ? "Slowest" : `Slowest (${report.slowest[0].speed_unit}/s)`;
  const rows = report.slowest.map((place) => [
    String(place.line), fixed(place.time, 3), fixed(place.lost, 4), number(place.least_speed, 4) + (units.size > 1 ? ` ${place.speed_unit}/s` : ""),
    `${fixed(100 * place.least_share, 0)} %`, place.phase, place.cause,
    place.position.map((v) => fixed(v, 3)).join(",  "), text(place),
  ]);
  const headings = ["Line", "at (s)", "Lost (s)", slowest, "of the feed", "What it does", "Limited by", `X, Y, Z (${unit})`, "Program"];
  const made = table(headings, rows, [0, 1, 2, 3, 4]);
  byId("places").append(made);
  made.querySelectorAll("tbody tr").forEach((row, i) => row.addEventListener("click", () => {
    setTime(report.slowest[i].time);
    byId("path-title").scrollIntoView({ behavior: "smooth" });
  }));
}

function fillEvenness() {
  const { total, feeds, below } = report.evenness;
  if (total.share === null) return;
  byId("even").hidden = false;
  const row = (name, cutting) => [name, fixed(cutting.time, 3), `${fixed(100 * cutting.share, 1)} %`, bar(cutting.share)];
  const all = [row("all", total), ...feeds.map((feed) => row(`F${number(feed.feed, 4)}`, feed))];
  byId("feeds").append(table(["Feed", "Cutting (s)", "Near it", ""], all, [1, 2]));
  const rows = below.map((stretch) => [
    `${stretch.lines[0]} to ${stretch.lines[1]}`, fixed(stretch.time, 3), fixed(stretch.duration, 4),
    `${fixed(100 * stretch.least_share, 0)} %`, stretch.cause, text(stretch),
  ]);
  byId("below").append(table(["Lines", "Slowest at (s)", "Below (s)", "Least of the feed", "Limited by", "Program"], rows, [0, 1, 2, 3]));
}

function fillPeaks() {
  const rows = report.axes.flatMap((axis) => axis.peaks.map((peak, i) => [
    i ? "" : axis.letter, ...peakCells(peak, axis.unit), fixed(peak.time, 3), String(peak.line),
  ]));
  const headings = ["Axis", "Quantity", "Peak", "Limit", "Unit", "Share of the limit", "", "at (s)", "Line"];
  byId("peaks").append(table(headings, rows, [2, 3, 6, 7, 8], 3));
}

function fillAccuracy() {
  const { planned, programmed: points, tightest, exact, unit: measure } = report.deviation;
  const rows = [];
  const add = (text, figure) => {
    if (!figure) return;
    const given = figure.tolerance === null ? "G64 without P" : figure.tolerance === 0 ? "exact" : length(figure.tolerance, measure).join(" ");
    const share = figure.tolerance ? `${number((100 * figure.distance) / figure.tolerance, 3)} %` : "";
    rows.push([text, length(figure.distance, measure).join(" "), given, share, String(figure.line)]);
  };
  add("Planned path, farthest from the program", planned);
  add("Programmed point, farthest from the planned path", points);
  add("Where the tolerance is used up most", tightest);
  add("In exact modes (G61, G61.1)", exact);
  byId("accuracy").append(table(["", "Distance", "Tolerance", "Used", "Line"], rows, [1, 2, 3, 4]));
}

const lineText = new Map(data.listing.lines);
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

function describe(point) {
  const { line, time } = point;
  return { line, text: lineText.get(line) ?? "", more: [["limited by", causeAt(time)]] };
}

fillAbout([report.machine, cycles(report.cycles), `limits: ${report.limits_from}`]);
fillFigures();
fillLegend();
fillTimes();
fillPlaces();
fillEvenness();
fillPeaks();
fillAccuracy();
if (data.listing.whole) fillListing(report.program, data.listing.lines);
byId("method").textContent =
  `Planned with the library of blendtp, driven as LinuxCNC\u2019s servo thread drives it; moves were handed over ${report.handed_over}. ` +
  "Velocity, acceleration and jerk are the first, second and third difference of the planned positions at the servo period. " +
  "The time is that from the first motion to the last; lost is what would be saved if a stretch were run at the feed of its moves. " +
  `The drawn path is thinned out to ${number(path.x.length, 9)} points, the curves to ${number(bucketTime.length, 9)} spans of time with their least and greatest values.`;

const columns = memberColumns(report.axes, data.profiles.axes);
columns.push({
  letter: "Path", name: "", curves: [
    { ...data.profiles.speed, title: `speed (${data.speed_unit})`, limit: null, unit: data.speed_unit, oneSided: true },
    distanceCurve(data.profiles.distance, null),
  ],
});
for (const choice of document.querySelectorAll("[name=colours]")) {
  choice.addEventListener("change", () => {
    Object.assign(colouring, choice.value === "cause" ? byCause : bySpeed);
    fillLegend();
    redraw();
  });
}
drawPage(columns, path.line, describe);
