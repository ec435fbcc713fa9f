// The first tab: which leaf, and the few sliders that everybody understands.
import type { App } from "../app";
import { emptyConfig, settled } from "../config";
import type { LeafSource } from "../core/protocol";
import { element } from "../dom";
import { SPECIES } from "../species";
import { type SliderSpec, settingSlider } from "./slider";

const kSliders: SliderSpec[] = [
  {
    key: "water.loss_rate",
    label: "Water loss",
    unit: "× usual",
    ends: ["slow", "fast"],
    min: 0,
    max: 4,
    step: 0.05,
  },
  {
    key: "water.temperature_c",
    onlyCell: true,
    label: "Temperature",
    unit: " °C",
    ends: ["cold", "hot"],
    min: 0,
    max: 45,
    step: 1,
  },
  {
    key: "water.humidity",
    onlyCell: true,
    label: "Humidity of the air",
    unit: " %",
    ends: ["dry", "damp"],
    min: 0,
    max: 100,
    step: 1,
    shown: (value) => 100 * value,
    meant: (percent) => percent / 100,
  },
  {
    key: "curvature.roll",
    onlyCell: true,
    label: "Curl",
    unit: "× usual",
    ends: ["flat", "rolled up"],
    min: 0,
    max: 3,
    step: 0.05,
  },
  {
    key: "shrinkage.amount",
    onlyCell: true,
    label: "Wrinkles",
    unit: "× usual",
    ends: ["smooth", "crumpled"],
    min: 0,
    max: 2.5,
    step: 0.05,
  },
];

/** Sliders "times the usual": of the species' own value. */
function relative(app: App, spec: SliderSpec): SliderSpec {
  if (!spec.unit.startsWith("×")) return spec;
  const usual = () => Number(app.active.settings.get(spec.key)?.usual) || 1;
  return { ...spec, shown: (value) => value / usual(), meant: (shown) => shown * usual() };
}

function speciesPicker(app: App): { root: HTMLElement; update: () => void } {
  const inputs = SPECIES.map(({ name }) =>
    element("input", {
      type: "radio",
      name: "species",
      value: name,
      change: () =>
        void load(app, {
          kind: "species",
          name,
          seed: app.active.source.seed,
          vertices: app.active.source.vertices,
        }),
    }),
  );
  const root = element(
    "fieldset",
    { class: "species", id: "species" },
    element("legend", { class: "unseen" }, "Species"),
    ...SPECIES.map(({ name, botanical, outline }, i) => {
      const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      svg.setAttribute("viewBox", "0 0 48 48");
      svg.setAttribute("aria-hidden", "true");
      svg.innerHTML = `<path d="${outline}"/>`;
      const label = element("label", {}, inputs[i], name, element("i", { lang: "la" }, botanical));
      label.insertBefore(svg, label.childNodes[1]!);
      return label;
    }),
  );
  const update = () => {
    const { source } = app.active;
    for (const input of inputs) input.checked = source.kind === "species" && source.name === input.value;
  };
  return { root, update };
}

/** Another leaf with the settings as they are; those of another species are not carried on. */
async function load(app: App, source: LeafSource): Promise<void> {
  const same = source.name === app.active.source.name;
  const config = same ? settled(app.active.config, app.active.head) : emptyConfig();
  const edits =
    same && source.seed === app.active.source.seed ? app.active.edits : { added: [], removed: [] };
  if (
    await app.load(
      { source, file: source.kind === "species" ? undefined : app.active.file, edits, config },
      "another leaf",
    )
  )
    app.playback.play();
}

export function buildWither(app: App): HTMLElement {
  const picker = speciesPicker(app);
  const sliders = kSliders.map((spec) => settingSlider(app, relative(app, spec)));
  const seed = element("input", {
    id: "seed",
    type: "number",
    min: 0,
    step: 1,
    value: 1,
    change: () => void load(app, { ...app.active.source, seed: Math.max(0, Math.round(Number(seed.value))) }),
  });
  seed.style.width = "6.5em";
  const another = element(
    "button",
    {
      id: "another",
      click: () => void load(app, { ...app.active.source, seed: app.active.source.seed + 1 }),
    },
    "Another leaf",
  );
  const vertices = element(
    "select",
    {
      id: "vertices",
      change: () => void load(app, { ...app.active.source, vertices: Number(vertices.value) }),
    },
    ...[0, 500, 1000, 2000, 5000, 10000, 20000, 50000].map((n) =>
      element("option", { value: n }, n === 0 ? "usual" : n.toLocaleString("en")),
    ),
  );
  const models = ["cell", "paper"].map((model) =>
    element("input", { type: "radio", name: "model", value: model, change: () => app.set("model", model) }),
  );
  const model = element(
    "div",
    { class: "switch", id: "model", role: "radiogroup", "aria-label": "Model" },
    ...models.map((input) => element("label", {}, input, input.value)),
  );
  const root = element(
    "div",
    {},
    picker.root,
    ...sliders.map((slider) => slider.root),
    element("div", { class: "row" }, another, element("label", {}, "Seed", seed)),
    element(
      "div",
      { class: "row" },
      element("span", { title: "cell: full mechanics. paper: the equations as printed." }, "Model"),
      model,
      element("label", {}, "Vertices", vertices),
    ),
  );
  const update = () => {
    const { source, settings } = app.active;
    picker.update();
    for (const slider of sliders) slider.update();
    seed.value = String(source.seed);
    if (![...vertices.options].some((option) => Number(option.value) === source.vertices)) {
      vertices.append(element("option", { value: source.vertices }, source.vertices.toLocaleString("en")));
    }
    vertices.value = String(source.vertices);
    const setting = settings.get("model");
    for (const input of models)
      input.checked = setting !== undefined && app.active.valueAt(setting, 0) === input.value;
  };
  for (const kind of ["leaf", "config", "active"] as const) app.events.on(kind, update);
  app.playback.events.on("moved", () => {
    if (app.active.config.changes.length > 0) for (const slider of sliders) slider.update();
  });
  return root;
}
