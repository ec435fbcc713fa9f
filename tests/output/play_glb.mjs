// three.js' own loader and animation mixer on a GLB: at a key frame and half way between two, the blade is where
// the data beside the file says. Usage: node play_glb.mjs NODE_MODULES FILE.glb ...
// Exit code 77 (skipped) when three is not installed.
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, ...files] = process.argv.slice(2);
const three = path.resolve(modules, 'three');
if (!fs.existsSync(three)) {
  console.log('skipped: three is not installed (npm ci in the node folder of the build)');
  process.exit(77);
}
globalThis.self = globalThis;
const THREE = await import(pathToFileURL(path.join(three, 'build/three.module.js')));
const { GLTFLoader } = await import(pathToFileURL(path.join(three, 'examples/jsm/loaders/GLTFLoader.js')));

const loader = new GLTFLoader();
// node has no decoder of pictures; the geometry does not need it.
loader.register(() => ({ name: 'no pictures', loadTexture: () => Promise.resolve(new THREE.Texture()) }));
const yUp = ([x, y, z]) => new THREE.Vector3(x, z, -y);
let bad = 0;
for (const file of files) bad += !(await plays(file));
process.exit(bad);

async function plays(file) {
  const bytes = fs.readFileSync(file);
  const gltf = await loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
  const dump = JSON.parse(fs.readFileSync(file.replace(/\.glb$/, '.json')));
  const blade = gltf.scene.getObjectByName('blade');
  const mixer = new THREE.AnimationMixer(gltf.scene);
  mixer.clipAction(gltf.animations[0]).setLoop(THREE.LoopOnce).play().clampWhenFinished = true;

  const last = dump.frames.at(-1).iteration;
  const time = (frame) => (dump.seconds * frame.iteration) / last;
  let worst = 0;
  function compare(seconds, a, b, share) {
    mixer.setTime(seconds);
    dump.skin.vertex.forEach((vertex, skin) => {
      const expected = yUp(a.positions[vertex]).lerp(yUp(b.positions[vertex]), share);
      worst = Math.max(worst, blade.getVertexPosition(skin, new THREE.Vector3()).distanceTo(expected));
    });
  }
  for (let k = 0; k + 1 < dump.frames.length; ++k) {
    const [a, b] = [dump.frames[k], dump.frames[k + 1]];
    compare(time(a), a, b, 0);
    compare((time(a) + time(b)) / 2, a, b, 0.5);
  }
  compare(dump.seconds, dump.frames.at(-1), dump.frames.at(-1), 0);
  // Rounding of float32 weights, bases and targets of 0.1 m: a few 1e-8.
  console.log(`${file}: three.js r${THREE.REVISION} plays it within ${worst.toExponential(2)} m`);
  return worst < 1e-7 && blade.morphTargetInfluences.length === dump.frames.length;
}
