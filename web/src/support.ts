// What the browser must have, and what is missing.

/** WebAssembly with SIMD: a module with one function that makes a vector (i32x4.splat). */
const kSimdModule = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 17, 11,
]);

export function hasWasmSimd(): boolean {
  return typeof WebAssembly === "object" && WebAssembly.validate(kSimdModule);
}

export function hasWebGl2(): boolean {
  try {
    return document.createElement("canvas").getContext("webgl2") !== null;
  } catch {
    return false;
  }
}
