// tinyusdz, which shares no code with wilt, on USD layers: every time sample is what the data beside the file says, and
// the scene that it makes of the layer has the materials with their maps.
// Usage: node read_usd.mjs NODE_MODULES FILE.usda...   Exit code 77 (skipped) when tinyusdz is not installed.
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, ...files] = process.argv.slice(2);
const folder = path.resolve(modules, 'tinyusdz');
if (!fs.existsSync(folder)) {
  console.log('skipped: tinyusdz is not installed (npm ci in the node folder of the build)');
  process.exit(77);
}
// It was built for browsers: it looks for a window, and goes when it finds node.
globalThis.window = globalThis;
process.type = 'renderer';
const { default: start } = await import(pathToFileURL(path.join(folder, 'tinyusdz.js')));
const usd = await start({ wasmBinary: fs.readFileSync(path.join(folder, 'tinyusdz.wasm')) });

const kFrameRate = 24, kEps = 2 ** -23;
let failures = 0;
function expect(holds, ...what) {
  if (!holds) console.log('  failed:', ...what, ++failures);
}

// The layer as tinyusdz holds it, printed again: {"/leaf/blade points": {value, samples: [[time, value]...]}, ...}.
function attributes(layer) {
  const found = {};
  const prims = [];
  let name = '', inSamples = null;
  for (const line of layer.split('\n').map((text) => text.trim())) {
    const prim = line.match(/^def \w+ "(\w+)"/), sample = line.match(/^([-\d.e]+): (.*),$/);
    const attribute = line.match(/^(?:uniform )?([\w[\]]+) ([\w:.]+) = (.*)$/);
    if (prim) {
      name = prim[1];
    } else if (line === '{') {
      prims.push(name);
    } else if (line === '}') {
      if (inSamples) inSamples = null;
      else prims.pop();
    } else if (sample && inSamples) {
      inSamples.push([Number(sample[1]), sample[2]]);
    } else if (attribute) {
      const [base, kind] = attribute[2].split('.');
      const key = `/${prims.join('/')} ${kind === 'connect' ? attribute[2] : base}`;
      found[key] ??= { type: attribute[1], samples: [] };
      if (kind === 'timeSamples') inSamples = found[key].samples;
      else found[key].value = attribute[3];
    }
  }
  return found;
}
const numbers = (text) => (text.replace(/\(\s*interpolation.*$/, '').match(/[-+\d.e]+/g) ?? []).map(Number);

const yUp = ([x, y, z]) => [x, z, -y];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const placed = (dump, p) =>
  yUp(dump.rotation.map((row, i) => dump.scale * dot(row, p) + dump.translation[0][i]));

// One rounding to float32, and one of the printed text.
function largestError(found, expected, what) {
  expect(found.length === expected.length, what, found.length, 'numbers instead of', expected.length);
  let error = 0, scale = 0;
  for (let i = 0; i < expected.length; ++i) {
    error = Math.max(error, Math.abs(found[i] - expected[i]));
    scale = Math.max(scale, Math.abs(expected[i]));
  }
  expect(error <= kEps * scale, what, 'error', error, 'of', scale);
  return error;
}

// Of every frame's positions; the other values are compared on the way.
function checkBlade(dump, found) {
  const times = dump.frames.map((f) => dump.seconds * kFrameRate * f.iteration / Math.max(1, dump.frames.at(-1).iteration));
  let worst = 0;
  const compare = (name, expected) => {
    const attribute = found[`/leaf/blade ${name}`];
    expect(attribute, name, 'is missing');
    worst = 0;
    const last = largestError(numbers(attribute.value), expected(dump.frames.at(-1)), name);
    if (dump.frames.length === 1) return last;
    expect(attribute.samples.length === times.length, name, 'has', attribute.samples.length, 'samples');
    for (const [k, [time, text]] of attribute.samples.entries()) {
      expect(Math.abs(time - times[k]) < 1e-9 * kFrameRate, name, 'at time code', time, 'instead of', times[k]);
      worst = Math.max(worst, largestError(numbers(text), expected(dump.frames[k]), `${name} ${k}`));
    }
    return Math.max(worst, last);
  };
  const error = compare('points', (frame) => frame.positions.flatMap((p) => placed(dump, p)));
  compare('primvars:dryness', (frame) => frame.dryness.flat());
  compare('extent', (frame) => {
    const points = frame.positions.map((p) => placed(dump, p));
    return [Math.min, Math.max].flatMap((pick) => [0, 1, 2].map((c) => pick(...points.map((p) => p[c]))));
  });
  if (!found['/leaf/materials/blade/colour inputs:file'] && dump.frames[0].colours)
    compare('primvars:displayColor', (frame) => frame.colours.flat());
  const st = dump.skin.uv.flatMap(([u, v]) => [u, 1 - v]);
  largestError(numbers(found['/leaf/blade primvars:st'].value), st, 'st');
  largestError(numbers(found['/leaf/blade primvars:st:indices'].value), dump.skin.faces.flat(), 'st:indices');
  largestError(numbers(found['/leaf/blade faceVertexIndices'].value), dump.mesh_faces.flat(), 'faces');
  return error;
}

// What a viewer makes of the layer: meshes of the last frame, their materials and maps.
function checkScene(bytes, file, dump, textured) {
  const loader = new usd.TinyUSDZLoaderNative();
  expect(loader.loadFromBinary(bytes, path.basename(file)), 'no scene:', loader.error());
  expect(loader.numMeshes() === (dump.frames[0].stalk.length ? 2 : 1), loader.numMeshes(), 'meshes');
  const mesh = loader.getMesh(0);
  expect(mesh.primName === 'blade' && mesh.faceVertexIndices.length === 3 * dump.mesh_faces.length, 'its blade');
  if (!textured) return;  // then it has no material
  expect(mesh.texcoords.length >= 2 * dump.skin.uv.length, 'its texture coordinates', mesh.texcoords.length);
  const material = loader.getMaterial(mesh.materialId);
  expect(Math.abs(material.roughness - 0.7) < 1e-6 && material.metallic === 0, 'its material');
  expect(material.diffuseColorTextureId >= 0, 'its texture', material);
  expect(material.normalTextureId >= 0, 'its normal map', material);
}

for (const file of files) {
  const bytes = fs.readFileSync(file), dump = JSON.parse(fs.readFileSync(file.replace(/\.usda$/, '.json')));
  const loader = new usd.TinyUSDZLoaderNative();
  expect(loader.loadAsLayerFromBinary(bytes, path.basename(file)), loader.error());
  const layer = loader.layerToString(), found = attributes(layer);
  const stated = (name) => Number(layer.match(new RegExp(`${name} = ([-\\d.e]+)`))[1]);
  expect(/upAxis = "Y"/.test(layer) && /defaultPrim = "leaf"/.test(layer), 'up or default prim');
  expect(Math.abs(stated('metersPerUnit') * dump.scale - 1) < 1e-12, 'metersPerUnit', stated('metersPerUnit'));
  expect(stated('timeCodesPerSecond') === kFrameRate && stated('startTimeCode') === 0, 'time codes');
  expect(stated('endTimeCode') === (dump.frames.length > 1 ? dump.seconds * kFrameRate : 0), 'endTimeCode');
  const error = checkBlade(dump, found), textured = '/leaf/materials/blade/colour inputs:file' in found;
  if (textured) {
    const name = found['/leaf/materials/blade/colour inputs:file'].value.replace(/^@(.*)@$/, '$1');
    expect(fs.existsSync(path.join(path.dirname(file), name)), name, 'is missing');
  }
  checkScene(bytes, file, dump, textured);
  console.log(`${path.basename(file, '.usda')}: USD        tinyusdz    ${dump.frames.length} frames, largest error of a ` +
              `position ${error.toExponential(1)}`);
}
process.exit(failures === 0 && files.length > 0 ? 0 : 1);
