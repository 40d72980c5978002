// Keys and what they do, as a table that can be changed; keys typed into fields are never taken.

export interface Binding {
  command: string;
  keys: readonly string[];
}

/** Written as "Ctrl+Shift+Z"; Ctrl is also the Command key. */
export const KEYS: readonly Binding[] = [
  { command: "play", keys: ["Space"] },
  { command: "next-frame", keys: ["ArrowRight"] },
  { command: "previous-frame", keys: ["ArrowLeft"] },
  { command: "ten-frames-on", keys: ["Shift+ArrowRight"] },
  { command: "ten-frames-back", keys: ["Shift+ArrowLeft"] },
  { command: "next-contact", keys: ["ArrowUp", "."] },
  { command: "previous-contact", keys: ["ArrowDown", ","] },
  { command: "range-start", keys: ["Home"] },
  { command: "range-end", keys: ["End"] },
  { command: "play-backward", keys: ["J"] },
  { command: "stop", keys: ["K"] },
  { command: "play-forward", keys: ["L"] },
  { command: "loop-in", keys: ["I", "["] },
  { command: "loop-out", keys: ["O", "]"] },
  { command: "loop-clear", keys: ["Alt+X"] },
  { command: "loop-mode", keys: ["R"] },
  { command: "slower", keys: ["-"] },
  { command: "faster", keys: ["+", "="] },
  { command: "normal-speed", keys: ["0"] },
  { command: "frame-selection", keys: ["F"] },
  { command: "frame-all", keys: ["A"] },
  { command: "view-front", keys: ["1"] },
  { command: "view-side", keys: ["3"] },
  { command: "view-top", keys: ["7"] },
  { command: "view-perspective", keys: ["5"] },
  { command: "follow", keys: ["C"] },
  { command: "ghost", keys: ["G"] },
  { command: "compare", keys: ["V"] },
  { command: "swap", keys: ["X"] },
  { command: "trails", keys: ["T"] },
  { command: "footprints", keys: ["P"] },
  { command: "names", keys: ["N"] },
  { command: "grid", keys: ["#"] },
  { command: "treadmill", keys: ["Y"] },
  { command: "fullscreen", keys: ["Shift+F"] },
  { command: "bypass", keys: ["B"] },
  { command: "solo", keys: ["S"] },
  { command: "duplicate", keys: ["Ctrl+D"] },
  { command: "delete", keys: ["Delete"] },
  { command: "undo", keys: ["Ctrl+Z"] },
  { command: "redo", keys: ["Ctrl+Shift+Z", "Ctrl+Y"] },
  { command: "open", keys: ["Ctrl+O"] },
  { command: "save", keys: ["Ctrl+S"] },
  { command: "export", keys: ["Ctrl+E"] },
  { command: "palette", keys: ["Ctrl+K"] },
  { command: "keys", keys: ["?"] },
];

/** Held, it shows the original; let go, the edited motion again. */
export const HOLD_ORIGINAL = "`";

type Press = Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "shiftKey" | "altKey">;

/** The way `KEYS` writes what was pressed: "Ctrl+Shift+Z", "?", "Space". */
export function chord(press: Press): string {
  const letter = press.key.length === 1 && press.key.toLowerCase() !== press.key.toUpperCase();
  const named = press.key.length > 1;
  const key = press.key === " " ? "Space" : letter ? press.key.toUpperCase() : press.key;
  const held = [];
  if (press.ctrlKey || press.metaKey) held.push("Ctrl");
  if (press.altKey) held.push("Alt");
  // Where Shift already chose the sign ("?", "#", "+"), it is not told twice.
  if (press.shiftKey && (letter || named || key === "Space")) held.push("Shift");
  return [...held, key].join("+");
}

/** The table with some commands' keys replaced; a key that moved is taken from where it was. */
export function rebound(
  table: readonly Binding[],
  changes: Readonly<Record<string, readonly string[]>>,
): Binding[] {
  const taken = new Set(Object.values(changes).flat());
  return table.map(({ command, keys }) => ({
    command,
    keys: changes[command] ?? keys.filter((key) => !taken.has(key)),
  }));
}

/** The command of what was pressed, or nothing. */
export function commandOf(table: readonly Binding[], press: Press): string | undefined {
  const pressed = chord(press);
  return table.find(({ keys }) => keys.includes(pressed))?.command;
}

const TYPING = new Set(["text", "search", "number", "email", "url", "password", "tel", ""]);
/** Keys that sliders, buttons, menus and lists use themselves. */
const OWN = new Set(["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End", "PageUp", "PageDown"]);
const PRESSING = new Set([" ", "Enter"]);

/** Whether the element with the focus needs the key itself, as a text field needs letters. */
export function isTaken(target: EventTarget | null, press: Press): boolean {
  if (!isElement(target)) return false;
  const withCommand = press.ctrlKey || press.metaKey;
  const name = target.tagName;
  const typing =
    name === "TEXTAREA" ||
    target.isContentEditable === true ||
    (name === "INPUT" && TYPING.has(target.getAttribute("type") ?? ""));
  // A field in which nothing is being typed has nothing of its own to undo.
  const free = target.dataset?.["settled"] === undefined ? "kseo" : "kseozy";
  if (typing) return !(withCommand && free.includes(press.key.toLowerCase()));
  if (withCommand) return false;
  const role = target.getAttribute("role") ?? "";
  const moves =
    name === "INPUT" ||
    name === "SELECT" ||
    ["slider", "radio", "tab", "option", "listbox", "menuitem", "menu", "grid", "separator"].includes(role);
  if (moves && (OWN.has(press.key) || PRESSING.has(press.key))) return true;
  if (name === "SELECT" && press.key.length === 1) return true;
  const presses =
    ["BUTTON", "A", "SUMMARY"].includes(name) || ["button", "switch", "checkbox"].includes(role);
  return presses && PRESSING.has(press.key);
}

function isElement(target: EventTarget | null): target is HTMLElement {
  return target !== null && "tagName" in target;
}

/** A chord for people: arrows as arrows. */
export function shown(key: string): string {
  return key
    .replace("ArrowLeft", "←")
    .replace("ArrowRight", "→")
    .replace("ArrowUp", "↑")
    .replace("ArrowDown", "↓");
}
