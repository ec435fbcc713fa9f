// Numbers as colours: matplotlib's viridis, which keeps its order in grey and for the colour-blind.
import type { FieldName, Frame } from "./core/protocol";

// Every 16th of its 256 colours and the last one, sRGB; by Smith, van der Walt and Firing, public domain (CC0).
const kStops =
  "440154 481a6c 472f7d 414487 39568c 31688e 2a788e 23888e 1f988b 22a884 35b779 54c568 7ad151 a5db36 d2e21b fde725"
    .split(" ")
    .map(
      (hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255) as [number, number, number],
    );

function linear(s: number): number {
  return s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
}

const kSteps = 256;
const kTable = new Float32Array(kSteps * 3); // linear
for (let step = 0; step < kSteps; ++step) {
  const at = (step / (kSteps - 1)) * (kStops.length - 1);
  const low = Math.min(Math.floor(at), kStops.length - 2);
  for (let c = 0; c < 3; ++c) {
    kTable[3 * step + c] = linear(kStops[low]![c]! + (kStops[low + 1]![c]! - kStops[low]![c]!) * (at - low));
  }
}

/** As the background of an element that shows the scale. */
export const SCALE_GRADIENT = `linear-gradient(to right, ${kStops.map((c) => `rgb(${c.map((v) => Math.round(255 * v)).join(" ")})`).join(", ")})`;

export interface Range {
  min: number;
  max: number;
}

/** Linear RGB of each value, interpolated between two moments. */
export function paintField(
  out: Float32Array,
  a: Float32Array,
  b: Float32Array,
  mix: number,
  { min, max }: Range,
): void {
  const scale = max > min ? (kSteps - 1) / (max - min) : 0;
  for (let i = 0; i < a.length; ++i) {
    const value = a[i]! + (b[i]! - a[i]!) * mix;
    const step = 3 * Math.round(Math.min(kSteps - 1, Math.max(0, (value - min) * scale)));
    out[3 * i] = kTable[step]!;
    out[3 * i + 1] = kTable[step + 1]!;
    out[3 * i + 2] = kTable[step + 2]!;
  }
}

/** The range of a field in a frame. */
export function fieldRange(frame: Frame, field: FieldName): Range {
  if (field === "dryness") return { min: 0, max: 1 };
  let min = Infinity;
  let max = -Infinity;
  for (const value of frame.fields[field]) {
    if (value < min) min = value;
    if (value > max) max = value;
  }
  if (!(min <= max)) return { min: 0, max: 1 };
  return { min, max };
}

export function united(a: Range | undefined, b: Range): Range {
  return a ? { min: Math.min(a.min, b.min), max: Math.max(a.max, b.max) } : b;
}
