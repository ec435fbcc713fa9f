// The petiole of a photographed leaf, where the outline alone does not show it: the same steps as
// src/wilt/import/photo_petiole.cpp, where they are explained.

import {
  type Mats,
  type OpenCv,
  type Plane,
  type Rgb,
  labOf,
  maskOf,
  morphed,
  numbersOf,
  resized,
  withMats,
} from "./opencv";
import type { PhotoObject } from "./photo_objects";
import { type Ridges, findRidges } from "./photo_ridges";
import { bledColours } from "./photo_texture";

const SIDE = 420; // pixels of the reduced leaf in which veins are sought
const DIRECTIONS = 72; // of rays around a point
const RAY_FROM = 5; // pixels of the reduced leaf
const RAY_TO = 75;
const FEWEST_VEINS = 5;
const WIDE_GAP = (105 / 180) * Math.PI; // between neighbouring main veins
const FAINTEST = 0.42; // strength of a main vein over the second strongest
const MOST_VEINS = 7;

export interface Place {
  x: number;
  y: number;
}

/** Where main veins meet. */
export interface VeinFork {
  /** Pixels of the photo. */
  place: Place;
  /** Radians, directions of the veins that leave it, x to the right, y down. */
  angles: number[];
}

const angleOf = (direction: number) => (2 * Math.PI * direction) / DIRECTIONS;

// The mean over a stretch of the ray at `angle`, a cone of 14 degrees: main veins bend a little.
function rayKernel(angle: number, from: number, to: number): Plane {
  const spread = 0.12;
  const reach = Math.trunc(to * (1 + spread)) + 1;
  const side = 2 * reach + 1;
  const data = new Float32Array(side * side);
  const [ax, ay] = [Math.cos(angle), Math.sin(angle)];
  for (let y = -reach; y <= reach; ++y) {
    for (let x = -reach; x <= reach; ++x) {
      const r = x * ax + y * ay;
      if (r >= from && r <= to && Math.abs(y * ax - x * ay) <= 1 + spread * r)
        data[(reach + y) * side + reach + x] = 1 / (to - from);
    }
  }
  return { width: side, height: side, data };
}

function filtered(mats: Mats, image: Plane, kernel: Plane): Float32Array {
  const { cv } = mats;
  const result = mats.empty();
  cv.filter2D(
    mats.of(image),
    result,
    cv.CV_32F,
    mats.of(kernel),
    new cv.Point(-1, -1),
    0,
    cv.BORDER_CONSTANT,
  );
  return numbersOf(result);
}

// For every pixel how steadily lines run along a ray from it: the weaker of its near and its far half.
function rayStrength(cv: OpenCv, ridges: Ridges, angle: number): Float32Array {
  const aligned = ridges.strength.data.map((strength, i) => {
    const turn = Math.cos(ridges.direction.data[i] - angle);
    return Math.max(0, (turn * turn - 0.9) / 0.1) * strength; // within 18 degrees
  });
  const image = { ...ridges.strength, data: aligned };
  const middle = 0.5 * (RAY_FROM + RAY_TO);
  return withMats(cv, (mats) => {
    const far = filtered(mats, image, rayKernel(angle, middle, RAY_TO));
    return filtered(mats, image, rayKernel(angle, RAY_FROM, middle)).map((near, i) => Math.min(near, far[i]));
  });
}

interface Fan {
  score: number;
  directions: number[]; // of distinct veins, the strongest first
  strengths: number[];
}

// Veins that leave a pixel: the strongest rays, at least 20 degrees apart.
function fanAt(rays: Float32Array[], pixel: number): Fan {
  const apart = DIRECTIONS / 18;
  const left = rays.map((ray) => ray[pixel]);
  const directions: number[] = [];
  const strengths: number[] = [];
  while (directions.length < MOST_VEINS) {
    let strongest = 0;
    for (let k = 1; k < DIRECTIONS; ++k) if (left[k] > left[strongest]) strongest = k;
    directions.push(strongest);
    strengths.push(left[strongest]);
    for (let k = 1 - apart; k < apart; ++k) left[(strongest + k + DIRECTIONS) % DIRECTIONS] = -1;
  }
  // A fork is as good as its fifth vein is strong, and better for every further one.
  const score = strengths[2] + strengths[3] + 2 * strengths[4] + 0.5 * strengths[5];
  return { score, directions, strengths };
}

