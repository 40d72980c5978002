// Everything the studio can do, by name: menus, keys and the palette all take it from here.
import { SPEEDS } from "../playback";
import { closeClip, exportFile, openSample, saveProject } from "./files";
import { stepContact } from "./contacts";
import * as stacks from "./stack";
import type { Studio } from "./store.svelte";
import type { Themes } from "./theme.svelte";
import { MODES, TOGGLES } from "./view";

export type Group = "File" | "Edit" | "View" | "Play" | "Mood" | "Add layer" | "Help";

export interface Command {
  id: string;
  name: string;
  /** What it is called where it does not matter what it is done to; as the name, where it is not said. */
  general?: string;
  group: Group;
  run: () => void;
  /** Whether it can be done now; always, where it is not said. */
  can?: boolean;
  /** For what is on or off. */
  checked?: boolean;
}

/** What commands need of the page around the store. */
export interface Place {
  studio: Studio;
  themes: Themes;
  pickFiles: () => void;
  /** What the viewport can be told. */
  stage: {
    view(name: string): void;
    frame(all: boolean): void;
    fullscreen(): void;
    picture(): void;
    link(): void;
  };
}

/** All commands as they are now. */
export function commandsOf(place: Place): Command[] {
  return [
    ...fileCommands(place),
    ...editCommands(place),
    ...viewCommands(place),
    ...playCommands(place),
    ...moodCommands(place),
    ...layerCommands(place),
    ...helpCommands(place),
  ];
}

function fileCommands({ studio, pickFiles, stage }: Place): Command[] {
  const clip = studio.clip;
  const samples = studio.hello?.samples ?? [];
  return [
    { id: "open", name: "Open clips or a project…", group: "File", run: pickFiles },
    {
      id: "save",
      name: "Save the project as a file",
      group: "File",
      run: () => saveProject(studio),
      can: !!clip,
    },
    { id: "export", name: "Export…", group: "File", run: () => (studio.dialog = "export"), can: !!clip },
    {
      id: "export-bvh",
      name: "Export BVH",
      group: "File",
      run: () => void exportFile(studio, "bvh", {}),
      can: studio.canEdit,
    },
    {
      id: "screenshot",
      name: "Save a picture of the viewport",
      group: "File",
      run: stage.picture,
      can: !!clip,
    },
    {
      id: "close",
      name: "Close the clip",
      group: "File",
      run: () => void closeClip(studio, studio.current),
      can: !!clip,
    },
    ...samples.map((name): Command => ({
      id: `sample-${name}`,
      name: `Open the sample ${name.replaceAll("_", " ")}`,
      group: "File",
      run: () => void openSample(studio, name),
    })),
    ...studio.clips.map((other): Command => ({
      id: `clip-${other.id}`,
      name: `Go to ${other.name}`,
      group: "File",
      run: () => void studio.select(other.id),
      can: other.id !== studio.current,
    })),
  ];
}

