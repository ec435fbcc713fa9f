// Browsers that lack something: it is said, and something useful is shown.
import { withoutWebGl } from "../browser.mjs";
import { coloursOf } from "./loading.mjs";

export default {
  // The leaf is drawn flat, and withers.
  async withoutWebGl2({ browser, assert }) {
    const plain = await browser.studio({ init: withoutWebGl });
    await plain.open("leaf=ivy&seed=1&vertices=400&s.iterations=20");
    assert.ok((await plain.messages()).some((text) => text.includes("WebGL")));
    await plain.page.fill("#scrub", "20");
    const state = await plain.until((now) => now.shown === 20);
    assert.ok(state.frames > 20);
    assert.ok((await coloursOf(plain.page, "#canvas")) > 5, "a leaf is drawn");
    assert.deepEqual(plain.problems, []);
    await plain.page.context().close();
  },

  async withoutSimd({ browser, assert }) {
    const old = await browser.studio({ init: () => (WebAssembly.validate = () => false) });
    await old.page.goto(old.address);
    await old.page.waitForSelector("#without-core");
    assert.match(await old.page.textContent("#without-core"), /SIMD[\s\S]*wilt simulate/);
    await old.page.waitForFunction(() => document.querySelector("#without-core img").naturalWidth > 100);
    assert.deepEqual(old.problems, []);
    await old.page.context().close();
  },

  async withoutWebAssembly({ browser, assert }) {
    const old = await browser.studio({ init: () => delete globalThis.WebAssembly });
    await old.page.goto(old.address);
    await old.page.waitForSelector("#without-core");
    assert.match(await old.page.textContent("#without-core"), /lacks WebAssembly/);
    assert.deepEqual(old.problems, []);
    await old.page.context().close();
  },
};
