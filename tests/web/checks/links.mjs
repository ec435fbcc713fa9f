// A link opens exactly what was seen.

import { withoutWebGl } from "../browser.mjs";

/** What a link promises to bring back. */
const promised = ({ leaf, source, edits, config, changes, shown, field, veins, tips }) => ({
  species: leaf.species,
  vertices: leaf.vertices,
  tipCount: leaf.tips,
  source: { name: source.name, seed: source.seed, vertices: source.vertices },
  edits: { added: edits.added.map((s) => s.toPrecision(4)), removed: edits.removed.map((s) => s.toPrecision(4)) },
  config,
  changes,
  shown,
  field,
  veins,
  tips,
});

const positions = (studio) => studio.core((_, __, app) => Array.from(app.frame().positions));

export default {
  // Oracle: the core's positions there, bit for bit.
  async bringsEverythingBack({ studio, browser, assert }) {
    await studio.leaf(
      "leaf=grape&seed=4&vertices=400&s.iterations=20&s.water.loss_rate=0.03&field=dryness&veins=1",
    );
    await studio.click("#tab-edit");
    await studio.click('#tip-list button[aria-label="Remove r1"]');
    await studio.until((now) => now.edits.removed.length === 1 && !now.busy);
    await studio.page.evaluate(() => globalThis.wiltStudio.app.playback.pause());
    await studio.page.fill("#scrub", "5");
    await studio.until((now) => now.shown === 5);
    await studio.click("#tab-wither");
    await studio.page.fill("#set-water-humidity", "20");
    await studio.until((now) => now.changes.length === 1);
    await studio.page.fill("#scrub", "7");
    await studio.until((now) => now.shown === 7);
    await studio.click("#share");
    const link = await studio.page.evaluate(() => location.hash.slice(1));
    const before = await studio.state();
    assert.deepEqual([before.changes.length, before.edits.removed.length], [1, 1]);
    const other = await browser.studio({ init: withoutWebGl });
    await other.open(link);
    const after = await other.until((now) => now.shown === 7 && !now.playing);
    assert.deepEqual(promised(after), promised(before));
    assert.deepEqual(await positions(other), await positions(studio));
    await other.page.context().close();
  },

  // Negative: a link that asks for what there is not says so, and the page works.
  async aWrongLinkIsSaid({ studio, assert }) {
    await studio.leaf("leaf=ivy&seed=1&vertices=400");
    for (const [hash, words] of [
      ["leaf=oak&seed=1", "'oak'"],
      ["leaf=ivy&vertices=400&s.water.humidity=7", "water.humidity"],
    ]) {
      await studio.page.evaluate((text) => (location.hash = text), hash);
      await studio.page.waitForSelector(`#messages .error:has-text("${words}")`);
      await studio.until((now) => now.leaf && !now.busy);
    }
  },

  // Two leaves, one clock: the settings of one leave the other alone.
  async twoLeavesSideBySide({ studio, assert }) {
    await studio.leaf("leaf=ivy&seed=1&vertices=400&s.iterations=20");
    await studio.click("#compare");
    await studio.until((now) => now.sides.length === 2 && now.sides[1].leaf && now.active === 1);
    await studio.page.fill("#set-water-humidity", "100");
    await studio.until((now) => now.sides[1].settings["water.humidity"] === 1);
    await studio.page.fill("#scrub", "10");
    await studio.until((now) => now.shown === 10 && now.sides.every((side) => side.head >= 10));
    const left = await studio.core((_, __, app) => app.sessions.map(({ frames }) => frames[0].waterLeft - frames[10].waterLeft));
    assert.ok(left[0] > 0.005 && left[1] < left[0] / 2, `${left}`);
    await studio.click("#compare");
    await studio.until((now) => now.sides.length === 1);
  },
};
