// Petiole, tips, forces, a region that dries faster: with the pointer and from the lists; asserted on the core.
const LEAF = "leaf=ivy&seed=1&vertices=500&s.iterations=20&view=2";

/** Where a point of the leaf's skin is in the window. */
const inWindow = (studio, point) =>
  studio.core((_, index, app) => {
    const place = app.stage.models[0].point(index, new app.stage.camera.position.constructor());
    const at = app.stage.project(place);
    const box = app.stage.canvas.getBoundingClientRect();
    return { x: box.x + at.x, y: box.y + at.y };
  }, point);

/** The box of an element once it has come to rest. */
async function restingBox(studio, locator) {
  for (let last = ""; ; ) {
    const box = await locator.boundingBox();
    if (JSON.stringify(box) === last) return box;
    last = JSON.stringify(box);
    await studio.page.waitForTimeout(300);
  }
}

async function fresh(studio) {
  await studio.leaf(LEAF);
  await studio.page.waitForTimeout(600); // the camera turns to its view
  await studio.click("#tab-edit");
}

/** To the place of the margin that is `share` of the perimeter from the petiole. */
const marginPoint = (studio, share) =>
  studio.core((_, part, app) => {
    const { margin } = app.active.info;
    const k = margin.s.findIndex((s) => s >= part * margin.perimeter);
    return { point: margin.point[k], s: margin.s[k], perimeter: margin.perimeter };
  }, share);

