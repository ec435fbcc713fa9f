// All of what is seen as an address: leaf, settings, changes on the way, edits, moment, view.
import { emptyConfig, parseValue, valueText } from "./config";
import type { App } from "./app";
import { FIELDS, type FieldName } from "./core/protocol";
import { byId } from "./dom";
import type { Recipe } from "./session";
import { SPECIES } from "./species";
import { VIEWS } from "./viewer/framing";

function numbers(text: string | null): number[] {
  return (text ?? "").split(",").filter(Boolean).map(Number).filter(Number.isFinite);
}

/** The kind of a value by its look; wilt itself says when it does not fit. */
function value(text: string): ReturnType<typeof parseValue> {
  if (text === "true" || text === "false") return text === "true";
  if (text === "" || text.includes(",")) return parseValue(text, "numbers");
  return Number.isFinite(Number(text)) ? Number(text) : text;
}

function writeRecipe({ source, edits, config }: Recipe): URLSearchParams {
  const out = new URLSearchParams();
  if (source.kind === "species") out.set("leaf", source.name);
  out.set("seed", String(source.seed));
  if (source.vertices > 0) out.set("vertices", String(source.vertices));
  if (source.petiole) out.set("petiole", source.petiole.map((v) => Number(v.toFixed(3))).join(","));
  if (edits.added.length > 0) out.set("added", edits.added.map((s) => s.toPrecision(6)).join(","));
  if (edits.removed.length > 0) out.set("removed", edits.removed.map((s) => s.toPrecision(6)).join(","));
  for (const [key, set] of config.base) out.set(`s.${key}`, valueText(set));
  for (const change of config.changes)
    out.append(`c.${change.iteration}.${change.key}`, valueText(change.value));
  return out;
}

function readRecipe(from: URLSearchParams): Recipe {
  const name = from.get("leaf") ?? "maple";
  if (!SPECIES.some((species) => species.name === name)) {
    throw new Error(
      `The link asks for '${name}'; there are ${SPECIES.map((species) => species.name).join(", ")}`,
    );
  }
  const config = emptyConfig();
  for (const [key, text] of from) {
    const change = /^c\.(\d+)\.(.+)$/.exec(key);
    if (key.startsWith("s.")) config.base.set(key.slice(2), value(text));
    else if (change)
      config.changes.push({ iteration: Number(change[1]), key: change[2]!, value: value(text) });
  }
  config.changes.sort((a, b) => a.iteration - b.iteration);
  const petiole = numbers(from.get("petiole"));
  return {
    source: {
      kind: "species",
      name,
      seed: Number(from.get("seed") ?? 1),
      vertices: Number(from.get("vertices") ?? 0),
      ...(petiole.length === 2 ? { petiole: petiole as [number, number] } : {}),
    },
    edits: { added: numbers(from.get("added")), removed: numbers(from.get("removed")) },
    config,
  };
}

export function linkOf(app: App): string {
  const out = writeRecipe(app.sessions[0]!.recipe());
  if (app.sessions[1]) out.set("beside", writeRecipe(app.sessions[1].recipe()).toString());
  out.set("i", String(app.playback.shown));
  if (app.shown.field) out.set("field", app.shown.field);
  if (app.shown.veins) out.set("veins", "1");
  if (app.shown.tips) out.set("tips", "1");
  if (app.stage?.isNamedView) out.set("view", String(app.stage.viewIndex + 1));
  else if (app.stage) out.set("camera", app.stage.cameraState.map((v) => Number(v.toFixed(3))).join(","));
  return `${location.href.split("#")[0]}#${out}`;
}

export interface Linked {
  recipe: Recipe;
  beside: Recipe | undefined;
  iteration: number;
  /** To be called when the leaf is there. */
  look: (app: App) => void;
}

/** What the page's address asks for; undefined: nothing. Throws with what is wrong with it. */
export function linked(): Linked | undefined {
  const from = new URLSearchParams(location.hash.slice(1));
  if (![...from.keys()].some((key) => key === "leaf" || key === "seed")) return undefined;
  const beside = from.get("beside");
  const camera = numbers(from.get("camera"));
  const field = from.get("field") ?? "";
  return {
    recipe: readRecipe(from),
    beside: beside ? readRecipe(new URLSearchParams(beside)) : undefined,
    iteration: Math.max(0, Number(from.get("i") ?? 0) || 0),
    look: (app) => {
      app.look({
        field: field in FIELDS ? (field as FieldName) : "",
        veins: from.has("veins"),
        tips: from.has("tips"),
      });
      if (camera.length === 6 && app.stage) app.stage.cameraState = camera;
      else app.stage?.setView(Math.min(VIEWS.length, Math.max(1, Number(from.get("view") ?? 1) || 1)) - 1);
    },
  };
}

export function buildShare(app: App): void {
  byId("share").addEventListener("click", () => {
    const link = linkOf(app);
    history.replaceState(null, "", link);
    const said = app.sessions.some((session) => session.source.kind !== "species")
      ? "The link has the settings and the view. Your file is not in it: whoever opens it sees a maple until the file is dropped there."
      : "The link is copied; it opens exactly this.";
    navigator.clipboard
      ?.writeText(link)
      .then(() => app.messages.hint(said))
      .catch(() => app.messages.tell(`${said} Copy it from the address bar.`));
    if (!navigator.clipboard) app.messages.tell(`${said} Copy it from the address bar.`);
  });
}
