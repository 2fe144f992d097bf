// The two drawings of the path: in a plane, and in space.

// Coordinates across and up in the plane: X and Y, as seen from above; of a lathe Z and X.
const [ACROSS, UP] = data.lathe ? [2, 0] : [0, 1];

const box = { low: [], high: [] };
for (const name of ["x", "y", "z"]) {
  let low = Infinity;
  let high = -Infinity;
  for (const column of [path[name], programmed[name]]) {
    for (const value of column) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  box.low.push(low);
  box.high.push(high);
}
const boxCentre = box.low.map((low, i) => (low + box.high[i]) / 2);
const boxDiagonal = Math.hypot(...box.low.map((low, i) => box.high[i] - low)) || 1;

// Points that are drawn while a drawing is being turned or moved.
const COARSE_POINTS = 12000;

// Rapids are drawn as long as the box is ticked.
const showsRapids = () => byId("rapids").checked;
const isHidden = (i) => path.rapid[i] === 1 && !showsRapids();

// Draws the programmed path under the executed path; `project(x, y, z)` gives pixels. `coarse` leaves out points.
function drawPaths(context, project, coarse = false) {
  const stroke = (rapid, width, dash) => {
    context.strokeStyle = colour("programmed");
    context.lineWidth = width;
    context.setLineDash(dash);
    context.beginPath();
    for (let i = 1; i < programmed.x.length; i++) {
      if ((programmed.rapid[i] === 1) !== rapid || programmed.rapid[i] < 0) continue;
      context.moveTo(...project(programmed.x[i - 1], programmed.y[i - 1], programmed.z[i - 1]));
      context.lineTo(...project(programmed.x[i], programmed.y[i], programmed.z[i]));
    }
    context.stroke();
    context.setLineDash([]);
  };
  context.lineCap = "butt";
  const rapids = showsRapids();
  if (rapids) stroke(true, 1.2, [5, 4]);
  context.lineCap = "round";
  stroke(false, 5, []);

  // Each colour in one go, the slow ones on top.
  const colours = colouring.colours();
  const strokes = colours.map(() => []);
  const stride = coarse ? Math.max(1, Math.ceil(path.x.length / COARSE_POINTS)) : 1;
  for (let i = stride; i < path.x.length; i += stride) {
    if (rapids || path.rapid[i] !== 1) strokes[colouring.step(i)].push(i);
  }
  // Thin where there is much to see.
  context.lineWidth = path.x.length > 20000 ? 1.2 : 2;
  for (let step = colours.length - 1; step >= 0; step--) {
    context.strokeStyle = colours[step];
    context.beginPath();
    let last = -1;
    for (const i of strokes[step]) {
      const from = i - stride;
      if (from !== last) context.moveTo(...project(path.x[from], path.y[from], path.z[from]));
      context.lineTo(...project(path.x[i], path.y[i], path.z[i]));
      last = i;
    }
    context.stroke();
  }
}

function drawDot(context, [x, y]) {
  context.beginPath();
  context.arc(x, y, 6, 0, 2 * Math.PI);
  context.fillStyle = colour("accent");
  context.strokeStyle = colour("ground");
  context.lineWidth = 2.5;
  context.fill();
  context.stroke();
}

// The time of the point of the path that is drawn nearest to a pixel, or null if none is close.
function timeAt(project, pixelX, pixelY) {
  let best = 30 * 30;
  let time = null;
  let before = project(path.x[0], path.y[0], path.z[0]);
  for (let i = 1; i < path.x.length; i++) {
    const here = project(path.x[i], path.y[i], path.z[i]);
    const dx = here[0] - before[0];
    const dy = here[1] - before[1];
    const square = dx * dx + dy * dy;
    const share = square > 0 ? Math.max(0, Math.min(1, ((pixelX - before[0]) * dx + (pixelY - before[1]) * dy) / square)) : 0;
    const away = (before[0] + share * dx - pixelX) ** 2 + (before[1] + share * dy - pixelY) ** 2;
    if (away < best && !isHidden(i)) {
      best = away;
      time = path.time[i - 1] + share * (path.time[i] - path.time[i - 1]);
    }
    before = here;
  }
  return time;
}

// Draws coarsely now and finely when the pointer rests.
const waiting = new Map();
function draft(draw) {
  draw(true);
  clearTimeout(waiting.get(draw));
  waiting.set(draw, setTimeout(draw, 150));
}

function makePlan(holder, onPoint) {
  const canvases = layers(holder);
  if (data.lathe) byId("seen").textContent = "X over Z";
  const margin = { left: 62, right: 18, top: 16, bottom: 44 };
  let zoom = 1;
  const middleOfBox = () => [boxCentre[ACROSS], boxCentre[UP]];
  let centre = middleOfBox();
  let size = { width: 1, height: 1 };
  let cursor = null;

  const scale = () => {
    const width = Math.max(box.high[ACROSS] - box.low[ACROSS], boxDiagonal / 50);
    const height = Math.max(box.high[UP] - box.low[UP], boxDiagonal / 50);
    const fit = Math.min((size.width - margin.left - margin.right) / width, (size.height - margin.top - margin.bottom) / height);
    return 0.92 * fit * zoom;
  };
  const middle = () => [
    (margin.left + size.width - margin.right) / 2,
    (margin.top + size.height - margin.bottom) / 2,
  ];
  const toPixels = (across, up) => {
    const [mx, my] = middle();
    return [mx + (across - centre[0]) * scale(), my - (up - centre[1]) * scale()];
  };
  const project = data.lathe ? (x, y, z) => toPixels(z, x) : toPixels;
  const title = (axis) => `${"XYZ"[axis]}${data.lathe && axis === 0 ? ", a radius" : ""} (${unit})`;

  function draw(coarse = false) {
    const { context, width, height } = canvases.base();
    size = { width, height };
    const s = scale();
    const [mx, my] = middle();
    const right = width - margin.right;
    const bottom = height - margin.bottom;
    const xs = ticks(centre[0] - (mx - margin.left) / s, centre[0] + (right - mx) / s, (right - margin.left) / 64);
    const ys = ticks(centre[1] - (bottom - my) / s, centre[1] + (my - margin.top) / s, (bottom - margin.top) / 64);
    context.strokeStyle = colour("rule");
    context.lineWidth = 1;
    context.beginPath();
    for (const x of xs) {
      const px = Math.round(toPixels(x, 0)[0]) + 0.5;
      context.moveTo(px, margin.top);
      context.lineTo(px, bottom);
    }
    for (const y of ys) {
      const py = Math.round(toPixels(0, y)[1]) + 0.5;
      context.moveTo(margin.left, py);
      context.lineTo(right, py);
    }
    context.stroke();
    context.fillStyle = colour("quiet");
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const x of xs) {
      const px = toPixels(x, 0)[0];
      if (px > margin.left + 8 && px < right - 8) context.fillText(number(x, 7), px, bottom + 6);
    }
    context.fillText(title(ACROSS), (margin.left + right) / 2, bottom + 24);
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const y of ys) {
      const py = toPixels(0, y)[1];
      if (py > margin.top + 4 && py < bottom - 2) context.fillText(number(y, 7), margin.left - 7, py);
    }
    context.save();
    context.translate(14, (margin.top + bottom) / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = "center";
    context.fillText(title(UP), 0, 0);
    context.restore();
    context.save();
    context.beginPath();
    context.rect(margin.left, margin.top, right - margin.left, bottom - margin.top);
    context.clip();
    drawPaths(context, project, coarse);
    context.restore();
    show(cursor);
  }

  function show(point) {
    cursor = point;
    const { context } = canvases.overlay();
    if (point) drawDot(context, project(point.x, point.y, point.z));
  }

  let drag = null;
  holder.addEventListener("pointerdown", (event) => {
    if (zoom > 1) drag = [event.offsetX, event.offsetY];
  });
  window.addEventListener("pointerup", () => (drag = null));
  holder.addEventListener("pointermove", (event) => {
    if (drag) {
      const s = scale();
      centre = [centre[0] - (event.offsetX - drag[0]) / s, centre[1] + (event.offsetY - drag[1]) / s];
      drag = [event.offsetX, event.offsetY];
      draft(draw);
    } else {
      onPoint(timeAt(project, event.offsetX, event.offsetY));
    }
  });
  holder.addEventListener("dblclick", (event) => {
    const [mx, my] = middle();
    centre = [centre[0] + (event.offsetX - mx) / scale(), centre[1] - (event.offsetY - my) / scale()];
    zoom *= 2.5;
    draw();
  });
  function enlarge(factor) {
    zoom = factor ? Math.max(1, zoom * factor) : 1;
    if (zoom === 1) centre = middleOfBox();
    else if (cursor) centre = data.lathe ? [cursor.z, cursor.x] : [cursor.x, cursor.y];
    draw();
  }
  return { draw, show, enlarge };
}

