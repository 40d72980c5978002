// The stack of layers as plain data: every function takes a stack and returns a new one.
import type { EditInfo, Layer, ParameterInfo, Stack } from "../messages";

export type Value = Layer["parameters"][string];
export type Strength = Layer["strength"];

export const EMPTY: Stack = Object.freeze({ layers: [], strength: 1, foot_plant: true, safe: true });

/** Layers that set the mood: a preset, or a point of the disc. */
const MOODS = new Set<Layer["kind"]>(["emotion", "place"]);

/** Return a layer with everything at its default and an id that the stack has not got. */
export function layerFor(
  stack: Stack,
  kind: Layer["kind"],
  name: string,
  parameters: Layer["parameters"] = {},
): Layer {
  return {
    id: freshId(stack),
    kind,
    name,
    parameters,
    ...fresh(),
  };
}

/** How a layer is done where nothing else is said. */
function fresh(): Omit<Layer, "id" | "kind" | "name" | "parameters"> {
  return { strength: 1, parts: [], span: null, ease: 0.25, on: true, solo: false };
}

export function find(stack: Stack, id: string): Layer | undefined {
  return stack.layers.find((layer) => layer.id === id);
}

export function add(stack: Stack, layer: Layer, at = stack.layers.length): Stack {
  return withLayers(stack, stack.layers.toSpliced(at, 0, layer));
}

export function remove(stack: Stack, id: string): Stack {
  return withLayers(
    stack,
    stack.layers.filter((layer) => layer.id !== id),
  );
}

/** Move a layer to a place in the list, kept inside it. */
export function move(stack: Stack, id: string, to: number): Stack {
  const from = stack.layers.findIndex((layer) => layer.id === id);
  const place = Math.min(Math.max(to, 0), stack.layers.length - 1);
  if (from < 0 || from === place) return stack;
  const others = stack.layers.toSpliced(from, 1);
  return withLayers(stack, others.toSpliced(place, 0, stack.layers[from]!));
}

/** Put a copy of a layer after it. */
export function duplicate(stack: Stack, id: string): Stack {
  const at = stack.layers.findIndex((layer) => layer.id === id);
  if (at < 0) return stack;
  return add(stack, { ...stack.layers[at]!, id: freshId(stack), solo: false }, at + 1);
}

export function change(stack: Stack, id: string, fields: Partial<Omit<Layer, "id">>): Stack {
  return withLayers(
    stack,
    stack.layers.map((layer) => (layer.id === id ? { ...layer, ...fields } : layer)),
  );
}

export function bypass(stack: Stack, id: string): Stack {
  const layer = find(stack, id);
  return layer ? change(stack, id, { on: !layer.on }) : stack;
}

export function solo(stack: Stack, id: string): Stack {
  const layer = find(stack, id);
  return layer ? change(stack, id, { solo: !layer.solo }) : stack;
}

/** Set one parameter of a layer; undefined takes it back to its default. */
export function setParameter(stack: Stack, id: string, name: string, value: Value | undefined): Stack {
  const layer = find(stack, id);
  if (!layer) return stack;
  const { [name]: _before, ...others } = layer.parameters;
  return change(stack, id, { parameters: value === undefined ? others : { ...others, [name]: value } });
}

/** Put a layer's strength, parts, span and parameters back to where they began. */
export function reset(stack: Stack, id: string): Stack {
  const layer = find(stack, id);
  if (!layer) return stack;
  const parameters = layer.kind === "place" ? layer.parameters : {};
  return change(stack, id, { parameters, ...fresh() });
}

/**
 * Set the mood: a clip has one until more are added on purpose. The selected mood changes, or the first;
 * its strength, parts and span stay. Without one, it becomes the first layer, so that edits come on top.
 */
export function setMood(
  stack: Stack,
  selected: string,
  mood: Pick<Layer, "kind" | "name" | "parameters">,
): { stack: Stack; id: string } {
  const there = moodOf(stack, selected);
  if (there) return { stack: change(stack, there.id, { ...mood }), id: there.id };
  const layer = layerFor(stack, mood.kind, mood.name, mood.parameters);
  return { stack: add(stack, layer, 0), id: layer.id };
}

