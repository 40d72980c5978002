/// All widgets on one page, for `npx vite` (demo.html) and for the tests in a browser; never shipped.
import { svelte } from "@sveltejs/vite-plugin-svelte";
import { defineConfig } from "vite";

export default defineConfig({
  base: "./",
  plugins: [svelte()],
  build: { target: "es2022", assetsInlineLimit: 0, rollupOptions: { input: "demo.html" } },
});
