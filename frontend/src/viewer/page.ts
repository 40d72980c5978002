// The page without a server: it shows the clips that are written into it.
// ?quality=low draws without shadows, ?theme=dark is dark, ?neutral is one colour, ?time=1.5 begins there and waits.
import { fromBase64 } from "../motion/base64";
import { clipSource, type PoseSource } from "../motion/blend";
import { decode } from "../wire";
import { Player } from "./player";

interface Enclosed {
  name: string;
  role: "original" | "edited";
  data: string;
}

function start(): void {
  const host = document.getElementById("viewer")!;
  const text = document.getElementById("mien-clips")?.textContent ?? "[]";
  const clips = JSON.parse(text) as Enclosed[];
  const source = (role: Enclosed["role"]): PoseSource | null => {
    const found = clips.find((clip) => clip.role === role);
    return found ? clipSource(decode(fromBase64(found.data))) : null;
  };
  const [original, edited] = [source("original"), source("edited")];
  if (!original && !edited) {
    host.textContent = "There is no clip in this page. Write one with: mien render clip.bvh -o page.html";
    return;
  }
  const asked = new URLSearchParams(location.search);
  const time = asked.get("time");
  const dark = asked.get("theme") ? asked.get("theme") === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  const player = new Player(host, {
    original,
    edited,
    quality: asked.get("quality") === "low" ? "low" : "high",
    theme: dark ? "dark" : "light",
    neutral: asked.has("neutral"),
    autoplay: time === null,
    keys: "page",
  });
  if (time !== null) player.playback.set({ time: Number(time) });
}

try {
  start();
} catch (error) {
  const host = document.getElementById("viewer");
  if (host) host.textContent = `This page cannot be shown: ${error instanceof Error ? error.message : String(error)}`;
}
