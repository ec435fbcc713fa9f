// A leaf cut out of a photo: the same steps as src/wilt/import/photo_leaf.cpp, up to what the core takes over.

import type { CutOut } from "../core/protocol";
import type { OpenCv } from "./opencv";
import { type Cover, coverOfAlpha, coverOfColours } from "./photo_cover";
import type { Photo } from "./photo_file";
import { type PhotoObject, photoObjects } from "./photo_objects";
import { type PhotoOutline, traceOutline } from "./photo_outline";
import { findVeinFork } from "./photo_petiole";
import { openSinus } from "./photo_sinus";
import { leafPhoto } from "./photo_texture";

/** What the core knows of outlines (Core has both). */
export interface OutlineOracle {
  notch(margin: Float64Array): Promise<number>;
  hasStalk(margin: Float64Array): Promise<boolean>;
}

export interface PhotoOptions {
  /** The N-th largest leaf, from 1. */
  nth?: number;
  /** Colour difference at which the leaf begins, above 0 to 100; by itself from the photo's histogram. */
  threshold?: number;
}

export interface PhotoLeaf {
  cutOut: CutOut;
  /** How many things in the photo may be leaves; where none may, how many things there are. */
  leaves: number;
}

type Progress = (share: number, what: string) => void;

function coverOf(cv: OpenCv, photo: Photo, threshold?: number): Cover {
  if (photo.alpha && threshold === undefined) return coverOfAlpha(photo.alpha);
  return coverOfColours(cv, photo.rgb, threshold);
}

// How the leaf was told from what is around it.
function separationNote(cover: Cover): string {
  if (cover.threshold === 0) return "the leaf is where the alpha channel is opaque";
  return (
    `the leaf differs from its plain background by ${cover.threshold.toFixed(0)} in colour (CIE Lab); if it is cut out ` +
    "badly take a plainer background, or save it as a PNG without its background"
  );
}

function countOf(objects: PhotoObject[]): number {
  return objects.filter((object) => !object.noLeafReason).length || objects.length;
}

// The leaf that was asked for, with what a user should know of the choice.
function chosen(objects: PhotoObject[], nth: number, notes: string[]): PhotoObject {
  if (!objects[0])
    throw new Error(
      "nothing in the photo stands out from its background; put the leaf on a background of another colour",
    );
  const onlyOthers = objects[0].noLeafReason !== "";
  const leaves = countOf(objects);
  const object = objects[nth - 1];
  if (!object || nth > leaves)
    throw new Error(`the photo shows ${leaves} that may be a leaf; there is no number ${nth}`);
  if (onlyOthers) notes.push(`what was taken for the leaf has the shape of ${object.noLeafReason}`);
  else if (leaves > 1)
    notes.push(`the photo shows ${leaves} things that may be leaves; this is number ${nth} by size`);
  const others = [...new Set(objects.map((other) => other.noLeafReason).filter((reason) => reason))]
    .sort()
    .join(", ");
  if (!onlyOthers && others) notes.push(`left out: ${others}`);
  if (object.cutOff) notes.push("the leaf touches the edge of the photo: what lies beyond it is missing");
  return object;
}

// As the core takes outlines: y up.
function yUp(pixels: Float64Array): Float64Array {
  return pixels.map((value, i) => (i % 2 === 0 ? value : -value));
}

// A stalk in the outline tells where the petiole is; else the place where main veins meet, with the sinus opened to it if
// basal lobes overlap; else (nothing) the outline's shape.
async function locateFork(
  cv: OpenCv,
  photo: Photo,
  object: PhotoObject,
  outline: PhotoOutline,
  oracle: OutlineOracle,
) {
  const { scale } = photo;
  if (await oracle.hasStalk(yUp(outline.margin))) return { outline, notes: [] };
  const fork = findVeinFork(cv, photo.rgb, object);
  if (!fork) return { outline, notes: [] };
  const notch = await oracle.notch(yUp(outline.margin));
  const towards = { x: outline.margin[2 * notch] / scale, y: outline.margin[2 * notch + 1] / scale };
  const cut = openSinus(cv, object, fork.place, towards);
  return {
    outline: cut > 0 ? traceOutline(object, scale) : outline,
    notes:
      cut > 0
        ? [
            "the lobes beside the petiole overlap or touch: the blade was cut open there, " +
              `over ${(scale * cut).toFixed(0)} pixels`,
          ]
        : [],
    fork: [scale * fork.place.x, scale * fork.place.y] as [number, number],
    forkVeins: fork.angles.length,
  };
}

/** Throws Error with wilt's kind of message when the photo shows no leaf. */
export async function cutOutLeaf(
  cv: OpenCv,
  photo: Photo,
  oracle: OutlineOracle,
  progress: Progress = () => {},
  options: PhotoOptions = {},
): Promise<PhotoLeaf> {
  progress(0.2, "telling the leaf from its background");
  const cover = coverOf(cv, photo, options.threshold);
  const notes = [separationNote(cover)];
  const objects = photoObjects(cv, cover.share);
  const object = chosen(objects, options.nth ?? 1, notes);
  const traced = traceOutline(object, photo.scale);
  progress(0.5, "looking for the petiole");
  const { outline, notes: more, ...fork } = await locateFork(cv, photo, object, traced, oracle);
  progress(0.8, "taking its colours");
  const texture = leafPhoto(cv, photo.rgb, photo.scale, object);
  return {
    cutOut: { ...outline, notes: [...notes, ...more], ...texture, ...fork },
    leaves: countOf(objects),
  };
}
