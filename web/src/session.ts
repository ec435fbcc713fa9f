// One leaf and its core: what was asked of it, the frames that it gave, and changes while it withers.
import * as Comlink from "comlink";
import type { Core, Frame, LeafInfo, LeafSource, Setting, Textures, VeinEdits } from "./core/protocol";
import {
  type RunConfig,
  type SettingValue,
  configToml,
  copyConfig,
  emptyConfig,
  settled,
  valueAt,
  valueText,
} from "./config";
import { Emitter } from "./emitter";

/** All that makes a run; what undo and links go back to. */
export interface Recipe {
  source: LeafSource;
  /** The file that the leaf is from, and which of its leaves, by size, from 1. */
  file?: { name: string; nth: number } | undefined;
  edits: VeinEdits;
  config: RunConfig;
}

interface SessionEvents {
  leaf: LeafInfo; // another leaf, or other veins
  textures: Textures | undefined;
  frames: void; // one more, or fewer
  restarted: void; // at rest again by a setting
  config: void;
  busy: string; // what keeps the core for long; "": nothing
  failed: Error;
}

const kFrameBytesAllowed = 600e6;
const kStopped =
  "The leaf changes faster than the equations can follow, so it stops here. What there is can be looked at; take back the " +
  "last change (Ctrl-Z), or move the sliders nearer to the usual. ";

export class Session {
  readonly core: Comlink.Remote<Core>;
  readonly events = new Emitter<SessionEvents>();
  source: LeafSource = { kind: "species", name: "maple", seed: 1, vertices: 0 };
  file: Recipe["file"];
  edits: VeinEdits = { added: [], removed: [] };
  config: RunConfig = emptyConfig();
  settings = new Map<string, Setting>();
  info: LeafInfo | undefined;
  textures: Textures | undefined;
  frames: Frame[] = []; // by iteration; the first is the leaf at rest
  busy = "";
  /** Texels a side of the blade's picture. */
  textureSize = 1024;

  private readonly worker = new Worker(new URL("./core/worker.ts", import.meta.url), { type: "module" });
  private queue: Promise<unknown> = Promise.resolve();
  private tickets = 0;
  private target = 0;
  private stepping = false;
  private readonly wanted = new Map<string, SettingValue>();
  private wantedAt = 0;
  private settling = false;

  constructor() {
    this.core = Comlink.wrap<Core>(this.worker);
    this.worker.addEventListener("error", (event) =>
      this.events.emit(
        "failed",
        new Error(`the core could not be loaded: ${event.message || "see the console"}`),
      ),
    );
  }

  /** The last iteration that was computed. */
  get head(): number {
    return this.frames.at(-1)?.iteration ?? 0;
  }

  get ended(): boolean {
    const last = this.frames.at(-1);
    return last !== undefined && (last.ended || last.stopped !== "");
  }

  get iterations(): number {
    return Number(this.setting("iterations", 100));
  }

  setting(key: string, otherwise: SettingValue = 0): SettingValue {
    return this.wanted.get(key) ?? this.config.base.get(key) ?? this.settings.get(key)?.usual ?? otherwise;
  }

  /** A setting after an iteration; what has been asked for and not yet been done counts. */
  valueAt(setting: Setting, iteration: number): SettingValue {
    return this.wanted.get(setting.key) ?? valueAt(this.config, setting, iteration);
  }

  recipe(): Recipe {
    return {
      source: this.source,
      file: this.file,
      edits: { added: [...this.edits.added], removed: [...this.edits.removed] },
      config: copyConfig(this.config),
    };
  }

  /** Makes another leaf; of several that are asked for at once the last. Rejects with wilt's message: the leaf stays. */
  load({ source, file, edits, config }: Recipe): Promise<void> {
    const ticket = ++this.tickets;
    return this.exclusive("Making the leaf", async () => {
      if (ticket !== this.tickets) return;
      const info = await this.core.load(source, edits, configToml(config));
      const [first, settings] = await Promise.all([this.core.frame(), this.core.settings()]);
      Object.assign(this, { source, file, edits, config, info, textures: undefined });
      this.settings = new Map(settings.map((setting) => [setting.key, setting]));
      this.begin([first]);
      this.events.emit("leaf", info);
      this.events.emit("config", undefined);
      if (ticket !== this.tickets || this.textureSize === 0) return;
      // The first picture needs no texture; the frames from here on have colours that go with it.
      this.textures = await this.core.texture(this.textureSize);
      if (this.textures) this.begin([await this.core.frame()]);
      this.events.emit("textures", this.textures);
    });
  }

  /** Starts again from the leaf at rest. */
  restart(config: RunConfig): Promise<void> {
    return this.exclusive("", () => this.startNow(config));
  }

  /** Starts again with the settings as they are after iteration `at`, without changes on the way. */
  reset(at: number): Promise<void> {
    return this.exclusive("", () => this.startNow(settled(this.config, at)));
  }

  /** Goes back to what was: a new leaf only where it must be. */
  restore(recipe: Recipe): Promise<void> {
    const same = recipe.source === this.source && JSON.stringify(recipe.edits) === JSON.stringify(this.edits);
    return same && !this.remakes(recipe.config) ? this.restart(recipe.config) : this.load(recipe);
  }

