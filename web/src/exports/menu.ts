// The export menu: files about the run, pictures of it, and how to get the same at a terminal.
import type { App } from "../app";
import type { FileKind } from "../core/protocol";
import { byId, download, element } from "../dom";
import { commandLine } from "./command";

function fileName(app: App, extension: string): string {
  const name = app.active.source.name.replace(/\.[^.]*$/, "").replace(/[^\w-]+/g, "-") || "leaf";
  return `${name}.${extension}`;
}

/** All of the run, where it has not been computed to its end. */
async function finish(app: App): Promise<void> {
  const progress = app.messages.progress("Computing the rest of the run ...");
  try {
    for (const session of app.sessions) {
      while (!session.ended && session.head < session.iterations) {
        await session.want(session.iterations);
        await new Promise((resolve) => setTimeout(resolve, 50));
      }
    }
  } finally {
    progress.close();
  }
}

const kTypes: Record<FileKind, string> = {
  glb: "model/gltf-binary",
  "forces.csv": "text/csv",
  toml: "text/plain",
  "report.json": "application/json",
  "veins.json": "application/json",
};
const kNamesOf: Partial<Record<FileKind, string>> = { toml: "run.toml", "veins.json": "veins.json" };

async function exportFile(app: App, kind: FileKind): Promise<void> {
  if (kind === "glb" || kind === "forces.csv" || kind === "report.json") await finish(app);
  const progress = app.messages.progress(`Writing ${kind} ...`);
  try {
    const bytes = await app.active.exclusive("", () => app.active.core.file(kind));
    download(kNamesOf[kind] ?? fileName(app, kind), bytes as BlobPart, kTypes[kind]);
    if (kind === "toml" || kind === "glb") sayCommand(app);
  } finally {
    progress.close();
  }
}

function sayCommand(app: App): void {
  const recipe = app.active.recipe();
  const line = commandLine(recipe, "run.toml", fileName(app, "glb"));
  const edited = recipe.edits.added.length + recipe.edits.removed.length > 0;
  const dialog = element("dialog", { "aria-labelledby": "command-title", close: () => dialog.remove() });
  dialog.append(
    element("h2", { id: "command-title" }, "The same at a terminal"),
    element("pre", { id: "command" }, line),
    element(
      "p",
      { class: "hint" },
      `run.toml${edited ? " and veins.json are" : " is"} in this menu. Positions agree with the browser's to a small tolerance.`,
    ),
    element(
      "div",
      { class: "row" },
      element(
        "button",
        { click: () => void navigator.clipboard?.writeText(line).then(() => app.messages.hint("Copied")) },
        "Copy",
      ),
      element("button", { class: "primary", click: () => dialog.close() }, "Close"),
    ),
  );
  document.body.append(dialog);
  dialog.showModal();
}

async function exportPicture(app: App): Promise<void> {
  const { stage } = app;
  if (!stage) throw new Error("A picture needs WebGL, which this browser does not have");
  const canvas = document.createElement("canvas");
  stage.beginPictures(2 * stage.canvas.clientWidth, 2 * stage.canvas.clientHeight);
  stage.takePicture(canvas);
  stage.endPictures();
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
  if (blob) download(fileName(app, "png"), blob, "image/png");
}

async function exportFilm(app: App): Promise<void> {
  const { stage, playback } = app;
  if (!stage) throw new Error("A film needs WebGL, which this browser does not have");
  playback.pause();
  await finish(app);
  const { makeFilm } = await import("./video");
  const abort = new AbortController();
  const bar = element("progress", { max: 1, value: 0, "aria-label": "Film" });
  const box = element("dialog", { id: "film", "aria-labelledby": "film-title", cancel: () => abort.abort() });
  box.append(
    element("h2", { id: "film-title" }, "Making the film ..."),
    element("p", {}, bar),
    element("button", { id: "cancel-film", click: () => abort.abort() }, "Cancel"),
  );
  document.body.append(box);
  box.showModal();
  const shownBefore = playback.playhead;
  const aspect = stage.canvas.clientWidth / stage.canvas.clientHeight;
  const height = 2 * Math.round((Math.min(1080, 1920 / aspect) * stage.pixelShare) / 2);
  const width = 2 * Math.round((height * aspect) / 2);
  const rate = 30;
  const seconds = (Number(app.active.setting("clip.seconds", 4)) * playback.iterations) / 100;
  const pictures = Math.max(2, Math.round(seconds * rate) + 1);
  stage.beginPictures(width, height);
  try {
    const film = await makeFilm({
      width,
      height,
      pictures,
      rate,
      signal: abort.signal,
      progress: (done) => (bar.value = done / pictures),
      draw: (n, onto) => {
        playback.playhead = (n / (pictures - 1)) * playback.iterations;
        app.show();
        stage.takePicture(onto);
      },
    });
    download(fileName(app, film.extension), film.bytes, `video/${film.extension}`);
  } catch (error) {
    if (!abort.signal.aborted) throw error;
    app.messages.hint("No film was written");
  } finally {
    stage.endPictures();
    box.remove();
    playback.scrub(shownBefore);
  }
}

export function buildExports(app: App): void {
  const button = byId("export");
  const menu = byId("export-menu");
  const show = (open: boolean) => {
    menu.hidden = !open;
    button.setAttribute("aria-expanded", String(open));
    if (open) (menu.firstElementChild as HTMLElement).focus();
  };
  const item = (id: string, name: string, help: string, run: () => Promise<void>) =>
    element(
      "button",
      {
        role: "menuitem",
        id: `export-${id}`,
        tabindex: -1,
        click: () => {
          show(false);
          button.focus();
          run().catch((error: Error) => app.messages.error(error.message));
        },
      },
      name,
      element("small", {}, help),
    );
  menu.append(
    item(
      "glb",
      "Animated leaf (.glb)",
      "For Blender, three.js, game engines: all frames, texture, veins",
      () => exportFile(app, "glb"),
    ),
    item("png", "Picture (.png)", "What you see, at twice the size", () => exportPicture(app)),
    item("film", "Film (.mp4 or .webm)", "The whole run, from where you look", () => exportFilm(app)),
    item("toml", "Settings (.toml)", "The command line takes them back and gives the same leaf", () =>
      exportFile(app, "toml"),
    ),
    item("csv", "Forces (.csv)", "By kind and region, every iteration", () => exportFile(app, "forces.csv")),
    item("report", "Report (.json)", "Measures of every frame, settings", () =>
      exportFile(app, "report.json"),
    ),
    item("veins", "Veins (.json)", "Tips, veins and the margin profile; to be edited and given back", () =>
      exportFile(app, "veins.json"),
    ),
  );
  button.addEventListener("click", () => show(menu.hidden));
  document.addEventListener("pointerdown", (event) => {
    if (!menu.hidden && !menu.parentElement!.contains(event.target as Node)) show(false);
  });
  menu.addEventListener("keydown", (event) => {
    const items = [...menu.children] as HTMLElement[];
    const at = items.indexOf(document.activeElement as HTMLElement);
    const to: Record<string, number> = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1 };
    if (event.key === "Escape" || event.key === "Tab") {
      show(false);
      button.focus();
    }
    const next = to[event.key];
    if (next === undefined) return;
    items[(next + items.length) % items.length]!.focus();
    event.preventDefault();
    event.stopPropagation();
  });
}
