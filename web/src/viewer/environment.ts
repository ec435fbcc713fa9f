// The light around the leaf: a bright sky, two soft boxes, a warm floor; as a light probe, which is cheap everywhere.
import * as THREE from "three";

interface SoftBox {
  towards: THREE.Vector3;
  light: THREE.Color;
  /** Sharpness: brightness falls as exp(k (cos - 1)). */
  k: number;
}

const kHorizon = new THREE.Color(0.46, 0.47, 0.48);
const kZenith = new THREE.Color(0.86, 0.91, 1.0);
const kFloor = new THREE.Color(0.36, 0.32, 0.28);
const kBoxes: SoftBox[] = [
  {
    towards: new THREE.Vector3(-5, 6, 2).normalize(),
    light: new THREE.Color(1, 0.97, 0.92).multiplyScalar(2.2),
    k: 9,
  },
  {
    towards: new THREE.Vector3(6, 3, -4).normalize(),
    light: new THREE.Color(1, 0.9, 0.78).multiplyScalar(1.3),
    k: 9,
  },
];

function sky(towards: THREE.Vector3, out: THREE.Color): THREE.Color {
  const { y } = towards;
  out.copy(kHorizon).lerp(y > 0 ? kZenith : kFloor, Math.min(1, y > 0 ? y : -2 * y));
  for (const box of kBoxes) {
    const lobe = Math.exp(box.k * (towards.dot(box.towards) - 1));
    out.r += box.light.r * lobe;
    out.g += box.light.g * lobe;
    out.b += box.light.b * lobe;
  }
  return out;
}

/** The sky's light in nine spherical harmonics, summed over directions spread evenly (a Fibonacci spiral). */
export function ambientLight(): THREE.LightProbe {
  const kDirections = 600;
  const harmonics = new THREE.SphericalHarmonics3();
  const basis: number[] = [];
  const towards = new THREE.Vector3();
  const light = new THREE.Color();
  for (let i = 0; i < kDirections; ++i) {
    const y = 1 - (2 * i + 1) / kDirections;
    const angle = i * Math.PI * (3 - Math.sqrt(5));
    towards.set(Math.cos(angle) * Math.sqrt(1 - y * y), y, Math.sin(angle) * Math.sqrt(1 - y * y));
    THREE.SphericalHarmonics3.getBasisAt(towards, basis);
    sky(towards, light);
    harmonics.coefficients.forEach((c, k) =>
      c.add(new THREE.Vector3(light.r, light.g, light.b).multiplyScalar(basis[k]!)),
    );
  }
  harmonics.scale((4 * Math.PI) / kDirections);
  return new THREE.LightProbe(harmonics, 1);
}

/** Their gleam on the leaf, which a probe does not give; without shadow. */
export function gleam(): THREE.Light[] {
  return kBoxes.map(({ towards, light }) => {
    const box = new THREE.DirectionalLight(light, 0.22);
    box.position.copy(towards);
    return box;
  });
}

/** The sun: its shadow on the ground and on the leaf itself. */
export function keyLight(): THREE.DirectionalLight {
  const key = new THREE.DirectionalLight("#fff4e4", 2.4);
  key.position.set(-2.2, 4, -0.6);
  key.castShadow = true;
  Object.assign(key.shadow.camera, { left: -2.2, right: 2.2, top: 2.2, bottom: -2.2, near: 0.5, far: 9 });
  key.shadow.bias = -0.0006;
  key.shadow.normalBias = 0.012;
  return key;
}

/** A ground that is seen only where it is in the shade. */
export function ground(shade: THREE.ShadowMaterial): THREE.Mesh {
  const plane = new THREE.Mesh(new THREE.CircleGeometry(8, 48), shade);
  plane.rotation.x = -Math.PI / 2;
  plane.position.y = -0.002;
  plane.receiveShadow = true;
  return plane;
}
