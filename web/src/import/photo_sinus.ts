// Where basal lobes that overlap hide the sinus the blade is cut open: open_sinus of src/wilt/import/photo_petiole.cpp.

import { type Mask, type OpenCv, type Plane, withMats } from "./opencv";
import type { PhotoObject } from "./photo_objects";
import type { Place } from "./photo_petiole";

const STEP = 0.5; // pixels
const HALF_OPENING = 0.02; // half the wedge's angle, radians
const DETOUR = 0.15; // of the size: what turning by a right angle is worth
const LEAST_CUT = 0.015; // of the size

// What is not covered and reaches the frame: 255.
function outsideOf({ width, height, data: share }: Plane): Mask {
  const outside = new Uint8Array(width * height);
  const open: number[] = [];
  const visit = (x: number, y: number) => {
    const pixel = y * width + x;
    if (x < 0 || y < 0 || x >= width || y >= height || outside[pixel] || share[pixel] >= 0.5) return;
    outside[pixel] = 255;
    open.push(pixel);
  };
  for (let x = 0; x < width; ++x) [0, height - 1].forEach((y) => visit(x, y));
  for (let y = 0; y < height; ++y) [0, width - 1].forEach((x) => visit(x, y));
  for (let pixel = open.pop(); pixel !== undefined; pixel = open.pop()) {
    const [x, y] = [pixel % width, Math.floor(pixel / width)];
    visit(x - 1, y);
    visit(x + 1, y);
    visit(x, y - 1);
    visit(x, y + 1);
  }
  return { width, height, data: outside };
}

// As cv::cvRound, halves to the even number.
function rounded(value: number): number {
  const low = Math.floor(value);
  if (value - low === 0.5) return low % 2 === 0 ? low : low + 1;
  return Math.round(value);
}

interface Cut {
  along: Place; // its direction
  reach: number; // pixels
  tissue: number; // of those through tissue
}

function cheapestCut(object: PhotoObject, start: Place, wanted: number, size: number): Cut {
  const { width, height, data: share } = object.share;
  const outside = outsideOf(object.share).data;
  // 0 outside, 1 in a hole, 2 in tissue
  const state = (px: number, py: number) => {
    const [x, y] = [rounded(px), rounded(py)];
    const pixel = y * width + x;
    if (x < 0 || y < 0 || x >= width || y >= height || outside[pixel]) return 0;
    return share[pixel] < 0.5 ? 1 : 2;
  };
  let least = Infinity;
  let best: Cut = { along: { x: 0, y: 0 }, reach: 0, tissue: 0 };
  for (let turn = 0; turn < 2 * Math.PI; turn += Math.PI / 360) {
    const along = { x: Math.cos(wanted + turn), y: Math.sin(wanted + turn) };
    let [reach, tissue] = [0, 0];
    for (
      let here = state(start.x, start.y);
      here !== 0;
      here = state(start.x + reach * along.x, start.y + reach * along.y)
    ) {
      tissue += here === 2 ? STEP : 0;
      reach += STEP;
    }
    const cost = tissue / size + DETOUR * (1 - Math.cos(turn));
    if (cost >= least) continue;
    least = cost;
    best = { along, reach, tissue };
  }
  return best;
}

function cutOut(cv: OpenCv, share: Plane, corners: Place[]): void {
  const shift = 6; // of the fixed-point coordinates
  withMats(cv, (mats) => {
    const wedge = mats.keep(new cv.Mat(corners.length, 1, cv.CV_32SC2));
    wedge.data32S.set(corners.flatMap(({ x, y }) => [rounded(x * (1 << shift)), rounded(y * (1 << shift))]));
    const cut = mats.of({ ...share, data: new Uint8Array(share.data.length) });
    cv.fillConvexPoly(cut, wedge, [255, 0, 0, 0], cv.LINE_AA, shift);
    cut.data.forEach((value, i) => (share.data[i] = Math.min(share.data[i], 1 - value / 255)));
  });
}

/**
 * Cuts the object's share open from the petiole to what lies around it, more or less `towards` a place (both in pixels of
 * the photo). Returns the length that was cut through tissue, pixels; 0 when nothing had to be cut.
 */
export function openSinus(cv: OpenCv, object: PhotoObject, petiole: Place, towards: Place): number {
  const size = Math.max(object.box.width, object.box.height);
  const start = { x: petiole.x - object.box.x - 0.5, y: petiole.y - object.box.y - 0.5 };
  const wanted = Math.atan2(towards.y - petiole.y, towards.x - petiole.x);
  const { along, reach, tissue } = cheapestCut(object, start, wanted, size);
  if (tissue <= LEAST_CUT * size) return 0;
  const end = { x: start.x + (reach + 2) * along.x, y: start.y + (reach + 2) * along.y };
  const beside = (place: Place, across: number) => ({
    x: place.x - across * along.y,
    y: place.y + across * along.x,
  });
  const half = 1 + HALF_OPENING * reach;
  cutOut(cv, object.share, [
    beside(start, -0.75),
    beside(end, -half),
    beside(end, half),
    beside(start, 0.75),
  ]);
  return tissue;
}
