// What of a photo is not its plain background: the same steps as src/wilt/import/photo_cover.cpp, where they are explained.

import {
  type Mask,
  type OpenCv,
  type Plane,
  type Rgb,
  bytesOf,
  labOf,
  maskOf,
  morphed,
  numbers,
  numbersOf,
  resized,
  withMats,
} from "./opencv";

const MODEL_SIDE = 320; // pixels of the reduced photo that the background is fitted to
const RIM = 0.04; // width of the photo's rim, share of its sides
const BIN = 6; // of the histogram of the rim's colours
const SIMILAR = 24; // difference from the commonest colour, at the start
const FARTHEST = 14; // and from the fitted background, at the end
const LEAST = 6; // the smallest threshold
const SURE_SHARE = 0.15; // of the photo that the background fills at least
const TERMS = 10;

export interface Cover {
  /** Of every pixel, 0 to 1, that something covers. */
  share: Plane;
  /** Colour difference that was taken for the edge; 0 with alpha. */
  threshold: number;
}

type Colour = [number, number, number];

// Lab with half the lightness.
function workingColours(cv: OpenCv, rgb: Rgb): Plane {
  const lab = labOf(cv, rgb);
  for (let i = 0; i < lab.data.length; i += 3) lab.data[i] *= 0.5;
  return lab;
}

// Cubic terms of x and y from -1 to 1 over the photo.
function termsAt(width: number, height: number, px: number, py: number, into: Float64Array): void {
  const x = (2 / width) * (px + 0.5) - 1;
  const y = (2 / height) * (py + 0.5) - 1;
  into[0] = 1;
  into[1] = x;
  into[2] = y;
  into[3] = x * x;
  into[4] = x * y;
  into[5] = y * y;
  into[6] = x * x * x;
  into[7] = x * x * y;
  into[8] = x * y * y;
  into[9] = y * y * y;
}

/** Three rows of coefficients. */
type Cubic = Float64Array;

function valueOf(cubic: Cubic, terms: Float64Array, channel: number): number {
  let value = 0;
  for (let k = 0; k < TERMS; ++k) value += cubic[TERMS * channel + k] * terms[k];
  return value;
}

// The commonest colour of the rim.
function rimColour(colours: Plane): Colour {
  const { width, height, data } = colours;
  const across = Math.max(1, Math.trunc(RIM * width));
  const down = Math.max(1, Math.trunc(RIM * height));
  const bins = new Map<number, { count: number; sum: Colour }>();
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      if (x >= across && x < width - across && y >= down && y < height - down) continue;
      const colour = [0, 1, 2].map((k) => data[3 * (y * width + x) + k]) as Colour;
      const key = colour.reduce((sum, value) => 1024 * sum + Math.floor(value / BIN) + 512, 0);
      const bin = bins.get(key) ?? { count: 0, sum: [0, 0, 0] };
      bin.count += 1;
      for (const k of [0, 1, 2] as const) bin.sum[k] += colour[k];
      bins.set(key, bin);
    }
  }
  const [, most] = [...bins].reduce((a, b) => ((b[1].count - a[1].count || a[0] - b[0]) > 0 ? b : a));
  return most.sum.map((sum) => sum / most.count) as Colour;
}

function fit(cv: OpenCv, colours: Plane, isBackground: Uint8Array): Cubic {
  const normal = new Float64Array(TERMS * TERMS);
  const right = new Float64Array(TERMS * 3);
  const terms = new Float64Array(TERMS);
  for (let i = 0; i < isBackground.length; ++i) {
    if (!isBackground[i]) continue;
    termsAt(colours.width, colours.height, i % colours.width, Math.floor(i / colours.width), terms);
    for (let a = 0; a < TERMS; ++a) {
      for (let b = 0; b < TERMS; ++b) normal[TERMS * a + b] += terms[a] * terms[b];
      for (let c = 0; c < 3; ++c) right[3 * a + c] += terms[a] * colours.data[3 * i + c];
    }
  }
  // A little of Tikhonov's: where no background is seen the higher terms stay small.
  for (let k = 1; k < TERMS; ++k) normal[(TERMS + 1) * k] += 1e-3 * normal[0];
  return withMats(cv, (mats) => {
    const matrix = mats.keep(new cv.Mat(TERMS, TERMS, cv.CV_64FC1));
    const columns = mats.keep(new cv.Mat(TERMS, 3, cv.CV_64FC1));
    const solution = mats.empty();
    matrix.data64F.set(normal);
    columns.data64F.set(right);
    cv.solve(matrix, columns, solution, cv.DECOMP_CHOLESKY);
    const solved = solution.data64F;
    return Float64Array.from(
      { length: 3 * TERMS },
      (_, i) => solved[3 * (i % TERMS) + Math.floor(i / TERMS)],
    );
  });
}

function differenceFrom(colours: Plane, cubic: Cubic): Plane {
  const { width, height, data } = colours;
  const result = new Float32Array(width * height);
  const terms = new Float64Array(TERMS);
  for (let i = 0; i < result.length; ++i) {
    termsAt(width, height, i % width, Math.floor(i / width), terms);
    let squared = 0;
    for (let c = 0; c < 3; ++c) squared += (data[3 * i + c] - valueOf(cubic, terms, c)) ** 2;
    result[i] = Math.sqrt(squared);
  }
  return { width, height, data: result };
}

