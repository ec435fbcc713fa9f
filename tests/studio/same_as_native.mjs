// A run in WebAssembly against the same run by the program: its configuration is given back to `wilt simulate`, whose
// point cache holds what the page would show. Oracle: the native build, by another compiler.
// Usage: node same_as_native.mjs CORE_FOLDER WILT
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, wilt] = process.argv.slice(2);
if (!existsSync(join(folder, "wilt.wasm"))) {
  console.log("skipped: the core has not been built; scripts/build-studio does that");
  process.exit(77);
}
globalThis.self = { location: { href: "" } }; // the module is made for a worker
const { default: createModule } = await import(pathToFileURL(resolve(folder, "wilt.mjs")));
const module = await createModule({ wasmBinary: readFileSync(join(folder, "wilt.wasm")) });

// Sines of another library differ by an ulp, and a leaf that buckles makes more of that. Measured on six species, two models:
// no difference in single precision.
const TOLERANCE = 1e-6; // of the leaf's length

function value(result) {
  if (result.error !== undefined) throw new Error(result.error);
  return result.value;
}

/** The last sample of a .pc2 file. */
function lastSample(path) {
  const bytes = readFileSync(path);
  const points = bytes.readUInt32LE(16);
  const size = 12 * points;
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset + bytes.length - size, bytes.byteOffset + bytes.length));
}

function largestDistance(a, b) {
  if (a.length !== b.length) return Infinity;
  let largest = 0;
  for (let i = 0; i < a.length; i += 3)
    largest = Math.max(largest, Math.hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]));
  return largest;
}

function compare(source, toml, scratch) {
  const studio = new module.Studio();
  const info = value(studio.load(source, { added: [], removed: [] }, toml));
  for (let step = 0; !value(studio.frame()).ended; ++step) value(studio.step());
  const config = join(scratch, "run.toml");
  writeFileSync(config, value(studio.toml(true)));
  const cache = join(scratch, "native.pc2");
  execFileSync(wilt, ["-q", "simulate", source.name, "--config", config, "-o", cache]);
  const positions = value(studio.frame()).positions;
  const share = largestDistance(positions, lastSample(cache)) / info.length;
  const moved = largestDistance(positions, firstPositions(source, toml)) / info.length;
  console.log(`${source.name} ${toml.trim()}: ${share.toExponential(2)} of its length apart, moved by ${moved.toFixed(2)}`);
  return share <= TOLERANCE && moved > 0.05;
}

function firstPositions(source, toml) {
  const studio = new module.Studio();
  value(studio.load(source, { added: [], removed: [] }, toml));
  return value(studio.frame()).positions;
}

const scratch = mkdtempSync(join(tmpdir(), "wilt-studio-"));
try {
  let same = true;
  for (const name of (process.argv[4] ?? "maple,willow").split(","))
    for (const model of ["cell", "paper"])
      same = compare({ kind: "species", name, vertices: +(process.argv[5] ?? 600), seed: 3 }, `model = "${model}"\n`, scratch) && same;
  process.exitCode = same ? 0 : 1;
} finally {
  rmSync(scratch, { recursive: true });
}
