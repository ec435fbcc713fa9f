// The light around the leaf: a bright, warm sky above, a paler wall behind, darker below. Made, not loaded.
import * as THREE from "three";

function sky(): THREE.Scene {
  const scene = new THREE.Scene();
  const dome = new THREE.SphereGeometry(10, 24, 16);
  const colours = new Float32Array(dome.attributes.position!.count * 3);
  const colour = new THREE.Color();
  for (let i = 0; i < dome.attributes.position!.count; ++i) {
    const height = dome.attributes.position!.getY(i) / 10;
    if (height > 0) colour.setRGB(0.62, 0.64, 0.66).lerp(new THREE.Color(1.05, 1.1, 1.2), height);
    else colour.setRGB(0.62, 0.64, 0.66).lerp(new THREE.Color(0.42, 0.38, 0.34), Math.min(1, -2 * height));
    colour.toArray(colours, 3 * i);
  }
  dome.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  scene.add(new THREE.Mesh(dome, new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.BackSide })));
  const softbox = (x: number, y: number, z: number, size: number, brightness: number) => {
    const box = new THREE.Mesh(
      new THREE.PlaneGeometry(size, size),
      new THREE.MeshBasicMaterial({ color: new THREE.Color(1, 0.97, 0.92).multiplyScalar(brightness), side: THREE.DoubleSide }),
    );
    box.position.set(x, y, z);
    box.lookAt(0, 0, 0);
    scene.add(box);
  };
  softbox(-5, 6, 2, 5, 5);
  softbox(6, 4, -4, 4, 2.5);
  return scene;
}

export function environment(renderer: THREE.WebGLRenderer): THREE.Texture {
  const generator = new THREE.PMREMGenerator(renderer);
  const made = generator.fromScene(sky(), 0.03).texture;
  generator.dispose();
  return made;
}
