// A file that was dropped, as a leaf for the core.

import * as Comlink from "comlink";
import type { Core, LeafSource } from "../core/protocol";
import { type ContentKind, contentKind } from "./content_kind";
import { listElements } from "./drawing";
import type { MeshKind, MeshTriangles } from "./mesh_file";
import type { PhotoReader } from "./photo.worker";

export const LEAF_FILE_TYPES = ".obj,.ply,.stl,.glb,.gltf,.svg,.json,.png,.jpg,.jpeg";

export interface LeafFile {
  source: LeafSource;
  /** The file's name: what `wilt simulate` is given for the same leaf. */
  file: string;
  /** What was found, left out or assumed in reading. */
  notes: string[];
  /** How many leaves a photo shows, and which of them this is, from 1. */
  leaves?: number;
  nth: number;
}

export interface ReadOptions {
  /** The N-th largest leaf of a photo or drawing, from 1. */
  nth?: number;
  /** Colour difference from a photo's background at which a leaf begins, above 0 to 100; by itself from its histogram. */
  threshold?: number;
}

/** `share` of the reading that is done, 0 to 1. */
export type Progress = (share: number, what: string) => void;

const LARGEST_FILE = 512 << 20; // bytes

/** The work in a thread of its own, which ends with it: the page does not freeze, and the memory is given back. */
async function inWorker<Work, Result>(
  worker: Worker,
  ask: (work: Comlink.Remote<Work>) => Promise<Result>,
): Promise<Result> {
  const broken = new Promise<never>((_, reject) => {
    worker.onerror = (event) =>
      reject(new Error(`its reader could not be loaded: ${event.message || "no connection"}`));
  });
  try {
    return await Promise.race([ask(Comlink.wrap<Work>(worker)), broken]);
  } finally {
    worker.terminate();
  }
}

function readMesh(bytes: Uint8Array, kind: MeshKind): Promise<MeshTriangles> {
  const worker = new Worker(new URL("./mesh.worker.ts", import.meta.url), { type: "module" });
  return inWorker<{ parseMesh(bytes: Uint8Array, kind: MeshKind): MeshTriangles }, MeshTriangles>(
    worker,
    (reader) => reader.parseMesh(Comlink.transfer(bytes, [bytes.buffer]), kind),
  );
}

async function readPhoto(bytes: Uint8Array, core: Core, progress: Progress, options: ReadOptions) {
  const worker = new Worker(new URL("./photo.worker.ts", import.meta.url), { type: "module" });
  return inWorker<PhotoReader, Awaited<ReturnType<PhotoReader["readPhoto"]>>>(worker, (reader) =>
    reader.readPhoto(
      Comlink.transfer(bytes, [bytes.buffer]),
      Comlink.proxy({ notch: (margin) => core.notch(margin), hasStalk: (margin) => core.hasStalk(margin) }),
      Comlink.proxy(progress),
      options,
    ),
  );
}

async function read(
  file: File,
  kind: ContentKind,
  bytes: Uint8Array,
  core: Core,
  progress: Progress,
  options: ReadOptions,
): Promise<LeafFile> {
  const nth = options.nth ?? 1;
  const found = { file: file.name, notes: [], nth };
  const usual = { seed: 1, vertices: 0, name: file.name.replace(/\.[^.]*$/, "") };
  const text = () => new TextDecoder().decode(bytes);
  if (kind === "outline") return { ...found, source: { ...usual, kind, outline: text() } };
  if (kind === "svg")
    return { ...found, source: { ...usual, kind: "drawing", elements: listElements(text()), nth } };
  if (kind === "photo") {
    const { cutOut, leaves } = await readPhoto(bytes, core, progress, options);
    return { ...found, source: { ...usual, kind, photo: cutOut }, leaves };
  }
  const { notes, ...mesh } = await readMesh(bytes, kind);
  return { ...found, source: { ...usual, kind: "mesh", ...mesh }, notes };
}

/**
 * What the file shows, told by its content. `core` answers questions about a photo's outline. Throws Error, which names
 * the file and says what is wrong and how to mend it.
 */
export async function readLeafFile(
  file: File,
  core: Core,
  progress: Progress = () => {},
  options: ReadOptions = {},
): Promise<LeafFile> {
  try {
    if (file.size > LARGEST_FILE)
      throw new Error(
        `it has ${Math.round(file.size / 2 ** 20)} MB; ${LARGEST_FILE / 2 ** 20} are allowed: simplify it`,
      );
    progress(0, "reading");
    const bytes = new Uint8Array(await file.arrayBuffer());
    const leaf = await read(file, contentKind(bytes, file.name), bytes, core, progress, options);
    progress(1, "read");
    return leaf;
  } catch (error) {
    throw new Error(`'${file.name}': ${error instanceof Error ? error.message : String(error)}`);
  }
}
