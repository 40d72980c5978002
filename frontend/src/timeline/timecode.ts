// Moments as people write them: 01:23.45, or the number of a frame. Frame 0 is the first.

/** Minutes, seconds and hundredths: `00:01.50`; hours in front where there are any. */
export function format(seconds: number): string {
  const hundredths = Math.round(Math.max(seconds, 0) * 100);
  const two = (number: number) => String(number).padStart(2, "0");
  const minutes = Math.floor(hundredths / 6000);
  const rest = `${two(Math.floor(hundredths / 100) % 60)}.${two(hundredths % 100)}`;
  const hours = Math.floor(minutes / 60);
  return hours ? `${hours}:${two(minutes % 60)}:${rest}` : `${two(minutes)}:${rest}`;
}

/** Short, for a ruler: as many decimals as its step needs, minutes only where there are any. */
export function ruled(seconds: number, step: number): string {
  const digits = step >= 1 ? 0 : step >= 0.1 ? 1 : step >= 0.01 ? 2 : 3;
  const rounded = Number(seconds.toFixed(digits));
  if (rounded < 60) return `${rounded.toFixed(digits)}${digits ? "" : " s"}`;
  const rest = (rounded % 60).toFixed(digits);
  return `${Math.floor(rounded / 60)}:${rest.padStart(digits ? digits + 3 : 2, "0")}`;
}

/** Seconds from `83.45`, `1:23.45`, `1:02:03`, `f90` or `90f` (a frame); null for anything else. */
export function parse(text: string, frameTime: number): number | null {
  const plain = text.trim().toLowerCase().replace(",", ".").replace(/\s*s$/, "");
  const frame = /^(?:f\s*(\d+)|(\d+)\s*f)$/.exec(plain);
  if (frame) return Number(frame[1] ?? frame[2]) * frameTime;
  if (!/^(\d+:){0,2}(\d+\.?\d*|\.\d+)$/.test(plain)) return null;
  const parts = plain.split(":").map(Number);
  if (parts.slice(1).some((part) => part >= 60)) return null;
  return parts.reduce((total, part) => total * 60 + part, 0);
}

/** The last frame of a clip: `duration` is from the first frame to the last. */
export function lastFrame(duration: number, frameTime: number): number {
  return Math.round(duration / frameTime);
}

/** Frames a second, without a tail of noughts. */
export function rate(frameTime: number): string {
  return String(Number((1 / frameTime).toFixed(2)));
}
