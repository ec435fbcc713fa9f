// On a phone: the handle that gives the controls more room, by pressing or dragging.
import { byId } from "./dom";

export function buildSheet(): void {
  const handle = byId("sheet");
  const main = document.querySelector("main")!;
  let from = 0;
  const open = (is: boolean) => {
    main.classList.toggle("sheet-open", is);
    handle.setAttribute("aria-expanded", String(is));
  };
  let dragged = false;
  handle.addEventListener("pointerdown", (event) => {
    from = event.clientY;
    handle.setPointerCapture(event.pointerId);
  });
  handle.addEventListener("pointerup", (event) => {
    dragged = Math.abs(event.clientY - from) > 20;
    if (dragged) open(event.clientY < from);
  });
  handle.addEventListener("click", () => {
    if (!dragged) open(!main.classList.contains("sheet-open"));
    dragged = false;
  });
}
