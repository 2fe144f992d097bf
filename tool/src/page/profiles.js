// Velocity, acceleration and jerk of each joint over time, and the distance from the programmed path.

const span = { from: bucketTime[0], to: endTime };

// One curve; `series` has columns low and high, the range of the values in each bucket of time.
function makeProfile(holder, series, onTime, onSpan) {
  const canvases = layers(holder);
  const low = decode(series.low, Float32Array);
  const high = series.high ? decode(series.high, Float32Array) : low;
  const margin = { left: 58, right: 6, top: 8, bottom: series.last ? 40 : 6 };
  const limit = series.limit;
  let greatest = 0;
  for (let i = 0; i < low.length; i++) greatest = Math.max(greatest, -low[i], high[i]);
  // What rounding leaves is no curve.
  const isFlat = greatest < 1e-7;
  if (isFlat) greatest = 1;
  // A limit that is far away is not drawn, or the curve would be flat.
  const limitShown = limit !== null && limit <= 4 * greatest;
  const top = 1.1 * Math.max(greatest, limitShown ? limit : 0);
  const bottomValue = series.oneSided ? 0 : -top;
  let size = { width: 1, height: 1 };
  let cursor = null;
  let selection = null;

  const toX = (time) => margin.left + ((time - span.from) / (span.to - span.from)) * (size.width - margin.left - margin.right);
  const toY = (value) => {
    const share = (value - bottomValue) / (top - bottomValue);
    return size.height - margin.bottom - share * (size.height - margin.top - margin.bottom);
  };
  const toTime = (x) => span.from + ((x - margin.left) / (size.width - margin.left - margin.right)) * (span.to - span.from);

  // The least and the greatest value in each column of pixels as far as `right`: [pixel, least, greatest].
  function envelope(right) {
    const columns = [];
    for (let i = 0; i < low.length; i++) {
      const x = toX(bucketTime[i]);
      if (x < margin.left - 40 || x > right + 40) continue;
      const pixel = Math.round(x);
      const last = columns[columns.length - 1];
      if (last && last[0] === pixel) {
        last[1] = Math.min(last[1], low[i]);
        last[2] = Math.max(last[2], high[i]);
      } else {
        columns.push([pixel, low[i], high[i]]);
      }
    }
    return columns;
  }

  function draw() {
    const { context, width, height } = canvases.base();
    size = { width, height };
    const right = width - margin.right;
    context.strokeStyle = colour("rule");
    context.lineWidth = 1;
    context.strokeRect(margin.left + 0.5, margin.top + 0.5, right - margin.left - 1, height - margin.bottom - margin.top - 1);
    context.beginPath();
    context.moveTo(margin.left, Math.round(toY(0)) + 0.5);
    context.lineTo(right, Math.round(toY(0)) + 0.5);
    context.stroke();
    context.fillStyle = colour("quiet");
    context.textAlign = "right";
    context.textBaseline = "middle";
    const scale = limitShown ? limit : ticks(0, greatest, 2.5).pop() || greatest;
    const marks = series.oneSided ? [0, scale] : [-scale, 0, scale];
    for (const value of isFlat && !limitShown ? [0] : marks) {
      context.fillText(number(value, 4), margin.left - 7, toY(value));
    }

    context.save();
    context.beginPath();
    context.rect(margin.left, margin.top, right - margin.left, height - margin.top - margin.bottom);
    context.clip();
    const curve = colour("accent");
    const columns = envelope(right);
    // What lies between the least and the greatest values is light, so that both stay to be seen where it is dense.
    context.beginPath();
    columns.forEach(([x, , most]) => context.lineTo(x, toY(most)));
    columns.reverse().forEach(([x, least]) => context.lineTo(x, toY(least)));
    context.fillStyle = curve;
    context.globalAlpha = 0.22;
    context.fill();
    context.globalAlpha = 1;
    context.strokeStyle = curve;
    context.lineWidth = 1.2;
    for (const side of [1, 2]) {
      context.beginPath();
      columns.forEach((edges) => context.lineTo(edges[0], toY(edges[side])));
      context.stroke();
    }
    context.restore();
    if (limitShown) {
      context.beginPath();
      for (const value of series.oneSided ? [limit] : [limit, -limit]) {
        context.moveTo(margin.left, Math.round(toY(value)) + 0.5);
        context.lineTo(right, Math.round(toY(value)) + 0.5);
      }
      // The light line below keeps the limit visible on a dense curve.
      context.strokeStyle = colour("ground");
      context.lineWidth = 3;
      context.stroke();
      context.strokeStyle = colour("bad");
      context.lineWidth = 1;
      context.setLineDash([4, 3]);
      context.stroke();
      context.setLineDash([]);
    }
    if (series.last) {
      context.fillStyle = colour("quiet");
      context.textBaseline = "top";
      context.textAlign = "center";
      for (const time of ticks(span.from, span.to, (right - margin.left) / 70)) {
        const x = Math.max(margin.left + 4, Math.min(right - 14, toX(time)));
        context.fillText(number(time, 6), x, height - margin.bottom + 5);
      }
      context.fillText("time (s)", (margin.left + right) / 2, height - margin.bottom + 22);
    }
    show(cursor);
  }

  function valueAt(time) {
    let a = 0;
    let b = bucketTime.length - 1;
    while (b - a > 1) {
      const middle = (a + b) >> 1;
      if (bucketTime[middle] <= time) a = middle;
      else b = middle;
    }
    const index = bucketTime[b] <= time ? b : a;
    const value = Math.abs(low[index]) > Math.abs(high[index]) ? low[index] : high[index];
    // What is left by the rounding of the recording is rest.
    return Math.abs(value) < 1e-6 * greatest ? 0 : value;
  }

  function show(point) {
    cursor = point;
    const { context } = canvases.overlay();
    if (selection) {
      context.fillStyle = colour("wash");
      context.fillRect(selection[0], margin.top, selection[1] - selection[0], size.height - margin.top - margin.bottom);
    }
    series.output.textContent = point ? `${number(valueAt(point.time), 5)} ${series.unit}` : "";
    if (!point || point.time < span.from || point.time > span.to) return;
    const x = Math.round(toX(point.time)) + 0.5;
    context.strokeStyle = colour("ink");
    context.lineWidth = 1;
    context.globalAlpha = 0.6;
    context.beginPath();
    context.moveTo(x, margin.top);
    context.lineTo(x, size.height - margin.bottom);
    context.stroke();
  }

  const within = (x) => Math.max(margin.left, Math.min(size.width - margin.right, x));
  holder.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "touch") return;
    selection = [within(event.offsetX), within(event.offsetX)];
    holder.setPointerCapture(event.pointerId);
  });
  holder.addEventListener("pointermove", (event) => {
    if (selection) selection[1] = within(event.offsetX);
    onTime(toTime(within(event.offsetX)));
  });
  holder.addEventListener("pointerup", () => {
    const chosen = selection;
    selection = null;
    if (chosen && Math.abs(chosen[1] - chosen[0]) > 5) onSpan(...chosen.map(toTime).sort((a, b) => a - b));
    else show(cursor);
  });
  holder.addEventListener("dblclick", () => onSpan(bucketTime[0], endTime));
  return { draw, show };
}

