// Adds a feature point on the margin, with its vein, or takes one away.
import * as THREE from "three";
import type { App } from "../app";
import { settled } from "../config";
import type { Tip, VeinEdits } from "../core/protocol";
import { marginUnder } from "../overlay";
import type { Stage } from "../viewer/stage";
import type { Tool } from "./tool";

const kSame = 0.02; // perimeters: two places of the margin nearer than this are one
const kClick = 6; // CSS pixels that a click may move

async function edit(app: App, edits: VeinEdits, what: string): Promise<void> {
  const session = app.active;
  const config = settled(session.config, session.head);
  if (config.base.delete("external.forces"))
    app.messages.tell("The forces on the tips are as usual again: there are other tips now");
  if (await app.load({ ...session.recipe(), edits, config }, what)) app.playback.play();
}

/** The edits without what stands at s, and whether there was something. */
function without(places: number[], s: number, near: number): [number[], boolean] {
  const rest = places.filter((place) => Math.abs(place - s) > near);
  return [rest, rest.length < places.length];
}

export function addTip(app: App, place: number): void {
  const { info, edits } = app.active;
  if (!info) return;
  const s = info.margin.s[place]!;
  const [removed, wasRemoved] = without(edits.removed, s, kSame * info.margin.perimeter);
  const added = wasRemoved ? edits.added : [...edits.added, s].sort((a, b) => a - b);
  void edit(app, { added, removed }, "a tip added");
}

export function removeTip(app: App, tip: Tip): void {
  const { info, edits } = app.active;
  if (!info) return;
  const [added, wasAdded] = without(edits.added, tip.s, 1e-3 * info.margin.perimeter);
  void edit(app, { added, removed: wasAdded ? edits.removed : [...edits.removed, tip.s] }, "a tip removed");
}

/** The tip of the active leaf that is under the pointer. */
export function tipUnder(app: App, stage: Stage, x: number, y: number): Tip | undefined {
  const model = stage.models[app.sessions.indexOf(app.active)];
  const point = new THREE.Vector3();
  return model?.info.tips.find((tip) => {
    const at = stage.project(model.point(tip.point, point));
    return (
      Math.hypot(at.x - x, at.y - y) < 16 || (at.x - x < 0 && x - at.x < 34 && at.y - y > 0 && at.y - y < 24)
    );
  });
}

export function tipsTool(app: App, stage: Stage): Tool {
  let start: [number, number] | undefined;
  return {
    id: "tips",
    name: "Add or remove tips",
    hint: "Click on a tip (r1, r2, ...) to remove it with its vein; click anywhere else on the margin to add one.",
    down: (x, y) => {
      if (!tipUnder(app, stage, x, y) && marginUnder(app, stage, x, y) < 0) return false;
      start = [x, y];
      return true;
    },
    move: () => undefined,
    up: (x, y) => {
      if (!start || Math.hypot(x - start[0], y - start[1]) > kClick) return;
      const tip = tipUnder(app, stage, x, y);
      const place = marginUnder(app, stage, x, y);
      if (tip) removeTip(app, tip);
      else if (place >= 0) addTip(app, place);
    },
    enter: () => app.look({ tips: true, veins: true }),
    leave: () => (start = undefined),
  };
}
