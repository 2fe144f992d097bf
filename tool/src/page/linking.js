// One cursor for all drawings, the bar at the bottom and the listing.

const linked = { drawings: [], describe: null, playback: null };

// The item of the listing that is shown as the current one.
let marked = null;
function markLine(line) {
  const item = byId("listing").children[line - 1] ?? null;
  if (item === marked) return;
  if (marked) marked.classList.remove("current");
  marked = item;
  if (!item) return;
  item.classList.add("current");
  const list = byId("listing");
  const top = item.offsetTop - list.offsetTop;
  if (top < list.scrollTop || top > list.scrollTop + list.clientHeight - 40) list.scrollTop = top - list.clientHeight / 2;
}

function fillCursor(point) {
  const bottom = byId("cursor");
  bottom.hidden = !point;
  if (!point) return;
  const { line, text, more } = linked.describe(point);
  const entries = [
    ["time", `${fixed(point.time, 3)} s`],
    ["line", line > 0 ? String(line) : "\u2013"],
    ...["x", "y", "z"].map((axis) => [axis.toUpperCase(), fixed(point[axis], 3)]),
    ["speed", `${number(point.speed, 4)} ${speedUnit}`],
    ...more,
  ];
  const shown = entries.map(([label, words]) => element("span", "", element("em", "", label), words));
  bottom.replaceChildren(...shown, element("code", "", text));
  markLine(line);
}

// Shows an instant everywhere; `null`: none.
function setTime(time) {
  linked.playback.show(time);
  const point = time === null ? null : locate(time);
  for (const drawing of linked.drawings) drawing.show(point);
  fillCursor(point);
}

function redraw() {
  for (const drawing of linked.drawings) drawing.draw();
}

// Draws the page: the path, and a column of curves for each of `columns`. `describe` gives of a point
// { line, text, more }: its line in the program, the text of it, and more entries [label, words] of
// the cursor; `lines` is the line of each point of the path.
function drawPage(columns, lines, describe) {
  linked.playback = makePlayback(byId("playback"), setTime);
  const point = (time) => linked.playback.isRunning() || setTime(time);
  const views = { plan: makePlan(byId("plan"), point), space: makeSpace(byId("space"), point) };
  const profiles = makeProfiles(byId("profiles"), columns, point, (from, to) => {
    span.from = from;
    span.to = to;
    redraw();
  });
  linked.describe = describe;
  linked.drawings = [views.plan, views.space, ...profiles];
  for (const [name, view] of Object.entries(views)) {
    for (const button of document.querySelectorAll(`[data-${name}]`)) {
      button.addEventListener("click", () => view.enlarge(Number(button.dataset[name])));
    }
  }
  for (const holder of document.querySelectorAll(".canvas")) holder.addEventListener("pointerleave", () => point(null));
  byId("listing").addEventListener("click", (event) => {
    const line = Number(event.target.closest("li")?.getAttribute("value"));
    const index = lines.indexOf(line);
    if (line && index >= 0) setTime(path.time[index]);
  });
  if (path.rapid.includes(1) || programmed.rapid.includes(1)) {
    byId("rapids").closest("label").hidden = false;
    byId("rapids").addEventListener("change", redraw);
  }
  showWhereTablesGoOn();
  window.addEventListener("resize", redraw);
  for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", redraw);
  redraw();
}
