// Tabs of the panel, as the ARIA practices have them: arrows move, the panels stay in the document.
import { byId, element } from "../dom";

export interface Tab {
  id: string;
  name: string;
  panel: HTMLElement;
  shown?: () => void;
}

export function buildTabs(tabs: Tab[]): (id: string) => void {
  const buttons = tabs.map((tab) =>
    element(
      "button",
      { id: `tab-${tab.id}`, role: "tab", "aria-controls": `panel-${tab.id}`, click: () => choose(tab.id) },
      tab.name,
    ),
  );
  const choose = (id: string) => {
    tabs.forEach((tab, i) => {
      const chosen = tab.id === id;
      buttons[i]!.setAttribute("aria-selected", String(chosen));
      buttons[i]!.tabIndex = chosen ? 0 : -1;
      tab.panel.hidden = !chosen;
      if (chosen) tab.shown?.();
    });
  };
  tabs.forEach((tab, i) => {
    tab.panel.id = `panel-${tab.id}`;
    tab.panel.setAttribute("role", "tabpanel");
    tab.panel.setAttribute("aria-labelledby", `tab-${tab.id}`);
    buttons[i]!.addEventListener("keydown", (event) => {
      const to = { ArrowRight: i + 1, ArrowLeft: i - 1, Home: 0, End: tabs.length - 1 }[event.key];
      if (to === undefined) return;
      const next = (to + tabs.length) % tabs.length;
      choose(tabs[next]!.id);
      buttons[next]!.focus();
      event.preventDefault();
      event.stopPropagation();
    });
  });
  byId("tabs").append(...buttons);
  byId("tab-panels").append(...tabs.map((tab) => tab.panel));
  choose(tabs[0]!.id);
  return choose;
}
