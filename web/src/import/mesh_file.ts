// A mesh file's triangles as they stand there, like src/wilt/import/mesh_file.cpp: all parts joined with their
// transforms, without a part named "stalk" beside others; of a shape that moves, the first frame.

import {
  type BufferAttribute,
  type BufferGeometry,
  type InterleavedBufferAttribute,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Vector3,
} from "three";
import { GLTFLoader, type GLTFParser } from "three/examples/jsm/loaders/GLTFLoader.js";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";
import type { ContentKind } from "./content_kind";

export interface MeshTriangles {
  /** Three per vertex, the file's own coordinates. */
  positions: Float32Array;
  faces: Uint32Array;
  /** Two per vertex, origin top left; not a number where a part has none. */
  uv?: Float32Array;
  notes: string[];
}

export type MeshKind = Extract<ContentKind, "glb" | "gltf" | "ply" | "stl" | "obj">;
type Attribute = BufferAttribute | InterleavedBufferAttribute;

const MOST_VERTICES = 2_000_000; // a page's memory; the program reads 50,000,000

// Materials would have their pictures decoded; nobody looks at them here.
class NoMaterials {
  readonly name = "wilt_no_materials";
  constructor(readonly parser: GLTFParser) {}
  loadMaterial(): Promise<MeshBasicMaterial> {
    return Promise.resolve(new MeshBasicMaterial());
  }
}

function jsonOf(bytes: Uint8Array, kind: "glb" | "gltf"): { buffers?: { uri?: string }[] } {
  let text = bytes;
  if (kind === "glb") {
    const length = bytes.length >= 20 ? new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true) : 0;
    text = bytes.subarray(20, 20 + length);
  }
  return JSON.parse(new TextDecoder().decode(text));
}

async function sceneOfGltf(bytes: Uint8Array, kind: "glb" | "gltf"): Promise<Object3D> {
  const apart = jsonOf(bytes, kind).buffers?.find((buffer) => buffer.uri && !buffer.uri.startsWith("data:"));
  if (apart)
    throw new Error(
      `its points stand in another file, '${apart.uri}', which a page cannot open; export it as .glb`,
    );
  const loader = new GLTFLoader().register((parser) => new NoMaterials(parser));
  const { buffer, byteOffset, byteLength } = bytes;
  return (await loader.parseAsync(buffer.slice(byteOffset, byteOffset + byteLength) as ArrayBuffer, ""))
    .scene;
}

// PLYLoader passes faces of more than four corners over in silence.
function refuseLargeFaces(bytes: Uint8Array, geometry: BufferGeometry): void {
  const header = new TextDecoder("latin1").decode(bytes.subarray(0, 65536)).split("end_header")[0] ?? "";
  const listed = Number(/^\s*element\s+face\s+(\d+)/m.exec(header)?.[1] ?? 0);
  if (listed === 0)
    throw new Error(
      "it has points and no faces: a scan is not read here but by the program, wilt simulate FILE -o out.glb; drop its .glb",
    );
  const triangles = (geometry.index?.count ?? 0) / 3;
  if (triangles < listed)
    throw new Error(
      `${listed - triangles} of its ${listed} faces have more than four corners; export triangles`,
    );
}

async function sceneOf(bytes: Uint8Array, kind: MeshKind): Promise<Object3D> {
  const buffer = () =>
    bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;
  if (kind === "glb" || kind === "gltf") return sceneOfGltf(bytes, kind);
  if (kind === "obj") return new OBJLoader().parse(new TextDecoder().decode(bytes));
  if (kind === "stl") return new Mesh(new STLLoader().parse(buffer()));
  const geometry = new PLYLoader().parse(buffer());
  refuseLargeFaces(bytes, geometry);
  return new Mesh(geometry);
}

// The parts that are the blade's.
function bladeParts(scene: Object3D, notes: string[]): Mesh[] {
  const parts: Mesh[] = [];
  scene.updateMatrixWorld(true);
  scene.traverse((object) => {
    if (object instanceof Mesh) parts.push(object);
  });
  const isStalk = (part: Mesh) =>
    part.name.startsWith("stalk") || part.parent?.name.startsWith("stalk") === true;
  const blade = parts.filter((part) => !isStalk(part));
  if (blade.length === 0 || blade.length === parts.length) return parts;
  notes.push("the part named 'stalk' was left out; the blade alone is a leaf");
  return blade;
}