  /** Another value, live where it may be; `at`: the iteration that is shown. Quick calls are put together. */
  set(key: string, value: SettingValue, at: number): void {
    this.wanted.set(key, value);
    this.wantedAt = at;
    this.events.emit("config", undefined);
    if (this.settling) return;
    this.settling = true;
    void this.exclusive("", () => this.settle())
      .catch((error: Error) => this.events.emit("failed", error))
      .finally(() => {
        this.settling = false;
        if (this.wanted.size > 0) this.set(...[...this.wanted][0]!, this.wantedAt);
        this.events.emit("config", undefined);
      });
  }

  /** Steps until `iteration` has been computed, while others may have their turn. */
  async want(iteration: number): Promise<void> {
    this.target = Math.min(iteration, this.iterations);
    if (this.stepping || !this.info) return;
    this.stepping = true;
    try {
      while (this.head < this.target && !this.ended) await this.exclusive("", () => this.stepNow());
    } catch (error) {
      this.target = 0;
      this.events.emit("failed", error as Error);
    } finally {
      this.stepping = false;
    }
  }

  /** The frames before and after a time in iterations, and how far it is from the one to the other. */
  around(time: number): { before: Frame; after: Frame; mix: number } | undefined {
    const frames = this.frames;
    if (frames.length === 0) return undefined;
    let low = 0;
    let high = frames.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (frames[middle]!.iteration <= time) low = middle;
      else high = middle - 1;
    }
    const before = frames[low]!;
    const after = frames[Math.min(low + 1, frames.length - 1)]!;
    const span = after.iteration - before.iteration;
    return { before, after, mix: span > 0 ? Math.min(1, Math.max(0, (time - before.iteration) / span)) : 0 };
  }

  /** Runs a task when the core is free. */
  exclusive<T>(busy: string, task: () => Promise<T>): Promise<T> {
    const result = this.queue.then(async () => {
      if (busy) this.events.emit("busy", (this.busy = busy));
      try {
        return await task();
      } finally {
        if (busy) this.events.emit("busy", (this.busy = ""));
      }
    });
    this.queue = result.catch(() => undefined);
    return result;
  }

  close(): void {
    this.worker.terminate();
  }

  private begin(frames: Frame[]): void {
    this.frames = frames;
    this.events.emit("frames", undefined);
  }

  private async startNow(config: RunConfig): Promise<void> {
    const first = await this.core.start(configToml(config));
    this.config = config;
    this.begin([first]);
    this.events.emit("restarted", undefined);
    this.events.emit("config", undefined);
  }

  private async stepNow(): Promise<void> {
    if (this.head >= this.target || this.ended) return;
    const frame = await this.core.step();
    if (frame.iteration > this.head) this.frames.push(frame);
    else this.frames[this.frames.length - 1] = frame; // the run came to its end, or could not go on
    this.thinOut(frame);
    this.events.emit("frames", undefined);
    if (frame.stopped) this.events.emit("failed", new Error(kStopped + frame.stopped));
  }

  /** Keeps every other frame when memory would run short; what lies between is interpolated. */
  private thinOut(frame: Frame): void {
    const bytes = frame.positions.byteLength * 3 + 9 * (frame.fields.mass?.byteLength ?? 0);
    if (this.frames.length < 8 || this.frames.length * bytes < kFrameBytesAllowed) return;
    const last = this.frames.length - 1;
    this.frames = this.frames.filter((_, index) => index % 2 === 0 || index === last);
  }

  private remakes(config: RunConfig): boolean {
    const veins = ({ base }: RunConfig) =>
      JSON.stringify(
        [...base].filter(([key]) => key.startsWith("veins.")).map(([key, value]) => [key, value]),
      );
    return veins(config) !== veins(this.config);
  }

  private async settle(): Promise<void> {
    const entries = [...this.wanted];
    try {
      await this.apply(entries);
    } finally {
      for (const [key, value] of entries) if (this.wanted.get(key) === value) this.wanted.delete(key);
    }
  }

  private async apply(entries: [string, SettingValue][]): Promise<void> {
    const at = Math.min(this.wantedAt, this.head);
    const live =
      this.head > 0 &&
      !(this.ended && at >= this.head) &&
      entries.every(([key]) => this.settings.get(key)?.duringRun);
    if (!live) {
      const config = settled(this.config, at);
      for (const [key, value] of entries) config.base.set(key, value);
      if (this.remakes(config))
        void this.load({ ...this.recipe(), config }).catch((error: Error) =>
          this.events.emit("failed", error),
        );
      else await this.startNow(config);
      return;
    }
    if (at < this.head - 2) {
      const there = await this.core.rewind(at);
      this.config.changes = this.config.changes.filter((change) => change.iteration <= at);
      this.begin([...this.frames.filter((frame) => frame.iteration < at), there]);
    }
    for (const [key, value] of entries) {
      await this.core.change(key, valueText(value));
      this.config.changes = this.config.changes.filter(
        (change) => change.key !== key || change.iteration < this.head,
      );
      this.config.changes.push({ iteration: this.head, key, value });
    }
  }
}
