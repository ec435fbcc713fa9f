// What all parts of the page share: the leaves, the clock, the stage, and what is looked at.
import type { FieldName, Frame } from "./core/protocol";
import { Emitter } from "./emitter";
import { type Range, fieldRange, united } from "./field_colours";
import type { Messages } from "./messages";
import { Playback } from "./playback";
import { type Recipe, Session } from "./session";
import type { SettingValue } from "./config";
import { Undo } from "./undo";
import type { Stage } from "./viewer/stage";

export interface Shown {
  field: FieldName | "";
  /** Fixed by the user; otherwise all values seen so far. */
  lockedRange: Range | undefined;
  veins: boolean;
  tips: boolean;
}

interface AppEvents {
  active: Session; // another leaf's controls
  sides: void; // one leaf or two
  shown: Shown; // another look
  leaf: Session; // it is another leaf
  config: Session;
  frames: Session;
  lit: number; // a place in the active leaf's margin profile, -1: none
  busy: string;
}

export class App {
  readonly events = new Emitter<AppEvents>();
  readonly sessions: Session[] = [];
  readonly playback = new Playback(() => this.sessions);
  readonly undo = new Undo();
  active: Session;
  shown: Shown = { field: "", lockedRange: undefined, veins: false, tips: false };
  range: Range = { min: 0, max: 1 };
  lit = -1;
  private ranges: { session: Session; frames: number; range: Range | undefined }[] = [];

  /** `stage`: absent where the browser cannot draw in 3D. */
  constructor(
    readonly stage: Stage | undefined,
    readonly messages: Messages,
    first: Session,
  ) {
    this.active = this.addSession(first);
    this.playback.events.on("moved", () => this.show());
  }

  addSession(session: Session): Session {
    const side = this.sessions.push(session) - 1;
    session.events.on("leaf", (info) => {
      this.stage?.setLeaf(side, info);
      this.forgetRange();
      this.events.emit("leaf", session);
      this.playback.scrub(0);
      this.reframe();
    });
    session.events.on("textures", (textures) => {
      const ready = this.stage?.setTextures(side, textures);
      void Promise.resolve(ready).then(() => this.show());
    });
    session.events.on("restarted", () => {
      this.forgetRange();
      if (this.playback.playing || this.playback.playhead >= session.iterations) {
        this.playback.scrub(0);
        this.playback.play();
      } else {
        this.playback.scrub(this.playback.playhead);
      }
    });
    session.events.on("frames", () => {
      this.events.emit("frames", session);
      this.show();
    });
    session.events.on("config", () => this.events.emit("config", session));
    session.events.on("failed", (error) => this.messages.error(error.message));
    session.events.on("busy", (what) => this.events.emit("busy", what));
    return session;
  }

  removeSession(): void {
    const session = this.sessions.pop();
    session?.close();
    if (session) this.undo.forget(session);
    this.stage?.setLeaf(this.sessions.length, undefined);
    this.choose(this.sessions[0]!);
    this.reframe();
    this.events.emit("sides", undefined);
  }

  choose(session: Session): void {
    this.active = session;
    this.events.emit("active", session);
  }

  /** Makes another leaf of the active one, which can be undone. */
  async load(recipe: Recipe, what: string): Promise<boolean> {
    const session = this.active;
    const before = session.info && session.recipe();
    const forget = before && this.undo.push(what, session, () => session.restore(before));
    try {
      await session.load(recipe);
    } catch (error) {
      forget?.();
      const said = (error as Error).message;
      const { file, source } = recipe;
      this.messages.error(file && !said.includes(source.name) ? `'${file.name}': ${said}` : said);
      this.events.emit("config", session);
      return false;
    }
    this.messages.forgetNotes();
    for (const note of session.info?.notes ?? []) {
      // What was asked for needs no saying, and there is no command line here.
      if (!/^petiole as given|--leaf N/.test(note))
        this.messages.tell(note.replace("give --petiole X,Y", "move it: Edit, Move the petiole"));
    }
    return true;
  }

  /** A setting of the active leaf, which can be undone. `undoable`: false while it is still being dragged. */
  set(key: string, value: SettingValue, undoable = true): void {
    const session = this.active;
    if (undoable) this.remember(key);
    session.set(key, value, this.playback.shown);
    const { playing, shown } = this.playback;
    const live = session.settings.get(key)?.duringRun && !(session.ended && shown >= session.head);
    if (live && !playing && shown > 0) {
      this.messages.hint(`From iteration ${shown} on. Press play to see it.`);
    }
  }

  /** The active leaf as it is can be gone back to. */
  remember(what: string): void {
    const session = this.active;
    const before = session.recipe();
    this.undo.push(what, session, () => session.restore(before));
  }

  look(change: Partial<Shown>): void {
    if (change.field !== undefined && change.field !== this.shown.field) this.forgetRange();
    Object.assign(this.shown, change);
    this.show();
    this.events.emit("shown", this.shown);
  }

  light(place: number): void {
    if (place === this.lit) return;
    this.lit = place;
    this.events.emit("lit", place);
    this.stage?.invalidate();
  }

  /** Draws the moment of the playhead. */
  show(): void {
    this.updateRange();
    this.sessions.forEach((session, side) => {
      const moment = session.around(this.playback.playhead);
      if (moment) this.stage?.show(side, moment, { ...this.shown, range: this.range });
    });
  }

  /** The active leaf's frame at the playhead. */
  frame(session = this.active): Frame | undefined {
    return session.around(this.playback.playhead + 1e-6)?.before;
  }

  private reframe(): void {
    this.show();
    if (this.stage?.isNamedView) this.stage.setView(this.stage.viewIndex);
  }

  private forgetRange(): void {
    this.ranges = [];
    if (!this.shown.lockedRange) return;
    this.shown.lockedRange = undefined;
    this.events.emit("shown", this.shown);
  }

  /** All values of the field that have been computed, in both leaves. */
  private updateRange(): void {
    const field = this.shown.field;
    if (!field) return;
    let all: Range | undefined;
    for (const session of this.sessions) {
      let seen = this.ranges.find((entry) => entry.session === session);
      if (!seen || seen.frames > session.frames.length) {
        this.ranges = this.ranges.filter((entry) => entry.session !== session);
        this.ranges.push((seen = { session, frames: 0, range: undefined }));
      }
      for (; seen.frames < session.frames.length; ++seen.frames) {
        seen.range = united(seen.range, fieldRange(session.frames[seen.frames]!, field));
      }
      if (seen.range) all = united(all, seen.range);
    }
    this.range = this.shown.lockedRange ?? all ?? this.range;
  }
}
