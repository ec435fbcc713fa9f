// Lines in a photo, veins among them: the same steps as src/wilt/import/photo_ridges.cpp.

import { type Mask, type Mat, type OpenCv, type Plane, numbers, numbersOf, withMats } from "./opencv";

const VEIN_WIDTH = 1.6; // standard deviation of the smoothing, pixels

export interface Ridges {
  /** Contrast of a line through the pixel, 0 to 1, which the strongest tenth share. */
  strength: Plane;
  /** Radians of the line, 0 to pi, y down. */
  direction: Plane;
}

function channelOf({ width, height, data }: Plane, c: number): Plane {
  return { width, height, data: numbers(width * height, (i) => data[3 * i + c]) };
}

// Strengths from 0 to 1, which the strongest tenth of the pixels share.
function level(strength: Float32Array, inside: Uint8Array): void {
  const values = strength.filter((_, i) => inside[i]).sort();
  if (values.length === 0) return;
  const tenth = Math.max(values[Math.floor(0.9 * values.length)], 1e-6);
  for (let i = 0; i < strength.length; ++i) strength[i] = Math.min(strength[i] / tenth, 1);
}

function secondDerivatives(
  cv: OpenCv,
  channel: Plane,
): { xx: Float32Array; xy: Float32Array; yy: Float32Array } {
  return withMats(cv, (mats) => {
    const smooth = mats.of(channel);
    cv.GaussianBlur(smooth, smooth, new cv.Size(0, 0), VEIN_WIDTH, 0, cv.BORDER_DEFAULT);
    const derivative = (dx: number, dy: number, into: Mat) => {
      cv.Sobel(smooth, into, cv.CV_32F, dx, dy, 3, 0.25);
      return numbersOf(into);
    };
    return {
      xx: derivative(2, 0, mats.empty()),
      xy: derivative(1, 1, mats.empty()),
      yy: derivative(0, 2, mats.empty()),
    };
  });
}

// The larger eigenvalue of the Hessian of one channel and its direction.
function ridgesOf(cv: OpenCv, channel: Plane, inside: Uint8Array): Ridges {
  const { xx, xy, yy } = secondDerivatives(cv, channel);
  const strength = new Float32Array(xx.length);
  const direction = new Float32Array(xx.length);
  for (let i = 0; i < xx.length; ++i) {
    if (!inside[i]) continue;
    const [a, b, c] = [xx[i], xy[i], yy[i]];
    const mean = 0.5 * (a + c);
    const spread = Math.hypot(0.5 * (a - c), b);
    const across = 0.5 * Math.atan2(2 * b, a - c); // of the eigenvalue mean + spread
    const [first, second] = [mean + spread, mean - spread];
    const dark = Math.abs(first) > Math.abs(second); // a dark line: lightness rises to both sides
    const [large, small] = dark ? [first, second] : [-second, first];
    const along = (dark ? across : across + 0.5 * Math.PI) + 0.5 * Math.PI;
    strength[i] = Math.max(0, large - Math.abs(small));
    direction[i] = along - Math.PI * Math.floor(along / Math.PI);
  }
  level(strength, inside);
  return { strength: { ...channel, data: strength }, direction: { ...channel, data: direction } };
}

/** The clearest ridges of lightness and of both colour axes, inside the mask. */
export function findRidges(cv: OpenCv, lab: Plane, inside: Mask): Ridges {
  const best = ridgesOf(cv, channelOf(lab, 0), inside.data);
  for (const c of [1, 2]) {
    const ridges = ridgesOf(cv, channelOf(lab, c), inside.data);
    ridges.strength.data.forEach((value, i) => {
      if (value <= best.strength.data[i]) return;
      best.strength.data[i] = value;
      best.direction.data[i] = ridges.direction.data[i];
    });
  }
  return best;
}
