// Moves the petiole along the margin.
import type { App } from "../app";
import { settled } from "../config";
import { marginUnder } from "../overlay";
import type { Stage } from "../viewer/stage";
import type { Tool } from "./tool";

/** Joins the stalk to a place of the margin: the veins are found anew, edits of them are forgotten. */
export async function movePetiole(app: App, place: number): Promise<void> {
  const session = app.active;
  if (!session.info) return;
  const { place: places } = session.info.margin;
  const petiole: [number, number] = [places[2 * place]!, places[2 * place + 1]!];
  const recipe = {
    file: session.file,
    source: { ...session.source, petiole },
    edits: { added: [], removed: [] },
    config: settled(session.config, session.head),
  };
  recipe.config.base.delete("external.forces"); // there may be other tips
  if (await app.load(recipe, "the petiole")) app.playback.play();
}

export function petioleTool(app: App, stage: Stage): Tool {
  let dragging = false;
  return {
    id: "petiole",
    name: "Move the petiole",
    hint: "Drag the end of the stalk along the leaf's margin, or press where it shall be. The veins are found anew.",
    down: (x, y) => {
      const place = marginUnder(app, stage, x, y, 40);
      dragging = place >= 0;
      app.light(place);
      return dragging;
    },
    move: (x, y) => app.light(marginUnder(app, stage, x, y, Infinity)),
    up: (x, y) => {
      dragging = false;
      const place = marginUnder(app, stage, x, y, Infinity);
      app.light(-1);
      if (place >= 0) void movePetiole(app, place);
    },
    enter: () => app.look({ tips: true }),
    leave: () => {
      if (dragging) app.light(-1);
      dragging = false;
    },
  };
}
