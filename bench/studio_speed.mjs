// Steps a second of a 2,000-vertex maple in WebAssembly beside the program's, one thread and all, in turn. Node has the
// engine of Chromium. Build both first: scripts/build-studio, and the preset release.
// Usage: node bench/studio_speed.mjs [RUNS] [WILT]
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const runs = Number(process.argv[2] ?? 7);
const root = new URL("..", import.meta.url).pathname;
const wilt = process.argv[3] ?? join(root, "build/release/wilt");
const STEPS = 100;

globalThis.self = { location: { href: "" } }; // the module is made for a worker
const core = join(root, "build/wasm/web");
const { default: createModule } = await import(join(core, "wilt.mjs"));
const module = await createModule({ wasmBinary: readFileSync(join(core, "wilt.wasm")) });
const scratch = mkdtempSync(join(tmpdir(), "wilt-bench-"));

function inWebAssembly(model) {
  const studio = new module.Studio();
  studio.load({ kind: "species", name: "maple", vertices: 2000, seed: 1 }, { added: [], removed: [] }, `model = "${model}"\n`);
  const begin = performance.now();
  for (let step = 0; step < STEPS; ++step) studio.step();
  const seconds = (performance.now() - begin) / 1000;
  studio.delete();
  return STEPS / seconds;
}

function native(model, threads) {
  const report = join(scratch, "report.json");
  execFileSync(wilt, ["-q", "simulate", "maple", "--vertices", "2000", "--model", model, ...threads, "--report", report]);
  return STEPS / JSON.parse(readFileSync(report)).timings_s.simulation;
}

const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

for (const model of ["cell", "paper"]) {
  const rates = { wasm: [], one: [], all: [] };
  inWebAssembly(model); // compiled at full optimisation from here on
  for (let run = 0; run < runs; ++run) {
    rates.wasm.push(inWebAssembly(model));
    rates.one.push(native(model, ["--threads", "1"]));
    rates.all.push(native(model, []));
  }
  const [wasm, one, all] = [rates.wasm, rates.one, rates.all].map(median);
  console.log(
    `${model}: ${wasm.toFixed(0)} steps/s in WebAssembly, ${one.toFixed(0)} by the program on one thread ` +
      `(${(wasm / one).toFixed(2)}x), ${all.toFixed(0)} on all (${(wasm / all).toFixed(2)}x)`,
  );
}
rmSync(scratch, { recursive: true });
