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
  handle.addEventListener("pointerdown", (event) => {
    from = event.clientY;
    handle.setPointerCapture(event.pointerId);
  });
  handle.addEventListener("pointerup", (event) => {
    if (Math.abs(event.clientY - from) > 20) open(event.clientY < from);
    else open(!main.classList.contains("sheet-open"));
  });
  handle.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    open(!main.classList.contains("sheet-open"));
  });
}
