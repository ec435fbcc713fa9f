// A lasso around a part of the leaf that shall dry faster, or slower.
import * as THREE from "three";
import type { App } from "../app";
import { byId } from "../dom";
import type { Stage } from "../viewer/stage";
import type { Tool } from "./tool";

type Point = [number, number];

/** The corners around all points, counter-clockwise (Andrew's monotone chain). */
export function convexHull(points: Point[]): Point[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list: Point[]): Point[] => {
    const chain: Point[] = [];
    for (const p of list) {
      for (let n = chain.length; n >= 2; n = chain.length) {
        const [a, b] = [chain[n - 2]!, chain[n - 1]!];
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

function inside(polygon: Point[], x: number, y: number): boolean {
  let is = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [ax, ay] = polygon[i]!;
    const [bx, by] = polygon[j]!;
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) is = !is;
  }
  return is;
}

/** Where a point of the skin is on the leaf at rest, leaf lengths, leaf frame. */
function restPlace(app: App, index: number): Point {
  const rest = app.active.frames[0]!.positions;
  const length = app.active.info!.length;
  return [rest[3 * index]! / length, -rest[3 * index + 2]! / length];
}

export function setRegion(app: App, corners: Point[]): void {
  app.set(
    "water.dry_region",
    corners.flat().map((value) => Number(value.toFixed(4))),
  );
}

export function regionOf(app: App): Point[] {
  const setting = app.active.settings.get("water.dry_region");
  if (!setting) return [];
  const list = app.active.valueAt(setting, app.playback.shown) as number[];
  return Array.from({ length: list.length / 2 }, (_, i) => [list[2 * i]!, list[2 * i + 1]!]);
}

/** A circle around a tip. */
export function regionAroundTip(app: App, tip: number): void {
  const [x, y] = restPlace(app, app.active.info!.tips[tip]!.point);
  const corners = Array.from({ length: 12 }, (_, i): Point => {
    const angle = (2 * Math.PI * i) / 12;
    return [x + 0.22 * Math.cos(angle), y + 0.22 * Math.sin(angle)];
  });
  setRegion(app, corners);
}

/** Draws the lasso and the region that is set. */
function drawing(app: App, stage: Stage): { lasso: (points: Point[]) => void } {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.innerHTML =
    '<polygon id="region-outline" fill="#d1603d33" stroke="#d1603d" stroke-width="2" stroke-dasharray="6 4"/>' +
    '<polyline id="lasso" fill="#3d85b822" stroke="#3d85b8" stroke-width="2"/>';
  byId("overlay").append(svg);
  const [outline, line] = [svg.children[0]!, svg.children[1]!];
  let cached: { key: string; within: number[] } = { key: "", within: [] };
  stage.events.on("drawn", () => {
    const model = stage.models[app.sessions.indexOf(app.active)];
    const corners = regionOf(app);
    const { info } = app.active;
    if (!model || model.info !== info || corners.length === 0 || byId("panel-edit").hidden)
      return outline.setAttribute("points", "");
    const key = `${info.name} ${info.points} ${corners}`;
    if (cached.key !== key) {
      const all = Array.from({ length: info.points }, (_, i) => i);
      cached = { key, within: all.filter((i) => inside(corners, ...restPlace(app, i))) };
    }
    const point = new THREE.Vector3();
    const seen = cached.within.map((index): Point => {
      const at = stage.project(model.point(index, point));
      return [at.x, at.y];
    });
    outline.setAttribute(
      "points",
      convexHull(seen)
        .map((p) => p.map((v) => v.toFixed(1)).join(","))
        .join(" "),
    );
  });
  return { lasso: (points) => line.setAttribute("points", points.map((p) => p.join(",")).join(" ")) };
}

export function regionTool(app: App, stage: Stage): Tool {
  const { lasso } = drawing(app, stage);
  let drawn: Point[] = [];
  return {
    id: "region",
    name: "Dry a region",
    hint: "Draw around a part of the leaf: it loses its water faster than the rest, by the factor below.",
    down: (x, y) => {
      drawn = [[x, y]];
      return true;
    },
    move: (x, y) => {
      drawn.push([x, y]);
      lasso(drawn);
    },
    up: () => {
      lasso([]);
      const model = stage.models[app.sessions.indexOf(app.active)];
      if (!model || drawn.length < 3) return;
      const point = new THREE.Vector3();
      const within: Point[] = [];
      for (let i = 0; i < model.info.points; ++i) {
        const at = stage.project(model.point(i, point));
        if (inside(drawn, at.x, at.y)) within.push(restPlace(app, i));
      }
      const corners = convexHull(within);
      drawn = [];
      if (corners.length < 3) app.messages.hint("There is no leaf inside that line");
      else setRegion(app, corners);
    },
    enter: () => undefined,
    leave: () => lasso((drawn = [])),
  };
}
