// Names of files that a person gives.

const MOST = 100; // letters
// What Windows, macOS or a path keep for themselves, and what is not to be seen.
const FORBIDDEN = /[<>:"/\\|?*\p{Cc}\p{Cf}]+/gu;
const RESERVED = /^(con|prn|aux|nul|com\d|lpt\d)(\.|$)/i;

/** The name of a clip without its ending. */
export function stemOf(name: string): string {
  return name.replace(/\.[^.]*$/, "");
}

/** What was typed as a file's name, without `.ending`, and such that every system takes it; never a path. */
export function cleanName(typed: string, ending: string): string {
  const parts = typed.normalize().split(/[/\\]/).map((part) => part.trim());
  const plain = parts.filter((part) => !/^\.*$/.test(part)).join("_").replace(FORBIDDEN, "_");
  const has = plain.toLowerCase().endsWith(`.${ending}`.toLowerCase());
  const bare = has ? plain.slice(0, -ending.length - 1) : plain;
  const cut = [...bare.replace(/^[.\s]+/, "")].slice(0, MOST).join("").replace(/[.\s]+$/, "");
  return RESERVED.test(cut) ? `_${cut}` : cut;
}
