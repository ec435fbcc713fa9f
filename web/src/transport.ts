// Play, step, start again, the time line and the speed.
import type { App } from "./app";
import { byId, element } from "./dom";
import { SPEEDS } from "./playback";

const kPlay = "M7 4v16l13-8z";
const kPause = "M6 4h4v16H6zM14 4h4v16h-4z";
const kBack = "M16 4v16L6 12zM4 4h2v16H4z";
const kOn = "M8 4v16l10-8zM18 4h2v16h-2z";
const kAgain = "M12 5V1L6 6l6 5V7a5 5 0 1 1-5 5H5a7 7 0 1 0 7-7z";

function icon(path: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  svg.innerHTML = `<path d="${path}"/>`;
  return svg;
}

export function buildTransport(app: App): void {
  const { playback } = app;
  const play = element(
    "button",
    { id: "play", class: "primary icon", "aria-label": "Play", click: () => playback.toggle() },
    icon(kPlay),
  );
  const back = element(
    "button",
    {
      id: "step-back",
      class: "icon optional",
      "aria-label": "One iteration back",
      click: () => playback.stepBy(-1),
    },
    icon(kBack),
  );
  const on = element(
    "button",
    { id: "step", class: "icon", "aria-label": "One iteration on", click: () => playback.stepBy(1) },
    icon(kOn),
  );
  const again = element(
    "button",
    {
      id: "reset",
      class: "icon",
      "aria-label": "Start again, fresh, with these settings",
      click: () => void resetAll(app),
    },
    icon(kAgain),
  );
  const scrub = element("input", {
    id: "scrub",
    type: "range",
    min: 0,
    max: 100,
    step: 1,
    value: 0,
    "aria-label": "Iteration",
    input: () => {
      playback.pause();
      playback.scrub(Number(scrub.value));
    },
  });
  const computed = element("div", { class: "computed" });
  const marks = element("div", {});
  const time = element("span", { id: "time", class: "time" });
  const speed = element(
    "select",
    { id: "speed", "aria-label": "Speed", change: () => (playback.speed = Number(speed.value)) },
    ...SPEEDS.map((value) =>
      element("option", { value, selected: value === 1 }, value === Infinity ? "max" : `${value}×`),
    ),
  );
  byId("transport").append(
    play,
    back,
    on,
    again,
    element("div", { class: "scrub" }, computed, scrub, marks),
    time,
    speed,
  );

  const update = () => {
    const all = playback.iterations;
    scrub.max = String(all);
    scrub.value = String(Math.round(Math.min(playback.playhead, playback.head)));
    const hours = (playback.shown * Number(app.active.setting("clip.hours", 48))) / 100;
    scrub.setAttribute("aria-valuetext", `iteration ${playback.shown} of ${all}, ${hours.toFixed(0)} hours`);
    time.replaceChildren(
      `${playback.shown} / ${all}`,
      element("span", { class: "more" }, ` · ${hours.toFixed(0)} h`),
    );
    computed.style.width = `${(100 * app.active.head) / all}%`;
  };
  const updateMarks = () => {
    const all = playback.iterations;
    const places = new Set(app.active.config.changes.map((change) => change.iteration));
    marks.replaceChildren(
      ...[...places].map((iteration) => {
        const mark = element("span", {
          class: "mark",
          title: `A setting changed after iteration ${iteration}`,
        });
        mark.style.left = `calc(8px + ${iteration / all} * (100% - 16px))`;
        return mark;
      }),
    );
  };
  playback.events.on("moved", update);
  playback.events.on("playing", (playing) => {
    play.replaceChildren(icon(playing ? kPause : kPlay));
    play.setAttribute("aria-label", playing ? "Pause" : "Play");
  });
  for (const kind of ["frames", "config", "active"] as const) {
    app.events.on(kind, () => {
      update();
      if (kind !== "frames") updateMarks();
    });
  }
  update();
}

/** Fresh again, with the settings as they are now. */
export async function resetAll(app: App): Promise<void> {
  const at = app.playback.shown;
  app.remember("Start again");
  app.playback.pause();
  app.playback.scrub(0);
  await Promise.all(app.sessions.map((session) => session.reset(at)));
}
