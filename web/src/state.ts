// What the page is doing, as plain data: for tests.
import type { App } from "./app";
import { configToml } from "./config";
import type { Session } from "./session";

function sessionState(session: Session) {
  const { info, source, edits, config, frames } = session;
  return {
    leaf: info && { name: info.name, species: info.species, vertices: info.vertices, length: info.length, tips: info.tips.length, notes: info.notes },
    source: { kind: source.kind, name: source.name, seed: source.seed, vertices: source.vertices, petiole: source.petiole },
    edits,
    config: configToml(config),
    changes: config.changes,
    settings: Object.fromEntries([...session.settings.keys()].map((key) => [key, session.setting(key)])),
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
    ...sessionState(app.active),
    sides: app.sessions.map(sessionState),
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
