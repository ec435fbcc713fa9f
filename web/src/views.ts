// Buttons over the stage: where to look from.
import { byId, element } from "./dom";
import type { Stage } from "./viewer/stage";
import { VIEWS } from "./viewer/framing";

export function buildViews(stage: Stage): void {
  const select = element(
    "select",
    { id: "view", "aria-label": "View", change: () => stage.setView(Number(select.value)) },
    ...VIEWS.map(({ name }, i) => element("option", { value: i }, `${i + 1}  ${name}`)),
  );
  const fit = element(
    "button",
    { id: "fit", class: "small", title: "Show all of the leaf (F)", click: () => stage.fit() },
    "Fit",
  );
  byId("views").append(select, fit);
  stage.events.on("viewed", () => (select.value = String(stage.viewIndex)));
}
