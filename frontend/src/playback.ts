// The clock of what is shown: time, speed, direction, loop. No framework, no DOM; pages subscribe to it.

export type Loop = "all" | "range" | "off";
export type Listener = (playback: Playback) => void;

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4] as const;

/** Seconds run from 0 to `duration`; `range` is the stretch that plays where one is set. */
export class Playback {
  time = 0;
  playing = false;
  speed = 1;
  direction: 1 | -1 = 1;
  loop: Loop = "all";
  range: readonly [number, number] | null = null;
  duration = 0;
  frameTime = 1 / 60;
  #listeners = new Set<Listener>();

  /** Call `listener` now and after every change; returns what ends that. */
  subscribe(listener: Listener): () => void {
    this.#listeners.add(listener);
    listener(this);
    return () => void this.#listeners.delete(listener);
  }

  /** Take some fields, keep the time inside the clip and the range inside too, and tell who listens. */
  set(fields: Partial<Pick<Playback, "time" | "playing" | "speed" | "direction" | "loop" | "range" | "duration" | "frameTime">>): void {
    const toEnd = this.range && this.range[1] >= this.duration - this.frameTime / 2;
    Object.assign(this, fields);
    // A range up to the end goes along with the end, when an edit makes the clip longer.
    if (toEnd && this.range && fields.range === undefined) this.range = [this.range[0], this.duration];
    if (this.range) {
      const low = clamp(Math.min(...this.range), 0, this.duration);
      const high = clamp(Math.max(...this.range), 0, this.duration);
      this.range = high - low >= this.frameTime / 2 ? [low, high] : null;
    }
    this.time = clamp(this.time, 0, this.duration);
    for (const listener of [...this.#listeners]) listener(this);
  }

  /** The frame nearest to the time. */
  get frame(): number {
    return Math.round(this.time / this.frameTime);
  }

  /** The stretch that plays: the range, or all. */
  get stretch(): readonly [number, number] {
    return this.range ?? [0, this.duration];
  }

  /** Go `frames` on, or back, and stop. */
  step(frames: number): void {
    this.set({ playing: false, time: (this.frame + frames) * this.frameTime });
  }

  /** J, K and L: play that way; the same again is twice as fast, 0 stops. */
  shuttle(direction: -1 | 0 | 1): void {
    if (direction === 0) return this.set({ playing: false, speed: 1 });
    const faster = this.playing && this.direction === direction;
    this.set({ playing: true, direction, speed: faster ? Math.min(2 * this.speed, 8) : 1 });
  }

  /** Let `seconds` of real time pass. */
  advance(seconds: number): void {
    if (!this.playing || this.duration <= 0) return;
    const [start, end] = this.stretch;
    const length = end - start;
    let time = this.time + seconds * this.speed * this.direction;
    if (time >= start && time <= end) return this.set({ time });
    if (this.loop === "off" || length <= 0) return this.set({ time: clamp(time, start, end), playing: false });
    time = start + ((((time - start) % length) + length) % length);
    this.set({ time });
  }
}

export function clamp(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}
