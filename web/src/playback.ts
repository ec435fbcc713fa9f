// The clock: which moment is shown, and how far ahead the cores must be.
import { Emitter } from "./emitter";
import type { Session } from "./session";

export const SPEEDS = [0.25, 0.5, 1, 2, Infinity];
const kAhead = 2; // iterations: enough to interpolate, few enough that a slider answers at once
const kFurthestAhead = 25; // where few pictures are drawn a second, or at full speed

export class Playback {
  readonly events = new Emitter<{ playing: boolean; moved: number; ended: void }>();
  speed = 1;
  playing = false;
  /** In iterations, with fractions. */
  playhead = 0;

  constructor(private readonly sessions: () => readonly Session[]) {}

  get iterations(): number {
    return Math.max(1, ...this.sessions().map((session) => session.iterations));
  }

  /** What all leaves have reached. */
  get head(): number {
    return Math.min(
      ...this.sessions().map((session) => (session.ended ? Infinity : session.head)),
      this.furthest,
    );
  }

  /** The iteration that is shown, whole. */
  get shown(): number {
    return Math.floor(Math.min(this.playhead, this.head) + 1e-6);
  }

  get finished(): boolean {
    return this.sessions().every((session) => session.ended) && this.playhead >= this.furthest;
  }

  play(): void {
    if (this.finished) this.moveTo(0);
    this.setPlaying(true);
  }

  pause(): void {
    this.setPlaying(false);
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  /** One iteration on or back, from a whole one. */
  stepBy(iterations: number): void {
    this.pause();
    this.scrub(Math.round(this.playhead) + iterations);
  }

  /** Shows another moment; what has not been computed is computed first. */
  scrub(iteration: number): void {
    this.moveTo(Math.min(Math.max(0, iteration), this.iterations));
    this.askFor(this.playhead);
  }

  /** Moves the clock on by `seconds`. */
  tick(seconds: number): void {
    if (!this.playing) return;
    const clip = Number(this.sessions()[0]?.setting("clip.seconds", 4));
    const advance = (seconds * this.speed * 100) / clip;
    const next = Math.max(this.playhead, Math.min(this.playhead + advance, this.head));
    this.askFor(next + Math.min(kFurthestAhead, Math.max(kAhead, 2 * advance)));
    if (next !== this.playhead) this.moveTo(next);
    if (this.finished) {
      this.pause();
      this.events.emit("ended", undefined);
    }
  }

  private get furthest(): number {
    return Math.max(0, ...this.sessions().map((session) => session.head));
  }

  private askFor(iteration: number): void {
    for (const session of this.sessions()) void session.want(Math.ceil(iteration));
  }

  private moveTo(iteration: number): void {
    this.playhead = iteration;
    this.events.emit("moved", iteration);
  }

  private setPlaying(playing: boolean): void {
    if (this.playing === playing) return;
    this.playing = playing;
    this.events.emit("playing", playing);
  }
}
