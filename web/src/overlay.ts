// Names and marks over the leaf: feature points, petiole, the place that is lit, which leaf is which.
import * as THREE from "three";
import type { App } from "./app";
import { byId, element } from "./dom";
import type { Stage } from "./viewer/stage";

const kNear = 26; // CSS pixels from the pointer to the margin that count as pointing at it

/** Puts an element at a point of the scene. */
export function place(
  stage: Stage,
  tag: HTMLElement | SVGElement,
  point: THREE.Vector3,
  dx = 0,
  dy = 0,
): void {
  const at = stage.project(point);
  tag.style.transform = `translate(${at.x + dx}px, ${at.y + dy}px)`;
}

/** The place of the active leaf's margin nearest to the pointer; -1: none is near. */
export function marginUnder(app: App, stage: Stage, x: number, y: number, near = kNear): number {
  const model = stage.models[app.sessions.indexOf(app.active)];
  if (!model) return -1;
  let best = -1;
  let least = near;
  const point = new THREE.Vector3();
  model.info.margin.point.forEach((index, i) => {
    const at = stage.project(model.point(index, point));
    const distance = Math.hypot(at.x - x, at.y - y);
    if (distance < least) [best, least] = [i, distance];
  });
  return best;
}

export function buildOverlay(app: App, stage: Stage): void {
  const box = byId("overlay");
  const spot = element("div", { class: "spot", hidden: true });
  const petiole = element("div", { class: "tag petiole", hidden: true }, "petiole");
  const sides = ["A", "B"].map((name) => element("div", { class: "tag side", hidden: true }, name));
  let tips: HTMLElement[] = [];
  box.append(spot, petiole, ...sides);

  const rebuild = () => {
    for (const tip of tips) tip.remove();
    tips = (app.active.info?.tips ?? []).map((tip) =>
      element("div", { class: "tag", hidden: true }, `r${tip.index + 1}`),
    );
    box.append(...tips);
    stage.invalidate();
  };
  const update = () => {
    const model = stage.models[app.sessions.indexOf(app.active)];
    const point = new THREE.Vector3();
    const { info } = app.active;
    for (const tip of tips) tip.hidden = !app.shown.tips;
    petiole.hidden = !app.shown.tips || !model;
    spot.hidden = app.lit < 0 || !model;
    if (!model || !info || model.info !== info) return;
    if (app.shown.tips) {
      tips.forEach((tag, i) => place(stage, tag, model.point(info.tips[i]!.point, point), 3, -21));
      place(stage, petiole, model.point(info.petiolePoint, point), 3, -21);
    }
    if (app.lit >= 0)
      place(
        stage,
        spot,
        model.point(info.margin.point[Math.min(app.lit, info.margin.point.length - 1)]!, point),
      );
    sides.forEach((tag, side) => {
      const other = stage.models[side];
      tag.hidden = app.sessions.length < 2 || !other;
      if (!tag.hidden)
        place(stage, tag, other!.group.localToWorld(point.set(0, 0, 0.12 * other!.info.length)), -8, 6);
      tag.classList.toggle("lit", app.sessions[side] === app.active);
    });
  };
  stage.events.on("drawn", update);
  app.events.on("leaf", rebuild);
  app.events.on("active", rebuild);
  app.events.on("shown", () => stage.invalidate());
  stage.canvas.addEventListener("pointermove", (event) => {
    if (event.buttons === 0) app.light(marginUnder(app, stage, event.offsetX, event.offsetY));
  });
  stage.canvas.addEventListener("pointerleave", () => app.light(-1));
}
