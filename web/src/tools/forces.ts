// Arrows at the tips: the external force that bends each, pulled by hand.
import * as THREE from "three";
import type { App } from "../app";
import { byId, element } from "../dom";
import { place } from "../overlay";
import type { Stage } from "../viewer/stage";
import type { Tool } from "./tool";

const kPerForce = 5; // leaf lengths that an arrow of force 1 is long
const kShortest = 0.03; // leaf lengths

/** The first force at each tip: x, y, z in the leaf frame. */
export function tipForces(app: App): number[] {
  const { info, frames } = app.active;
  const given = app.active.setting("external.forces", []) as number[];
  if (!info) return [];
  if (given.length === 3 * info.tips.length) return [...given];
  const first = frames[0]?.tipForces ?? new Float32Array(3 * info.tips.length);
  return info.tips.flatMap((_, i) =>
    [first[3 * i]!, -first[3 * i + 2]!, first[3 * i + 1]!].map((v) => Number(v.toPrecision(4))),
  );
}

export function setTipForce(app: App, tip: number, force: [number, number, number]): void {
  const all = tipForces(app);
  force.forEach(
    (value, axis) => (all[3 * tip + axis] = Number(Math.min(100, Math.max(-100, value)).toPrecision(4))),
  );
  app.set("external.forces", all);
}

/** From the leaf frame to the scene's axes, and back. */
function toScene([x, y, z]: number[]): THREE.Vector3 {
  return new THREE.Vector3(x, z, -y!);
}
function toLeaf({ x, y, z }: THREE.Vector3): [number, number, number] {
  return [x, -z, y];
}

export function forcesTool(app: App, stage: Stage): Tool {
  const arrows = new THREE.Group();
  stage.scene.add(arrows);
  let handles: HTMLElement[] = [];
  let active = false;
  let pulled: { tip: number; force: THREE.Vector3 } | undefined;

  const model = () => stage.models[app.sessions.indexOf(app.active)];
  const forceAt = (tip: number) =>
    pulled?.tip === tip ? pulled.force : toScene(tipForces(app).slice(3 * tip, 3 * tip + 3));

  const rebuild = () => {
    for (const handle of handles) handle.remove();
    handles = [];
    arrows.clear();
    if (!active || !app.active.info) return;
    for (const { index } of app.active.info.tips) {
      arrows.add(
        new THREE.ArrowHelper(new THREE.Vector3(0, 1, 0), new THREE.Vector3(), 0.1, "#23658f", 0.04, 0.025),
      );
      handles.push(
        element("div", {
          class: "handle",
          title: `Force at r${index + 1}`,
          pointerdown: (event: PointerEvent) => grab(event, index),
        }),
      );
    }
    byId("overlay").append(...handles);
    stage.invalidate();
  };
  const update = () => {
    const leaf = model();
    if (!active || !leaf || leaf.info !== app.active.info) return;
    leaf.info.tips.forEach((tip, i) => {
      const force = forceAt(i);
      const from = leaf.point(tip.point, new THREE.Vector3());
      const arrow = arrows.children[i] as THREE.ArrowHelper | undefined;
      const length = Math.max(kShortest, force.length() * kPerForce);
      arrow?.position.copy(from);
      arrow?.setDirection(force.lengthSq() > 0 ? force.clone().normalize() : new THREE.Vector3(0, 1, 0));
      arrow?.setLength(length, Math.min(0.05, length / 2), 0.025);
      if (handles[i]) place(stage, handles[i]!, from.addScaledVector(force, kPerForce));
    });
  };

  const grab = (event: PointerEvent, tip: number) => {
    event.preventDefault();
    event.stopPropagation();
    const handle = event.currentTarget as HTMLElement;
    const leaf = model();
    if (!leaf) return;
    handle.setPointerCapture(event.pointerId);
    const from = leaf.point(leaf.info.tips[tip]!.point, new THREE.Vector3());
    const end = from.clone().addScaledVector(forceAt(tip), kPerForce);
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(
      stage.camera.getWorldDirection(new THREE.Vector3()),
      end,
    );
    const ray = new THREE.Raycaster();
    const box = stage.canvas.getBoundingClientRect();
    const drag = (moved: PointerEvent) => {
      const at = new THREE.Vector2(
        ((moved.clientX - box.left) / box.width) * 2 - 1,
        1 - ((moved.clientY - box.top) / box.height) * 2,
      );
      ray.setFromCamera(at, stage.camera);
      const hit = ray.ray.intersectPlane(plane, new THREE.Vector3());
      if (hit) pulled = { tip, force: hit.sub(from).divideScalar(kPerForce) };
      stage.invalidate();
    };
    const drop = () => {
      handle.removeEventListener("pointermove", drag);
      if (pulled) setTipForce(app, tip, toLeaf(pulled.force));
      pulled = undefined;
    };
    handle.addEventListener("pointermove", drag);
    handle.addEventListener("pointerup", drop, { once: true });
  };
  stage.events.on("drawn", update);
  app.events.on("leaf", rebuild);
  app.events.on("active", rebuild);
  app.events.on("config", () => stage.invalidate());
  return {
    id: "forces",
    name: "Pull the tips",
    hint: "Drag the end of an arrow: the force at that tip. The leaf begins anew when you let go.",
    down: () => false,
    move: () => undefined,
    up: () => undefined,
    enter: () => {
      active = true;
      app.look({ tips: true });
      rebuild();
    },
    leave: () => {
      active = false;
      pulled = undefined;
      rebuild();
    },
  };
}
