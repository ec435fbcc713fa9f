// Puts the page together.
import { App } from "./app";
import { emptyConfig } from "./config";
import { byId, element } from "./dom";
import { Messages } from "./messages";
import { buildAllSettings } from "./panel/all_settings";
import { buildTabs } from "./panel/tabs";
import { buildWither } from "./panel/wither";
import { hasWebGl2 } from "./support";
import { buildTheme } from "./theme";
import { buildTransport } from "./transport";
import { Stage } from "./viewer/stage";
import { buildViews } from "./views";

async function begin(): Promise<void> {
  const messages = new Messages(byId("messages"));
  const stage = hasWebGl2() ? new Stage(byId<HTMLCanvasElement>("canvas")) : undefined;
  const app = new App(stage, messages);
  buildTheme(() => stage?.invalidate());
  if (stage) buildViews(stage);
  buildTransport(app);
  buildTabs([
    { id: "wither", name: "Wither", panel: buildWither(app) },
    { id: "all", name: "All settings", panel: buildAllSettings(app) },
  ]);
  app.events.on("busy", (what) => (byId("busy").textContent = what));

  Object.assign(window, { wiltStudio: { app, core: app.active.core } });

  let last = performance.now();
  const tick = (now: number) => {
    app.playback.tick(Math.min(0.1, (now - last) / 1000));
    last = now;
    stage?.draw();
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);

  await app.active.load({ source: app.active.source, edits: app.active.edits, config: emptyConfig() });
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) app.playback.play();
}

begin().catch((error: Error) => document.body.append(element("p", { class: "fallback" }, error.message)));