function editCommands({ studio }: Place): Command[] {
  const layer = studio.layer;
  const at = studio.stack.layers.findIndex(({ id }) => id === studio.selected);
  const named = layer ? stacks.title(layer).toLowerCase() : "the layer";
  const can = layer !== undefined;
  const on = (label: string, work: typeof stacks.bypass) => () =>
    studio.change(label, (stack) => work(stack, studio.selected));
  return [
    {
      id: "undo",
      general: "Undo",
      name: studio.undoLabel ? `Undo: ${studio.undoLabel}` : "Undo",
      group: "Edit",
      run: () => studio.undo(),
      can: studio.undoLabel !== "",
    },
    {
      id: "redo",
      general: "Redo",
      name: studio.redoLabel ? `Redo: ${studio.redoLabel}` : "Redo",
      group: "Edit",
      run: () => studio.redo(),
      can: studio.redoLabel !== "",
    },
    {
      id: "bypass",
      general: "Bypass the layer",
      name: layer?.on === false ? `Switch on ${named}` : `Bypass ${named}`,
      group: "Edit",
      run: on(`bypass ${named}`, stacks.bypass),
      can,
    },
    {
      id: "solo",
      name: `Solo ${named}`,
      general: "Solo the layer",
      group: "Edit",
      run: on(`solo ${named}`, stacks.solo),
      can,
    },
    {
      id: "duplicate",
      general: "Duplicate the layer",
      name: `Duplicate ${named}`,
      group: "Edit",
      run: on(`duplicate ${named}`, stacks.duplicate),
      can,
    },
    { id: "reset", name: `Reset ${named}`, group: "Edit", run: on(`reset ${named}`, stacks.reset), can },
    {
      id: "layer-up",
      name: `Move ${named} up`,
      group: "Edit",
      run: on(`move ${named}`, (stack, id) => stacks.move(stack, id, at - 1)),
      can: at > 0,
    },
    {
      id: "layer-down",
      name: `Move ${named} down`,
      group: "Edit",
      run: on(`move ${named}`, (stack, id) => stacks.move(stack, id, at + 1)),
      can: can && at < studio.stack.layers.length - 1,
    },
    {
      id: "delete",
      name: `Delete ${named}`,
      general: "Delete the layer",
      group: "Edit",
      run: () => studio.removeLayer(studio.selected),
      can,
    },
    {
      id: "clear",
      name: "Remove all layers",
      group: "Edit",
      run: () => studio.change("remove all layers", (stack) => ({ ...stack, layers: [], strength: 1 })),
      can: studio.stack.layers.length > 0,
    },
    {
      id: "joints",
      name: "Name its joints…",
      group: "Edit",
      run: () => (studio.dialog = "joints"),
      can: studio.clip !== undefined,
    },
    {
      id: "safe",
      name: "Make safe: mend what breaks the body",
      group: "Edit",
      run: () => studio.change("make safe", (stack) => ({ ...stack, safe: !stack.safe })),
      can: studio.canEdit,
      checked: studio.stack.safe,
    },
    {
      id: "foot-plant",
      name: "Keep feet on the floor",
      group: "Edit",
      run: () => studio.change("feet on the floor", (stack) => ({ ...stack, foot_plant: !stack.foot_plant })),
      can: studio.canEdit,
      checked: studio.stack.foot_plant,
    },
  ];
}

function viewCommands({ studio, themes, stage }: Place): Command[] {
  const { view } = studio;
  const modes = MODES.map(({ mode }) => mode);
  return [
    ...MODES.map(({ mode, label, hint }): Command => ({
      id: `mode-${mode}`,
      name: `${label}: ${hint}`,
      group: "View",
      run: () => studio.show({ mode }),
      checked: view.mode === mode,
    })),
    {
      id: "compare",
      name: "Next way to compare",
      group: "View",
      run: () => studio.show({ mode: modes[(modes.indexOf(view.mode) + 1) % modes.length]! }),
    },
    {
      id: "ghost",
      name: "Ghost of the original",
      group: "View",
      run: () => studio.show({ mode: view.mode === "overlay" ? "edited" : "overlay" }),
      checked: view.mode === "overlay",
    },
    {
      id: "swap",
      name: "Show the original in place of the edit",
      group: "View",
      run: () => (studio.showsOriginal = !studio.showsOriginal),
      checked: studio.showsOriginal,
    },
    ...TOGGLES.map(({ toggle, label, hint }): Command => ({
      id: toggle,
      name: `${label}: ${hint}`,
      group: "View",
      run: () => studio.toggle(toggle),
      checked: studio.isOn(toggle),
    })),
    { id: "frame-all", name: "Look at all of it", group: "View", run: () => stage.frame(true) },
    { id: "frame-selection", name: "Look at the figure", group: "View", run: () => stage.frame(false) },
    { id: "view-front", name: "From the front", group: "View", run: () => stage.view("front") },
    { id: "view-side", name: "From the side", group: "View", run: () => stage.view("side") },
    { id: "view-top", name: "From above", group: "View", run: () => stage.view("top") },
    { id: "view-perspective", name: "From a corner", group: "View", run: () => stage.view("perspective") },
    { id: "fullscreen", name: "Viewport in full screen", group: "View", run: stage.fullscreen },
    {
      id: "copy-link",
      name: "Copy a link to this view",
      group: "View",
      run: stage.link,
      can: studio.clip !== undefined,
    },
    {
      id: "theme",
      name: themes.theme === "dark" ? "Light colours" : "Dark colours",
      group: "View",
      run: () => themes.toggle(),
    },
  ];
}

