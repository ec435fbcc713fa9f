// A leaf in the scene: blade, stalk and veins, moved to any moment between two frames.
import * as THREE from "three";
import type { FieldName, Frame, LeafInfo, Textures } from "../core/protocol";
import { type Range, paintField } from "../field_colours";
import { jpegTexture, leafMaterial, mapMaterial } from "./leaf_material";

export interface Moment {
  before: Frame;
  after: Frame;
  mix: number;
}

/** What is shown on a leaf. */
export interface Look {
  field: FieldName | "";
  range: Range;
  veins: boolean;
}

function mixed(out: Float32Array, a: Float32Array, b: Float32Array, mix: number): void {
  for (let i = 0; i < out.length; ++i) out[i] = a[i]! + (b[i]! - a[i]!) * mix;
}

function moving(points: number): THREE.BufferAttribute {
  return new THREE.BufferAttribute(new Float32Array(3 * points), 3).setUsage(THREE.DynamicDrawUsage);
}

function geometry(points: number, faces: Uint32Array): THREE.BufferGeometry {
  const made = new THREE.BufferGeometry();
  made.setIndex(new THREE.BufferAttribute(faces, 1));
  made.setAttribute("position", moving(points)).setAttribute("normal", moving(points));
  return made;
}

export class LeafModel {
  /** Scaled so that the leaf is 1 long; its lowest point on the ground. */
  readonly group = new THREE.Group();
  private readonly blade: THREE.Mesh<THREE.BufferGeometry, THREE.Material>;
  private readonly stalk: THREE.Mesh<THREE.BufferGeometry, THREE.MeshStandardMaterial>;
  private readonly veins: THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial>;
  private readonly natural = leafMaterial();
  private readonly mapped = mapMaterial();

  constructor(readonly info: LeafInfo) {
    const skin = geometry(info.points, info.faces);
    skin.setAttribute("uv", new THREE.BufferAttribute(info.uv, 2)).setAttribute("color", moving(info.points));
    this.blade = new THREE.Mesh(skin, this.natural);
    this.stalk = new THREE.Mesh(
      geometry(info.stalkPoints, info.stalkFaces),
      new THREE.MeshStandardMaterial({ roughness: 0.7 }),
    );
    this.veins = new THREE.LineSegments(veinLines(info), new THREE.LineBasicMaterial({ vertexColors: true }));
    for (const part of [this.blade, this.stalk, this.veins]) {
      part.frustumCulled = false;
      this.group.add(part);
    }
    for (const part of [this.blade, this.stalk]) part.castShadow = part.receiveShadow = true;
    this.group.scale.setScalar(1 / info.length);
  }

  async setTextures(textures: Textures | undefined): Promise<void> {
    const [colour, normal] = await Promise.all([
      textures && jpegTexture(textures.colour, true),
      textures && jpegTexture(textures.normal, false),
    ]);
    this.natural.map = colour ?? null;
    this.natural.normalMap = normal ?? null;
    this.natural.needsUpdate = true;
  }

  show({ before, after, mix }: Moment, look: Look): void {
    const skin = this.blade.geometry.attributes;
    mixed(array(skin.position), before.positions, after.positions, mix);
    mixed(array(skin.normal), before.normals, after.normals, mix);
    const { field } = look;
    if (field) paintField(array(skin.color), before.fields[field], after.fields[field], mix, look.range);
    else mixed(array(skin.color), before.colours, after.colours, mix);
    this.blade.material = field ? this.mapped : this.natural;
    const stalk = this.stalk.geometry.attributes;
    mixed(array(stalk.position), before.stalkPositions, after.stalkPositions, mix);
    mixed(array(stalk.normal), before.stalkNormals, after.stalkNormals, mix);
    const [r, g, b] = before.stalkColour.map((value, c) => value + (after.stalkColour[c]! - value) * mix);
    this.stalk.material.color.setRGB(r!, g!, b!);
    this.veins.visible = look.veins;
    if (look.veins) mixed(array(this.veins.geometry.attributes.position), before.veins, after.veins, mix);
    // Relief belongs to the dry leaf (docs/method.md, section 10). The map's y is glTF's, three.js derives its own.
    const relief = 0.3 + 0.7 * Math.min(1, mean(after.fields.dryness));
    this.natural.normalScale.set(relief, -relief);
    this.group.position.y =
      -Math.min(lowest(array(skin.position)), lowest(array(stalk.position))) / this.info.length;
    for (const moved of [skin.position, skin.normal, skin.color, stalk.position, stalk.normal])
      moved!.needsUpdate = true;
    this.veins.geometry.attributes.position!.needsUpdate = look.veins;
  }

  /** Where a point of the blade is now, in the scene. */
  point(index: number, out: THREE.Vector3): THREE.Vector3 {
    const position = this.blade.geometry.attributes.position!;
    return this.group.localToWorld(out.fromBufferAttribute(position, index));
  }

  /** Places that enclose the leaf as it is shown, in the scene. */
  outlinePoints(): THREE.Vector3[] {
    const stalk = this.stalk.geometry.attributes.position!;
    const points = Array.from(this.info.margin.point, (index) => this.point(index, new THREE.Vector3()));
    for (let i = 0; i < stalk.count; i += 4) {
      points.push(this.group.localToWorld(new THREE.Vector3().fromBufferAttribute(stalk, i)));
    }
    return points;
  }

  dispose(): void {
    for (const part of [this.blade, this.stalk, this.veins]) part.geometry.dispose();
    for (const material of [this.natural, this.mapped, this.stalk.material, this.veins.material])
      material.dispose();
    this.natural.map?.dispose();
    this.natural.normalMap?.dispose();
  }
}

function array(
  attribute: THREE.BufferAttribute | THREE.InterleavedBufferAttribute | undefined,
): Float32Array {
  return attribute!.array as Float32Array;
}

function mean(values: Float32Array): number {
  let sum = 0;
  for (const value of values) sum += value;
  return sum / Math.max(1, values.length);
}

function lowest(positions: Float32Array): number {
  let least = Infinity;
  for (let i = 1; i < positions.length; i += 3) least = Math.min(least, positions[i]!);
  return least;
}

/** A segment between neighbours of each vein; primary ones brighter. */
function veinLines(info: LeafInfo): THREE.BufferGeometry {
  const points = info.veinStart.at(-1) ?? 0;
  const segments: number[] = [];
  const colours = new Float32Array(3 * points);
  for (let vein = 0; vein + 1 < info.veinStart.length; ++vein) {
    const colour = new THREE.Color(info.veinOrder[vein] === 1 ? "#ff5a36" : "#ffb199");
    for (let i = info.veinStart[vein]!; i < info.veinStart[vein + 1]!; ++i) {
      colour.toArray(colours, 3 * i);
      if (i + 1 < info.veinStart[vein + 1]!) segments.push(i, i + 1);
    }
  }
  const made = new THREE.BufferGeometry();
  made.setIndex(segments).setAttribute("position", moving(points));
  made.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  return made;
}
