// Undo and redo: immutable snapshots. What happens during one gesture, such as a drag, is one step.

interface Entry<Value> {
  readonly value: Value;
  /** What made this value, for "Undo …". */
  readonly label: string;
}

export interface History<Value> {
  readonly past: readonly Entry<Value>[];
  readonly present: Entry<Value>;
  readonly future: readonly Entry<Value>[];
  /** The gesture that is going on; empty between gestures. */
  readonly gesture: string;
}

const LONGEST = 200;

export function begun<Value>(value: Value): History<Value> {
  return { past: [], present: { value, label: "" }, future: [], gesture: "" };
}

/** Take a new value. During the same gesture it replaces the last one; an empty gesture is a step alone. */
export function changed<Value>(
  history: History<Value>,
  value: Value,
  label: string,
  gesture = "",
): History<Value> {
  if (value === history.present.value) return history;
  const goesOn = gesture !== "" && gesture === history.gesture;
  const past = goesOn ? history.past : [...history.past, history.present].slice(-LONGEST);
  return { past, present: { value, label }, future: [], gesture };
}

/** The gesture is over: what comes next is another step. */
export function settled<Value>(history: History<Value>): History<Value> {
  return history.gesture === "" ? history : { ...history, gesture: "" };
}

export function undone<Value>(history: History<Value>): History<Value> {
  const before = history.past.at(-1);
  if (!before) return history;
  return {
    past: history.past.slice(0, -1),
    present: before,
    future: [history.present, ...history.future],
    gesture: "",
  };
}

export function redone<Value>(history: History<Value>): History<Value> {
  const [next, ...future] = history.future;
  if (!next) return history;
  return { past: [...history.past, history.present], present: next, future, gesture: "" };
}
