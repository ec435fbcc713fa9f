// What the browser must have, and what is missing.

/** WebAssembly with SIMD: a module with one function that makes a vector (i32x4.splat). */
const kSimdModule = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 17, 11,
]);

/** WebAssembly with exceptions: a function with a try block and catch_all. */
const kExceptionsModule = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11,
]);

/** What of the core's needs this browser lacks; empty: nothing. */
export function missingForCore(): string {
  if (typeof WebAssembly !== "object") return "WebAssembly";
  if (!WebAssembly.validate(kSimdModule)) return "WebAssembly's SIMD instructions";
  return WebAssembly.validate(kExceptionsModule) ? "" : "WebAssembly's exceptions";
}

/** Whether and how the browser draws in 3D; undefined: it does not. */
export function webGl2(): { software: boolean } | undefined {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return undefined;
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const renderer = String(context.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return { software: /swiftshader|llvmpipe|software|basic render/i.test(renderer) };
}

/** Says what is missing and shows leaves that withered elsewhere. */
export function showWithoutCore(missing: string): void {
  const box = document.createElement("div");
  box.className = "fallback";
  box.id = "without-core";
  box.innerHTML = `
    <h2>This browser lacks ${missing}</h2>
    <p>The leaves here are computed in the page, and need it. Chrome and Edge 95, Firefox 100, Safari 16.4 and later have it;
      some browsers turn it off in a "lockdown" or strict security mode.</p>
    <p>The same at a terminal:</p>
    <pre>wilt simulate maple -o maple.glb -o maple.png</pre>
    <p>What it looks like:</p>
    <p><img alt="A maple leaf, fresh, turning, dry" src="stages.webp" width="1120" height="214" /></p>`;
  document.getElementById("stage")!.replaceChildren(box);
  document.body.classList.add("without-core");
}
