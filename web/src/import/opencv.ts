// OpenCV as the photo's steps need it: its types, how it is loaded, and who frees its memory.

export interface Mat {
  readonly rows: number;
  readonly cols: number;
  /** The elements. Views of a memory that may move: to be asked for anew after every call of OpenCV. */
  readonly data: Uint8Array;
  readonly data32F: Float32Array;
  readonly data32S: Int32Array;
  readonly data64F: Float64Array;
  convertTo(result: Mat, type: number, scale: number): void;
  delete(): void;
}

interface MatVector {
  size(): number;
  get(index: number): Mat;
  delete(): void;
}

interface Size {
  width: number;
  height: number;
}

interface Point {
  x: number;
  y: number;
}

/** The functions that are used, named and ordered as OpenCV has them. */
export interface OpenCv {
  Mat: new (rows?: number, cols?: number, type?: number, value?: number[]) => Mat;
  MatVector: new () => MatVector;
  Size: new (width: number, height: number) => Size;
  Point: new (x: number, y: number) => Point;
  readonly CV_8U: number;
  readonly CV_8UC1: number;
  readonly CV_8UC3: number;
  readonly CV_8UC4: number;
  readonly CV_32S: number;
  readonly CV_32SC2: number;
  readonly CV_32F: number;
  readonly CV_32FC1: number;
  readonly CV_32FC3: number;
  readonly CV_64FC1: number;
  readonly COLOR_RGB2Lab: number;
  readonly COLOR_RGBA2RGB: number;
  readonly INTER_AREA: number;
  readonly MORPH_ELLIPSE: number;
  readonly MORPH_CROSS: number;
  readonly THRESH_OTSU: number;
  readonly DIST_L2: number;
  readonly DIST_LABEL_PIXEL: number;
  readonly RETR_EXTERNAL: number;
  readonly CHAIN_APPROX_NONE: number;
  readonly BORDER_CONSTANT: number;
  readonly BORDER_DEFAULT: number;
  readonly BORDER_REPLICATE: number;
  readonly DECOMP_CHOLESKY: number;
  readonly LINE_AA: number;
  readonly CC_STAT_LEFT: number;
  readonly CC_STAT_TOP: number;
  readonly CC_STAT_WIDTH: number;
  readonly CC_STAT_HEIGHT: number;
  readonly CC_STAT_AREA: number;
  cvtColor(source: Mat, result: Mat, code: number): void;
  resize(source: Mat, result: Mat, size: Size, fx: number, fy: number, interpolation: number): void;
  erode(source: Mat, result: Mat, kernel: Mat): void;
  dilate(source: Mat, result: Mat, kernel: Mat): void;
  getStructuringElement(shape: number, size: Size): Mat;
  threshold(source: Mat, result: Mat, threshold: number, most: number, type: number): number;
  GaussianBlur(source: Mat, result: Mat, size: Size, sigmaX: number, sigmaY: number, border: number): void;
  Sobel(source: Mat, result: Mat, type: number, dx: number, dy: number, size: number, scale: number): void;
  filter2D(
    s: Mat,
    result: Mat,
    type: number,
    kernel: Mat,
    anchor: Point,
    delta: number,
    border: number,
  ): void;
  copyMakeBorder(
    source: Mat,
    result: Mat,
    top: number,
    bottom: number,
    left: number,
    right: number,
    border: number,
    value: number[],
  ): void;
  solve(matrix: Mat, right: Mat, result: Mat, method: number): boolean;
  distanceTransform(source: Mat, result: Mat, type: number, size: number): void;
  distanceTransformWithLabels(
    s: Mat,
    result: Mat,
    labels: Mat,
    type: number,
    size: number,
    label: number,
  ): void;
  connectedComponentsWithStats(
    source: Mat,
    labels: Mat,
    statistics: Mat,
    centroids: Mat,
    neighbours: number,
  ): number;
  findContours(source: Mat, rings: MatVector, hierarchy: Mat, mode: number, method: number): void;
  contourArea(ring: Mat): number;
  arcLength(ring: Mat, closed: boolean): number;
  minAreaRect(ring: Mat): { size: Size };
  minEnclosingCircle(ring: Mat): { radius: number };
  fillConvexPoly(image: Mat, points: Mat, colour: number[], line: number, shift: number): void;
}

