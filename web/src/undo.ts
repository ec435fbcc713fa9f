// What can be taken back, the last first.
import { Emitter } from "./emitter";

export class Undo {
  readonly events = new Emitter<{ changed: void }>();
  private readonly steps: { what: string; back: () => Promise<void> }[] = [];

  /** What the next undo takes back; "": nothing. */
  get next(): string {
    return this.steps.at(-1)?.what ?? "";
  }

  push(what: string, back: () => Promise<void>): void {
    this.steps.push({ what, back });
    if (this.steps.length > 100) this.steps.shift();
    this.events.emit("changed", undefined);
  }

  /** What was taken back; "": nothing was left. */
  async undo(): Promise<string> {
    const step = this.steps.pop();
    this.events.emit("changed", undefined);
    await step?.back();
    return step?.what ?? "";
  }
}
