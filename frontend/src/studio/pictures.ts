// Pictures of presets: asked for once each, and a few at a time.
import type { Api } from "./api";

const AT_ONCE = 2; // the server draws them one after the other anyway, and edits should come between

const addresses = new WeakMap<Api, Map<string, Promise<string>>>();
const queues = new WeakMap<Api, Promise<unknown>[]>();

/** The address of a preset's picture. */
export function pictures(api: Api, name: string): Promise<string> {
  const known = addresses.get(api) ?? new Map<string, Promise<string>>();
  addresses.set(api, known);
  const there = known.get(name);
  if (there) return there;
  const queue = queues.get(api) ?? Array.from({ length: AT_ONCE }, () => Promise.resolve());
  queues.set(api, queue);
  const lane = known.size % AT_ONCE;
  const asked = queue[lane]!.catch(() => undefined).then(() => api.presetPicture(name));
  queue[lane] = asked;
  known.set(name, asked);
  asked.catch(() => known.delete(name));
  return asked;
}
