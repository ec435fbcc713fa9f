// The reader of photos in a thread of its own, with OpenCV, which is fetched when the first photo is dropped.

import * as Comlink from "comlink";
import opencvUrl from "@techstark/opencv-js/dist/opencv.js?url";
import type { OpenCv } from "./opencv";
import { decode, photoOf } from "./photo_file";
import { type OutlineOracle, type PhotoLeaf, type PhotoOptions, cutOutLeaf } from "./photo_leaf";

// The file is made for <script> and for CommonJS; imported as a module it finds neither `this` nor `window`, so
// it is given a CommonJS module to fill. What it puts there has a `then` that gives itself: awaited it would be
// awaited for ever.
async function loadOpenCv(): Promise<{ cv: OpenCv }> {
  const commonJs = { exports: {} };
  Object.assign(globalThis, { module: commonJs });
  await import(/* @vite-ignore */ opencvUrl);
  const cv = commonJs.exports as OpenCv & { onRuntimeInitialized?: () => void };
  if (!cv.Mat) await new Promise<void>((resolve) => (cv.onRuntimeInitialized = resolve));
  return { cv };
}

export interface PhotoReader {
  readPhoto(
    bytes: Uint8Array,
    oracle: OutlineOracle,
    progress: (share: number, what: string) => void,
    options: PhotoOptions,
  ): Promise<PhotoLeaf>;
}

const reader: PhotoReader = {
  async readPhoto(bytes, oracle, progress, options) {
    progress(0.05, "fetching OpenCV");
    const [{ cv }, pixels] = await Promise.all([loadOpenCv(), decode(bytes)]);
    const leaf = await cutOutLeaf(cv, photoOf(cv, pixels), oracle, progress, options);
    const { margin, holes, rgb, ridges } = leaf.cutOut;
    return Comlink.transfer(
      leaf,
      [margin, ...holes, rgb, ridges].map((array) => array.buffer as ArrayBuffer),
    );
  },
};

Comlink.expose(reader);