function bestFan(rays: Float32Array[], near: Uint8Array): { fan: Fan; pixel: number } {
  let best: { fan: Fan; pixel: number } = { fan: { score: 0, directions: [], strengths: [] }, pixel: 0 };
  near.forEach((value, pixel) => {
    if (!value) return;
    const fan = fanAt(rays, pixel);
    if (fan.score > best.fan.score) best = { fan, pixel };
  });
  return best;
}

// Whether veins leave to all sides but one, where the sinus is; at a node of a pinnate leaf they leave two sides free.
function isPalmate(angles: number[]): boolean {
  const around = [...angles].sort((a, b) => a - b);
  around.push(around[0] + 2 * Math.PI);
  return around.filter((angle, k) => k > 0 && angle - around[k - 1] > WIDE_GAP).length <= 1;
}

// One step of sharpened(): where the lines near `place` meet. Nothing when they are parallel.
function meetingPoint(ridges: Ridges, fan: Fan, place: Place, veins: number): Place | undefined {
  const reach = 40;
  const { width, data: strength } = ridges.strength;
  let [xx, xy, yy, bx, by] = [0, 0, 0, 0, 0];
  for (const angle of fan.directions.slice(0, veins).map(angleOf)) {
    for (let i = 0; i < strength.length; ++i) {
      const [x, y] = [i % width, Math.floor(i / width)];
      const [dx, dy] = [x - place.x, y - place.y];
      const r = Math.hypot(dx, dy);
      const line = ridges.direction.data[i];
      if (r < RAY_FROM || r > reach || Math.cos(Math.atan2(dy, dx) - angle) < 0.94) continue;
      if (Math.cos(line - angle) ** 2 < 0.9) continue;
      const [ax, ay] = [-Math.sin(line), Math.cos(line)];
      const weight = strength[i] / r;
      xx += weight * ax * ax;
      xy += weight * ax * ay;
      yy += weight * ay * ay;
      bx += weight * ax * (ax * x + ay * y);
      by += weight * ay * (ax * x + ay * y);
    }
  }
  const determinant = xx * yy - xy * xy;
  if (!(xx > 0 && determinant > 0)) return undefined;
  return { x: (yy * bx - xy * by) / determinant, y: (xx * by - xy * bx) / determinant };
}

// Where lines along the fan's directions meet: least squares over the lines' pixels near the fork.
function sharpened(ridges: Ridges, fan: Fan, start: Place, veins: number): Place {
  let place = start;
  for (let round = 0; round < 4; ++round) {
    const next = meetingPoint(ridges, fan, place, veins);
    if (!next) break;
    const [dx, dy] = [next.x - place.x, next.y - place.y];
    const step = Math.min(1, 6 / Math.max(Math.hypot(dx, dy), 1e-9));
    place = { x: place.x + step * dx, y: place.y + step * dy };
  }
  return place;
}

/** The place of a palmate leaf from which five veins or more leave; none when the photo shows no such place. */
export function findVeinFork(cv: OpenCv, rgb: Rgb, object: PhotoObject): VeinFork | undefined {
  const { box } = object;
  const reduction = Math.max(box.width, box.height) / SIDE;
  const size = { width: Math.round(box.width / reduction), height: Math.round(box.height / reduction) };
  if (reduction < 0.5 || Math.min(size.width, size.height) < 8) return undefined;
  // With its colours carried on beyond it the leaf's margin is no line.
  const lab = labOf(cv, bledColours(cv, rgb, object), size);
  const inside = maskOf(resized(cv, object.share, 1, size.width, size.height), (share) => share > 0.5);
  const ridges = findRidges(cv, lab, inside);
  const rays = Array.from({ length: DIRECTIONS }, (_, k) => rayStrength(cv, ridges, angleOf(k)));
  const { fan, pixel } = bestFan(rays, morphed(cv, "dilate", inside, cv.MORPH_ELLIPSE, 9).data);
  const veins = fan.strengths.filter((strength) => strength >= FAINTEST * fan.strengths[1]).length;
  if (veins < FEWEST_VEINS) return undefined;
  const angles = fan.directions.slice(0, veins).map(angleOf);
  if (!isPalmate(angles)) return undefined;
  const at = { x: pixel % size.width, y: Math.floor(pixel / size.width) };
  const place = sharpened(ridges, fan, at, veins);
  return {
    place: { x: box.x + (place.x + 0.5) * reduction, y: box.y + (place.y + 0.5) * reduction },
    angles,
  };
}