/** The mood that a preset or the disc would change: the selected one, or the first. */
export function moodOf(stack: Stack, selected: string): Layer | undefined {
  const moods = stack.layers.filter((layer) => MOODS.has(layer.kind));
  return moods.find((layer) => layer.id === selected) ?? moods[0];
}

/** The layer that an edit's own sliders change: the selected one, or the first of that edit. */
export function editOf(stack: Stack, selected: string, edit: string): Layer | undefined {
  const layers = stack.layers.filter((layer) => layer.kind === "edit" && layer.name === edit);
  return layers.find((layer) => layer.id === selected) ?? layers[0];
}

/** Set parameters of an edit, in a new layer where there is none. */
export function setEdit(
  stack: Stack,
  selected: string,
  edit: string,
  parameters: Layer["parameters"],
): { stack: Stack; id: string } {
  const there = editOf(stack, selected, edit);
  if (there) {
    const merged = { ...there.parameters, ...parameters };
    return { stack: change(stack, there.id, { parameters: merged }), id: there.id };
  }
  const layer = layerFor(stack, "edit", edit, parameters);
  return { stack: add(stack, layer), id: layer.id };
}

/** The layers that are done, as the server sees it: those that are on, or of them only the solo ones. */
export function active(stack: Stack): Layer[] {
  const on = stack.layers.filter((layer) => layer.on);
  const alone = on.filter((layer) => layer.solo);
  return alone.length ? alone : on;
}

/** Whether the stack leaves a clip as it is, so that nobody has to be asked. */
export function isIdle(stack: Stack): boolean {
  return stack.strength === 0 || active(stack).every((layer) => layer.strength === 0);
}

/** What a parameter's slider shows: what the layer says, or the edit's default. */
export function valueOf(layer: Layer | undefined, parameter: ParameterInfo): Value {
  return layer?.parameters[parameter.name] ?? parameter.default;
}

/** Whether a layer does something other than its edit's defaults. */
export function isChanged(layer: Layer | undefined, edit: EditInfo): boolean {
  return edit.parameters.some((parameter) => {
    const value = layer?.parameters[parameter.name];
    return value !== undefined && JSON.stringify(value) !== JSON.stringify(parameter.default);
  });
}

/** Edits whose own name says little to people who did not make them; as their sections are called. */
const NAMED: Record<string, string> = { grid: "Paths and timing" };

/** A name for people: "tired", "posture", "pleasant 0.60, calm 0.30". */
export function title(layer: Layer): string {
  if (layer.kind === "emotion") return sentence(moodName(layer.name));
  if (layer.kind === "edit") return NAMED[layer.name] ?? sentence(layer.name);
  const { valence, arousal } = layer.parameters;
  return typeof valence === "number" && typeof arousal === "number"
    ? `Disc ${signed(valence)}, ${signed(arousal)}`
    : "Disc";
}

function signed(value: number): string {
  return `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(2)}`;
}

/** A preset for people: "energetic sad", "sad (as in the thesis)". */
export function moodName(name: string): string {
  const plain = name.split("/").at(-1)!.replaceAll("-", " ");
  return name.includes("/") ? `${plain} (as in the thesis)` : plain;
}

/** A docstring's line without the marks around its names. */
export function plain(doc: string): string {
  return doc.replaceAll("``", "");
}

/** "path_length" as "Path length". */
export function sentence(name: string): string {
  const words = name.replaceAll("_", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** "layer 3" where there are layers up to 2: ids say nothing, and the same work gives the same ones. */
function freshId(stack: Stack): string {
  const numbers = stack.layers.map((layer) => Number(layer.id.replace(/^layer /, "")) || 0);
  return `layer ${Math.max(0, ...numbers) + 1}`;
}

function withLayers(stack: Stack, layers: Layer[]): Stack {
  return { ...stack, layers };
}
