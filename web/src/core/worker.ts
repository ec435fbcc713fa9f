// The worker in which leaves wither: wilt's core behind the interface of protocol.ts.
import * as Comlink from "comlink";
import type { Core, FileKind, Frame, LeafInfo, LeafSource, Setting, Textures, VeinEdits } from "./protocol";
import type { Module, Result, Studio } from "./wasm";
import createModule from "wilt-core/wilt.mjs";
import wasmUrl from "wilt-core/wilt.wasm?url";

function value<T>(result: Result<T>): T {
  if (result.error !== undefined) throw new Error(result.error);
  return result.value as T;
}

/** Everything that can be moved instead of copied. */
function buffers(object: object): Transferable[] {
  return Object.values(object).flatMap((entry): Transferable[] => {
    if (ArrayBuffer.isView(entry)) return [entry.buffer as ArrayBuffer];
    return entry !== null && typeof entry === "object" ? buffers(entry) : [];
  });
}

function moved<T extends object>(object: T): T {
  return Comlink.transfer(object, buffers(object));
}

function frameOf(result: Result<Omit<Frame, "milliseconds">>, milliseconds: number): Frame {
  return moved({ ...value(result), milliseconds });
}

class WasmCore implements Core {
  private readonly module: Promise<Module> = createModule({ locateFile: () => wasmUrl });
  private readonly studio: Promise<Studio> = this.module.then((module) => new module.Studio());
  private loaded = false;

  async load(source: LeafSource, edits: VeinEdits, toml: string): Promise<LeafInfo> {
    const info = value((await this.studio).load(source, edits, toml));
    this.loaded = true;
    return moved(info);
  }

  async start(toml: string): Promise<Frame> {
    return frameOf((await this.ready()).start(toml), 0);
  }

  async frame(): Promise<Frame> {
    return frameOf((await this.ready()).frame(), 0);
  }

  async step(): Promise<Frame> {
    const studio = await this.ready();
    const before = performance.now();
    value(studio.step());
    return frameOf(studio.frame(), performance.now() - before);
  }

  async change(key: string, text: string): Promise<void> {
    value((await this.ready()).change(key, text));
  }

  async rewind(iteration: number): Promise<Frame> {
    return frameOf((await this.ready()).rewind(iteration), 0);
  }

  async settings(): Promise<Setting[]> {
    return JSON.parse(value((await this.ready()).settings())) as Setting[];
  }

  async toml(full: boolean): Promise<string> {
    return value((await this.ready()).toml(full));
  }

  async texture(size: number): Promise<Textures | undefined> {
    const maps = value((await this.ready()).texture(size));
    return maps && moved(maps);
  }

  async file(kind: FileKind): Promise<Uint8Array> {
    const bytes = value((await this.ready()).file(kind));
    return Comlink.transfer(bytes, [bytes.buffer as ArrayBuffer]);
  }

  async notch(margin: Float64Array): Promise<number> {
    return value((await this.studio).notch(margin));
  }

  async hasStalk(margin: Float64Array): Promise<boolean> {
    return value((await this.studio).hasStalk(margin));
  }

  async about(): Promise<string> {
    return `wilt ${(await this.module).version()}, WebAssembly with SIMD`;
  }

  private async ready(): Promise<Studio> {
    if (!this.loaded) throw new Error("no leaf has been loaded");
    return this.studio;
  }
}

Comlink.expose(new WasmCore());