// All curves, one column for each joint, axis or path: { letter, name, curves: [{ title, unit, limit, .. }] }.
function makeProfiles(parent, columns, onTime, onSpan) {
  const profiles = [];
  for (const { letter, name, curves } of columns) {
    const column = element("div", "joint", element("h3", "", letter + " ", element("span", "quiet", name)));
    parent.append(column);
    curves.forEach((curve, q) => {
      const last = q === curves.length - 1;
      const output = element("output");
      const holder = element("div", "canvas profile" + (last ? " last" : ""));
      column.append(element("div", "profile-title", element("span", "", curve.title), output), holder);
      profiles.push(makeProfile(holder, { ...curve, last, output }, onTime, onSpan));
    });
  }
  return profiles;
}

// Velocity, acceleration and jerk of joints or axes.
function memberColumns(members, envelopes) {
  return members.map((member, m) => ({
    letter: member.letter,
    name: member.name,
    curves: member.peaks.map((peak, q) => {
      const unit = rateUnit(member.unit, peak.quantity);
      const limit = peak.limit === null ? "not limited" : `limit ${number(peak.limit, 6)}`;
      return { ...envelopes[m][q], title: `${peak.quantity} (${unit}), ${limit}`, limit: peak.limit, unit };
    }),
  }));
}

// The distance from the programmed path; without a tolerance `null`.
function distanceCurve(series, tolerance) {
  const factor = data.profiles.distance_factor;
  const name = factor === 1000 ? "\u00b5m" : data.profiles.distance_unit ?? unit;
  const limit = tolerance === null ? "" : `, tolerance ${number(tolerance * factor, 5)}`;
  return {
    ...series, title: `distance (${name})${limit}`, limit: tolerance === null ? null : tolerance * factor,
    unit: name, oneSided: true,
  };
}
