// The margin profile: how far each place of the margin is from the petiole (the paper's Fig. 2c), tied to the leaf.
import type { App } from "../app";
import type { LeafInfo } from "../core/protocol";
import { element } from "../dom";

const kLeft = 8;
const kTop = 18;
const kBottom = 8;

interface Scale {
  x: (s: number) => number;
  y: (d: number) => number;
  width: number;
  height: number;
}

function scaleOf(canvas: HTMLCanvasElement, { margin }: LeafInfo): Scale {
  const { clientWidth: width, clientHeight: height } = canvas;
  const top = margin.d.reduce((a, b) => Math.max(a, b), 1e-9);
  return {
    width,
    height,
    x: (s) => kLeft + (s / margin.perimeter) * (width - 2 * kLeft),
    y: (d) => height - kBottom - (d / top) * (height - kTop - kBottom),
  };
}

/** Centimetres, as they are said. */
function cm(metres: number): string {
  return `${(100 * metres).toFixed(1)} cm`;
}

function draw(canvas: HTMLCanvasElement, info: LeafInfo, lit: number): void {
  const scale = scaleOf(canvas, info);
  const ratio = devicePixelRatio;
  canvas.width = scale.width * ratio;
  canvas.height = scale.height * ratio;
  const pen = canvas.getContext("2d")!;
  const style = getComputedStyle(canvas);
  const colour = (name: string) => style.getPropertyValue(name);
  pen.scale(ratio, ratio);
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "center";
  const { s, d } = info.margin;
  pen.beginPath();
  for (let i = 0; i < s.length; ++i) pen.lineTo(scale.x(s[i]!), scale.y(d[i]!));
  pen.lineTo(scale.x(info.margin.perimeter), scale.y(0));
  pen.strokeStyle = colour("--ink");
  pen.lineWidth = 1.5;
  pen.stroke();
  pen.lineTo(scale.x(0), scale.y(0));
  pen.fillStyle = colour("--accent-soft");
  pen.globalAlpha = 0.6;
  pen.fill();
  pen.globalAlpha = 1;
  for (const tip of info.tips) {
    pen.fillStyle = colour("--accent");
    pen.beginPath();
    pen.arc(scale.x(tip.s), scale.y(tip.d), 3.5, 0, 7);
    pen.fill();
    pen.fillStyle = colour("--ink");
    pen.fillText(`r${tip.index + 1}`, scale.x(tip.s), scale.y(tip.d) - 6);
  }
  if (lit < 0) return;
  pen.fillStyle = pen.strokeStyle = colour("--second");
  pen.fillRect(scale.x(s[lit]!) - 0.75, kTop - 8, 1.5, scale.height);
  pen.beginPath();
  pen.arc(scale.x(s[lit]!), scale.y(d[lit]!), 5, 0, 7);
  pen.fill();
}

/** The place of the margin that is nearest to s. */
export function placeAt({ margin }: LeafInfo, s: number): number {
  let best = 0;
  for (let i = 1; i < margin.s.length; ++i)
    if (Math.abs(margin.s[i]! - s) < Math.abs(margin.s[best]! - s)) best = i;
  return best;
}

export function buildProfile(app: App): HTMLElement {
  const canvas = element("canvas", {
    id: "profile",
    class: "profile",
    tabindex: 0,
    role: "slider",
    "aria-label": "Place along the margin, clockwise from the petiole",
    "aria-valuemin": 0,
  });
  const said = element("p", { class: "hint", id: "profile-place" });
  const redraw = () => {
    const { info } = app.active;
    if (!info || canvas.clientWidth === 0) return;
    draw(canvas, info, app.lit);
    canvas.setAttribute("aria-valuemax", String(info.margin.s.length - 1));
    canvas.setAttribute("aria-valuenow", String(Math.max(0, app.lit)));
    const text =
      app.lit < 0
        ? `${info.tips.length} peaks; ${cm(info.margin.perimeter)} around`
        : `${cm(info.margin.s[app.lit]!)} along the margin, ${cm(info.margin.d[app.lit]!)} from the petiole`;
    canvas.setAttribute("aria-valuetext", text);
    said.textContent = text;
  };
  const point = (event: PointerEvent) => {
    const { info } = app.active;
    if (!info) return;
    const part = (event.offsetX - kLeft) / (canvas.clientWidth - 2 * kLeft);
    app.light(placeAt(info, Math.min(1, Math.max(0, part)) * info.margin.perimeter));
  };
  canvas.addEventListener("pointermove", point);
  canvas.addEventListener("pointerdown", point);
  canvas.addEventListener("pointerleave", () => app.light(-1));
  canvas.addEventListener("keydown", (event) => {
    const { info } = app.active;
    if (!info) return;
    const tips = info.tips.map((tip) => placeAt(info, tip.s));
    const last = info.margin.s.length - 1;
    const to: Record<string, number | undefined> = {
      ArrowRight: Math.min(last, app.lit + 1),
      ArrowLeft: Math.max(0, app.lit - 1),
      PageDown: tips.find((place) => place > app.lit) ?? tips[0],
      PageUp: tips.findLast((place) => place < app.lit) ?? tips.at(-1),
      Home: 0,
      End: last,
    };
    const next = to[event.key];
    if (next === undefined) return;
    app.light(next);
    event.preventDefault();
    event.stopPropagation();
  });
  canvas.addEventListener("blur", () => app.light(-1));
  new ResizeObserver(redraw).observe(canvas);
  for (const kind of ["leaf", "active", "lit", "shown"] as const) app.events.on(kind, redraw);
  return element(
    "section",
    {},
    element("h2", {}, "Margin profile: distance to the petiole around the leaf"),
    canvas,
    said,
    element(
      "p",
      { class: "hint" },
      "Point at the curve or at the leaf's margin: the other lights up. Arrow keys move, Page Up and Down go from peak to peak.",
    ),
  );
}
