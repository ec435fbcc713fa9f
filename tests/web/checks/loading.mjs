// A stranger opens the page.

/** How many colours, of 4096, a part of the page shows: 1 when nothing is drawn. */
export async function coloursOf(page, selector) {
  const png = (await page.locator(selector).screenshot()).toString("base64");
  return page.evaluate(async (text) => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${text}`)).blob());
    const pen = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    pen.drawImage(bitmap, 0, 0);
    const { data } = pen.getImageData(0, 0, bitmap.width, bitmap.height);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) seen.add(((data[i] >> 4) << 8) | ((data[i + 1] >> 4) << 4) | (data[i + 2] >> 4));
    return seen.size;
  }, png);
}

export default {
  // Oracle: it withers by itself: the core's frames grow and the leaf moves.
  async aLeafWithersByItself({ studio, assert }) {
    const before = performance.now();
    await studio.page.goto(studio.address);
    await studio.until((state) => state.leaf);
    console.log(`  first leaf after ${(performance.now() - before).toFixed(0)} ms`);
    const state = await studio.until((now) => now.playing && now.frames > 4 && now.textured);
    assert.equal(state.leaf.species, "maple");
    assert.ok(Math.abs(state.leaf.vertices - 2000) < 100, `${state.leaf.vertices} vertices`);
    assert.equal(await studio.page.title(), "wilt studio");
    assert.ok((await coloursOf(studio.page, "#canvas")) > 40, "a leaf is drawn");
    const moved = await studio.core((core, _, app) => {
      const [first, last] = [app.active.frames[0], app.active.frames.at(-1)];
      return (
        first.positions.reduce((most, value, i) => Math.max(most, Math.abs(value - last.positions[i])), 0) /
        app.active.info.length
      );
    });
    assert.ok(moved > 1e-3, `moved by ${moved} lengths`);
  },

  // Reported, never judged: other machines, other times.
  async theTimeOfAFrame({ studio, assert }) {
    await studio.click("#play");
    const times = await studio.core(async (core) => {
      const list = [];
      for (let k = 0; k < 20; ++k) list.push((await core.step()).milliseconds);
      return list.sort((a, b) => a - b);
    });
    console.log(
      `  2,000 vertices in the worker: median ${times[10].toFixed(1)} ms, longest ${times[19].toFixed(1)} ms an iteration`,
    );
    assert.equal(times.length, 20);
  },
};
