// What the pointer does on the leaf while a tool is chosen; one at a time, Escape leaves.
import type { App } from "../app";
import { Emitter } from "../emitter";
import type { Stage } from "../viewer/stage";

export interface Tool {
  id: string;
  name: string;
  hint: string;
  /** The pointer goes down on the stage, CSS pixels; true: the tool takes it, and the camera stays. */
  down(x: number, y: number): boolean;
  move(x: number, y: number): void;
  up(x: number, y: number): void;
  /** Chosen or left; leaving in the middle of something forgets it. */
  enter(): void;
  leave(): void;
}

export class Toolbox {
  readonly events = new Emitter<{ chosen: Tool | undefined }>();
  chosen: Tool | undefined;
  private held = false;
  private shownBefore = { tips: false, veins: false };

  constructor(
    readonly app: App,
    readonly stage: Stage,
    readonly tools: Tool[],
  ) {
    const canvas = stage.canvas;
    // Before the camera's own listeners, which are on the canvas.
    const box = canvas.parentElement!;
    box.addEventListener("pointerdown", (event) => this.onDown(event), { capture: true });
    canvas.addEventListener(
      "pointermove",
      (event) => this.held && this.chosen?.move(event.offsetX, event.offsetY),
    );
    canvas.addEventListener("pointerup", (event) => this.release(event));
    canvas.addEventListener("pointercancel", () => this.choose(undefined));
  }

  choose(tool: Tool | undefined): void {
    const { tips, veins } = this.app.shown;
    if (this.chosen) this.chosen.leave();
    else this.shownBefore = { tips, veins };
    this.app.look(this.shownBefore);
    this.held = false;
    this.stage.controls.enabled = true;
    this.chosen = tool;
    this.stage.canvas.parentElement!.classList.toggle("tool", tool !== undefined);
    if (tool) {
      this.app.playback.pause();
      tool.enter();
    }
    this.events.emit("chosen", tool);
    this.stage.invalidate();
  }

  private onDown(event: PointerEvent): void {
    if (event.target !== this.stage.canvas || !this.chosen || event.button !== 0) return;
    this.held = this.chosen.down(event.offsetX, event.offsetY);
    this.stage.controls.enabled = !this.held;
    if (this.held) this.stage.canvas.setPointerCapture(event.pointerId);
  }

  private release(event: PointerEvent): void {
    if (!this.held) return;
    this.held = false;
    this.stage.controls.enabled = true;
    this.chosen?.up(event.offsetX, event.offsetY);
  }
}
