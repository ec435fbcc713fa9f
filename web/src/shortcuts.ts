// Keys, and the dialog that lists them.
import type { App } from "./app";
import { byId, element } from "./dom";
import { undoLast } from "./panel/edit";
import type { Toolbox } from "./tools/tool";
import { resetAll } from "./transport";
import { VIEWS } from "./viewer/framing";

const kTurn = Math.PI / 18;
const kKeys: [string, string][] = [
  ["Space", "Play, pause"],
  ["← →", "One iteration back, on; with Shift ten"],
  ["Home, End", "To the fresh leaf, to the dry one"],
  ["R", "Start again, fresh, with these settings"],
  ["F", "Show all of the leaf"],
  [`1 to ${VIEWS.length}`, "Views: from above, from the side, ..."],
  ["W A S D, + −", "Turn the view; nearer, away"],
  ["Ctrl Z", "Take back"],
  ["Escape", "Leave a tool, close a menu"],
  ["?", "This help"],
];

function help(): HTMLDialogElement {
  const dialog = element("dialog", { id: "help-dialog", "aria-labelledby": "help-title" });
  dialog.append(
    element("h2", { id: "help-title" }, "Leaves that wither"),
    element(
      "p",
      {},
      "Press play, and move a slider while the leaf withers: it goes on from there. The bar at the bottom goes back in time; what you change there begins a new course.",
    ),
    element(
      "p",
      {},
      "Drop a photo on a plain background, a drawing (.svg) or a mesh (.obj, .ply, .glb) anywhere on the page. Nothing leaves your computer.",
    ),
    element(
      "p",
      {},
      "Drag turns the leaf, the wheel or two fingers zoom, the right button moves it. A double click on a slider goes back to the usual.",
    ),
    element(
      "table",
      { class: "keys" },
      ...kKeys.map(([key, does]) =>
        element("tr", {}, element("td", {}, element("kbd", {}, key)), element("td", {}, does)),
      ),
    ),
    element("p", { class: "hint", id: "about" }),
    element("button", { class: "primary", click: () => dialog.close() }, "Close"),
  );
  document.body.append(dialog);
  return dialog;
}

/** Whether a key belongs to what has the focus: text, numbers, sliders, lists. */
function taken(event: KeyboardEvent): boolean {
  const target = event.target as HTMLElement;
  if (target.closest("dialog")) return true;
  if (target instanceof HTMLInputElement && ["radio", "range"].includes(target.type))
    return event.key.startsWith("Arrow") || event.key === " " || event.key === "Home" || event.key === "End";
  if (target instanceof HTMLInputElement && target.type !== "checkbox") return true;
  if (target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement) return true;
  return event.key === " " && target.closest("button, summary, input") !== null;
}

export function buildShortcuts(app: App, tools: Toolbox | undefined): void {
  const dialog = help();
  byId("help").addEventListener("click", () => {
    dialog.showModal();
    void app.active.core.about().then((text) => (byId("about").textContent = text));
  });
  const { playback, stage } = app;
  const actions: Record<string, (event: KeyboardEvent) => void> = {
    " ": () => playback.toggle(),
    ArrowRight: (event) => playback.stepBy(event.shiftKey ? 10 : 1),
    ArrowLeft: (event) => playback.stepBy(event.shiftKey ? -10 : -1),
    Home: () => playback.stepBy(-playback.iterations),
    End: () => playback.stepBy(playback.iterations),
    r: () => void resetAll(app),
    f: () => stage?.fit(),
    a: () => stage?.orbit(-kTurn, 0),
    d: () => stage?.orbit(kTurn, 0),
    w: () => stage?.orbit(0, kTurn),
    s: () => stage?.orbit(0, -kTurn),
    "+": () => stage?.zoom(0.9),
    "=": () => stage?.zoom(0.9),
    "-": () => stage?.zoom(1 / 0.9),
    "?": () => byId("help").click(),
    Escape: () => tools?.choose(undefined),
  };
  addEventListener("keydown", (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z" && !event.shiftKey) {
      if (
        event.target instanceof HTMLInputElement &&
        ["text", "search", "number"].includes(event.target.type)
      )
        return;
      event.preventDefault();
      void undoLast(app);
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey || taken(event)) return;
    const view = Number(event.key) - 1;
    if (VIEWS[view] && event.key.length === 1) stage?.setView(view);
    else if (actions[event.key]) actions[event.key]!(event);
    else if (actions[event.key.toLowerCase()]) actions[event.key.toLowerCase()]!(event);
    else return;
    event.preventDefault();
  });
}
