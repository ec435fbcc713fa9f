// Says now and then how the leaf is, for those who do not see it.
import type { App } from "./app";
import { byId } from "./dom";

const kEvery = 4000; // ms, while it plays
const kSettled = 700; // ms after the last movement

export function buildAnnouncements(app: App): void {
  let last = 0;
  let timer = 0;
  const say = () => {
    clearTimeout(timer);
    const frame = app.frame();
    if (!frame) return;
    if (!app.playback.playing && frame.iteration < Math.floor(app.playback.playhead) && !app.active.ended) {
      timer = window.setTimeout(say, kSettled); // it is still being computed
      return;
    }
    last = performance.now();
    byId("live").textContent =
      `Iteration ${frame.iteration} of ${app.playback.iterations}: ${Math.round(100 * frame.waterLeft)} per cent of the water left, ` +
      `curl ${Math.round(frame.curl)} degrees, wrinkle ${(100 * frame.wrinkle).toFixed(1)} per cent of the length`;
  };
  app.playback.events.on("moved", () => {
    clearTimeout(timer);
    if (performance.now() - last > kEvery) say();
    else timer = window.setTimeout(say, kSettled);
  });
  app.playback.events.on("playing", say);
  app.events.on("leaf", (session) => {
    byId("canvas").setAttribute(
      "aria-label",
      `A ${session.info!.species} leaf in 3D, ${(100 * session.info!.length).toFixed(1)} centimetres long, ${session.info!.tips.length} tips`,
    );
  });
}
