// Dark or light: as the system has it until the user says otherwise.
import { byId } from "./dom";

const kKey = "wilt-theme";
const kMoon =
  '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M20 14.5A8.5 8.5 0 0 1 9.5 4 8.5 8.5 0 1 0 20 14.5z"/></svg>';
const kSun =
  '<svg viewBox="0 0 24 24" aria-hidden="true"><path d="M12 7a5 5 0 1 0 0 10 5 5 0 0 0 0-10zM11 1h2v4h-2zm0 18h2v4h-2zM1 11h4v2H1zm18 0h4v2h-4zM4 5.5 5.5 4l2.8 2.8-1.5 1.5zm11.7 11.7 1.5-1.5L20 18.5 18.5 20zM4 18.5l2.8-2.8 1.5 1.5L5.5 20zM15.7 6.8 18.5 4 20 5.5l-2.8 2.8z"/></svg>';

function stored(): string | null {
  try {
    return localStorage.getItem(kKey);
  } catch {
    return null; // storage is forbidden here
  }
}

/** `changed`: the colours are others now. */
export function buildTheme(changed: (dark: boolean) => void): void {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const button = byId("theme");
  const apply = (theme = stored() ?? (system.matches ? "dark" : "light")) => {
    document.documentElement.dataset.theme = theme;
    button.innerHTML = theme === "dark" ? kSun : kMoon;
    button.setAttribute("aria-label", theme === "dark" ? "Light colours" : "Dark colours");
    changed(theme === "dark");
  };
  button.addEventListener("click", () => {
    const next = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    try {
      localStorage.setItem(kKey, next);
    } catch {
      // it holds for this visit only
    }
    apply(next);
  });
  system.addEventListener("change", () => apply());
  apply();
}