function fitBackground(cv: OpenCv, rgb: Rgb): Cubic {
  const reduction = Math.max(1, Math.max(rgb.width, rgb.height) / MODEL_SIDE);
  const size = (side: number) => Math.round(side / reduction);
  const colours = workingColours(cv, resized(cv, rgb, 3, size(rgb.width), size(rgb.height)));
  let cubic: Cubic = new Float64Array(3 * TERMS);
  rimColour(colours).forEach((value, c) => (cubic[TERMS * c] = value));
  let within = SIMILAR;
  for (let round = 0; round < 5; ++round) {
    const similar = maskOf(differenceFrom(colours, cubic), (difference) => difference < within).data;
    const share = similar.reduce((count, value) => count + (value ? 1 : 0), 0) / similar.length;
    if (share < SURE_SHARE)
      throw new Error(
        `no plain background was found: only ${(100 * share).toFixed(0)} % of the photo has the colour of its rim; ` +
          "put the leaf on white paper or dark cloth, or save it as a PNG without its background",
      );
    cubic = fit(cv, colours, similar);
    within = Math.max(FARTHEST, 0.75 * within);
  }
  return cubic;
}

// Otsu's threshold of differences from 0 to 64.
function otsu(cv: OpenCv, differences: Plane): number {
  return withMats(cv, (mats) => {
    const levels = mats.empty();
    mats.of(differences).convertTo(levels, cv.CV_8U, 4);
    return cv.threshold(levels, mats.empty(), 0, 255, cv.THRESH_OTSU) / 4;
  });
}

function blurred(cv: OpenCv, picture: Plane, channels: 1 | 3): Plane {
  return withMats(cv, (mats) => {
    const result = mats.of(picture, channels);
    cv.GaussianBlur(result, result, new cv.Size(0, 0), 2.5, 0, cv.BORDER_DEFAULT);
    return { ...picture, data: numbersOf(result) };
  });
}

// The colour of what is surely an object, averaged nearby; zero weight where there is none.
function nearbyColour(
  cv: OpenCv,
  colours: Plane,
  differences: Plane,
  threshold: number,
): { sum: Plane; weight: Plane } {
  const sure = maskOf(differences, (difference) => difference > 1.25 * threshold);
  const inner = morphed(cv, "erode", sure, cv.MORPH_ELLIPSE, 3).data;
  // Needles lose everything to erosion: they count with what they have, faintly.
  const weight = numbers(inner.length, (i) => (inner[i] ? 1 : sure.data[i] ? 0.02 : 0));
  const sum = numbers(colours.data.length, (i) => weight[Math.floor(i / 3)] * colours.data[i]);
  return {
    sum: blurred(cv, { ...colours, data: sum }, 3),
    weight: blurred(cv, { ...colours, data: weight }, 1),
  };
}

// Pixels within two of the edge between what is above the threshold and what is below.
function edgeBand(cv: OpenCv, above: Mask): Uint8Array {
  return withMats(cv, (mats) => {
    const disc = mats.structuringElement(cv.MORPH_ELLIPSE, 5);
    const [source, wide, narrow] = [mats.of(above), mats.empty(), mats.empty()];
    cv.dilate(source, wide, disc);
    cv.erode(source, narrow, disc);
    const inner = bytesOf(narrow);
    return bytesOf(wide).map((value, i) => value & ~inner[i]);
  });
}

export function coverOfAlpha(alpha: Mask): Cover {
  return { share: { ...alpha, data: numbers(alpha.data.length, (i) => alpha.data[i] / 255) }, threshold: 0 };
}

/** `threshold`: by default Otsu's. Throws when there is no plain background. */
export function coverOfColours(cv: OpenCv, rgb: Rgb, asked?: number): Cover {
  const background = fitBackground(cv, rgb);
  const colours = workingColours(cv, rgb);
  const differences = differenceFrom(colours, background);
  const threshold = asked ?? Math.max(LEAST, otsu(cv, differences));
  const above = maskOf(differences, (difference) => difference > threshold);
  const band = edgeBand(cv, above);
  const nearby = nearbyColour(cv, colours, differences, threshold);
  const share = numbers(above.data.length, (i) => (above.data[i] ? 1 : 0));
  const terms = new Float64Array(TERMS);
  for (let i = 0; i < share.length; ++i) {
    const weight = nearby.weight.data[i];
    if (!band[i] || weight < 1e-4) continue;
    termsAt(rgb.width, rgb.height, i % rgb.width, Math.floor(i / rgb.width), terms);
    let along = 0;
    let squared = 0;
    for (let c = 0; c < 3; ++c) {
      const behind = valueOf(background, terms, c);
      const across = nearby.sum.data[3 * i + c] / weight - behind;
      along += (colours.data[3 * i + c] - behind) * across;
      squared += across * across;
    }
    share[i] = Math.min(1, Math.max(0, along / Math.max(squared, 1e-6)));
  }
  return { share: { width: rgb.width, height: rgb.height, data: share }, threshold };
}
