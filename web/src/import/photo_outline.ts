// From covered pixels to an outline, by marching squares: the same steps as src/wilt/import/photo_outline.cpp.

import type { Plane } from "./opencv";
import type { PhotoObject } from "./photo_objects";

const SMALLEST_HOLE = 16; // pixels

/** Rings in pixels of the photo's file from its top left corner, y downwards: x, y of each point. */
export interface PhotoOutline {
  margin: Float64Array;
  holes: Float64Array[];
}

type Ring = Float64Array;

// The line crosses edges between neighbours; edge 2 i is the one from pixel i to the right, 2 i + 1 the one downwards.
// Covered pixels lie on its left, y down.
class Contour {
  readonly #next: Int32Array; // the edge that the line crosses next; -1: none

  constructor(readonly share: Plane) {
    this.#next = new Int32Array(2 * share.data.length).fill(-1);
    for (let y = 0; y + 1 < share.height; ++y)
      for (let x = 0; x + 1 < share.width; ++x) this.#crossCell(x, y);
  }

  /** The closed lines; empties the contour. */
  takeRings(): Ring[] {
    const rings: Ring[] = [];
    for (let start = 0; start < this.#next.length; ++start) {
      if (this.#next[start] < 0) continue;
      const points: number[] = [];
      for (let edge = start; this.#next[edge] >= 0; ) {
        points.push(...this.#point(edge));
        const next = this.#next[edge];
        this.#next[edge] = -1;
        edge = next;
      }
      rings.push(Float64Array.from(points));
    }
    return rings;
  }

  #at(x: number, y: number): number {
    return this.share.data[y * this.share.width + x];
  }

  // Walks around the cell: where it steps from covered to free the line leaves, where from free to covered it enters. Of a
  // saddle's two ways the one that keeps the covered corners together is taken when the middle is covered.
  #crossCell(x: number, y: number): void {
    const shares = [this.#at(x, y), this.#at(x + 1, y), this.#at(x + 1, y + 1), this.#at(x, y + 1)];
    const covered = shares.map((share) => share >= 0.5);
    if (covered.every((corner) => corner === covered[0])) return;
    const right = (px: number, py: number) => 2 * (py * this.share.width + px);
    const edge = [right(x, y), right(x + 1, y) + 1, right(x, y + 1), right(x, y) + 1];
    const sides = [0, 1, 2, 3];
    const outs = sides.filter((k) => covered[k] && !covered[(k + 1) % 4]);
    const ins = sides.filter((k) => !covered[k] && covered[(k + 1) % 4]);
    if (ins.length === 1) {
      this.#next[edge[ins[0]]] = edge[outs[0]];
      return;
    }
    const middle = shares.reduce((sum, share) => sum + share, 0) >= 2;
    // Around the cell ins and outs alternate; joining an in to the out before it cuts off a free corner.
    for (const k of ins) this.#next[edge[k]] = edge[(k + (middle ? 3 : 1)) % 4];
  }

  #point(edge: number): [number, number] {
    const pixel = edge >> 1;
    const x = pixel % this.share.width;
    const y = Math.floor(pixel / this.share.width);
    const a = this.#at(x, y);
    const b = edge % 2 === 0 ? this.#at(x + 1, y) : this.#at(x, y + 1);
    const t = Math.min(0.98, Math.max(0.02, (0.5 - a) / (b - a))); // lines do not meet in a pixel's middle
    return edge % 2 === 0 ? [x + t, y] : [x, y + t];
  }
}

function framed({ width, height, data }: Plane): Plane {
  const wider = width + 2;
  const result = new Float32Array(wider * (height + 2));
  for (let y = 0; y < height; ++y) result.set(data.subarray(y * width, (y + 1) * width), (y + 1) * wider + 1);
  return { width: wider, height: height + 2, data: result };
}

function signedArea(ring: Ring): number {
  let twice = 0;
  for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2)
    twice += ring[j] * ring[i + 1] - ring[i] * ring[j + 1];
  return twice / 2;
}

function contains(ring: Ring, x: number, y: number): boolean {
  let inside = false;
  for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2) {
    const [ax, ay, bx, by] = [ring[i], ring[i + 1], ring[j], ring[j + 1]];
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  }
  return inside;
}

/** The line where half a pixel is covered. `scale`: pixels of the file in one of these. Throws when nothing is left. */
export function traceOutline(object: PhotoObject, scale: number): PhotoOutline {
  const { x: left, y: top } = object.box;
  const rings = new Contour(framed(object.share)).takeRings();
  const areas = rings.map(signedArea);
  const best = areas.reduce((most, area, k) => (Math.abs(area) > Math.abs(areas[most] ?? 0) ? k : most), 0);
  const largest = rings[best];
  if (!largest || Math.abs(areas[best]) < SMALLEST_HOLE)
    throw new Error("the leaf in the photo is too small to have an outline");
  const inFile = (ring: Ring) => ring.map((value, i) => scale * ((i % 2 === 0 ? left : top) + value - 0.5));
  const isHole = (ring: Ring, k: number) =>
    areas[k] * areas[best] < 0 && Math.abs(areas[k]) >= SMALLEST_HOLE && contains(largest, ring[0], ring[1]);
  return { margin: inFile(largest), holes: rings.filter(isHole).map(inFile) };
}
