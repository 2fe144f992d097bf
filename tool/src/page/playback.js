// Playback: the instant that is shown moves on by itself.

// How much faster than the machine, at choice.
const PACES = [0.1, 0.5, 1, 2, 10, 100];

// Adds the controls to `holder`; `onTime` shows an instant. What is returned is told of the instants that
// others show.
function makePlayback(holder, onTime) {
  const start = path.time[0] ?? 0;
  const button = element("button", "", "Play");
  const slider = element("input");
  Object.assign(slider, { type: "range", id: "instant", min: start, max: endTime, step: "any", value: start });
  slider.setAttribute("aria-label", "Time");
  const clock = element("output", "", "");
  const choice = element("select", "", ...PACES.map((pace) => {
    const made = element("option", "", `${pace} \u00d7 the machine\u2019s speed`);
    made.value = pace;
    return made;
  }));
  choice.value = 1;
  choice.setAttribute("aria-label", "Speed of the playback");
  button.id = "play";
  holder.append(button, slider, clock, choice);

  let running = null;
  let time = start;
  const tell = () => {
    slider.value = time;
    clock.textContent = `${fixed(time, 2)} of ${fixed(endTime, 2)} s`;
  };
  const stop = () => {
    if (running !== null) cancelAnimationFrame(running);
    running = null;
    button.textContent = "Play";
  };
  const go = (before) => (now) => {
    time = Math.min(endTime, time + (Math.max(0, now - before) / 1000) * Number(choice.value));
    tell();
    onTime(time);
    if (time >= endTime) stop();
    else running = requestAnimationFrame(go(now));
  };
  button.addEventListener("click", () => {
    if (running !== null) return stop();
    if (time >= endTime) time = start;
    button.textContent = "Pause";
    running = requestAnimationFrame(go(performance.now()));
  });
  slider.addEventListener("input", () => {
    time = Number(slider.value);
    tell();
    onTime(time);
  });
  tell();
  return {
    // While it plays, the pointer that lies over a drawing shows nothing else.
    isRunning: () => running !== null,
    show(instant) {
      if (instant === null) return;
      time = instant;
      tell();
    },
  };
}
