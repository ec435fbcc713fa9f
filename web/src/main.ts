// Puts the page together.
import { buildAnnouncements } from "./announce";
import { App } from "./app";
import { buildCompare, openCompare } from "./compare";
import { emptyConfig } from "./config";
import { byId } from "./dom";
import { buildDrop } from "./drop";
import { buildExports } from "./exports/menu";
import { type Linked, buildShare, linked } from "./link";
import { Messages } from "./messages";
import { buildOverlay } from "./overlay";
import { buildAllSettings } from "./panel/all_settings";
import { buildEdit } from "./panel/edit";
import { buildLook } from "./panel/look";
import { buildPlots } from "./panel/plots";
import { buildTabs } from "./panel/tabs";
import { buildWither } from "./panel/wither";
import { Session } from "./session";
import { buildSheet } from "./sheet";
import { buildShortcuts } from "./shortcuts";
import { missingForCore, showWithoutCore, webGl2 } from "./support";
import { appState } from "./state";
import { buildTheme } from "./theme";
import { forcesTool } from "./tools/forces";
import { petioleTool } from "./tools/petiole";
import { regionTool } from "./tools/region";
import { tipsTool } from "./tools/tips";
import { Toolbox } from "./tools/tool";
import { buildTransport } from "./transport";
import { buildFlat } from "./viewer/flat";
import { Stage } from "./viewer/stage";
import { buildViews } from "./views";

function build(messages: Messages): App {
  const first = new Session(); // its worker loads while the rest is built
  const drawing = webGl2();
  const stage = drawing && new Stage(byId<HTMLCanvasElement>("canvas"), drawing.software);
  const app = new App(stage, messages, first);
  buildTheme((dark) => stage?.setDark(dark));
  let tools: Toolbox | undefined;
  if (stage) {
    buildViews(stage);
    buildOverlay(app, stage);
    tools = new Toolbox(app, stage, [
      petioleTool(app, stage),
      forcesTool(app, stage),
      tipsTool(app, stage),
      regionTool(app, stage),
    ]);
  } else {
    app.active.textureSize = 0;
    buildFlat(app);
    messages.tell(
      "This browser has no WebGL 2, so the leaf is drawn flat, from above. Turning on hardware acceleration in the browser's settings, or another browser, usually brings it.",
    );
  }
  buildTransport(app);
  const plots = buildPlots(app);
  buildTabs([
    { id: "wither", name: "Wither", panel: buildWither(app) },
    { id: "look", name: "Look", panel: buildLook(app) },
    { id: "edit", name: "Edit", panel: buildEdit(app, tools) },
    { id: "plots", name: "Plots", ...plots },
    { id: "all", name: "All", panel: buildAllSettings(app) },
  ]);
  byId("tabs").addEventListener("click", () => stage?.invalidate());
  buildExports(app);
  buildShare(app);
  buildCompare(app);
  buildDrop(app);
  buildSheet();
  buildShortcuts(app, tools);
  buildAnnouncements(app);
  app.events.on("busy", (what) => (byId("busy").textContent = what));
  return app;
}

function run(app: App): void {
  let last = performance.now();
  const tick = (now: number) => {
    app.playback.tick(Math.min(0.5, (now - last) / 1000));
    last = now;
    app.stage?.draw();
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}

/** What the address asks for, or a maple that begins to wither. */
async function openFirst(app: App): Promise<void> {
  let asked: Linked | undefined;
  try {
    asked = linked();
    if (asked) await app.sessions[0]!.load(asked.recipe);
  } catch (error) {
    app.messages.error((error as Error).message);
    asked = undefined;
  }
  if (!asked) {
    const recipe = {
      source: { kind: "species", name: "maple", seed: 1, vertices: 0 } as const,
      edits: { added: [], removed: [] },
    };
    await app.sessions[0]!.load({ ...recipe, config: emptyConfig() });
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) app.playback.play();
    return;
  }
  if (asked.beside) await openCompare(app, asked.beside);
  app.playback.pause();
  app.playback.scrub(asked.iteration);
  asked.look(app);
}

function begin(): void {
  const missing = missingForCore();
  if (missing) {
    buildTheme(() => undefined);
    return showWithoutCore(missing);
  }
  const messages = new Messages(byId("messages"));
  const app = build(messages);
  run(app);
  // For tests, and for those who want to play with the core from the console.
  Object.assign(window, { wiltStudio: { core: app.sessions[0]!.core, app, state: () => appState(app) } });
  const open = () => openFirst(app).catch((error: Error) => messages.error(error.message));
  addEventListener("hashchange", () => {
    if (app.sessions.length > 1) app.removeSession();
    void open();
  });
  void open();
}

begin();