function makeSpace(holder, onPoint) {
  const canvases = layers(holder);
  // Seen from the front right and above, as most people stand at a mill.
  let turn = -0.6;
  let tilt = 0.55;
  let zoom = 1;
  let shift = [0, 0];
  let size = { width: 1, height: 1 };
  let cursor = null;

  // Large enough to fill the drawing at this tilt, the same at every turn.
  const spaceScale = () => {
    const [dx, dy, dz] = box.low.map((low, i) => box.high[i] - low);
    const flat = Math.hypot(dx, dy);
    const tall = Math.cos(tilt) * dz + Math.sin(tilt) * flat;
    return zoom * Math.min((0.88 * size.width) / (flat || boxDiagonal), (0.74 * size.height) / (tall || boxDiagonal));
  };
  // From a place to pixels, as the drawing is turned now: there are many points, so the angles are worked out once.
  const projection = () => {
    const s = spaceScale();
    const [cosTurn, sinTurn, cosTilt, sinTilt] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
    const [middleX, middleY] = [size.width / 2 + shift[0], size.height / 2 + shift[1]];
    const [centreX, centreY, centreZ] = boxCentre;
    return (x, y, z) => {
      const dx = x - centreX;
      const dy = y - centreY;
      const across = cosTurn * dx - sinTurn * dy;
      const deep = sinTurn * dx + cosTurn * dy;
      return [middleX + across * s, middleY - (cosTilt * (z - centreZ) + sinTilt * deep) * s];
    };
  };

  function draw(coarse = false) {
    const { context, width, height } = canvases.base();
    size = { width, height };
    const project = projection();
    const corner = (bits) => box.low.map((low, i) => (bits & (1 << i) ? box.high[i] : low));
    context.strokeStyle = colour("rule");
    context.lineWidth = 1;
    context.beginPath();
    for (let bits = 0; bits < 8; bits++) {
      for (let axis = 0; axis < 3; axis++) {
        if (bits & (1 << axis)) continue;
        context.moveTo(...project(...corner(bits)));
        context.lineTo(...project(...corner(bits | (1 << axis))));
      }
    }
    context.stroke();
    drawPaths(context, project, coarse);

    // The three axes as a small cross of their own, where it is never in the way of the path.
    const origin = [46, height - 46];
    const zero = project(0, 0, 0);
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (const [letter, ...direction] of [["X", 1, 0, 0], ["Y", 0, 1, 0], ["Z", 0, 0, 1]]) {
      const far = project(...direction);
      const arm = [((far[0] - zero[0]) * 30) / spaceScale(), ((far[1] - zero[1]) * 30) / spaceScale()];
      const long = Math.hypot(...arm);
      context.strokeStyle = colour("quiet");
      context.lineWidth = 1.5;
      context.beginPath();
      context.moveTo(...origin);
      context.lineTo(origin[0] + arm[0], origin[1] + arm[1]);
      context.stroke();
      if (long < 7) continue;
      context.fillStyle = colour("ink");
      context.fillText(letter, origin[0] + arm[0] * (1 + 11 / long), origin[1] + arm[1] * (1 + 11 / long));
    }
    context.fillStyle = colour("quiet");
    context.textAlign = "right";
    const extents = box.low.map((low, i) => number(box.high[i] - low, 5)).join(" \u00d7 ");
    context.fillText(`box ${extents} ${unit}`, width - 14, height - 18);
    show(cursor);
  }

  function show(point) {
    cursor = point;
    const { context } = canvases.overlay();
    if (point) drawDot(context, projection()(point.x, point.y, point.z));
  }

  function rotate(dx, dy) {
    turn += dx * 0.01;
    tilt = Math.max(0, Math.min(Math.PI / 2, tilt + dy * 0.01));
    draft(draw);
  }

  // About a point of the drawing; 0 shows all again.
  function enlarge(factor, about = [size.width / 2, size.height / 2]) {
    const next = factor ? Math.max(1, Math.min(1e4, zoom * factor)) : 1;
    const ratio = next / zoom;
    const middle = [size.width / 2, size.height / 2];
    shift = next === 1 ? [0, 0] : shift.map((moved, i) => about[i] - middle[i] - ratio * (about[i] - middle[i] - moved));
    zoom = next;
    draft(draw);
  }

  let drag = null;
  holder.tabIndex = 0;
  holder.setAttribute("role", "img");
  holder.setAttribute("aria-label", "The path in space; the arrow keys turn it");
  holder.addEventListener("pointerdown", (event) => {
    drag = [event.clientX, event.clientY];
    holder.setPointerCapture(event.pointerId);
  });
  holder.addEventListener("pointerup", () => (drag = null));
  holder.addEventListener("pointercancel", () => (drag = null));
  holder.addEventListener("pointermove", (event) => {
    if (drag) {
      const way = [event.clientX - drag[0], event.clientY - drag[1]];
      if (event.shiftKey) {
        shift = [shift[0] + way[0], shift[1] + way[1]];
        draft(draw);
      } else {
        rotate(...way);
      }
      drag = [event.clientX, event.clientY];
    } else {
      onPoint(timeAt(projection(), event.offsetX, event.offsetY));
    }
  });
  holder.addEventListener("dblclick", (event) => enlarge(2.5, [event.offsetX, event.offsetY]));
  // The wheel scrolls the page until the drawing was clicked on.
  holder.addEventListener("wheel", (event) => {
    if (document.activeElement !== holder) return;
    event.preventDefault();
    enlarge(Math.exp(-0.002 * event.deltaY), [event.offsetX, event.offsetY]);
  }, { passive: false });
  holder.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, -10], ArrowDown: [0, 10] }[event.key];
    if (!step) return;
    event.preventDefault();
    rotate(...step);
  });
  return { draw, show, enlarge };
}
