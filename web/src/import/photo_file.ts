// A photo's pixels: as src/wilt/import/photo_file.cpp, with the browser's decoder.

import { type Mask, type OpenCv, type Rgb, bytesOf, resized, withMats } from "./opencv";

const SMALLEST_SIDE = 64;
const MOST_PIXELS = 100e6; // of the file: four bytes each, several times
/** What is larger is scaled down: an outline is found to a fraction of a pixel. */
const WORKING_SIDE = 3000;

export interface Photo {
  /** sRGB, upright, at most WORKING_SIDE pixels on a side. */
  rgb: Rgb;
  /** Opacity; none when the photo is opaque throughout. */
  alpha?: Mask;
  /** Pixels of the file, upright, in one of these. */
  scale: number;
}

/** A decoded picture, RGBA, upright. */
export interface Pixels {
  width: number;
  height: number;
  data: Uint8Array | Uint8ClampedArray;
}

/** The pixels of a file in a browser, turned upright by its EXIF orientation, its colours as they stand there. */
export async function decode(bytes: Uint8Array): Promise<Pixels> {
  let bitmap: ImageBitmap;
  try {
    bitmap = await createImageBitmap(new Blob([bytes as BlobPart]), {
      colorSpaceConversion: "none",
      imageOrientation: "from-image",
      premultiplyAlpha: "none",
    });
  } catch {
    throw new Error("the picture cannot be decoded: it is damaged or cut off; save it again as PNG or JPEG");
  }
  const { width, height } = bitmap;
  if (width * height > MOST_PIXELS)
    throw new Error(
      `the photo has ${width} x ${height} pixels; ${MOST_PIXELS / 1e6} million are allowed: scale it down`,
    );
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true })!;
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return context.getImageData(0, 0, width, height);
}

function rgbOf(cv: OpenCv, { width, height, data }: Pixels): Rgb {
  return withMats(cv, (mats) => {
    const rgba = mats.keep(new cv.Mat(height, width, cv.CV_8UC4));
    rgba.data.set(data);
    const rgb = mats.empty();
    cv.cvtColor(rgba, rgb, cv.COLOR_RGBA2RGB);
    return { width, height, data: bytesOf(rgb) };
  });
}

// Nothing when it is opaque throughout.
function alphaOf({ width, height, data }: Pixels): Mask | undefined {
  const alpha = new Uint8Array(width * height);
  let least = 255;
  for (let i = 0; i < alpha.length; ++i) least = Math.min(least, (alpha[i] = data[4 * i + 3]));
  return least < 250 ? { width, height, data: alpha } : undefined;
}

export function photoOf(cv: OpenCv, pixels: Pixels): Photo {
  const { width, height } = pixels;
  if (Math.min(width, height) < SMALLEST_SIDE)
    throw new Error(
      `the photo has ${width} x ${height} pixels; a leaf needs ${SMALLEST_SIDE} at least on each side, and some 500 to ` +
        "keep its teeth",
    );
  const [rgb, alpha] = [rgbOf(cv, pixels), alphaOf(pixels)];
  const side = Math.max(width, height);
  if (side <= WORKING_SIDE) return { rgb, ...(alpha ? { alpha } : {}), scale: 1 };
  const scale = side / WORKING_SIDE;
  const [across, down] = [Math.round(width / scale), Math.round(height / scale)];
  return {
    rgb: resized(cv, rgb, 3, across, down),
    ...(alpha ? { alpha: resized(cv, alpha, 1, across, down) } : {}),
    scale,
  };
}
