/// The viewer as one module for notebooks (anywidget).
import { defineConfig } from "vite";

export default defineConfig({
  publicDir: false,
  build: {
    target: "es2022",
    outDir: "../src/mien/studio/static",
    emptyOutDir: false,
    modulePreload: false,
    chunkSizeWarningLimit: 1200,
    rollupOptions: {
      input: "src/widget.ts",
      preserveEntrySignatures: "strict",
      output: { format: "es", entryFileNames: "widget.js" },
    },
  },
});
