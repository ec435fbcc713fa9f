// Files that are dropped: the same leaf as by the program, and what is said of those that are none.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { outlinesApart } from "../outlines.mjs";

/** A GLB's JSON and a reader of its accessors of three floats. */
function parseGlb(bytes) {
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + length).toString());
  const binary = bytes.subarray(28 + length);
  const vectors = (index) => {
    const { bufferView, byteOffset = 0, count } = json.accessors[index];
    const view = json.bufferViews[bufferView];
    const start = binary.byteOffset + (view.byteOffset ?? 0) + byteOffset;
    return new Float32Array(binary.buffer.slice(start, start + 12 * count));
  };
  return { json, vectors };
}

/** The blade as `wilt leaf` reads the file: positions in metres, where the file has it. */
function nativePositions(wilt, file, scratch) {
  const out = join(scratch, "native.glb");
  execFileSync(wilt, ["-q", "leaf", file, "-o", out]);
  const { json, vectors } = parseGlb(readFileSync(out));
  const metres = Number(/"metres_per_unit":([^,}]+)/.exec(JSON.stringify(json))[1]);
  return vectors(json.meshes.find(({ name }) => name === "blade").primitives[0].attributes.POSITION).map(
    (value) => metres * value,
  );
}

/** How far the leaf at rest is from the same points moved and turned; shares of its length. */
const apart = (studio, positions) =>
  studio.core((_, list, app) => {
    const rest = app.active.frames[0].positions;
    if (rest.length !== list.length) return Infinity;
    const at = (all, i) => Array.from(all.slice(3 * i, 3 * i + 3));
    const count = list.length / 3;
    const anchors = [0, Math.floor(count / 3), Math.floor((2 * count) / 3)];
    const distance = (all, i, j) => Math.hypot(...at(all, i).map((value, k) => value - all[3 * j + k]));
    let most = 0;
    for (let i = 0; i < count; ++i)
      for (const j of anchors) most = Math.max(most, Math.abs(distance(rest, i, j) - distance(list, i, j)));
    return most / app.active.info.length;
  }, Array.from(positions));

async function opened(studio, kind, name) {
  const state = await studio.until(
    (now, [k, n]) => now.source.kind === k && now.source.name === n && now.leaf && !now.busy,
    [kind, name],
  );
  await studio.page.evaluate(() => globalThis.wiltStudio.app.playback.pause());
  return state;
}

/** The OBJ's triangles as other programs write them. */
function asPly(obj) {
  const lines = obj.split("\n");
  const vertices = lines.filter((line) => line.startsWith("v ")).map((line) => line.slice(2));
  const faces = lines
    .filter((line) => line.startsWith("f "))
    .map((line) =>
      line
        .slice(2)
        .trim()
        .split(/\s+/)
        .map((corner) => parseInt(corner) - 1),
    );
  return `ply\nformat ascii 1.0\nelement vertex ${vertices.length}\nproperty float x\nproperty float y\nproperty float z\nelement face ${faces.length}\nproperty list uchar int vertex_indices\nend_header\n${vertices.join("\n")}\n${faces.map((face) => `3 ${face.join(" ")}`).join("\n")}\n`;
}

function asStl(obj) {
  const lines = obj.split("\n");
  const vertices = lines.filter((line) => line.startsWith("v ")).map((line) => line.slice(2).trim().split(/\s+/).map(Number));
  const faces = lines
    .filter((line) => line.startsWith("f "))
    .map((line) =>
      line
        .slice(2)
        .trim()
        .split(/\s+/)
        .map((corner) => parseInt(corner) - 1),
    );
  const bytes = Buffer.alloc(84 + 50 * faces.length);
  bytes.writeUInt32LE(faces.length, 80);
  faces.forEach((face, f) =>
    face.forEach((vertex, c) =>
      vertices[vertex].forEach((value, k) => bytes.writeFloatLE(value, 84 + 50 * f + 12 + 12 * c + 4 * k)),
    ),
  );
  return bytes;
}

