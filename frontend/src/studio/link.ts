// A link to what is seen: the clip, the moment, how it is compared, and from where. What is done to the clip
// is no part of it; that is kept where the clip is.
import { MODES, type Mode } from "./view";

export interface Link {
  clip: string;
  /** Seconds. */
  time: number;
  mode: Mode | null;
  /** The camera's own numbers; none: as it is. */
  camera: readonly number[] | null;
}

const CAMERA = 6; // numbers

/** The part of an address behind its #. With the page's key, so that it opens in another window too. */
export function linkText({ clip, time, mode, camera }: Link, token: string): string {
  const short = (value: number) => String(Number(value.toFixed(4)));
  const fields = new URLSearchParams({ clip, at: short(time) });
  if (token) fields.set("token", token);
  if (mode) fields.set("mode", mode);
  if (camera) fields.set("camera", camera.map(short).join("_"));
  return fields.toString();
}

/** Read it back; null where it is no link to a view. What makes no sense in it is left out. */
export function readLink(hash: string): Link | null {
  const fields = new URLSearchParams(hash.replace(/^#/, ""));
  const clip = fields.get("clip");
  if (!clip) return null;
  const time = Number(fields.get("at"));
  const camera = (fields.get("camera") ?? "").split("_").map((part) => (part === "" ? NaN : Number(part)));
  return {
    clip,
    time: Number.isFinite(time) ? Math.max(time, 0) : 0,
    mode: MODES.find(({ mode }) => mode === fields.get("mode"))?.mode ?? null,
    camera: camera.length === CAMERA && camera.every(Number.isFinite) ? camera : null,
  };
}

/** Take the link out of the page's address, so that reloading goes on where the work is. */
export function takeLink(): Link | null {
  const link = readLink(location.hash);
  if (link && !new URLSearchParams(location.hash.slice(1)).has("token"))
    history.replaceState(null, "", location.pathname + location.search);
  return link;
}
