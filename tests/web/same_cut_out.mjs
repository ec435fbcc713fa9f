// A leaf cut out of a photo by the page's steps (web/src/import/photo_*.ts) and by the native ones, from the same pixels.
// Oracle: the native program, whose OpenCV is another version by another compiler. Photos: two painted ones, and those of
// grape leaves where they are there.
// Usage: node same_cut_out.mjs WEB_FOLDER CORE_FOLDER NATIVE_CUT_OUT PYTHON PHOTOS_FOLDER
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { outlinesApart } from "./outlines.mjs";

const [web, coreFolder, native, python, photosFolder] = process.argv.slice(2);
const needed = [join(web, "node_modules/@techstark/opencv-js"), join(coreFolder, "wilt.wasm")];
if (!needed.every(existsSync)) {
  console.log("skipped: the studio has not been built; scripts/build-studio does that");
  process.exit(77);
}

const TOLERANCE = 2; // pixels

async function pageSteps(scratch) {
  const require = createRequire(resolve(web, "package.json"));
  const { build } = createRequire(require.resolve("vite"))("esbuild");
  const entryPoints = ["photo_leaf", "photo_file"].map((name) => join(web, "src/import", `${name}.ts`));
  await build({ entryPoints, bundle: true, format: "esm", platform: "node", outdir: scratch, outExtension: { ".js": ".mjs" } });
  const load = (name) => import(pathToFileURL(join(scratch, `${name}.mjs`)));
  const cv = require("@techstark/opencv-js");
  if (!cv.Mat) await new Promise((ready) => (cv.onRuntimeInitialized = ready));
  return { cv, ...(await load("photo_leaf")), ...(await load("photo_file")) };
}

async function outlineOracle() {
  globalThis.self = { location: { href: "" } }; // the module is made for a worker
  const { default: createModule } = await import(pathToFileURL(resolve(coreFolder, "wilt.mjs")));
  const module = await createModule({ wasmBinary: readFileSync(join(coreFolder, "wilt.wasm")) });
  const studio = new module.Studio();
  const value = (result) => {
    if (result.error !== undefined) throw new Error(result.error);
    return result.value;
  };
  return { notch: async (margin) => value(studio.notch(margin)), hasStalk: async (margin) => value(studio.hasStalk(margin)) };
}

function same(name, page, expected) {
  const { margin, fork, ridges, size } = page.cutOut;
  const apart = outlinesApart(margin, expected.margin);
  const forks =
    fork && expected.fork
      ? Math.hypot(fork[0] - expected.fork[0], fork[1] - expected.fork[1])
      : fork || expected.fork
        ? Infinity
        : 0;
  const lines = ridges.reduce((sum, value, i) => sum + Math.abs(value - expected.ridges[i]), 0) / ridges.length;
  console.log(
    `${name}: outlines ${apart.toFixed(3)} px apart, forks ${fork ? forks.toFixed(3) + " px" : "none"}, ` +
      `veins' strength ${lines.toExponential(1)}, ${page.leaves} leaves, ${margin.length / 2} points`,
  );
  return apart <= TOLERANCE && forks <= TOLERANCE && lines < 0.01 && page.leaves === expected.leaves && size === expected.size;
}

const scratch = mkdtempSync(join(tmpdir(), "wilt-cut-out-"));
let failed = [];
try {
  const pixels = join(scratch, "pixels");
  mkdirSync(pixels);
  execFileSync(python, ["-B", join(dirname(fileURLToPath(import.meta.url)), "paint_photos.py"), scratch]);
  const photos = ["lobed.jpg", "stalked.png"].map((name) => join(scratch, name));
  if (existsSync(photosFolder))
    photos.push(
      ...readdirSync(photosFolder)
        .filter((name) => name.endsWith(".jpg"))
        .map((name) => join(photosFolder, name)),
    );
  else console.log("the photos of grape leaves are not there: only the painted ones are compared");
  const expected = JSON.parse(execFileSync(native, [pixels, ...photos], { maxBuffer: 1 << 30 }));
  const [{ cv, cutOutLeaf, photoOf }, oracle] = [await pageSteps(scratch), await outlineOracle()];
  for (const [k, photo] of photos.entries()) {
    const { width, height } = expected[k];
    const before = performance.now();
    const page = await cutOutLeaf(cv, photoOf(cv, { width, height, data: readFileSync(join(pixels, `${k}.rgba`)) }), oracle);
    if (!same(photo.split("/").pop(), page, expected[k])) failed.push(photo);
    console.log(`  ${((performance.now() - before) / 1000).toFixed(1)} s`);
  }
} finally {
  rmSync(scratch, { recursive: true });
}
if (failed.length > 0) console.log(`differ: ${failed.join(", ")}`);
process.exit(failed.length > 0 ? 1 : 0); // OpenCV's module keeps node alive
