// What every part of the page gets at, handed down once by the page itself.
import { createContext } from "svelte";
import type { Command } from "./commands";
import type { Studio } from "./store.svelte";
import type { Themes } from "./theme.svelte";

export interface Context {
  readonly studio: Studio;
  readonly themes: Themes;
  /** All commands as they are now. */
  readonly commands: () => readonly Command[];
  /** Do a command, if it can be done. */
  readonly run: (id: string) => void;
  /** The keys of a command for people; empty where it has none. */
  readonly keyOf: (id: string) => string;
}

export const [useContext, giveContext] = createContext<Context>();
