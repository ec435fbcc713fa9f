// What is exported: readable by others, and the same by the program.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const LEAF = "leaf=ivy&seed=1&vertices=400&s.iterations=12&i=12";

// Sines of another library differ by an ulp; see tests/studio/same_as_native.mjs.
const TOLERANCE = 1e-6; // of the leaf's length

// A normal map without tangents: viewers make them alike (MikkTSpace), as glTF has them do. The program's files have it too.
const GENERATED_TANGENTS = "MESH_PRIMITIVE_GENERATED_TANGENT_SPACE";

/** Chooses from the export menu; [file name, bytes]. */
async function exported(studio, id) {
  await studio.click("#export");
  return studio.download(() => studio.click(`#export-${id}`));
}

async function closeDialog(studio) {
  const line = await studio.page.textContent("#command");
  await studio.page.click("dialog[open] button.primary");
  return line;
}

/** The last sample of a .pc2 file. */
function lastSample(path) {
  const bytes = readFileSync(path);
  const size = 12 * bytes.readUInt32LE(16);
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset + bytes.length - size, bytes.byteOffset + bytes.length));
}

export default {
  // Oracle: the Khronos validator.
  async theGlbIsValid({ studio, assert, nodeFolder }) {
    await studio.leaf(LEAF);
    const [name, bytes] = await exported(studio, "glb");
    assert.equal(name, "ivy.glb");
    assert.match(await closeDialog(studio), /^wilt simulate ivy --vertices 400 --seed 1 --config run.toml -o ivy.glb$/);
    const validator = createRequire(join(resolve(nodeFolder), "package.json"))("gltf-validator");
    const report = await validator.validateBytes(new Uint8Array(bytes));
    const faults = report.issues.messages.filter(({ code }) => code !== GENERATED_TANGENTS);
    assert.deepEqual(faults, []);
    assert.equal(report.info.animationCount, 1);
    assert.ok(report.info.hasMorphTargets);
  },

  // Oracle: the program, given the file and the command line that the page shows. With a change on the way.
  async theSettingsGiveTheSameLeafNatively({ studio, assert, scratch, wilt }) {
    for (const name of ["willow", "ivy"]) {
      for (const model of ["cell", "paper"]) {
        await studio.leaf(`leaf=${name}&seed=2&vertices=400&s.iterations=30&s.model=${model}&c.10.water.humidity=0.15&i=30`);
        const [file, bytes] = await exported(studio, "toml");
        const line = await closeDialog(studio);
        writeFileSync(join(scratch, file), bytes);
        const words = line.replace(/-o .*/, "-o same.pc2").split(" ").slice(1);
        execFileSync(resolve(wilt), ["-q", ...words], { cwd: scratch });
        const native = lastSample(join(scratch, "same.pc2"));
        const { share, moved } = await studio.core((_, list, app) => {
          const { frames, info } = app.active;
          const most = (a, b) =>
            a.reduce((sum, value, i) => Math.max(sum, Math.abs(value - b[i])), a.length === b.length ? 0 : Infinity) /
            info.length;
          return { share: most(frames.at(-1).positions, list), moved: most(frames.at(-1).positions, frames[0].positions) };
        }, Array.from(native));
        console.log(`  ${name}, ${model}: ${share.toExponential(1)} of its length apart, moved by ${moved.toFixed(2)}`);
        assert.ok(share <= TOLERANCE && moved > 0.01, `${line}: ${share}`);
      }
    }
  },

  async thePictureIsOfTheWindowTwice({ studio, assert }) {
    const [name, bytes] = await exported(studio, "png");
    assert.match(name, /\.png$/);
    const box = await studio.page.locator("#canvas").boundingBox();
    const [across, down] = [bytes.readUInt32BE(16) - 2 * box.width, bytes.readUInt32BE(20) - 2 * box.height];
    assert.ok(Math.max(Math.abs(across), Math.abs(down)) <= 1, `${across}, ${down} pixels off`);
    assert.ok(bytes.length > 20_000, `${bytes.length} bytes`);
  },

  // Oracle: the frames that the page has.
  async tablesAndReports({ studio, assert }) {
    const state = await studio.leaf(LEAF);
    const [, csv] = await exported(studio, "csv");
    const rows = csv.toString().trim().split("\n");
    assert.match(rows[0], /^iteration,region,elastic/);
    assert.equal(Math.max(...rows.slice(1).map((row) => Number(row.split(",")[0]))), 12);
    const [, report] = await exported(studio, "report");
    const { leaf, metrics } = JSON.parse(report.toString());
    assert.equal(leaf.vertices, state.leaf.vertices);
    const curl = await studio.core((_, __, app) => app.active.frames.at(-1).curl);
    assert.ok(
      Math.abs((metrics.curl * 180) / Math.PI - curl) < 1e-3 * Math.max(1, Math.abs(curl)) ||
        Math.abs(metrics.curl - curl) < 1e-3 * Math.max(1, Math.abs(curl)),
      `${metrics.curl}, ${curl}`,
    );
    const [, veins] = await exported(studio, "veins");
    assert.equal(JSON.parse(veins.toString()).tips.length, state.leaf.tips);
  },

  // Oracle: the container's own mark, and a length of its own.
  async aFilm({ studio, assert }) {
    await studio.page.setViewportSize({ width: 480, height: 400 });
    const [name, bytes] = await exported(studio, "film");
    await studio.page.setViewportSize({ width: 900, height: 640 });
    if (name.endsWith(".webm")) assert.equal(bytes.readUInt32BE(0), 0x1a45dfa3);
    else assert.equal(bytes.toString("latin1", 4, 8), "ftyp");
    assert.ok(bytes.length > 3000, `${bytes.length} bytes`);
  },
};
