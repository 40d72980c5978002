// The key map of this person: the usual one, and what was changed in it.
import { KEYS, rebound, shown, type Binding } from "./keymap";

const PLACE = "mien keys";

export class Keys {
  #changes = $state.raw<Readonly<Record<string, readonly string[]>>>({});
  readonly table = $derived<readonly Binding[]>(rebound(KEYS, this.#changes));

  constructor(private readonly shelf: Pick<Storage, "getItem" | "setItem"> = localStorage) {
    try {
      const kept: unknown = JSON.parse(shelf.getItem(PLACE) ?? "{}");
      if (kept && typeof kept === "object") this.#changes = kept as Record<string, string[]>;
    } catch {
      this.#changes = {};
    }
  }

  /** Give a command one key, which is taken from any other. */
  bind(command: string, key: string): void {
    const others = Object.entries(this.#changes).map(([name, keys]) => [
      name,
      keys.filter((old) => old !== key),
    ]);
    this.#set({ ...Object.fromEntries(others), [command]: [key] });
  }

  restore(): void {
    this.#set({});
  }

  /** The first key of a command for people; empty where it has none. */
  keyOf(command: string): string {
    const [key] = this.table.find((binding) => binding.command === command)?.keys ?? [];
    return key ? shown(key) : "";
  }

  #set(changes: Record<string, readonly string[]>): void {
    this.#changes = changes;
    this.shelf.setItem(PLACE, JSON.stringify(changes));
  }
}
