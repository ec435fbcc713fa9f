// What the page is doing, as plain data: for tests.
import type { App } from "./app";
import { configToml } from "./config";
import type { Session } from "./session";

/** Settings as they are after iteration `at`. */
function sessionState(session: Session, at: number) {
  const { info, source, edits, config, frames } = session;
  return {
    leaf: info && {
      name: info.name,
      species: info.species,
      vertices: info.vertices,
      length: info.length,
      tips: info.tips.length,
      notes: info.notes,
    },
    source: {
      kind: source.kind,
      name: source.name,
      seed: source.seed,
      vertices: source.vertices,
      petiole: source.petiole,
    },
    edits,
    config: configToml(config),
    changes: config.changes,
    settings: Object.fromEntries(
      [...session.settings].map(([key, setting]) => [key, session.valueAt(setting, at)]),
    ),
    frames: frames.length,
    head: session.head,
    ended: session.ended,
    busy: session.busy,
    textured: session.textures !== undefined,
  };
}

export function appState(app: App) {
  const { playback, stage, shown } = app;
  return {
    ...sessionState(app.active, playback.shown),
    sides: app.sessions.map((session) => sessionState(session, playback.shown)),
    active: app.sessions.indexOf(app.active),
    playing: playback.playing,
    playhead: playback.playhead,
    shown: playback.shown,
    speed: playback.speed,
    field: shown.field,
    range: app.range,
    veins: shown.veins,
    tips: shown.tips,
    lit: app.lit,
    view: stage?.viewIndex,
    camera: stage?.cameraState,
    undo: app.undo.next,
  };
}
