// What the page says: errors stay until they are dismissed, hints go by themselves.
import { element } from "./dom";

export class Messages {
  private readonly hintBox = element("div", { class: "message", hidden: true }, element("p"));
  private hintTimer = 0;

  constructor(private readonly box: HTMLElement) {
    box.append(this.hintBox);
  }

  error(text: string): void {
    this.add(text, "error");
  }

  tell(text: string): void {
    this.add(text, "note");
  }

  hint(text: string): void {
    this.hintBox.firstElementChild!.textContent = text;
    this.hintBox.hidden = false;
    clearTimeout(this.hintTimer);
    this.hintTimer = window.setTimeout(() => (this.hintBox.hidden = true), 4000);
  }

  /** A message with what is being done, which can be said anew, until it is closed. */
  progress(text: string): { say: (text: string) => void; close: () => void } {
    const said = element("p", {}, text);
    const message = element("div", { class: "message" }, said);
    this.box.append(message);
    return { say: (next) => (said.textContent = next), close: () => message.remove() };
  }

  /** A choice beside a message. */
  offer(text: string, action: string, run: () => void): void {
    const button = element("button", { class: "small" }, action);
    const message = this.add(text, "note");
    message.insertBefore(button, message.lastElementChild);
    button.addEventListener("click", () => {
      message.remove();
      run();
    });
  }

  /** What was said about the last leaf. */
  forgetNotes(): void {
    for (const note of this.box.querySelectorAll(".note")) note.remove();
  }

  private add(text: string, kind: string): HTMLElement {
    for (const old of [...this.box.children])
      if (old.querySelector("p")?.textContent === text && old !== this.hintBox) old.remove();
    const message: HTMLElement = element(
      "div",
      { class: `message ${kind}`, role: kind === "error" ? "alert" : undefined },
      element("p", {}, text),
      element("button", { class: "small", "aria-label": "Dismiss", click: () => message.remove() }, "✕"),
    );
    this.box.append(message);
    while (this.box.children.length > 5) this.box.children[1]!.remove();
    return message;
  }
}
