// Sliders, species, models; asserted on the core's settings and on what the leaf does.
const LEAF = "leaf=ivy&seed=1&vertices=400&s.iterations=40";

/** A setting as the core has it now. */
const inCore = (studio, key) =>
  studio.core(async (core, name) => (await core.settings()).find((setting) => setting.key === name).value, key);

/** Moves a slider to a place between its ends. */
async function slide(studio, key, share) {
  await studio.page.$eval(
    `#set-${key.replaceAll(".", "-")}`,
    (input, part) => {
      input.value = String(Number(input.min) + part * (Number(input.max) - Number(input.min)));
      input.dispatchEvent(new Event("input", { bubbles: true }));
      input.dispatchEvent(new Event("change", { bubbles: true }));
    },
    share,
  );
}

export default {
  // Oracle: the slider's place between its ends, by hand; those of "times the usual" times the species' own.
  async eachSliderReachesTheCore({ studio, assert }) {
    await studio.leaf(LEAF);
    const usual = async (key) => studio.core((core, name, app) => app.active.settings.get(name).usual, key);
    const expected = {
      "water.loss_rate": 3 * (await usual("water.loss_rate")),
      "water.temperature_c": 0.75 * 45,
      "water.humidity": 0.75,
      "curvature.roll": 0.75 * 3 * (await usual("curvature.roll")),
      "shrinkage.amount": 0.75 * 2.5 * (await usual("shrinkage.amount")),
    };
    for (const [key, value] of Object.entries(expected)) {
      await slide(studio, key, 0.75);
      await studio.until((now, name) => Math.abs(now.settings[name]) > 0 && now.config.includes(name.split(".")[1]), key);
      await studio.page.waitForFunction(
        async ([name, wanted]) => {
          const all = await globalThis.wiltStudio.core.settings();
          return Math.abs(all.find((setting) => setting.key === name).value - wanted) <= 0.02 * wanted;
        },
        [key, value],
        { polling: 100 },
      );
    }
  },

  // Oracle: in air that holds all the water it can, no water is lost; before, it was.
  async humidityHoldsTheWaterFromThereOn({ studio, assert }) {
    await studio.leaf(`${LEAF}&i=8`);
    await slide(studio, "water.humidity", 1);
    await studio.until((now) => now.changes.some((change) => change.key === "water.humidity"));
    await studio.page.fill("#scrub", "16");
    const state = await studio.until((now) => now.shown === 16);
    assert.deepEqual(
      state.changes.map(({ iteration, key, value }) => [iteration, key, value]),
      [[8, "water.humidity", 1]],
    );
    const left = await studio.core((_, __, app) => app.active.frames.map((frame) => frame.waterLeft));
    assert.ok(left[0] - left[8] > 0.01, `${left[0] - left[8]} of the water was lost before`);
    assert.ok(Math.abs(left[8] - left[16]) < 1e-6, `${left[8] - left[16]} was lost after`);
    assert.equal(await inCore(studio, "water.humidity"), 1);
  },

  // Oracle: a change of the past forgets what came after it, and keeps what was before.
  async aChangeOfThePastBeginsANewCourse({ studio, assert }) {
    await studio.leaf(`${LEAF}&i=20`);
    const before = await studio.core((_, __, app) => app.active.frames[9].waterLeft);
    await studio.page.fill("#scrub", "10");
    await studio.until((now) => now.shown === 10);
    await slide(studio, "water.loss_rate", 0);
    const state = await studio.until((now) => now.changes.length > 0 && now.head < 20);
    assert.equal(state.changes[0].iteration, 10);
    assert.equal(await studio.core((_, __, app) => app.active.frames[9].waterLeft), before);
  },

  async undoTakesASettingBack({ studio, assert }) {
    await studio.leaf(LEAF);
    const usual = await inCore(studio, "water.humidity");
    await slide(studio, "water.humidity", 0.9);
    await studio.until((now) => now.settings["water.humidity"] === 0.9);
    await studio.page.keyboard.press("Control+z");
    await studio.until((now, value) => now.settings["water.humidity"] === value, usual);
    assert.equal(await inCore(studio, "water.humidity"), usual);
  },

  async everySpeciesIsThere({ studio, assert }) {
    for (const name of ["maple", "poplar", "tilia", "ivy", "willow", "grape"]) {
      await studio.page.check(`input[name=species][value=${name}]`, { force: true });
      const state = await studio.until((now, species) => now.leaf?.species === species && !now.busy, name);
      assert.equal(state.source.name, name);
      assert.ok(Math.abs(state.leaf.vertices - 400) < 40, `${name} has ${state.leaf.vertices} vertices`);
    }
  },

  async anotherSeedIsAnotherLeaf({ studio, assert }) {
    await studio.leaf(LEAF);
    const rest = () => studio.core(async (_, __, app) => Array.from(app.active.frames[0].positions.slice(0, 60)));
    const first = await rest();
    await studio.click("#another");
    const state = await studio.until((now) => now.source.seed === 2 && !now.busy);
    assert.equal(state.leaf.species, "ivy");
    assert.notDeepEqual(await rest(), first);
  },

  async theModelSwitches({ studio, assert }) {
    await studio.leaf(LEAF);
    for (const model of ["paper", "cell"]) {
      await studio.page.click(`#model label:has-text("${model}")`);
      await studio.until((now, name) => now.settings.model === name, model);
      await studio.page.waitForFunction(
        async (name) => (await globalThis.wiltStudio.core.toml(true)).includes(`model = "${name}"`),
        model,
      );
      await studio.page.waitForFunction((name) => document.querySelector(`input[name=model][value=${name}]`).checked, model);
      // The printed equations know no humidity.
      assert.equal(await studio.page.isDisabled("#set-water-humidity"), model === "paper");
      assert.equal(await studio.page.isDisabled("#set-water-loss_rate"), false);
    }
    assert.equal((await studio.state()).frames, 1);
  },

  async moreVerticesAreMade({ studio, assert }) {
    await studio.leaf(LEAF);
    await studio.page.selectOption("#vertices", "1000");
    const state = await studio.until((now) => now.source.vertices === 1000 && !now.busy);
    assert.ok(Math.abs(state.leaf.vertices - 1000) < 60, `${state.leaf.vertices}`);
  },

  // Oracle: the command line's own table, by the core: each has a row; a search finds by key and by help.
  async allSettingsAreListed({ studio, assert }) {
    await studio.leaf(LEAF);
    await studio.click("#tab-all");
    const keys = await studio.core(async (core) => (await core.settings()).map((setting) => setting.key));
    const rows = await studio.page.$$eval("#panel-all [data-key]", (list) => list.map((row) => row.dataset.key));
    assert.deepEqual(
      keys.filter((key) => !rows.includes(key)).sort(),
      ["frames", "seed", "species", "vertices"].filter((key) => keys.includes(key)),
    );
    await studio.page.fill("#search", "humidity");
    const seen = await studio.page.locator("#panel-all .setting:visible").count();
    assert.ok(seen >= 1 && seen < 10, `${seen} rows for humidity`);
    await studio.page.fill("#search", "");
    await studio.click("#tab-wither");
  },

  // Negative: what is out of range is said and goes nowhere.
  async aWrongValueIsRefused({ studio, assert }) {
    await studio.leaf(LEAF);
    await studio.click("#tab-all");
    const before = await inCore(studio, "water.temperature_c");
    const input = studio.page.locator('[id="all-water.temperature_c"]');
    await input.fill("4000");
    await input.press("Enter");
    assert.ok((await studio.messages()).some((text) => text.includes("water.temperature_c") && text.includes("4000")));
    assert.equal(await input.getAttribute("aria-invalid"), "true");
    assert.equal(await inCore(studio, "water.temperature_c"), before);
    await studio.click("#tab-wither");
  },
};
