// The studio in Chromium: every check of checks/*.mjs, in one browser.
// Usage: node studio.mjs SITE NODE_FOLDER CHROMIUM WILT NATIVE_CUT_OUT SHARED_DATA PYTHON SCREENSHOTS [CHECK...]
import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { startBrowser } from "./browser.mjs";

const [site, nodeFolder, chromium, wilt, nativeCutOut, shared, python, screenshots, ...asked] = process.argv.slice(2);
const needed = {
  "the page has not been built (scripts/build-studio does that)": join(site, "index.html"),
  "playwright-core is not there (npm ci in build/dev/node installs it)": join(nodeFolder, "node_modules/playwright-core"),
  "chromium is not there (apt-get install chromium)": chromium,
};
for (const [why, path] of Object.entries(needed)) {
  if (existsSync(path)) continue;
  console.log(`skipped: ${why}`);
  process.exit(77);
}

const GROUPS = ["loading", "playing", "settings", "looks", "editing", "files", "exports", "links", "access", "fallbacks"];

let failures = 0;
const scratch = mkdtempSync(join(tmpdir(), "wilt-web-"));
process.on("exit", () => rmSync(scratch, { recursive: true, force: true })); // when it is stopped too
mkdirSync(screenshots, { recursive: true });
const browser = await startBrowser(nodeFolder, chromium, site);
try {
  // One page for most checks: making its shaders takes software GL ten seconds.
  const studio = await browser.studio();
  await studio.open(asked.length > 0 ? "leaf=ivy&seed=1&vertices=400" : "");
  for (const group of GROUPS) {
    if (asked.length > 0 && !asked.some((name) => name.startsWith(group))) continue;
    const { default: checks } = await import(`./checks/${group}.mjs`);
    const tools = { studio, browser, assert, scratch, wilt, nativeCutOut, shared, python, screenshots, nodeFolder };
    for (const [name, check] of Object.entries(checks)) {
      if (asked.length > 0 && !asked.some((word) => `${group}.${name}`.includes(word))) continue;
      const before = performance.now();
      let verdict = "ok";
      try {
        await check(tools);
        assert.deepEqual(studio.problems, [], "the console is silent");
      } catch (error) {
        ++failures;
        verdict = `FAILED: ${error.message}\n${error.stack}`;
        await studio.page.screenshot({ path: join(screenshots, `failed-${group}-${name}.png`) }).catch(() => {});
      }
      studio.problems.length = 0;
      console.log(`${group}.${name} (${((performance.now() - before) / 1000).toFixed(1)} s): ${verdict}`);
    }
  }
} finally {
  await browser.close();
}
console.log(`${(performance.now() / 1000) | 0} s, ${failures} failures`);
process.exitCode = failures > 0 ? 1 : 0;
