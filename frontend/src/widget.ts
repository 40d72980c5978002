// The viewer in a notebook, as anywidget wants it: clips come as bytes, and are shown until the cell is gone.
import { clipSource, type PoseSource } from "./motion/blend";
import { Player } from "./viewer/player";
import { decode } from "./wire";

/** What anywidget gives: the Python side's fields. */
interface Model {
  get(name: string): unknown;
  on(event: string, act: () => void): void;
  off(event: string, act: () => void): void;
}

function render({ model, el }: { model: Model; el: HTMLElement }): () => void {
  const host = document.createElement("div");
  el.append(host);
  const source = (name: string): PoseSource | null => {
    const view = model.get(name) as DataView | null;
    // A copy: arrays of numbers must start at a multiple of four.
    return view?.byteLength ? clipSource(decode(new Uint8Array(view.buffer, view.byteOffset, view.byteLength).slice().buffer))
      : null;
  };
  const size = (): void => void (host.style.height = `${Number(model.get("height"))}px`);
  size();
  const player = new Player(host, {
    original: source("original"),
    edited: source("edited"),
    quality: model.get("quality") === "low" ? "low" : "high",
    theme: matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light",
    keys: "inside",
  });
  const again = (): void => {
    player.viewer.setOriginal(source("original"));
    player.viewer.setEdited(source("edited"));
  };
  const events: [string, () => void][] = [["change:original", again], ["change:edited", again], ["change:height", size]];
  for (const [event, act] of events) model.on(event, act);
  return () => {
    for (const [event, act] of events) model.off(event, act);
    player.dispose();
  };
}

export default { render };
