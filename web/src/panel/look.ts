// The second tab: what is shown on the leaf, and the margin profile.
import type { App } from "../app";
import { FIELDS, type FieldName } from "../core/protocol";
import { byId, element, shortNumber } from "../dom";
import { SCALE_GRADIENT } from "../field_colours";
import { buildProfile } from "./profile";

const kNames: Record<FieldName, string> = {
  mass: "Mass",
  water: "Water",
  water_fraction: "Water in the tissue",
  dryness: "Dryness",
  pressure: "Pressure",
  elastic: "Elastic force",
  damping: "Damping force",
  swelling: "Swelling force",
  external: "External force",
};

function legend(app: App): void {
  const title = element("strong");
  const low = element("span");
  const high = element("span");
  const lock = element(
    "button",
    {
      id: "lock-range",
      class: "small",
      "aria-pressed": "false",
      title: "Keep these two numbers",
      click: () => app.look({ lockedRange: app.shown.lockedRange ? undefined : { ...app.range } }),
    },
    "Lock",
  );
  const scale = element("div", { class: "scale" });
  scale.style.background = SCALE_GRADIENT;
  const box = byId("legend");
  box.append(title, scale, element("div", { class: "ends" }, low, lock, high));
  const update = () => {
    const { field, lockedRange } = app.shown;
    box.hidden = !field;
    if (!field) return;
    title.textContent = FIELDS[field];
    low.textContent = shortNumber(app.range.min);
    high.textContent = shortNumber(app.range.max);
    lock.setAttribute("aria-pressed", String(lockedRange !== undefined));
  };
  app.events.on("shown", update);
  app.events.on("frames", update);
  app.events.on("leaf", update);
}

export function buildLook(app: App): HTMLElement {
  const field = element(
    "select",
    { id: "field", change: () => app.look({ field: field.value as FieldName | "" }) },
    element("option", { value: "" }, "Natural colours"),
    ...Object.keys(FIELDS).map((name) => element("option", { value: name }, kNames[name as FieldName])),
  );
  const veins = element("input", {
    type: "checkbox",
    id: "show-veins",
    change: () => app.look({ veins: veins.checked }),
  });
  const tips = element("input", {
    type: "checkbox",
    id: "show-tips",
    change: () => app.look({ tips: tips.checked }),
  });
  app.events.on("shown", (shown) => {
    field.value = shown.field;
    veins.checked = shown.veins;
    tips.checked = shown.tips;
  });
  legend(app);
  return element(
    "div",
    {},
    element("div", { class: "row" }, element("label", {}, "Colours", field)),
    element("label", { class: "row" }, veins, "Veins"),
    element("label", { class: "row" }, tips, "Feature points and petiole"),
    buildProfile(app),
  );
}
