// The settings of a run as the page keeps them: what differs from the species' defaults, and what changes on the way.
import type { Setting } from "./core/protocol";

export type SettingValue = Setting["value"];

export interface Change {
  /** The steps after it have the new value. */
  iteration: number;
  key: string;
  value: SettingValue;
}

export interface RunConfig {
  base: Map<string, SettingValue>;
  changes: Change[]; // by iteration
}

export function emptyConfig(): RunConfig {
  return { base: new Map(), changes: [] };
}

export function copyConfig(config: RunConfig): RunConfig {
  return { base: new Map(config.base), changes: config.changes.map((change) => ({ ...change })) };
}

/** A value as `--set` takes it. */
export function valueText(value: SettingValue): string {
  return Array.isArray(value) ? value.join(",") : String(value);
}

/** The value that `--set`'s text means for a setting of this kind. */
export function parseValue(text: string, kind: Setting["kind"]): SettingValue {
  if (kind === "flag") return text === "true";
  if (kind === "numbers") return text.trim() === "" ? [] : text.split(",").map(Number);
  return kind === "word" ? text : Number(text);
}

function literal(value: SettingValue): string {
  return typeof value === "string"
    ? JSON.stringify(value)
    : Array.isArray(value)
      ? `[${value.join(", ")}]`
      : String(value);
}

/** As a configuration file of wilt. */
export function configToml(config: RunConfig): string {
  const lines = [...config.base].map(([key, value]) => `${key} = ${literal(value)}`);
  for (const { iteration, key, value } of config.changes) {
    lines.push("[[change]]", `iteration = ${iteration}`, `${key} = ${literal(value)}`);
  }
  return lines.join("\n") + "\n";
}

/** What a setting is in the step after `iteration`; `usual`: where nothing is said. */
export function valueAt(config: RunConfig, setting: Setting, iteration: number): SettingValue {
  let value = config.base.get(setting.key) ?? setting.usual;
  for (const change of config.changes) {
    if (change.key === setting.key && change.iteration <= iteration) value = change.value;
  }
  return value;
}

/** The settings after `iteration` as those of a whole run without changes. */
export function settled(config: RunConfig, iteration: number): RunConfig {
  const base = new Map(config.base);
  for (const change of config.changes) if (change.iteration <= iteration) base.set(change.key, change.value);
  return { base, changes: [] };
}

export function sameValue(a: SettingValue, b: SettingValue): boolean {
  return valueText(a) === valueText(b);
}
