// For everybody: axe-core's rules, the keyboard alone, reduced motion, what is said to those who do not see.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { withoutWebGl } from "../browser.mjs";

const LEAF = "leaf=ivy&seed=1&vertices=400&s.iterations=30";

/** Serious and critical faults of what is shown. */
async function faults(studio, nodeFolder) {
  await studio.page.evaluate(readFileSync(join(nodeFolder, "node_modules/axe-core/axe.min.js"), "utf8"));
  const { violations } = await studio.page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
  return violations
    .filter(({ impact }) => ["serious", "critical"].includes(impact))
    .map(
      ({ id, nodes }) =>
        `${id}: ${nodes.slice(0, 3).map(({ html, failureSummary }) => `${html.slice(0, 120)} (${failureSummary.slice(0, 200)})`)}`,
    );
}

export default {
  async axeFindsNothingSerious({ studio, assert, nodeFolder }) {
    await studio.leaf(LEAF);
    for (const theme of ["light", "dark"]) {
      await studio.page.emulateMedia({ colorScheme: theme });
      for (const tab of ["wither", "look", "edit", "plots", "all"]) {
        await studio.click(`#tab-${tab}`);
        assert.deepEqual(await faults(studio, nodeFolder), [], `${theme}, ${tab}`);
      }
      await studio.click("#help");
      assert.deepEqual(await faults(studio, nodeFolder), [], `${theme}, help`);
      await studio.page.keyboard.press("Escape");
      await studio.click("#export");
      assert.deepEqual(await faults(studio, nodeFolder), [], `${theme}, export menu`);
      await studio.page.keyboard.press("Escape");
    }
    await studio.page.emulateMedia({ colorScheme: "light" });
    await studio.click("#tab-wither");
  },

  // Everything that a first visit needs, without a pointer.
  async theKeyboardAlone({ studio, assert }) {
    await studio.leaf(LEAF);
    const { keyboard } = studio.page;
    const focused = () =>
      studio.page.evaluate(() => document.activeElement?.id || document.activeElement?.name || document.activeElement?.className);
    await studio.page.evaluate(() => (document.activeElement instanceof HTMLElement ? document.activeElement.blur() : undefined));
    const order = [];
    for (let k = 0; k < 40; ++k) {
      await keyboard.press("Tab");
      order.push(await focused());
    }
    for (const id of [
      "open",
      "compare",
      "export",
      "share",
      "theme",
      "help",
      "canvas",
      "play",
      "step",
      "reset",
      "scrub",
      "speed",
      "tab-wither",
      "species",
      "set-water-humidity",
      "another",
      "model",
      "vertices",
    ])
      assert.ok(order.includes(id), `Tab reaches ${id}: ${order.join(" ")}`);
    await studio.page.focus("#canvas");
    await keyboard.press(" ");
    await studio.until((now) => now.playing);
    await keyboard.press(" ");
    await studio.until((now) => !now.playing);
    await keyboard.press("End");
    await studio.until((now) => now.shown === 30);
    await keyboard.press("Home");
    await studio.until((now) => now.shown === 0);
    await keyboard.press("ArrowRight");
    await studio.until((now) => now.shown === 1);
    await keyboard.press("Shift+ArrowRight");
    await studio.until((now) => now.shown === 11);
    await studio.page.focus("#set-water-humidity");
    const before = (await studio.state()).settings["water.humidity"];
    await keyboard.press("ArrowRight");
    await studio.until((now, old) => now.settings["water.humidity"] > old, before);
    await studio.page.focus("#tab-wither");
    await keyboard.press("ArrowRight");
    assert.equal(await focused(), "tab-look");
    await studio.page.focus("#canvas");
    await keyboard.press("?");
    assert.ok(await studio.page.isVisible("#help-dialog"));
    await keyboard.press("Escape");
    await studio.page.focus("#export");
    await keyboard.press("Enter");
    assert.equal(await focused(), "export-glb");
    await keyboard.press("ArrowDown");
    assert.equal(await focused(), "export-png");
    await keyboard.press("Escape");
    assert.equal(await focused(), "export");
  },

  async itSaysHowTheLeafIs({ studio, assert }) {
    await studio.leaf(`${LEAF}&i=20`);
    await studio.click("#step-back");
    await studio.page.waitForFunction(() =>
      /Iteration 19 of 30: \d+ per cent of the water left/.test(document.getElementById("live").textContent),
    );
    assert.match(await studio.page.getAttribute("#scrub", "aria-valuetext"), /19 of 30/);
  },

  async stillnessIsKept({ browser, assert }) {
    const calm = await browser.studio({ reducedMotion: "reduce", init: withoutWebGl });
    await calm.open();
    await calm.page.waitForTimeout(500);
    const state = await calm.state();
    assert.equal(state.playing, false);
    assert.equal(state.shown, 0);
    await calm.page.context().close();
  },

  async itIsDarkWhereTheSystemIs({ browser, assert }) {
    const dark = await browser.studio({ colorScheme: "dark", reducedMotion: "reduce", init: withoutWebGl });
    await dark.open("leaf=ivy&seed=1&vertices=400");
    const theme = () =>
      dark.page.evaluate(() => [document.documentElement.dataset.theme, getComputedStyle(document.body).backgroundColor]);
    const [name, background] = await theme();
    assert.equal(name, "dark");
    assert.ok(Number(/\d+/.exec(background)[0]) < 80, background);
    await dark.click("#theme");
    assert.equal((await theme())[0], "light");
    await dark.page.context().close();
  },
};
