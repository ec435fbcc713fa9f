// What the page and the core, which runs in a worker, say to each other.
//
// Positions are in metres, Y up, as in wilt's files (three.js draws them as they are). Arrays "per point" have one entry
// per vertex of the leaf's skin, which is split where texture coordinates jump; `vertex` maps them to the mesh.

/** A leaf to be made. `petiole`: where the stalk meets the blade, as `wilt --petiole` takes it; absent: found. */
export type LeafSource = {
  seed: number;
  /** 200 to 100,000; 0: what is usual for the source (a mesh keeps its own). */
  vertices: number;
  petiole?: [number, number];
} & (
  | { kind: "species"; name: string }
  /** `outline`: the text of wilt's .json outline file. */
  | { kind: "outline"; name: string; outline: string }
  /** `elements`: those of an SVG, as ../import/drawing.ts lists them; the `nth` largest leaf, from 1. */
  | { kind: "drawing"; name: string; elements: string; nth: number }
  /** As three.js's loaders give it: a file's own coordinates, Y up; texture coordinates with glTF's origin, top left. */
  | { kind: "mesh"; name: string; positions: Float32Array; faces: Uint32Array; uv?: Float32Array }
  | { kind: "photo"; name: string; photo: CutOut }
);

/** A leaf cut out of a photo. Pixels from the photo's top left corner, y downwards. */
export interface CutOut {
  margin: Float64Array; // x, y of each point
  holes: Float64Array[];
  notes: string[];
  /** A square picture whose colours are carried on beyond the margin, RGB, and the part of the photo that it shows. */
  size: number;
  rgb: Uint8Array;
  area: { x: number; y: number; width: number; height: number };
  /** How much each place looks like a vein, 0 to 1, -1 beside the blade; `ridgeSize` squared, of the same area. */
  ridgeSize: number;
  ridges: Float32Array;
  /** Where main veins meet, if they do and no stalk shows it. */
  fork?: [number, number];
  forkVeins?: number;
}

export interface Tip {
  /** Its place in wilt's r1, r2, ... from 0. */
  index: number;
  point: number;
  /** Place along the margin (clockwise from the petiole) and distance to the petiole, metres. */
  s: number;
  d: number;
  prominence: number;
}

/** A leaf with its veins, and all that does not change while it withers. */
export interface LeafInfo {
  name: string;
  species: string;
  vertices: number; // of the mesh
  length: number; // metres
  notes: string[];
  points: number;
  vertex: Uint32Array; // per point: the vertex of the mesh
  faces: Uint32Array; // three points each
  uv: Float32Array; // two per point
  stalkPoints: number;
  stalkFaces: Uint32Array;
  petiolePoint: number;
  tips: Tip[];
  /** The margin profile, clockwise from the petiole: the paper's Fig. 2c. */
  margin: {
    point: Uint32Array;
    s: Float32Array;
    d: Float32Array;
    perimeter: number;
    /** x, y of each as LeafSource.petiole takes it, whether or not the petiole has been moved. */
    place: Float64Array;
  };
  /** Where each vein begins in Frame.veins (in points), and one more for the end; 1: primary, 2: secondary. */
  veinStart: Uint32Array;
  veinOrder: Uint8Array;
  hasPhoto: boolean;
}

/** What can be shown as colours on the blade, with its unit. The order is that of Frame.fields. */
export const FIELDS = {
  mass: "mass (working units)",
  water: "water (working units)",
  water_fraction: "water / mass",
  dryness: "dryness, 0 fresh to 1 dry",
  pressure: "pressure, p - p_out (working units)",
  elastic: "elastic force (working units)",
  damping: "damping force (working units)",
  swelling: "swelling force (working units)",
  external: "external force (working units)",
} as const;
export type FieldName = keyof typeof FIELDS;

export const REGIONS = ["tip", "vein", "margin", "mesophyll"] as const;

