// The things in a photo, and which of them are leaves: the same steps as src/wilt/import/photo_objects.cpp.

import { type Mask, type Mat, type OpenCv, type Plane, maskOf, morphed, withMats } from "./opencv";

const SMALLEST = 1 / 2000; // of the photo
const RECTANGLE = 0.92; // area over that of the smallest rectangle around it
const DISC = 0.975; // area over that of its smallest circle
const THINNEST = 0.02; // area of the largest disc inside over its own
const SPECK = 0.05; // smaller than this share of the largest is no leaf beside it,
const EDGE_THING = 0.2; // nor is this at the edge of the photo
const WHOLE_WINS = 0.25; // a whole leaf goes before one that is cut off and not 1 / this larger

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** A connected thing of a photo. */
export interface PhotoObject {
  /** Pixels, two wider than the object where the photo allows it. */
  box: Box;
  /** Of each of the box's pixels, 0 to 1, that this object covers. */
  share: Plane;
  /** Pixels. */
  area: number;
  /** Whether it touches the photo's edge. */
  cutOff: boolean;
  /** Why it is taken for no leaf; empty for a leaf. */
  noLeafReason: string;
}

function longestRing(cv: OpenCv, mask: Mat, use: (ring: Mat) => string): string {
  return withMats(cv, (mats) => {
    const rings = mats.keep(new cv.MatVector());
    cv.findContours(mask, rings, mats.empty(), cv.RETR_EXTERNAL, cv.CHAIN_APPROX_NONE);
    let longest = mats.keep(rings.get(0));
    for (let k = 1; k < rings.size(); ++k) {
      const ring = mats.keep(rings.get(k));
      if (ring.rows > longest.rows) longest = ring;
    }
    return use(longest);
  });
}

function deepest(cv: OpenCv, mask: Mat): number {
  return withMats(cv, (mats) => {
    const [framed, depth] = [mats.empty(), mats.empty()];
    cv.copyMakeBorder(mask, framed, 1, 1, 1, 1, cv.BORDER_CONSTANT, [0, 0, 0, 0]);
    cv.distanceTransform(framed, depth, cv.DIST_L2, 5);
    return depth.data32F.reduce((most, value) => Math.max(most, value), 0);
  });
}

function whyNoLeaf(cv: OpenCv, picture: Mask, area: number): string {
  return withMats(cv, (mats) => {
    const mask = mats.of(picture);
    const shape = longestRing(cv, mask, (ring) => {
      const filled = cv.contourArea(ring) + 0.5 * cv.arcLength(ring, true);
      const { size } = cv.minAreaRect(ring);
      if (filled > RECTANGLE * (size.width + 1) * (size.height + 1)) return "a ruler or a card";
      const { radius } = cv.minEnclosingCircle(ring);
      return filled > DISC * Math.PI * (radius + 0.5) ** 2 ? "a coin" : "";
    });
    if (shape) return shape;
    return Math.PI * deepest(cv, mask) ** 2 < THINNEST * area ? "a line" : "";
  });
}

function objectOf(cv: OpenCv, share: Plane, labels: Int32Array, label: number, tight: Box): PhotoObject {
  const { width: across, height: down } = share;
  const [right, bottom] = [tight.x + tight.width, tight.y + tight.height];
  const x = Math.max(0, tight.x - 2);
  const y = Math.max(0, tight.y - 2);
  const width = Math.min(across, right + 2) - x;
  const height = Math.min(down, bottom + 2) - y;
  const mask: Mask = { width, height, data: new Uint8Array(width * height) };
  const own = new Float32Array(width * height);
  for (let i = 0; i < own.length; ++i) {
    const at = (y + Math.floor(i / width)) * across + x + (i % width);
    mask.data[i] = labels[at] === label ? 255 : 0;
    // The half-covered rim belongs to the object that it touches.
    own[i] = labels[at] === label || labels[at] === 0 ? share.data[at] : 0;
  }
  const near = morphed(cv, "dilate", mask, cv.MORPH_ELLIPSE, 7).data;
  let area = 0;
  for (let i = 0; i < own.length; ++i) {
    if (!near[i]) own[i] = 0;
    area += own[i];
  }
  return {
    box: { x, y, width, height },
    share: { width, height, data: own },
    area,
    cutOff: tight.x === 0 || tight.y === 0 || right === across || bottom === down,
    noLeafReason: whyNoLeaf(cv, mask, area),
  };
}

function connectedObjects(cv: OpenCv, share: Plane): PhotoObject[] {
  return withMats(cv, (mats) => {
    const covered = maskOf(share, (value) => value >= 0.5);
    const [labels, statistics] = [mats.empty(), mats.empty()];
    const count = cv.connectedComponentsWithStats(mats.of(covered), labels, statistics, mats.empty(), 8);
    const label = labels.data32S.slice();
    const row = statistics.data32S.slice();
    const columns = statistics.cols;
    const objects: PhotoObject[] = [];
    for (let k = 1; k < count; ++k) {
      const of = (column: number) => row[k * columns + column];
      if (of(cv.CC_STAT_AREA) < SMALLEST * share.data.length) continue;
      const tight = {
        x: of(cv.CC_STAT_LEFT),
        y: of(cv.CC_STAT_TOP),
        width: of(cv.CC_STAT_WIDTH),
        height: of(cv.CC_STAT_HEIGHT),
      };
      objects.push(objectOf(cv, share, label, k, tight));
    }
    return objects;
  });
}

function order(a: PhotoObject, b: PhotoObject): number {
  if ((a.noLeafReason === "") !== (b.noLeafReason === "")) return a.noLeafReason === "" ? -1 : 1;
  const weight = (object: PhotoObject) => (object.cutOff ? WHOLE_WINS * object.area : object.area);
  return weight(b) - weight(a);
}

/** The things that cover at least 1/2000 of the photo, those that may be leaves first, by area. */
export function photoObjects(cv: OpenCv, share: Plane): PhotoObject[] {
  const objects = connectedObjects(cv, share);
  const largest = Math.max(
    0,
    ...objects.filter((object) => !object.noLeafReason).map((object) => object.area),
  );
  for (const object of objects) {
    if (object.noLeafReason) continue;
    if (object.area < SPECK * largest) object.noLeafReason = "a speck";
    if (object.cutOff && object.area < EDGE_THING * largest) object.noLeafReason = "a thing at the edge";
  }
  return objects.sort(order);
}
