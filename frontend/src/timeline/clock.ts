// What the timeline needs of a playback, as plain data that can be compared.
import { type Playback, SPEEDS } from "../playback";

export type Clock = Pick<
  Playback, "time" | "playing" | "speed" | "direction" | "loop" | "range" | "duration" | "frameTime" | "frame"
>;

export function read(playback: Playback): Clock {
  const { time, playing, speed, direction, loop, range, duration, frameTime, frame } = playback;
  return { time, playing, speed, direction, loop, range, duration, frameTime, frame };
}

/** The next speed up (1) or down (-1) of those on offer; at the end the same. */
export function nextSpeed(speed: number, way: 1 | -1): number {
  const beyond = SPEEDS.filter((one) => (one - speed) * way > 1e-9);
  return (way > 0 ? beyond[0] : beyond.at(-1)) ?? speed;
}

const LOOPS = { all: "range", range: "off", off: "all" } as const;

export function nextLoop(loop: Playback["loop"]): Playback["loop"] {
  return LOOPS[loop];
}
