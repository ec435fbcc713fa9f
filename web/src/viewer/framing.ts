// Where the camera stands: named views, and the distance at which all of the leaf is seen in a window of any shape.
import * as THREE from "three";

export interface NamedView {
  name: string;
  /** Degrees: clockwise from the side of the stalk, and above the ground. */
  around: number;
  above: number;
}

export const VIEWS: NamedView[] = [
  { name: "Three-quarter", around: 28, above: 38 },
  { name: "From above", around: 0, above: 89.9 },
  { name: "From the stalk", around: 0, above: 14 },
  { name: "From the right", around: 90, above: 12 },
  { name: "From the apex", around: 180, above: 14 },
  { name: "From the left", around: -90, above: 12 },
  { name: "From below", around: 0, above: -60 },
  { name: "Close to the ground", around: 40, above: 5 },
];

/** How much of the window's height and width a framed leaf fills. */
export const FILLED = 0.9;

export function direction({ around, above }: NamedView): THREE.Vector3 {
  const a = THREE.MathUtils.degToRad(around);
  const h = THREE.MathUtils.degToRad(above);
  return new THREE.Vector3(Math.sin(a) * Math.cos(h), Math.sin(h), Math.cos(a) * Math.cos(h));
}

/** The camera's place from which `points` fill the window but for a margin, seen from `towards`; the point looked at. */
export function framed(
  camera: THREE.PerspectiveCamera,
  points: THREE.Vector3[],
  towards: THREE.Vector3,
): { position: THREE.Vector3; target: THREE.Vector3 } {
  const box = new THREE.Box3().setFromPoints(points);
  let target = box.getCenter(new THREE.Vector3());
  const basis = new THREE.Matrix4().lookAt(towards, new THREE.Vector3(), camera.up);
  const [right, up, back] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
  basis.extractBasis(right, up, back);
  const tanY = Math.tan(THREE.MathUtils.degToRad(camera.fov) / 2) * FILLED;
  const tanX = tanY * camera.aspect;
  // Twice: the centre is moved to the middle of what is seen.
  let distance = 1;
  for (let round = 0; round < 3; ++round) {
    distance = 0.2;
    for (const point of points) {
      const p = point.clone().sub(target);
      const depth = p.dot(back);
      distance = Math.max(
        distance,
        depth + Math.abs(p.dot(right)) / tanX,
        depth + Math.abs(p.dot(up)) / tanY,
      );
    }
    const seen = points.map((point) => {
      const p = point.clone().sub(target);
      const z = distance - p.dot(back);
      return [p.dot(right) / z, p.dot(up) / z];
    });
    const middle = (axis: number) =>
      (Math.min(...seen.map((p) => p[axis]!)) + Math.max(...seen.map((p) => p[axis]!))) / 2;
    target = target
      .clone()
      .addScaledVector(right, middle(0) * distance)
      .addScaledVector(up, middle(1) * distance);
  }
  return { position: target.clone().addScaledVector(back, distance), target };
}
