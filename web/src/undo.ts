// What can be taken back, the last first.
import { Emitter } from "./emitter";

export class Undo {
  readonly events = new Emitter<{ changed: void }>();
  private steps: { what: string; of: object; back: () => Promise<void> }[] = [];

  /** What the next undo takes back; "": nothing. */
  get next(): string {
    return this.steps.at(-1)?.what ?? "";
  }

  /** `of`: what is changed. Returns what forgets the step, when nothing came of it. */
  push(what: string, of: object, back: () => Promise<void>): () => void {
    const step = { what, of, back };
    this.steps.push(step);
    if (this.steps.length > 100) this.steps.shift();
    this.events.emit("changed", undefined);
    return () => {
      const at = this.steps.indexOf(step);
      if (at >= 0) this.steps.splice(at, 1);
      this.events.emit("changed", undefined);
    };
  }

  /** Something is no longer there. */
  forget(of: object): void {
    this.steps = this.steps.filter((step) => step.of !== of);
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