/** The leaf after an iteration. */
export interface Frame {
  iteration: number;
  positions: Float32Array; // three per point
  normals: Float32Array;
  colours: Float32Array; // linear RGB per point, to be multiplied by the texture if there is one
  stalkPositions: Float32Array;
  stalkNormals: Float32Array;
  stalkColour: [number, number, number];
  veins: Float32Array; // three per point of the veins
  fields: Record<FieldName, Float32Array>; // magnitudes of forces
  tipForces: Float32Array; // three per tip: the external force now; Y up, in the unit of external.forces
  wrinkle: number; // shares of the leaf's length
  curl: number; // degrees
  areaRatio: number;
  waterLeft: number; // share of the first water
  /** Mean magnitude by region (REGIONS): elastic, damping, swelling, external, water fraction, pressure. */
  forces: Record<"elastic" | "damping" | "swelling" | "external" | "water" | "pressure", number[]>;
  ended: boolean;
  /** Why the run could not go on; empty: it can, or it came to its end. */
  stopped: string;
  milliseconds: number; // what the step took in the core, without making this record
}

/** One row of wilt's table of settings. */
export interface Setting {
  key: string; // "water.humidity"
  unit: string;
  help: string;
  kind: "number" | "whole" | "flag" | "word" | "numbers";
  min: number;
  max: number;
  words: string[];
  value: number | boolean | string | number[]; // as it is now
  usual: number | boolean | string | number[]; // the species' default
  /** Whether it may change while the leaf withers; the others begin the run anew. */
  duringRun: boolean;
}

/** Edits of the veins that were found. */
export interface VeinEdits {
  /** Places on the margin, s in metres as in LeafInfo.margin of the unedited leaf. */
  added: number[];
  /** The s of tips that were found and are to go. */
  removed: number[];
}

/** JPEGs, the first row at the top (glTF's convention): base colour, sRGB, that multiplies Frame.colours; tangent-space normals. */
export interface Textures {
  colour: Uint8Array;
  normal: Uint8Array;
}

export type FileKind = "glb" | "forces.csv" | "toml" | "report.json" | "veins.json";

/** The core. Every method rejects with an Error whose message is wilt's own; nothing has changed then. */
export interface Core {
  /** Makes the leaf, finds its veins and starts a run with the settings of `toml` (the text of a configuration file). */
  load(source: LeafSource, edits: VeinEdits, toml: string): Promise<LeafInfo>;
  /** Starts again from the leaf at rest; the settings are those of `toml` beside the species' own. The leaf and its veins stay:
   * vertices, seed and veins.* are for load(). */
  start(toml: string): Promise<Frame>;
  /** The leaf as it is. */
  frame(): Promise<Frame>;
  /** One iteration. Once the run has ended nothing happens. */
  step(): Promise<Frame>;
  /** Changes a setting from here on (Setting.duringRun), which the configuration keeps as [[change]]. `value` as --set takes it. */
  change(key: string, value: string): Promise<void>;
  /** Starts again, with the changes made so far up to `iteration`, and runs silently to it: the state that was there. */
  rewind(iteration: number): Promise<Frame>;
  settings(): Promise<Setting[]>;
  /** The configuration in full or only what differs from the species' defaults, changes during the run too. */
  toml(full: boolean): Promise<string>;
  /** Draws the blade's maps, `size` texels a side (0: none); every Frame from here on has colours to match. It takes some
   * tenths of a second. Nothing where the leaf's texture coordinates carry none. */
  texture(size: number): Promise<Textures | undefined>;
  /** The bytes of a file about the run up to now. */
  file(kind: FileKind): Promise<Uint8Array>;
  /** Where the outline alone would have the petiole: the index of a point of `margin` (x, y of each, y up). */
  notch(margin: Float64Array): Promise<number>;
  /** Whether that outline shows a stalk. */
  hasStalk(margin: Float64Array): Promise<boolean>;
  /** "wilt 0.1.0" and how it was compiled. */
  about(): Promise<string>;
}