function pointsOf(part: Mesh, attribute: Attribute, into: Float32Array, first: number): void {
  const point = new Vector3();
  for (let i = 0; i < attribute.count; ++i) {
    point.fromBufferAttribute(attribute, i).applyMatrix4(part.matrixWorld);
    if (!Number.isFinite(point.x + point.y + point.z))
      throw new Error(
        `vertex ${i} of '${part.name || "the mesh"}' is not finite or not in the file; mend its faces`,
      );
    point.toArray(into, 3 * (first + i));
  }
}

// Texture coordinates of all but glTF have their origin at the bottom left.
function uvOf(
  attribute: Attribute | undefined,
  count: number,
  upwards: boolean,
  into: Float32Array,
  first: number,
) {
  for (let i = 0; i < count; ++i) {
    const v = attribute ? attribute.getY(i) : NaN;
    into[2 * (first + i)] = attribute ? attribute.getX(i) : NaN;
    into[2 * (first + i) + 1] = upwards ? 1 - v : v;
  }
}

function facesOf(part: Mesh, first: number, into: number[]): void {
  const { index, attributes } = part.geometry as BufferGeometry;
  const vertices = attributes.position.count;
  const corners = index ? index.count : vertices;
  const mirrored = part.matrixWorld.determinant() < 0;
  for (let k = 0; k + 2 < corners; k += 3) {
    const [a, b, c] = [k, k + 1, k + 2].map((corner) => (index ? index.getX(corner) : corner)) as [
      number,
      number,
      number,
    ];
    if (Math.max(a, b, c) >= vertices)
      throw new Error(
        `face ${k / 3} has vertex ${Math.max(a, b, c)}, but there are ${vertices} (counted from 0); remove the face`,
      );
    into.push(first + a, first + (mirrored ? c : b), first + (mirrored ? b : c));
  }
}

function joined(parts: Mesh[], upwards: boolean, notes: string[]): MeshTriangles {
  const attributesOf = (part: Mesh) =>
    (part.geometry as BufferGeometry).attributes as Record<string, Attribute>;
  const counts = parts.map((part) => attributesOf(part).position?.count ?? 0);
  const total = counts.reduce((sum, count) => sum + count, 0);
  if (total > MOST_VERTICES)
    throw new Error(`it has ${total} vertices; ${MOST_VERTICES} are allowed in a page: simplify it first`);
  const positions = new Float32Array(3 * total);
  const uv = new Float32Array(2 * total);
  const faces: number[] = [];
  let first = 0;
  parts.forEach((part, k) => {
    if (counts[k] === 0) return;
    pointsOf(part, attributesOf(part).position, positions, first);
    uvOf(attributesOf(part).uv, counts[k], upwards, uv, first);
    facesOf(part, first, faces);
    first += counts[k];
  });
  if (faces.length === 0) throw new Error("there is no face; a leaf needs triangles");
  const hasUv = parts.some((part) => attributesOf(part).uv);
  return { positions, faces: Uint32Array.from(faces), ...(hasUv ? { uv } : {}), notes };
}

/** Throws Error with wilt's kind of message when the bytes are not those of such a file. */
export async function parseMesh(bytes: Uint8Array, kind: MeshKind): Promise<MeshTriangles> {
  const notes: string[] = [];
  let scene: Object3D;
  try {
    scene = await sceneOf(bytes, kind);
  } catch (error) {
    // RangeError, SyntaxError, TypeError: the loaders trip over what is damaged, in words that help nobody.
    if (error instanceof Error && error.constructor === Error) throw error;
    throw new Error(
      `it cannot be read as a mesh: its content is not that of a .${kind} file, or it is cut off`,
    );
  }
  return joined(bladeParts(scene, notes), kind !== "glb" && kind !== "gltf", notes);
}
