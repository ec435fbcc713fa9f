// Without WebGL: the leaf from above, drawn triangle by triangle on a plain canvas.
import type { App } from "../app";
import { byId } from "../dom";
import { paintField } from "../field_colours";

function sRgb(linear: number): number {
  const v = Math.min(1, Math.max(0, linear));
  return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
}

/** Draws the active leaf whenever it changes. */
export function buildFlat(app: App): void {
  const canvas = byId<HTMLCanvasElement>("canvas");
  const pen = canvas.getContext("2d");
  if (!pen) return;
  const draw = () => {
    const { info } = app.active;
    const moment = app.active.around(app.playback.playhead);
    const { clientWidth: width, clientHeight: height } = canvas.parentElement!;
    if (!info || !moment || width === 0) return;
    Object.assign(canvas, { width, height });
    const { positions } = moment.before;
    let colours = moment.before.colours;
    if (app.shown.field) {
      const values = moment.before.fields[app.shown.field];
      colours = new Float32Array(3 * info.points);
      paintField(colours, values, values, 0, app.range);
    }
    const scale = Math.min(width, height) / (1.9 * info.length);
    const x = (i: number) => width / 2 + scale * positions[3 * i]!;
    const y = (i: number) => height * 0.66 + scale * positions[3 * i + 2]!;
    const faces = Array.from({ length: info.faces.length / 3 }, (_, f) => f);
    const depth = (f: number) => positions[3 * info.faces[3 * f]! + 1]!;
    faces.sort((a, b) => depth(a) - depth(b));
    for (const f of faces) {
      const [a, b, c] = [info.faces[3 * f]!, info.faces[3 * f + 1]!, info.faces[3 * f + 2]!];
      const area = (x(b) - x(a)) * (y(c) - y(a)) - (x(c) - x(a)) * (y(b) - y(a));
      const normal = Math.abs(moment.before.normals[3 * a + 1]!);
      const light = (area < 0 ? 1 : 0.75) * (0.55 + 0.6 * normal);
      const channel = (k: number) =>
        sRgb(((colours[3 * a + k]! + colours[3 * b + k]! + colours[3 * c + k]!) / 3) * light);
      pen.fillStyle = pen.strokeStyle = `rgb(${channel(0)} ${channel(1)} ${channel(2)})`;
      pen.beginPath();
      pen.moveTo(x(a), y(a));
      pen.lineTo(x(b), y(b));
      pen.lineTo(x(c), y(c));
      pen.closePath();
      pen.fill();
      pen.stroke();
    }
  };
  let asked = false;
  const ask = () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      draw();
    });
  };
  for (const kind of ["frames", "leaf", "active", "shown"] as const) app.events.on(kind, ask);
  app.playback.events.on("moved", ask);
  addEventListener("resize", ask);
}
