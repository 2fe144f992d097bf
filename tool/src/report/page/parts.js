// Parts of a page that reports and plans share.

const byId = (id) => document.getElementById(id);

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
