// The pixels of a photographed leaf as a texture: the same steps as src/wilt/import/photo_texture.cpp.

import { type OpenCv, type Plane, type Rgb, labOf, maskOf, morphed, resized, withMats } from "./opencv";
import { findRidges } from "./photo_ridges";
import type { Box, PhotoObject } from "./photo_objects";

const LARGEST_SIDE = 4096;
const RIDGE_SIDE = 448; // main veins of most leaves are then some three texels wide

/** The square around a leaf, its colours carried on beyond the margin, and its veins. As CutOut has them. */
export interface PhotoTexture {
  size: number;
  rgb: Uint8Array;
  area: Box;
  ridgeSize: number;
  ridges: Float32Array;
}

/** A part of a picture with `channels` values a pixel; beyond the picture its rim goes on (`repeat`) or there is nothing. */
function part<Data extends Uint8Array | Float32Array>(
  data: Data,
  channels: number,
  from: { width: number; height: number },
  box: Box,
  repeat: boolean,
): Data {
  const Array = data.constructor as new (length: number) => Data;
  const result = new Array(channels * box.width * box.height);
  const within = (value: number, size: number) => Math.min(size - 1, Math.max(0, value));
  for (let y = 0; y < box.height; ++y) {
    const row = within(box.y + y, from.height);
    for (let x = 0; x < box.width; ++x) {
      const column = within(box.x + x, from.width);
      if (!repeat && (row !== box.y + y || column !== box.x + x)) continue;
      const [source, target] = [channels * (row * from.width + column), channels * (y * box.width + x)];
      for (let c = 0; c < channels; ++c) result[target + c] = data[source + c];
    }
  }
  return result;
}

/** The colours of the object's box, in which every pixel not wholly covered has the colour of the nearest that is. */
export function bledColours(cv: OpenCv, rgb: Rgb, object: PhotoObject): Rgb {
  const { width, height } = object.box;
  const colours = part(rgb.data, 3, rgb, object.box, true);
  const pure = maskOf(object.share, (share) => share >= 0.98);
  const inner = morphed(cv, "erode", pure, cv.MORPH_CROSS, 3).data;
  if (!inner.includes(255)) return { width, height, data: colours };
  // The number of the nearest pure pixel, which has its own number.
  const nearest = withMats(cv, (mats) => {
    const outside = mats.of({ width, height, data: inner.map((value) => 255 - value) });
    const labels = mats.empty();
    cv.distanceTransformWithLabels(outside, mats.empty(), labels, cv.DIST_L2, 5, cv.DIST_LABEL_PIXEL);
    return labels.data32S.slice();
  });
  const pixelOf = new Int32Array(inner.length + 1);
  nearest.forEach((label, i) => {
    if (inner[i]) pixelOf[label] = i;
  });
  nearest.forEach((label, i) => {
    if (!inner[i]) colours.copyWithin(3 * i, 3 * pixelOf[label], 3 * pixelOf[label] + 3);
  });
  return { width, height, data: colours };
}

// `square` and `share` are of the same area.
function ridgeMap(cv: OpenCv, square: Rgb, share: Plane): Float32Array {
  const side = RIDGE_SIDE;
  const lab = labOf(cv, square, { width: side, height: side });
  const inside = maskOf(resized(cv, share, 1, side, side), (covered) => covered >= 0.5);
  return findRidges(cv, lab, inside).strength.data.map((value, i) => (inside.data[i] ? value : -1));
}

/** The square around the object, with 1/64 to spare on every side. `scale`: pixels of the file in one of these. */
export function leafPhoto(cv: OpenCv, rgb: Rgb, scale: number, object: PhotoObject): PhotoTexture {
  const { width, height } = object.box;
  const longest = Math.max(width, height);
  const side = longest + 2 * (Math.floor(longest / 64) + 2);
  const left = Math.floor((side - width) / 2);
  const top = Math.floor((side - height) / 2);
  const around = { x: -left, y: -top, width: side, height: side };
  const colours = part(bledColours(cv, rgb, object).data, 3, object.box, around, true);
  const square: Rgb = { width: side, height: side, data: colours };
  const share = part(object.share.data, 1, object.box, around, false);
  const ridges = ridgeMap(cv, square, { width: side, height: side, data: share });
  const shown = side > LARGEST_SIDE ? resized(cv, square, 3, LARGEST_SIDE, LARGEST_SIDE) : square;
  return {
    size: shown.width,
    rgb: shown.data,
    area: {
      x: scale * (object.box.x - left),
      y: scale * (object.box.y - top),
      width: scale * side,
      height: scale * side,
    },
    ridgeSize: RIDGE_SIDE,
    ridges,
  };
}
