/// The viewer as one module for notebooks (anywidget).
import { defineConfig } from "vite";

export default defineConfig({
  publicDir: false,
  build: {
    target: "es2022",
    outDir: "../src/mien/studio/static",
    emptyOutDir: false,
    lib: { entry: "src/widget.ts", formats: ["es"], fileName: "widget" },
  },
});
