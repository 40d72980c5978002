// Going from one foot contact to the next.
import type { Playback } from "../playback";
import type { Clip } from "../wire";

/** The seconds at which a foot comes down or goes up. */
export function changesOf(clip: Clip): number[] {
  const { frames, frame_time: step } = clip.head;
  const found = [];
  for (let frame = 1; frame < frames; frame += 1) {
    const at = 2 * frame;
    const same = [0, 1].every((foot) => clip.contacts[at + foot] === clip.contacts[at + foot - 2]);
    if (!same) found.push(frame * step);
  }
  return found;
}

/** Stop at the next contact, or the one before; at the last one nothing happens. */
export function stepContact(playback: Playback, clip: Clip | null, direction: 1 | -1): void {
  if (!clip) return;
  const half = clip.head.frame_time / 2;
  const changes = changesOf(clip);
  const next =
    direction > 0
      ? changes.find((time) => time > playback.time + half)
      : changes.findLast((time) => time < playback.time - half);
  if (next !== undefined) playback.set({ playing: false, time: next });
}
