/// The viewer as one file that needs nothing else: `mien render clip.bvh page.html` puts a clip in it.
import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

export default defineConfig({
  base: "./",
  plugins: [viteSingleFile()],
  build: {
    target: "es2022",
    outDir: "../src/mien/studio/static",
    emptyOutDir: false,
    rollupOptions: { input: "viewer.html" },
  },
});