/** A picture outside OpenCV's memory: `channels` values for each pixel, row by row. */
export interface Picture<Data extends Uint8Array | Float32Array> {
  width: number;
  height: number;
  data: Data;
}
/** sRGB, three bytes a pixel. */
export type Rgb = Picture<Uint8Array>;
/** One byte or one number a pixel. */
export type Mask = Picture<Uint8Array>;
export type Plane = Picture<Float32Array>;

/** 255 where `test` holds. */
export function maskOf({ width, height, data }: Plane, test: (value: number) => boolean): Mask {
  const mask = new Uint8Array(data.length);
  for (let i = 0; i < mask.length; ++i) mask[i] = test(data[i]) ? 255 : 0;
  return { width, height, data: mask };
}

/** `valueAt` of every place. */
export function numbers(length: number, valueAt: (i: number) => number): Float32Array {
  const result = new Float32Array(length); // Float32Array.from takes ten times as long
  for (let i = 0; i < length; ++i) result[i] = valueAt(i);
  return result;
}

/** Mats that live as long as a call of withMats. */
export class Mats {
  readonly #kept: { delete(): void }[] = [];

  constructor(readonly cv: OpenCv) {}

  keep<Kept extends { delete(): void }>(kept: Kept): Kept {
    this.#kept.push(kept);
    return kept;
  }

  empty(): Mat {
    return this.keep(new this.cv.Mat());
  }

  /** A copy of a picture with `channels` (1 or 3) values a pixel. */
  of(picture: Picture<Uint8Array | Float32Array>, channels: 1 | 3 = 1): Mat {
    const { cv } = this;
    const { width, height, data } = picture;
    if (data instanceof Uint8Array) {
      const mat = this.keep(new cv.Mat(height, width, channels === 1 ? cv.CV_8UC1 : cv.CV_8UC3));
      mat.data.set(data);
      return mat;
    }
    const mat = this.keep(new cv.Mat(height, width, channels === 1 ? cv.CV_32FC1 : cv.CV_32FC3));
    mat.data32F.set(data);
    return mat;
  }

  structuringElement(shape: number, side: number): Mat {
    return this.keep(this.cv.getStructuringElement(shape, new this.cv.Size(side, side)));
  }

  free(): void {
    for (const kept of this.#kept) kept.delete();
  }
}

/** What `work` makes in OpenCV's memory is freed when it ends. */
export function withMats<Result>(cv: OpenCv, work: (mats: Mats) => Result): Result {
  const mats = new Mats(cv);
  try {
    return work(mats);
  } finally {
    mats.free();
  }
}

export function bytesOf(mat: Mat): Uint8Array {
  return mat.data.slice();
}

export function numbersOf(mat: Mat): Float32Array {
  return mat.data32F.slice();
}

/** sRGB as CIE Lab, three numbers a pixel; scaled by areas to another size before that. */
export function labOf(
  cv: OpenCv,
  rgb: Rgb,
  { width, height }: { width: number; height: number } = rgb,
): Plane {
  return withMats(cv, (mats) => {
    const lab = mats.empty();
    mats.of(rgb, 3).convertTo(lab, cv.CV_32FC3, 1 / 255);
    if (width !== rgb.width || height !== rgb.height)
      cv.resize(lab, lab, new cv.Size(width, height), 0, 0, cv.INTER_AREA);
    cv.cvtColor(lab, lab, cv.COLOR_RGB2Lab);
    return { width, height, data: numbersOf(lab) };
  });
}

/** Scaled by areas, bytes or numbers. */
export function resized<Data extends Uint8Array | Float32Array>(
  cv: OpenCv,
  picture: Picture<Data>,
  channels: 1 | 3,
  width: number,
  height: number,
): Picture<Data> {
  return withMats(cv, (mats) => {
    const result = mats.empty();
    cv.resize(mats.of(picture, channels), result, new cv.Size(width, height), 0, 0, cv.INTER_AREA);
    const data = picture.data instanceof Uint8Array ? bytesOf(result) : numbersOf(result);
    return { width, height, data: data as Data };
  });
}

/** A mask grown or shrunk by a structuring element. */
export function morphed(cv: OpenCv, how: "dilate" | "erode", mask: Mask, shape: number, side: number): Mask {
  return withMats(cv, (mats) => {
    const result = mats.empty();
    cv[how](mats.of(mask), result, mats.structuringElement(shape, side));
    return { ...mask, data: bytesOf(result) };
  });
}
