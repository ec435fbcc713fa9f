// Every setting that wilt has, with unit, range and help, and a search.
import type { App } from "../app";
import { type SettingValue, parseValue, sameValue, valueText } from "../config";
import type { Setting } from "../core/protocol";
import { element, shortNumber } from "../dom";

// These have their own controls, or belong to files that the page does not write.
const kElsewhere = new Set(["species", "vertices", "seed", "frames"]);

function rangeText({ kind, min, max, unit, usual }: Setting): string {
  const range =
    (kind === "number" || kind === "whole") && min < max ? `${shortNumber(min)} to ${shortNumber(max)}` : "";
  return [range, unit && `[${unit}]`, `usually ${valueText(usual) || "none"}`].filter(Boolean).join(" · ");
}

function control(
  app: App,
  setting: Setting,
): { root: HTMLInputElement | HTMLSelectElement; show: (value: SettingValue) => void } {
  const attributes = { id: `all-${setting.key}`, "data-key": setting.key, "aria-label": setting.key };
  if (setting.kind === "word") {
    const select = element(
      "select",
      { ...attributes, change: () => app.set(setting.key, select.value) },
      ...setting.words.map((word) => element("option", {}, word)),
    );
    return { root: select, show: (value) => (select.value = String(value)) };
  }
  if (setting.kind === "flag") {
    const box = element("input", {
      ...attributes,
      type: "checkbox",
      change: () => app.set(setting.key, box.checked),
    });
    return { root: box, show: (value) => (box.checked = value === true) };
  }
  const list = setting.kind === "numbers";
  const input = element("input", {
    ...attributes,
    type: list ? "text" : "number",
    step: setting.kind === "whole" ? 1 : "any",
    change: () => {
      const value = parseValue(input.value, setting.kind);
      const numbers = Array.isArray(value) ? value : [Number(value)];
      const wrong =
        input.value.trim() === "" ? !list : numbers.some((n) => !(n >= setting.min && n <= setting.max));
      input.setAttribute("aria-invalid", String(wrong));
      if (wrong)
        app.messages.error(
          `${setting.key} takes ${shortNumber(setting.min)} to ${shortNumber(setting.max)}, not '${input.value}'`,
        );
      else app.set(setting.key, value);
    },
  });
  const show = (value: SettingValue) => {
    if (document.activeElement === input && input.getAttribute("aria-invalid") === "true") return;
    input.value = valueText(value);
  };
  return { root: input, show };
}

export function buildAllSettings(app: App): HTMLElement {
  const search = element("input", {
    type: "search",
    id: "search",
    placeholder: "Search: humidity, k_s, margin ...",
    "aria-label": "Search the settings",
    input: () => filter(),
  });
  search.style.width = "100%";
  const onlyChanged = element("input", { type: "checkbox", id: "only-changed", change: () => filter() });
  const found = element("p", { class: "hint", role: "status" });
  const list = element("div", {});
  let rows: { setting: Setting; row: HTMLElement; show: (value: SettingValue) => void; back: HTMLElement }[] =
    [];

  const filter = () => {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const { setting, row } of rows) {
      const text = `${setting.key} ${setting.help} ${setting.unit}`.toLowerCase();
      row.hidden =
        !words.every((word) => text.includes(word)) ||
        (onlyChanged.checked && !row.classList.contains("changed"));
      if (!row.hidden) ++count;
    }
    found.textContent =
      count === 0
        ? "No setting is called that"
        : `${count} of ${rows.length} settings. “live”: may change while the leaf withers; the others begin anew.`;
  };
  const build = () => {
    rows = [...app.active.settings.values()]
      .filter((setting) => !kElsewhere.has(setting.key))
      .map((setting) => {
        const { root, show } = control(app, setting);
        const back = element(
          "button",
          {
            class: "small",
            hidden: true,
            "aria-label": `${setting.key} as usual`,
            click: () => app.set(setting.key, setting.usual),
          },
          "usual",
        );
        const row = element(
          "div",
          { class: "setting" },
          element(
            "div",
            { class: "name" },
            element("code", {}, setting.key),
            setting.duringRun ? element("small", { class: "hint" }, "live") : undefined,
            back,
            root,
          ),
          element("p", { class: "hint" }, setting.help, element("br"), rangeText(setting)),
        );
        return { setting, row, show, back };
      });
    list.replaceChildren(...rows.map(({ row }) => row));
    update();
    filter();
  };
  const update = () => {
    for (const { setting, row, show, back } of rows) {
      const value = app.active.valueAt(setting, app.playback.shown);
      show(value);
      const changed = !sameValue(value, setting.usual);
      row.classList.toggle("changed", changed);
      back.hidden = !changed;
    }
  };
  app.events.on("leaf", build);
  app.events.on("active", build);
  app.events.on("config", update);
  return element(
    "div",
    {},
    search,
    element("label", { class: "row" }, onlyChanged, "Only what is not as usual"),
    found,
    list,
  );
}
