// A second leaf beside the first: the same clock and camera, settings of its own.
import type { App } from "./app";
import { byId, element } from "./dom";
import { type Recipe, Session } from "./session";

/** `recipe`: of the second leaf. */
export async function openCompare(app: App, recipe: Recipe): Promise<void> {
  if (app.sessions.length > 1) return;
  const second = app.addSession(new Session());
  try {
    await second.load(recipe);
  } catch (error) {
    app.removeSession();
    throw error;
  }
  app.events.emit("sides", undefined);
  app.choose(second);
}

export function buildCompare(app: App): void {
  const button = byId("compare");
  const sides = byId("sides");
  const inputs = ["A", "B"].map((name, side) => {
    const input = element("input", {
      type: "radio",
      name: "side",
      id: `side-${name}`,
      change: () => app.sessions[side] && app.choose(app.sessions[side]),
    });
    sides.append(element("label", {}, input, `Leaf ${name}`));
    return input;
  });
  const update = () => {
    const two = app.sessions.length > 1;
    button.setAttribute("aria-pressed", String(two));
    sides.hidden = !two;
    inputs.forEach((input, side) => (input.checked = app.sessions[side] === app.active));
  };
  app.events.on("sides", update);
  app.events.on("active", update);
  button.addEventListener("click", () => {
    if (app.sessions.length > 1) return app.removeSession();
    app.messages.hint("Leaf B is like A: change a slider to see the difference.");
    openCompare(app, app.sessions[0]!.recipe()).then(
      () => app.playback.play(),
      (error: Error) => app.messages.error(error.message),
    );
  });
}
