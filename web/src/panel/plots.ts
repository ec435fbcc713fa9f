// Live plots against the iteration: forces of a region, water, wrinkle, curl. With two leaves the second is dashed.
import type uPlot from "uplot";
import type { App } from "../app";
import { type Frame, REGIONS } from "../core/protocol";
import { element } from "../dom";
import type { Session } from "../session";

interface Line {
  label: string;
  colour: string; // readable on light and dark
  value: (frame: Frame) => number;
}
interface PlotSpec {
  title: string;
  lines: Line[];
}

let region = 0;
const kForces = { elastic: "#d1603d", damping: "#7a8f3a", swelling: "#3d85b8", external: "#9a63b5" } as const;
const kPlots: PlotSpec[] = [
  {
    title: "Forces (mean, working units)",
    lines: Object.entries(kForces).map(([label, colour]) => ({
      label,
      colour,
      value: (frame) => frame.forces[label as keyof typeof kForces][region] ?? 0,
    })),
  },
  {
    title: "Water left (%)",
    lines: [{ label: "water", colour: "#3d85b8", value: (frame) => 100 * frame.waterLeft }],
  },
  {
    title: "Wrinkle (% of the leaf's length)",
    lines: [{ label: "wrinkle", colour: "#d1603d", value: (frame) => 100 * frame.wrinkle }],
  },
  { title: "Curl (degrees)", lines: [{ label: "curl", colour: "#7a8f3a", value: (frame) => frame.curl }] },
];

/** What all lines share: the iterations of both leaves, with gaps where one has not come. */
function table(spec: PlotSpec, sessions: readonly Session[]): uPlot.AlignedData {
  const iterations = [...new Set(sessions.flatMap((s) => s.frames.map((f) => f.iteration)))].sort(
    (a, b) => a - b,
  );
  const columns = sessions.flatMap((session) => {
    const frames = new Map(session.frames.map((frame) => [frame.iteration, frame]));
    return spec.lines.map((line) =>
      iterations.map((i) => (frames.has(i) ? line.value(frames.get(i)!) : null)),
    );
  });
  return [iterations, ...columns];
}

function options(app: App, spec: PlotSpec, width: number): uPlot.Options {
  const style = getComputedStyle(document.documentElement);
  const ink = style.getPropertyValue("--soft");
  const grid = { stroke: style.getPropertyValue("--line"), width: 1 };
  const axis = { stroke: ink, grid, ticks: grid, font: "11px system-ui, sans-serif" };
  return {
    width,
    height: 150,
    legend: { show: spec.lines.length > 1, live: false },
    scales: { x: { time: false, range: () => [0, app.playback.iterations] } },
    axes: [axis, { ...axis, size: 52 }],
    cursor: { drag: { x: false, y: false }, points: { size: 6 } },
    series: [
      { label: "iteration" },
      ...app.sessions.flatMap((_, side) =>
        spec.lines.map((line) => ({
          label: app.sessions.length > 1 ? `${line.label} ${"AB"[side]}` : line.label,
          stroke: line.colour,
          width: 2,
          dash: side === 1 ? [6, 4] : undefined,
          points: { show: false },
          value: (_: uPlot, value: number | null) => (value === null ? "" : value.toPrecision(3)),
        })),
      ),
    ],
    hooks: {
      draw: [
        (plot) => {
          const x = plot.valToPos(Math.min(app.playback.playhead, app.playback.head), "x", true);
          plot.ctx.fillStyle = style.getPropertyValue("--ink");
          plot.ctx.fillRect(x - devicePixelRatio / 2, plot.bbox.top, devicePixelRatio, plot.bbox.height);
        },
      ],
      ready: [
        (plot) =>
          plot.over.addEventListener("click", (event) => {
            app.playback.pause();
            app.playback.scrub(Math.round(plot.posToVal(event.offsetX, "x")));
          }),
      ],
    },
  };
}

/** The panel, and what to call when it is seen. */
export function buildPlots(app: App): { panel: HTMLElement; shown: () => void } {
  const regions = element(
    "select",
    { id: "region", change: () => ((region = regions.selectedIndex), refresh()) },
    ...REGIONS.map((name) => element("option", {}, name)),
  );
  const boxes = kPlots.map(() => element("div", { class: "plot" }));
  const panel = element(
    "div",
    {},
    element("div", { class: "row" }, element("label", {}, "Forces on", regions)),
    ...kPlots.flatMap((spec, i) => [element("h2", {}, spec.title), boxes[i]!]),
    element(
      "p",
      { class: "hint" },
      "Click on a plot to go to that moment. forces.csv in the export menu has the numbers.",
    ),
  );
  let plots: uPlot[] = [];
  let asked = false;
  let Plot: typeof uPlot | undefined;

  const build = () => {
    if (!Plot || panel.hidden || panel.clientWidth === 0) return;
    for (const plot of plots) plot.destroy();
    plots = kPlots.map(
      (spec, i) => new Plot!(options(app, spec, boxes[i]!.clientWidth), table(spec, app.sessions), boxes[i]!),
    );
  };
  const refresh = () => {
    if (panel.hidden || asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      plots.forEach((plot, i) => plot.setData(table(kPlots[i]!, app.sessions)));
    });
  };
  app.events.on("frames", refresh);
  app.events.on("sides", build);
  app.playback.events.on("moved", refresh);
  new ResizeObserver(() =>
    plots.forEach((plot, i) => plot.setSize({ width: boxes[i]!.clientWidth, height: 150 })),
  ).observe(panel);
  new MutationObserver(build).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  const shown = () => {
    if (Plot) build();
    else
      void Promise.all([import("uplot"), import("uplot/dist/uPlot.min.css")]).then(([module]) => {
        Plot = module.default;
        build();
      });
  };
  return { panel, shown };
}
