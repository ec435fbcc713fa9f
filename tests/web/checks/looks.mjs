// Colour maps, veins, the margin profile, plots, views, screenshots.
import { join } from "node:path";
import { coloursOf } from "./loading.mjs";

const LEAF = "leaf=ivy&seed=1&vertices=500&s.iterations=40&i=12";

export default {
  // Oracle: the range is that of the core's values over all frames so far; of dryness, fresh to dry.
  async everyFieldHasItsMapAndLegend({ studio, assert }) {
    await studio.leaf(LEAF);
    await studio.click("#tab-look");
    const fields = await studio.page.$$eval("#field option", (options) => options.map((option) => option.value).filter(Boolean));
    assert.equal(fields.length, 9);
    for (const field of fields) {
      await studio.page.selectOption("#field", field);
      const { range } = await studio.until((now, name) => now.field === name, field);
      const [min, max] = await studio.core((_, name, app) => {
        const all = app.active.frames.flatMap((frame) => Array.from(frame.fields[name]));
        return [all.reduce((a, b) => Math.min(a, b)), all.reduce((a, b) => Math.max(a, b))];
      }, field);
      if (field === "dryness") assert.deepEqual(range, { min: 0, max: 1 });
      else
        assert.ok(
          range.min >= min - 1e-9 && range.max <= max + 1e-9 && range.max - range.min >= 0.5 * (max - min),
          `${field}: ${JSON.stringify(range)}, values ${min} to ${max}`,
        );
      assert.match(await studio.page.textContent("#legend strong"), new RegExp(field.split("_")[0], "i"));
    }
    await studio.page.selectOption("#field", "dryness");
    const mapped = await coloursOf(studio.page, "#canvas");
    assert.ok(mapped > 20, `${mapped} colours`);
    await studio.page.selectOption("#field", "");
    assert.equal(await studio.page.isVisible("#legend"), false);
  },

  async veinsAndTipsAreShown({ studio, assert }) {
    await studio.page.check("#show-veins");
    await studio.page.check("#show-tips");
    const state = await studio.until((now) => now.veins && now.tips);
    assert.equal(await studio.page.locator("#overlay >> text=/^r\\d+$/").count(), state.leaf.tips);
    await studio.page.uncheck("#show-veins");
    await studio.page.uncheck("#show-tips");
  },

  // Oracle: peak to peak by Page Down are the tips that the core found.
  async theProfileLightsTheLeaf({ studio, assert }) {
    await studio.page.focus("#profile");
    const lit = [];
    const { leaf } = await studio.state();
    for (let k = 0; k < leaf.tips; ++k) {
      await studio.page.keyboard.press("PageDown");
      lit.push((await studio.state()).lit);
    }
    const tips = await studio.core((_, __, app) => {
      const { margin, tips: all } = app.active.info;
      return all.map((tip) =>
        margin.s.reduce((best, s, i) => (Math.abs(s - tip.s) < Math.abs(margin.s[best] - tip.s) ? i : best), 0),
      );
    });
    assert.deepEqual(
      [...lit].sort((a, b) => a - b),
      [...tips].sort((a, b) => a - b),
    );
    const box = await studio.page.locator("#profile").boundingBox();
    await studio.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    const { lit: middle } = await studio.until((now) => now.lit >= 0);
    const share = await studio.core((_, i, app) => app.active.info.margin.s[i] / app.active.info.margin.perimeter, middle);
    assert.ok(Math.abs(share - 0.5) < 0.03, `${share} of the perimeter`);
    await studio.page.mouse.move(2, 2);
  },

  async pointingAtTheMarginLightsTheProfile({ studio, assert }) {
    const tip = await studio.core((_, __, app) => {
      const point = new app.stage.camera.position.constructor();
      app.stage.models[0].point(app.active.info.tips[0].point, point);
      const at = app.stage.project(point);
      const box = app.stage.canvas.getBoundingClientRect();
      return { x: box.x + at.x, y: box.y + at.y, s: app.active.info.tips[0].s, perimeter: app.active.info.margin.perimeter };
    });
    await studio.page.mouse.move(tip.x, tip.y);
    const { lit } = await studio.until((now) => now.lit >= 0);
    const s = await studio.core((_, i, app) => app.active.info.margin.s[i], lit);
    assert.ok(Math.abs(s - tip.s) < 0.05 * tip.perimeter, `lit at ${s}, the tip is at ${tip.s}`);
    await studio.page.mouse.move(2, 2);
  },

  async plotsFollowTheRun({ studio, assert }) {
    await studio.click("#tab-plots");
    await studio.page.waitForSelector("#panel-plots canvas");
    assert.ok((await studio.page.locator("#panel-plots canvas").count()) >= 2);
    await studio.click("#tab-wither");
  },

  async viewsTurnTheCamera({ studio, assert }) {
    const views = new Set();
    await studio.page.focus("#canvas");
    for (const key of ["1", "2", "3"]) {
      await studio.page.keyboard.press(key);
      await studio.until((now, index) => now.view === index, Number(key) - 1);
      await studio.page.waitForTimeout(500);
      views.add(JSON.stringify((await studio.state()).camera));
    }
    assert.equal(views.size, 3);
    await studio.page.keyboard.press("1");
  },

  // For people to look at; what is asserted: nothing is wider than the window, and a leaf is drawn.
  async atThreeSizes({ studio, assert, screenshots }) {
    for (const [width, height] of [
      [1440, 900],
      [820, 1180],
      [390, 844],
    ]) {
      await studio.page.setViewportSize({ width, height });
      for (const iteration of [0, 40]) {
        await studio.page.fill("#scrub", String(iteration));
        await studio.until((now, i) => now.shown === i, iteration);
        await studio.page.waitForTimeout(300);
        await studio.page.screenshot({ path: join(screenshots, `${width}x${height}-${iteration === 0 ? "fresh" : "dry"}.png`) });
      }
      const wide = await studio.page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, `${wide} pixels wide in a window of ${width}`);
      assert.ok((await coloursOf(studio.page, "#canvas")) > 30, "a leaf is drawn");
    }
    await studio.page.setViewportSize({ width: 900, height: 640 });
  },
};
