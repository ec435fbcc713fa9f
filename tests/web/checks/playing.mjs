// Play, pause, step, scrub, start again; asserted on the core's frames.
const LEAF = "leaf=ivy&seed=1&vertices=400&s.iterations=30";

export default {
  async playRunsToTheEnd({ studio, assert }) {
    await studio.leaf(LEAF);
    await studio.page.selectOption("#speed", "Infinity");
    await studio.click("#play");
    const state = await studio.until((now) => now.ended && !now.playing);
    assert.equal(state.head, 30);
    assert.equal(state.frames, 31);
    assert.equal(state.shown, 30);
    assert.equal((await studio.core((core) => core.frame())).iteration, 30);
    await studio.page.selectOption("#speed", "1");
  },

  // Oracle: frames that were seen are kept, so going back computes nothing and coming forward gives the same.
  async scrubbingLooksUp({ studio, assert }) {
    await studio.page.fill("#scrub", "12");
    const state = await studio.until((now) => now.shown === 12);
    assert.equal(state.playing, false);
    assert.equal(state.frames, 31);
    await studio.click("#step");
    await studio.until((now) => now.shown === 13);
    await studio.click("#step-back");
    await studio.until((now) => now.shown === 12);
  },

  async aRunRepeatsItself({ studio, assert }) {
    await studio.leaf(`${LEAF}&i=8`);
    const last = () => studio.core((_, __, app) => Array.from(app.active.frames[8].positions));
    const before = await last();
    await studio.core((_, __, app) => app.active.frames.forEach((frame) => (frame.old = true)));
    await studio.click("#reset");
    await studio.until((now) => now.shown === 0 && !globalThis.wiltStudio.app.active.frames[0].old);
    for (let k = 0; k < 8; ++k) await studio.click("#step");
    await studio.until((now) => now.shown === 8);
    assert.deepEqual(await last(), before);
  },

  async pauseHolds({ studio, assert }) {
    await studio.click("#play");
    await studio.until((now) => now.playing && now.playhead > 9);
    await studio.click("#play");
    const { playhead } = await studio.until((now) => !now.playing);
    await studio.page.waitForTimeout(300);
    assert.equal((await studio.state()).playhead, playhead);
  },

  async theSpeedIsTheClocks({ studio, assert }) {
    await studio.page.selectOption("#speed", "0.25");
    assert.equal((await studio.state()).speed, 0.25);
    await studio.page.selectOption("#speed", "1");
  },
};
