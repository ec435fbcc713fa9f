// What a leaf looks like: a thin sheet with a waxy coat, paler below, through which light comes.
import * as THREE from "three";

// The underside and the light that is let through are those of `wilt render` (docs/method.md, section 10).
const kUnderside = /* glsl */ `#include <color_fragment>
  if (!gl_FrontFacing) {
    float brightest = max(diffuseColor.r, max(diffuseColor.g, diffuseColor.b));
    float grey = 0.5 * (brightest + dot(diffuseColor.rgb, vec3(0.2126, 0.7152, 0.0722)));
    diffuseColor.rgb = mix(diffuseColor.rgb, vec3(grey), 0.45);
  }`;
const kThrough = /* glsl */ `
  #if NUM_DIR_LIGHTS > 0
  {
    vec3 reflectance = diffuseColor.rgb;
    float most = max(max(reflectance.r, max(reflectance.g, reflectance.b)), 1e-3);
    vec3 through = 0.55 * reflectance * sqrt(reflectance / most);
    float behind = saturate(-dot(normal, directionalLights[0].direction));
    reflectedLight.directDiffuse += RECIPROCAL_PI * directionalLights[0].color * behind * through;
  }
  #endif
  #include <lights_fragment_end>`;

export function leafMaterial(): THREE.MeshStandardMaterial {
  const material = new THREE.MeshStandardMaterial({
    vertexColors: true,
    side: THREE.DoubleSide,
    roughness: 0.62,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <color_fragment>", kUnderside)
      .replace("#include <lights_fragment_end>", kThrough);
  };
  return material;
}

/** For colour maps: shape without gloss, so that a colour can be read. */
export function mapMaterial(): THREE.MeshStandardMaterial {
  return new THREE.MeshStandardMaterial({
    vertexColors: true,
    toneMapped: false,
    color: new THREE.Color(0.72, 0.72, 0.72), // so that what is well lit has the legend's colours
    roughness: 1,
    side: THREE.DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}

/** A JPEG of the core as a texture with glTF's texture coordinates. */
export async function jpegTexture(bytes: Uint8Array, colour: boolean): Promise<THREE.Texture> {
  const picture = await createImageBitmap(new Blob([bytes as BlobPart], { type: "image/jpeg" }), {
    colorSpaceConversion: "none",
    premultiplyAlpha: "none",
  });
  const texture = new THREE.Texture(picture);
  texture.flipY = false;
  texture.colorSpace = colour ? THREE.SRGBColorSpace : THREE.NoColorSpace;
  texture.anisotropy = 8;
  texture.needsUpdate = true;
  return texture;
}

/** Nothing to be seen, of all materials: the graphics driver compiles them while the first leaf is being made. */
export function warmUp(): THREE.Mesh[] {
  const shape = new THREE.BufferGeometry();
  for (const [name, size] of [
    ["position", 3],
    ["normal", 3],
    ["color", 3],
    ["uv", 2],
  ] as const) {
    shape.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * size), size));
  }
  const textured = leafMaterial();
  const texel = new THREE.DataTexture(new Uint8Array([128, 128, 255, 255]));
  textured.map = textured.normalMap = texel;
  return [leafMaterial(), textured, new THREE.MeshStandardMaterial()].map((material) => {
    const mesh = new THREE.Mesh(shape, material);
    mesh.receiveShadow = true;
    return mesh;
  });
}
