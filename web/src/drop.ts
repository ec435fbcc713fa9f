// A leaf of the user's own: dropped anywhere on the page, or chosen.
import type { App } from "./app";
import { emptyConfig } from "./config";
import { byId } from "./dom";

async function open(app: App, file: File, nth = 1): Promise<void> {
  const progress = app.messages.progress(`Reading ${file.name} ...`);
  try {
    const { readLeafFile } = await import("./import/read_leaf");
    const said = (share: number, what: string) =>
      progress.say(`${file.name}: ${what}, ${Math.round(100 * share)} %`);
    const { source, notes, leaves: inPhoto = 1 } = await readLeafFile(file, app.active.core, said, { nth });
    const edits = { added: [], removed: [] };
    const recipe = { source, file: { name: file.name, nth }, edits, config: emptyConfig() };
    if (!(await app.load(recipe, `opening ${file.name}`))) return;
    for (const note of notes) app.messages.tell(note);
    const inDrawing = /has (\d+) leaf-like shapes/.exec(app.active.info?.notes.join(" ") ?? "");
    const leaves = inDrawing ? Number(inDrawing[1]) : inPhoto;
    if (leaves > 1) {
      const next = (nth % leaves) + 1;
      app.messages.offer(
        `${file.name} shows ${leaves} leaves; this is number ${nth} by size.`,
        `Take number ${next}`,
        () => void open(app, file, next),
      );
    }
    app.playback.play();
  } catch (error) {
    app.messages.error((error as Error).message);
  } finally {
    progress.close();
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
