// A leaf of the user's own: dropped anywhere on the page, or chosen.
import type { App } from "./app";
import { emptyConfig } from "./config";
import { byId } from "./dom";

async function open(app: App, file: File): Promise<void> {
  const done = app.messages.progress(`Reading ${file.name} ...`);
  try {
    const { readLeafFile } = await import("./import/read_leaf");
    const { source, notes, leaves } = await readLeafFile(file, app.active.core);
    const there = await app.load({ source, edits: { added: [], removed: [] }, config: emptyConfig() }, `opening ${file.name}`);
    if (!there) return;
    for (const note of notes) app.messages.tell(note);
    if (leaves && leaves > 1) app.messages.tell(`The picture shows ${leaves} leaves; this is the largest`);
    app.playback.play();
  } catch (error) {
    app.messages.error(`${file.name}: ${(error as Error).message}`);
  } finally {
    done();
  }
}

export function buildDrop(app: App): void {
  const input = byId<HTMLInputElement>("file");
  const hint = byId("drop-hint");
  void import("./import/read_leaf").then(({ LEAF_FILE_TYPES }) => (input.accept = LEAF_FILE_TYPES));
  byId("open").addEventListener("click", () => input.click());
  input.addEventListener("change", () => {
    if (input.files?.[0]) void open(app, input.files[0]);
    input.value = "";
  });
  let depth = 0; // of elements that the pointer has entered
  const show = (change: number) => {
    depth = Math.max(0, depth + change);
    hint.hidden = depth === 0;
  };
  addEventListener("dragenter", (event) => {
    event.preventDefault();
    show(1);
  });
  addEventListener("dragleave", () => show(-1));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    show(-depth);
    const file = event.dataTransfer?.files[0];
    if (file) void open(app, file);
    else app.messages.error("What was dropped is not a file");
  });
}
