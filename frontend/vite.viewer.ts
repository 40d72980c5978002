/// The viewer as one file that needs nothing else: `mien render clip.bvh -o page.html` puts a clip in it.
import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

/** Let the page load and run nothing but what is written in it: its script and style are named by their hashes. */
function policy(): Plugin {
  return {
    name: "mien-policy",
    enforce: "post",
    generateBundle: { order: "post", handler: async (_, bundle) => {
      for (const file of Object.values(bundle)) {
        if (file.type !== "asset" || !file.fileName.endsWith(".html")) continue;
        const page = String(file.source);
        const scripts = await hashes(page, /<script type="module"[^>]*>([\s\S]*?)<\/script>/g);
        const styles = await hashes(page, /<style[^>]*>([\s\S]*?)<\/style>/g);
        const rules = `default-src 'none'; script-src ${scripts}; style-src ${styles}; img-src data: blob:; ` +
          "base-uri 'none'; form-action 'none'";
        file.source = page.replace('<meta charset="utf-8" />', (meta) =>
          `${meta}\n    <meta http-equiv="Content-Security-Policy" content="${rules}" />`);
      }
    } },
  };
}

async function hashes(page: string, pattern: RegExp): Promise<string> {
  const found: string[] = [];
  for (const [, text] of page.matchAll(pattern)) {
    const digest = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text));
    found.push(`'sha256-${btoa(String.fromCharCode(...new Uint8Array(digest)))}'`);
  }
  return found.join(" ");
}

export default defineConfig({
  base: "./",
  plugins: [viteSingleFile(), policy()],
  build: {
    target: "es2022",
    outDir: "../src/mien/studio/static",
    emptyOutDir: false,
    modulePreload: { polyfill: false },
    rollupOptions: { input: "viewer.html" },
  },
});