/** Without the part named "stalk", which neither PLY nor STL can name. */
function bladeOnly(obj) {
  const parts = obj.split(/^(?=[og] )/m);
  return parts.filter((part) => !/^[og] stalk/.test(part)).join("");
}

const SVG = `<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="120mm" viewBox="0 0 90 120"><style>.leaf { fill: #395 }</style>
  <script>globalThis.wasRun = true</script><rect width="90" height="120" fill="white"/>
  <g transform="translate(45 10) scale(1.5)"><path class="leaf" d="M0,0C18,6 24,32 0,56C-24,32 -18,6 0,0z"/></g></svg>`;
const OUTLINE = JSON.stringify({
  outline: [
    [0, 0],
    [20, 10],
    [28, 30],
    [14, 52],
    [0, 70],
    [-14, 52],
    [-28, 30],
    [-20, 10],
  ],
  petiole: [0, 0],
  mm_per_unit: 1,
});

/** Meshes of the program, and drawings. */
async function meshFiles(scratch, wilt) {
  const path = (name) => join(scratch, name);
  if (!existsSync(path("ivy.obj"))) {
    for (const name of ["ivy.obj", "whole.glb"]) execFileSync(wilt, ["-q", "leaf", "ivy", "--vertices", "400", "-o", path(name)]);
    const blade = bladeOnly(readFileSync(path("ivy.obj"), "utf8"));
    writeFileSync(path("blade.ply"), asPly(blade));
    writeFileSync(path("solid.stl"), asStl(blade));
    writeFileSync(path("drawn.svg"), SVG);
    writeFileSync(path("outline.json"), OUTLINE);
    execFileSync(wilt, ["-q", "simulate", "ivy", "--vertices", "400", "--iterations", "8", "-o", path("run.glb")]);
  }
  return path;
}

const KINDS = {
  "ivy.obj": "mesh",
  "whole.glb": "mesh",
  "blade.ply": "mesh",
  "solid.stl": "mesh",
  "drawn.svg": "drawing",
  "outline.json": "outline",
};

