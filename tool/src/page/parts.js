// The parts that pages are made of.

const byId = (id) => document.getElementById(id);

// So many decimals, a real minus sign, and none before a zero.
function fixed(value, decimals) {
  const text = value.toFixed(decimals);
  return /[1-9]/.test(text) ? text.replace("-", "\u2212") : text.replace("-", "");
}

// A table that is wider than its place fades where it goes on, and says so.
function showWhereTablesGoOn() {
  for (const holder of document.querySelectorAll(".table")) {
    const look = () => {
      const hidden = holder.scrollWidth - holder.clientWidth;
      holder.classList.toggle("more-left", hidden > 1 && holder.scrollLeft > 1);
      holder.classList.toggle("more-right", hidden > 1 && holder.scrollLeft < hidden - 1);
      // For those who scroll with the keyboard.
      if (hidden > 1) holder.tabIndex = 0;
      else holder.removeAttribute("tabindex");
    };
    holder.addEventListener("scroll", look);
    new ResizeObserver(look).observe(holder);
    look();
  }
}

// A table; a cell is text, or an element; `numbers` lists the columns that are numbers, and
// `group` is how many rows belong together (0: each stands for itself).
function table(headings, rows, numbers, group = 0) {
  const row = (cells, kind, className) => element("tr", className, ...cells.map((cell, i) => {
    const made = element(kind, numbers.includes(i) ? "number" : "", cell);
    if (cell instanceof Element && cell.classList.contains("bar")) made.className = "wide";
    return made;
  }));
  const place = (i) => (i % group === 0 ? "first" : i % group === group - 1 ? "last" : "");
  const body = rows.map((cells, i) => row(cells, "td", group ? place(i) : ""));
  return element("table", group ? "grouped" : "", element("thead", "", row(headings, "th", "")), element("tbody", "", ...body));
}

// A share as a bar; none is 0.
function bar(share, className = "") {
  const made = element("span", "bar", element("i", className));
  made.firstChild.style.width = `${Math.min(100, 100 * (share ?? 0))}%`;
  return made;
}

// The cells of a peak from its quantity on: peak, limit, unit, share of the limit as a bar and in percent.
function peakCells(peak, lengthUnit) {
  const of = (value, text) => (value === null ? "\u2013" : text(value));
  return [
    peak.quantity, number(peak.peak, 6), of(peak.limit, (limit) => number(limit, 6)), rateUnit(lengthUnit, peak.quantity),
    bar(peak.share, peak.judgement === "over" ? "over" : ""), of(peak.share, (share) => `${fixed(share * 100, 1)} %`),
  ];
}

// A key figure: what it is, [number, unit], and what is to be said of it.
function addFigure(label, [value, of], note) {
  const figure = element("div", "figure", element("span", "", label));
  figure.append(element("b", "", value, " ", element("small", "", of)), element("span", "", note));
  byId("figures").append(figure);
}

function fillAbout(parts) {
  if (data.lathe) parts.push("X is a radius");
  byId("about").textContent = parts.filter(Boolean).join("  \u00b7  ");
}

function cycles(count) {
  return `${number(count, 9)} servo cycles of ${number(report.servo_period * 1e3, 4)} ms`;
}

// The scale of the speed colours.
function speedScale(words) {
  const marks = [0, 0.25, 0.5, 0.75, 1].map((share) => element("span", "", number(share * greatestSpeed, 3)));
  return element("div", "scale", element("i"), element("div", "", ...marks), `${words} (${speedUnit})`);
}

// The program, as [line, text].
function fillListing(name, lines) {
  byId("program").hidden = false;
  byId("program-name").textContent = name;
  for (const [line, text] of lines) {
    const item = element("li", "", text);
    item.setAttribute("value", line);
    byId("listing").append(item);
  }
}
