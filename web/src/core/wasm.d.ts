// What web/core/bindings.cpp gives: the module wilt.mjs that em++ makes.
import type { Frame, LeafInfo, LeafSource, VeinEdits } from "./protocol";

/** `error`: why wilt refuses; nothing has changed then. */
export type Result<T> = { value: T; error?: undefined } | { value?: undefined; error: string };

export interface Studio {
  load(source: LeafSource, edits: VeinEdits, toml: string): Result<LeafInfo>;
  start(toml: string): Result<Omit<Frame, "milliseconds">>;
  frame(): Result<Omit<Frame, "milliseconds">>;
  step(): Result<number>;
  change(key: string, value: string): Result<void>;
  rewind(iteration: number): Result<Omit<Frame, "milliseconds">>;
  settings(): Result<string>;
  toml(full: boolean): Result<string>;
  texture(size: number): Result<{ colour: Uint8Array; normal: Uint8Array } | undefined>;
  file(kind: string): Result<Uint8Array>;
  notch(margin: Float64Array): Result<number>;
  hasStalk(margin: Float64Array): Result<boolean>;
}

export interface Module {
  Studio: new () => Studio;
  version(): string;
}

export default function createModule(options: { locateFile: (name: string) => string }): Promise<Module>;
