// A slider of one setting: follows the run, sends while it is dragged, goes back to the usual value with a double click.
import type { App } from "../app";
import { element, shortNumber } from "../dom";

export interface SliderSpec {
  key: string;
  label: string;
  unit: string;
  ends: [string, string];
  min: number;
  max: number;
  step: number;
  /** The printed equations (model "paper") have no such thing. */
  onlyCell?: boolean;
  /** From the setting's value to the slider's and back; absent: the same. */
  shown?: (value: number) => number;
  meant?: (shown: number) => number;
}

export function settingSlider(app: App, spec: SliderSpec): { root: HTMLElement; update: () => void } {
  const { shown = (v: number) => v, meant = (v: number) => v } = spec;
  const id = `set-${spec.key.replaceAll(".", "-")}`;
  const output = element("output", { for: id });
  let dragged = false;
  const input = element("input", {
    id,
    type: "range",
    min: spec.min,
    max: spec.max,
    step: spec.step,
    "data-key": spec.key,
    input: () => {
      app.set(spec.key, Number(meant(Number(input.value)).toPrecision(6)), !dragged);
      dragged = true;
      say(Number(input.value));
    },
    change: () => (dragged = false),
    dblclick: () => {
      const usual = app.active.settings.get(spec.key)?.usual;
      if (usual !== undefined) app.set(spec.key, usual);
    },
  });
  const say = (value: number) => {
    output.textContent = `${shortNumber(Number(value.toFixed(3)))}${spec.unit}`;
    input.setAttribute("aria-valuetext", output.textContent);
  };
  const update = () => {
    const setting = app.active.settings.get(spec.key);
    root.hidden = setting === undefined;
    if (!setting || dragged) return;
    input.max = String(Math.min(spec.max, shown(setting.max)));
    const value = shown(Number(app.active.valueAt(setting, app.playback.shown)));
    if (value > Number(input.max)) input.max = String(value);
    input.value = String(value);
    say(value);
    const model = app.active.settings.get("model");
    input.disabled = Boolean(spec.onlyCell && model && app.active.valueAt(model, 0) === "paper");
    if (input.disabled) output.textContent = "not in model paper";
  };
  const root = element(
    "div",
    { class: "slider" },
    element("label", { for: id }, spec.label),
    output,
    input,
    element(
      "div",
      { class: "ends", "aria-hidden": "true" },
      element("span", {}, spec.ends[0]),
      element("span", {}, spec.ends[1]),
    ),
  );
  return { root, update };
}
