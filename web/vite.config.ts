// The studio's page as static files with relative addresses: any host can serve them, from any folder.
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

const root = fileURLToPath(new URL("..", import.meta.url));

export default defineConfig({
  base: "./",
  resolve: {
    // wilt.mjs and wilt.wasm, as CMake's preset "wasm" makes them.
    alias: { "wilt-core": process.env.WILT_CORE ?? resolve(root, "build/wasm/web") },
  },
  server: { fs: { allow: [root, process.env.WILT_CORE ?? root] } },
  worker: { format: "es" },
  build: {
    target: "es2022",
    outDir: process.env.WILT_STUDIO ?? resolve(root, "build/studio"),
    emptyOutDir: true,
    assetsInlineLimit: 2048,
    chunkSizeWarningLimit: 700,
  },
});