function playCommands({ studio }: Place): Command[] {
  const { playback } = studio;
  const faster = (by: 1 | -1) => () => {
    const at = SPEEDS.findIndex((speed) => speed >= playback.speed);
    const next = SPEEDS[Math.min(Math.max((at < 0 ? SPEEDS.length - 1 : at) + by, 0), SPEEDS.length - 1)]!;
    playback.set({ speed: next });
  };
  const range = (fields: { start?: number; end?: number }) => () => {
    const [start, end] = playback.range ?? [0, playback.duration];
    const next: [number, number] = [fields.start ?? start, fields.end ?? end];
    playback.set({ range: next[0] < next[1] ? next : null, loop: "range" });
  };
  const loops = ["all", "range", "off"] as const;
  const play = (id: string, name: string, run: () => void): Command => ({
    id,
    name,
    group: "Play",
    run,
    can: studio.clip !== undefined,
  });
  const contacts = () => (studio.answers.made?.motion ?? studio.answers.original) || null;
  return [
    play("play", "Play or pause", () => playback.set({ playing: !playback.playing, direction: 1 })),
    play("next-frame", "Next frame", () => playback.step(1)),
    play("previous-frame", "Previous frame", () => playback.step(-1)),
    play("ten-frames-on", "Ten frames on", () => playback.step(10)),
    play("ten-frames-back", "Ten frames back", () => playback.step(-10)),
    play("next-contact", "Next foot contact", () => stepContact(playback, contacts(), 1)),
    play("previous-contact", "Previous foot contact", () => stepContact(playback, contacts(), -1)),
    play("range-start", "Go to the start", () => playback.set({ time: playback.stretch[0] })),
    play("range-end", "Go to the end", () => playback.set({ time: playback.stretch[1] })),
    play("play-backward", "Play backward, each time faster", () => playback.shuttle(-1)),
    play("stop", "Stop", () => playback.shuttle(0)),
    play("play-forward", "Play forward, each time faster", () => playback.shuttle(1)),
    play("loop-in", "Loop from here", () => range({ start: playback.time })()),
    play("loop-out", "Loop to here", () => range({ end: playback.time })()),
    play("loop-clear", "Loop over all", () => playback.set({ range: null, loop: "all" })),
    play("loop-mode", "Next loop mode: all, range, once", () =>
      playback.set({ loop: loops[(loops.indexOf(playback.loop) + 1) % loops.length]! }),
    ),
    play("slower", "Slower", faster(-1)),
    play("faster", "Faster", faster(1)),
    play("normal-speed", "Normal speed", () => playback.set({ speed: 1 })),
  ];
}

function moodCommands({ studio }: Place): Command[] {
  return (studio.hello?.presets ?? []).map(({ name }) => ({
    id: `mood-${name}`,
    name: `Make it ${stacks.moodName(name)}`,
    group: "Mood",
    run: () => studio.setMood({ kind: "emotion", name, parameters: {} }),
    can: studio.canEdit,
  }));
}

function layerCommands({ studio }: Place): Command[] {
  return (studio.hello?.edits ?? []).map(({ name }) => ({
    id: `add-${name}`,
    name: `Add ${stacks.sentence(name).toLowerCase()}`,
    group: "Add layer",
    run: () => studio.addLayer("edit", name),
    can: studio.canEdit,
  }));
}

function helpCommands({ studio }: Place): Command[] {
  return [
    { id: "palette", name: "Find a command…", group: "Help", run: () => (studio.dialog = "palette") },
    { id: "keys", name: "Keys", group: "Help", run: () => (studio.dialog = "keys") },
    { id: "help", name: "First steps", group: "Help", run: () => (studio.dialog = "help") },
  ];
}

/** Commands that leave the clip for another one. */
const OTHER_CLIP = /^(sample|clip)-/;

/** The commands that fit what was typed: every word of it somewhere, those that begin with it first. */
export function search(commands: readonly Command[], typed: string): Command[] {
  const words = typed.toLowerCase().split(/\s+/).filter(Boolean);
  const rank = (command: Command): number => {
    const name = command.name.toLowerCase();
    const text = `${name} ${command.group.toLowerCase()}`;
    if (!words.every((word) => text.includes(word))) return -1;
    const [first] = words;
    if (!first || name.startsWith(first)) return 0;
    // Who types "tired" wants the clip tired before he wants another clip that is called so.
    const other = OTHER_CLIP.test(command.id) ? 0.5 : 0;
    return other + (name.split(/[^a-z0-9]+/).some((word) => word.startsWith(first)) ? 1 : 2);
  };
  return commands
    .map((command) => ({ command, place: rank(command) }))
    .filter(({ command, place }) => place >= 0 && command.can !== false)
    .sort((one, other) => one.place - other.place)
    .map(({ command }) => command);
}
