// The third tab: tools for the pointer, and the same with the keyboard.
import type { App } from "../app";
import { element } from "../dom";
import { regionAroundTip, regionOf } from "../tools/region";
import { setTipForce, tipForces } from "../tools/forces";
import { movePetiole } from "../tools/petiole";
import { addTip, removeTip } from "../tools/tips";
import type { Toolbox } from "../tools/tool";
import { placeAt } from "./profile";
import { settingSlider } from "./slider";

function toolButtons(box: Toolbox): HTMLElement {
  const hint = element("p", { class: "hint", role: "status" });
  const buttons = box.tools.map((tool) =>
    element(
      "button",
      {
        id: `tool-${tool.id}`,
        "aria-pressed": "false",
        click: () => box.choose(box.chosen === tool ? undefined : tool),
      },
      tool.name,
    ),
  );
  const say = () =>
    (hint.textContent = box.chosen
      ? `${box.chosen.hint} Escape leaves.`
      : "Choose a tool, then use it on the leaf.");
  box.events.on("chosen", (chosen) => {
    buttons.forEach((button, i) => button.setAttribute("aria-pressed", String(box.tools[i] === chosen)));
    say();
  });
  say();
  return element("div", {}, element("div", { class: "row" }, ...buttons), hint);
}

/** A row for each tip: its place, its force, remove. */
function tipRow(app: App, index: number): HTMLElement {
  const tip = app.active.info!.tips[index]!;
  const name = `r${index + 1}`;
  const force = tipForces(app).slice(3 * index, 3 * index + 3) as [number, number, number];
  const axes = ["right", "to the apex", "up"].map((axis, i) =>
    element("input", {
      type: "number",
      step: "any",
      min: -100,
      max: 100,
      value: force[i],
      "aria-label": `Force at ${name}, ${axis}`,
      title: `Force, ${axis}`,
      change: (event: Event) => {
        force[i] = Number((event.target as HTMLInputElement).value) || 0;
        setTipForce(app, index, force);
      },
    }),
  );
  for (const input of axes) input.style.width = "4.4em";
  const row: HTMLElement = element(
    "li",
    { pointerenter: () => app.light(placeAt(app.active.info!, tip.s)), pointerleave: () => app.light(-1) },
    element("strong", {}, name),
    ...axes,
    element(
      "button",
      {
        class: "small",
        "aria-label": `Remove ${name}`,
        title: `Remove ${name}`,
        click: () => removeTip(app, tip),
      },
      "✕",
    ),
  );
  return row;
}

/** `box`: absent without 3D; then there are the lists only. */
export function buildEdit(app: App, box: Toolbox | undefined): HTMLElement {
  const undo = element("button", { id: "undo", disabled: true, click: () => void undoLast(app) }, "Undo");
  app.undo.events.on("changed", () => {
    undo.disabled = app.undo.next === "";
    undo.title = app.undo.next ? `Take back: ${app.undo.next} (Ctrl-Z)` : "";
  });
  const tips = element("ul", { class: "list", id: "tip-list" });
  const place = element("input", {
    type: "range",
    id: "place",
    min: 0,
    max: 100,
    step: 0.5,
    value: 50,
    "aria-label": "Place along the margin, per cent from the petiole, clockwise",
    input: () => app.light(chosenPlace()),
  });
  const chosenPlace = () => {
    const { info } = app.active;
    return info ? placeAt(info, (Number(place.value) / 100) * info.margin.perimeter) : -1;
  };
  const around = element("select", { id: "around-tip", "aria-label": "Tip" });
  const clear = element(
    "button",
    { class: "small", id: "clear-region", click: () => app.set("water.dry_region", []) },
    "No region",
  );
  const factor = settingSlider(app, {
    key: "water.dry_factor",
    label: "It dries",
    unit: "× as fast",
    ends: ["not at all", "fast"],
    min: 0,
    max: 10,
    step: 0.1,
  });
  const usual = element(
    "button",
    { class: "small", id: "usual-forces", click: () => app.set("external.forces", []) },
    "Forces as usual",
  );
  const root = element(
    "div",
    {},
    box && toolButtons(box),
    element("div", { class: "row" }, undo),
    element("h2", {}, "Tips, and the force on each (right, to the apex, up)"),
    tips,
    element("div", { class: "row" }, usual),
    element("h2", {}, "A place on the margin"),
    place,
    element(
      "div",
      { class: "row" },
      element(
        "button",
        { class: "small", id: "add-tip", click: () => addTip(app, chosenPlace()) },
        "Add a tip there",
      ),
      element(
        "button",
        { class: "small", id: "move-petiole", click: () => void movePetiole(app, chosenPlace()) },
        "Petiole there",
      ),
    ),
    element("h2", {}, "A region that dries faster"),
    element(
      "div",
      { class: "row" },
      element("label", {}, "Around", around),
      element(
        "button",
        { class: "small", id: "dry-around", click: () => regionAroundTip(app, around.selectedIndex) },
        "Dry it",
      ),
      clear,
    ),
    factor.root,
  );
  let listed = "";
  const update = () => {
    const { info, settings } = app.active;
    factor.update();
    clear.disabled = regionOf(app).length === 0;
    const given = settings.get("external.forces");
    usual.hidden = given === undefined;
    usual.disabled = given !== undefined && (app.active.valueAt(given, 0) as number[]).length === 0;
    const now = `${info?.name}${info?.tips.map((tip) => tip.s)}${tipForces(app)}`;
    if (!info || now === listed) return;
    listed = now;
    tips.replaceChildren(...info.tips.map((_, i) => tipRow(app, i)));
    around.replaceChildren(...info.tips.map((_, i) => element("option", {}, `r${i + 1}`)));
  };
  for (const kind of ["leaf", "config", "active"] as const) app.events.on(kind, update);
  return root;
}

export async function undoLast(app: App): Promise<void> {
  try {
    const what = await app.undo.undo();
    app.messages.hint(what ? `Taken back: ${what}` : "There is nothing to take back");
  } catch (error) {
    app.messages.error((error as Error).message);
  }
}
