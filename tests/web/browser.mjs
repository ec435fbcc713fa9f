// A browser with the studio's page in it: one Chromium and one small server for many checks.
import { createReadStream, existsSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { basename, extname, join, normalize, resolve } from "node:path";

const TYPES = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".wasm": "application/wasm",
  ".webp": "image/webp",
};
const FLAGS = [
  "--no-sandbox",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** For a page's `init`: there is no WebGL. */
export function withoutWebGl() {
  const original = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
    return kind.startsWith("webgl") ? null : original.call(this, kind, ...more);
  };
}

/** What a folder holds, on loopback. */
async function serve(folder) {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname));
    const file = join(folder, path.endsWith("/") ? `${path}index.html` : path);
    if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
    response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream" });
    createReadStream(file).pipe(response);
  });
  await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/** The page and what is asked of it. Its state is the core's, told by window.wiltStudio. */
export class Studio {
  problems = []; // errors in the console, exceptions, requests that failed

  constructor(page, address) {
    this.page = page;
    this.address = address;
    page.on("console", (message) => message.type() === "error" && this.problems.push(`console: ${message.text()}`));
    page.on("pageerror", (error) => this.problems.push(`exception: ${error.message}`));
    page.on("requestfailed", (request) => this.problems.push(`request: ${request.url()} ${request.failure()?.errorText}`));
    page.setDefaultTimeout(45_000); // of a machine that has much else to do
    page.setDefaultNavigationTimeout(60_000);
  }

  /** `hash`: what a link says, "leaf=ivy&seed=1". Waits for a leaf at rest with its textures. */
  async open(hash = "") {
    await this.page.goto(this.address + (hash && `#${hash}`));
    await this.until((state) => state.leaf && !state.busy);
  }

  state() {
    return this.page.evaluate(() => globalThis.wiltStudio.state());
  }

  /** Until `test` (of the state, in the page) holds; the state then. */
  async until(test, argument) {
    const source = `const state = globalThis.wiltStudio?.state(); return Boolean(state && (${test})(state, argument)) && JSON.stringify(state);`;
    const found = await this.page.waitForFunction(new Function("argument", source), argument, { polling: 50 });
    return JSON.parse(await found.jsonValue());
  }

  /** In the page, with the core and `argument`. */
  core(work, argument) {
    const source = `return (${work})(globalThis.wiltStudio.core, argument, globalThis.wiltStudio.app)`;
    return this.page.evaluate(new Function("argument", source), argument);
  }

  click(selector) {
    return this.page.click(selector);
  }

  /** Another leaf, as a link opens it; it stands still at iteration `i`. */
  async leaf(hash) {
    await this.page.evaluate(() => {
      globalThis.wiltStudio.app.active.info = undefined;
      for (const button of document.querySelectorAll("#messages button")) button.click();
    });
    await this.page.evaluate((text) => (location.hash = text), `${hash}&t=${Math.random()}`);
    const state = await this.until((now) => now.leaf && !now.busy && !now.playing);
    const wanted = Number(new URLSearchParams(hash).get("i") ?? 0);
    return wanted > 0 ? this.until((now, i) => now.shown >= i, wanted) : state;
  }

  /** Drops files on the page as a user does. */
  async drop(...files) {
    const contents = files.map((file) => {
      const { name, bytes } = typeof file === "string" ? { name: basename(file), bytes: readFileSync(file) } : file;
      return [name, Buffer.from(bytes).toString("base64")];
    });
    await this.page.evaluate((list) => {
      const data = new DataTransfer();
      for (const [name, text] of list) data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
      for (const type of ["dragenter", "dragover", "drop"])
        document.body.dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true, dataTransfer: data }));
    }, contents);
  }

  /** What is downloaded when `act` is done: [file name, bytes]. */
  async download(act) {
    const [download] = await Promise.all([this.page.waitForEvent("download"), act()]);
    return [download.suggestedFilename(), readFileSync(await download.path())];
  }

  messages() {
    return this.page.$$eval("#messages .message p", (list) => list.map((p) => p.textContent));
  }
}

/** Starts Chromium; `nodeFolder` holds playwright-core. */
export async function startBrowser(nodeFolder, chromium, site) {
  const { chromium: driver } = createRequire(join(resolve(nodeFolder), "package.json"))("playwright-core");
  const server = await serve(site);
  const browser = await driver.launch({ executablePath: chromium, headless: true, args: FLAGS });
  return {
    /** A page of its own, with its own storage; `init` runs in it before the page does. */
    async studio({ width = 900, height = 640, init, ...more } = {}) {
      const context = await browser.newContext({ viewport: { width, height }, acceptDownloads: true, ...more });
      if (init) await context.addInitScript(init);
      return new Studio(await context.newPage(), server.address);
    },
    async close() {
      await browser.close();
      server.close();
    },
  };
}