export default {
  async aTipIsRemovedAndTakenBack({ studio, assert }) {
    await fresh(studio);
    const { leaf } = await studio.state();
    await studio.click('#tip-list button[aria-label="Remove r2"]');
    const state = await studio.until((now, tips) => now.leaf?.tips === tips - 1 && !now.busy, leaf.tips);
    assert.equal(state.edits.removed.length, 1);
    const primaries = await studio.core((_, __, app) => app.active.info.veinOrder.filter((order) => order === 1).length);
    assert.equal(primaries, leaf.tips - 1);
    await studio.page.keyboard.press("Control+z");
    await studio.until((now, tips) => now.leaf?.tips === tips && !now.busy, leaf.tips);
  },

  async aTipIsAddedByClick({ studio, assert }) {
    await fresh(studio);
    const { leaf } = await studio.state();
    await studio.click("#tool-tips");
    const between = await studio.core((_, __, app) => {
      const { tips, margin } = app.active.info;
      return (tips[0].s + tips[1].s) / 2 / margin.perimeter;
    });
    const { point, s, perimeter } = await marginPoint(studio, between);
    const at = await inWindow(studio, point);
    await studio.page.mouse.click(at.x, at.y);
    const state = await studio.until((now, tips) => now.leaf?.tips === tips + 1 && !now.busy, leaf.tips);
    assert.ok(Math.abs(state.edits.added[0] - s) < 0.03 * perimeter, `added at ${state.edits.added[0]}, clicked at ${s}`);
    await studio.page.keyboard.press("Escape");
  },

  // Oracle: the petiole's place on the margin of the leaf as it was.
  async thePetioleIsDragged({ studio, assert }) {
    await fresh(studio);
    await studio.click("#tool-petiole");
    const target = await marginPoint(studio, 0.12);
    const rest = await studio.core(
      (_, i, app) => Array.from(app.active.frames[0].positions.slice(3 * i, 3 * i + 3)),
      target.point,
    );
    const start = await inWindow(studio, await studio.core((_, __, app) => app.active.info.petiolePoint));
    const end = await inWindow(studio, target.point);
    await studio.page.mouse.move(start.x, start.y);
    await studio.page.mouse.down();
    await studio.page.mouse.move((start.x + end.x) / 2, (start.y + end.y) / 2);
    await studio.page.mouse.move(end.x, end.y);
    await studio.page.mouse.up();
    const state = await studio.until((now) => now.source.petiole && !now.busy);
    const [x, y] = state.source.petiole.map((millimetres) => millimetres / 1000);
    const apart = Math.hypot(x - rest[0], y + rest[2]) / state.leaf.length;
    assert.ok(apart < 0.08, `${apart} lengths from where it was dropped`);
    const petiole = await studio.core((_, __, app) => {
      const { petiolePoint } = app.active.info;
      return Array.from(app.active.frames[0].positions.slice(3 * petiolePoint, 3 * petiolePoint + 3));
    });
    assert.ok(Math.hypot(...petiole) < 1e-3 * state.leaf.length, "the petiole is the leaf's origin");
    await studio.page.keyboard.press("Escape");
  },

  async aForceIsPulled({ studio, assert }) {
    await fresh(studio);
    await studio.click("#tool-forces");
    const box = await restingBox(studio, studio.page.locator("#overlay .handle").first());
    const before = await studio.core(async (core) => Array.from((await core.frame()).tipForces));
    await studio.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await studio.page.mouse.down();
    await studio.page.mouse.move(box.x + 60, box.y + 10, { steps: 3 });
    await studio.page.mouse.up();
    await studio.until((now) => now.settings["external.forces"].length > 0);
    await studio.page.waitForFunction(
      async (old) =>
        (await globalThis.wiltStudio.core.frame()).tipForces.slice(0, 3).some((value, i) => Math.abs(value - old[i]) > 1e-3),
      before,
      { polling: 100 },
    );
    const after = await studio.core(async (core) => Array.from((await core.frame()).tipForces));
    assert.equal(after.length, before.length);
    const others = after.slice(3).map((value, i) => Math.abs(value - before[i + 3]));
    assert.ok(Math.max(...others) < 1e-3, "the other tips' forces stay");
    await studio.page.keyboard.press("Escape");
  },

  // Oracle: the force that is typed is the one that the core's frame shows (leaf frame to Y up).
  async aForceIsTyped({ studio, assert }) {
    await fresh(studio);
    const input = studio.page.locator('#tip-list input[aria-label="Force at r1, up"]');
    await input.fill("0.25");
    await input.press("Enter");
    await studio.page.waitForFunction(
      async () => Math.abs((await globalThis.wiltStudio.core.frame()).tipForces[1] - 0.25) < 1e-6,
      undefined,
      { polling: 100 },
    );
    assert.equal((await studio.state()).settings["external.forces"][2], 0.25);
  },

  // Oracle: the same leaf without a region: cells inside the lasso have less water than then, and less than those outside.
  async aRegionDriesFaster({ studio, assert }) {
    await fresh(studio);
    await studio.page.fill("#scrub", "10");
    await studio.until((now) => now.shown === 10);
    const usual = await studio.core((_, __, app) => Array.from(app.active.frames[10].fields.water_fraction));
    await studio.page.fill("#scrub", "0");
    await studio.until((now) => now.shown === 0);
    await studio.click("#tool-region");
    const box = await studio.page.locator("#canvas").boundingBox();
    const corner = (x, y) => [box.x + x * box.width, box.y + y * box.height];
    await studio.page.mouse.move(...corner(0.5, 0.05));
    await studio.page.mouse.down();
    for (const [x, y] of [
      [0.95, 0.05],
      [0.95, 0.6],
      [0.5, 0.6],
      [0.5, 0.1],
    ])
      await studio.page.mouse.move(...corner(x, y), { steps: 3 });
    await studio.page.mouse.up();
    const { settings } = await studio.until((now) => now.settings["water.dry_region"].length >= 6 && now.head === 0);
    await studio.page.fill("#scrub", "10");
    await studio.until((now) => now.shown === 10);
    const [inside, outside] = await studio.core(
      (_, [region, usual], app) => {
        const { frames, info } = app.active;
        const within = (x, y) => {
          let is = false;
          for (let i = 0, j = region.length - 2; i < region.length; j = i, i += 2)
            if (
              region[i + 1] > y !== region[j + 1] > y &&
              x < region[i] + ((region[j] - region[i]) * (y - region[i + 1])) / (region[j + 1] - region[i + 1])
            )
              is = !is;
          return is;
        };
        const sums = [
          [0, 0],
          [0, 0],
        ];
        frames[10].fields.water_fraction.forEach((water, i) => {
          const [x, y] = [frames[0].positions[3 * i] / info.length, -frames[0].positions[3 * i + 2] / info.length];
          const sum = sums[within(x, y) ? 0 : 1];
          sum[0] += water - usual[i];
          sum[1] += 1;
        });
        return sums.map(([sum, count]) => sum / count);
      },
      [settings["water.dry_region"], usual],
    );
    assert.ok(
      inside < -0.005 && Math.abs(outside) < 0.1 * Math.abs(inside),
      `water differs by ${inside} inside, ${outside} outside`,
    );
    await studio.page.keyboard.press("Escape");
    await studio.click("#clear-region");
    await studio.until((now) => now.settings["water.dry_region"].length === 0);
  },

  async theSameFromTheLists({ studio, assert }) {
    await fresh(studio);
    const { leaf } = await studio.state();
    await studio.page.fill("#place", "30");
    await studio.click("#add-tip");
    await studio.until((now, tips) => now.leaf?.tips === tips + 1 && !now.busy, leaf.tips);
    await studio.click("#dry-around");
    const { settings } = await studio.until((now) => now.settings["water.dry_region"].length > 0);
    assert.equal(settings["water.dry_region"].length, 24);
    await studio.page.fill("#place", "10");
    await studio.click("#move-petiole");
    await studio.until((now) => now.source.petiole && !now.busy);
    await studio.click("#tab-wither");
  },
};
