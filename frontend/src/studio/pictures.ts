// Pictures of presets: asked for once each, one after the other, so that edits come between.
import type { Api } from "./api";

interface Album {
  pictures: Map<string, Promise<string>>;
  last: Promise<unknown>;
}

const albums = new WeakMap<Api, Album>();

/** The address of a preset's picture; one that could not be had is asked for again next time. */
export function pictures(api: Api, name: string): Promise<string> {
  const album = albums.get(api) ?? { pictures: new Map(), last: Promise.resolve() };
  albums.set(api, album);
  const there = album.pictures.get(name);
  if (there) return there;
  const asked = album.last.then(() => api.presetPicture(name));
  album.pictures.set(name, asked);
  album.last = asked.catch(() => album.pictures.delete(name));
  return asked;
}