export default {
  // Oracle: `wilt leaf FILE`. A file's own vertices are kept to single precision; an outline is meshed by the same code in
  // WebAssembly.
  async areTheProgramsLeaves({ studio, assert, scratch, wilt }) {
    const path = await meshFiles(scratch, wilt);
    for (const [file, kind] of Object.entries(KINDS)) {
      await studio.drop(path(file));
      await opened(studio, kind, file.split(".")[0]);
      const share = await apart(studio, nativePositions(wilt, path(file), scratch));
      console.log(`  ${file}: ${share.toExponential(1)} of its length apart`);
      assert.ok(share < 1e-6, `${file} is ${share} lengths apart`);
    }
    assert.equal(await studio.page.evaluate(() => globalThis.wasRun), undefined, "no script of a drawing runs");
  },

  // Oracle: the first frame is the leaf at rest that the run began with.
  async aRunGivesItsFirstFrame({ studio, assert, scratch, wilt }) {
    const path = await meshFiles(scratch, wilt);
    await studio.drop(path("run.glb"));
    await opened(studio, "mesh", "run");
    const share = await apart(studio, nativePositions(wilt, path("whole.glb"), scratch));
    assert.ok(share < 1e-3, `${share} lengths from the leaf at rest`);
    assert.ok((await studio.messages()).some((text) => text.includes("stalk")));
  },

  // Oracle: the outlines that `wilt leaf` traces, both meshed: vertices lie on the margin and inside, differently.
  async drawingsOfOthers({ studio, assert, scratch, wilt, shared }) {
    const folder = join(shared, "outlines");
    if (!existsSync(folder)) return console.log("  skipped: the shared drawings are not there");
    for (const name of readdirSync(folder).filter((each) => each.endsWith(".svg"))) {
      await studio.drop(join(folder, name));
      await opened(studio, "drawing", name.slice(0, -4));
      const share = await apart(studio, nativePositions(wilt, join(folder, name), scratch));
      console.log(`  ${name}: ${share.toExponential(1)} of its length apart`);
      assert.ok(share < 1e-6);
    }
  },

  // Oracle: the native reader with its own decoder of JPEG and PNG; same_cut_out.mjs compares the steps behind that.
  async photosAreCutOutAlike({ studio, assert, scratch, python, shared, nativeCutOut }) {
    execFileSync(python, ["-B", join(dirname(fileURLToPath(import.meta.url)), "../paint_photos.py"), scratch]);
    const grape = join(shared, "grape_traced/Almeria_K0130A.jpg");
    const photos = [join(scratch, "stalked.png"), join(scratch, "lobed.jpg"), ...(existsSync(grape) ? [grape] : [])];
    const expected = JSON.parse(execFileSync(nativeCutOut, [scratch, ...photos], { maxBuffer: 1 << 30 }));
    for (const [k, photo] of photos.entries()) {
      await studio.drop(photo);
      await opened(studio, "photo", basename(photo).split(".")[0]);
      const margin = await studio.core((_, __, app) => Array.from(app.active.source.photo.margin));
      const pixels = outlinesApart(margin, expected[k].margin);
      console.log(`  ${basename(photo)}: outlines ${pixels.toFixed(2)} pixels apart`);
      assert.ok(pixels <= 2, `${pixels} pixels`);
    }
  },

  // Negative: each is refused by its name, in words; the leaf that was there stays.
  async brokenFilesAreRefused({ studio, assert, scratch, wilt }) {
    const path = await meshFiles(scratch, wilt);
    const { leaf } = await studio.leaf("leaf=willow&seed=1&vertices=400");
    const cut = (name, share) => ({
      name: `cut-${name}`,
      bytes: readFileSync(path(name)).subarray(0, Math.floor(share * readFileSync(path(name)).length)),
    });
    const broken = [
      [cut("whole.glb", 0.5), /cannot be read as a mesh/],
      [{ name: "no-face.obj", bytes: Buffer.from("v 0 0 0\nv 1 0 0\nv 0 1 0\n") }, /there is no face/],
      [{ name: "wrong-face.obj", bytes: Buffer.from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n") }, /not finite or not in the file/],
      [
        {
          name: "points.ply",
          bytes: Buffer.from(
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
          ),
        },
        /no faces/,
      ],
      [cut("solid.stl", 0.7), /no kind of leaf file|cannot be read|mesh/],
      [{ name: "torn.svg", bytes: Buffer.from(SVG.slice(0, 300)) }, /cannot be read as SVG/],
      [{ name: "empty.svg", bytes: Buffer.from('<svg xmlns="http://www.w3.org/2000/svg"/>') }, /no filled path/],
      [{ name: "wrong.json", bytes: Buffer.from('{"outline": [[0, 0], [1, "a"], [2, 2]]}') }, /outline\[1\]/],
      [{ name: "not.json", bytes: Buffer.from("{") }, /JSON/],
      [{ name: "torn.png", bytes: Buffer.from("\x89PNG\r\n\x1a\nnothing", "latin1") }, /cannot be decoded/],
      [{ name: "animated.gif", bytes: Buffer.from("GIF89a") }, /a GIF picture.*PNG or JPEG/],
      [{ name: "leaf.zip", bytes: Buffer.from("PK\x03\x04....", "latin1") }, /a ZIP archive.*unpack/],
      [{ name: "nothing.obj", bytes: Buffer.alloc(0) }, /empty/],
      [{ name: "letter.docx", bytes: Buffer.from("Dear wilt,") }, /no kind of leaf file; allowed are/],
    ];
    for (const [file, words] of broken) {
      await studio.page.evaluate(() => document.querySelectorAll("#messages button").forEach((button) => button.click()));
      await studio.drop(file);
      const text = await (await studio.page.waitForSelector("#messages .error p")).textContent();
      assert.match(text, words);
      assert.ok(text.includes(file.name.split(".")[0]), `"${text}" names the file`);
      const state = await studio.state();
      assert.equal(state.leaf.species, leaf.species, `${file.name}: the leaf stays`);
    }
    // What was refused leaves no run that cannot go on.
    await studio.page.fill("#scrub", "3");
    await studio.until((now) => now.shown === 3);
  },
};
