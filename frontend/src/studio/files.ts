// Opening, closing and giving files. Failures are told and leave everything as it was.
import type { ClipInfo, ExportRequest, Project } from "../messages";
import { asSentence, type Download } from "./api";
import { stemOf } from "./names";
import { keepFile } from "./shelf";
import type { Studio } from "./store.svelte";

/** Open clips and project files, one after the other, and show the last. */
export async function openFiles(studio: Studio, files: Iterable<File>): Promise<void> {
  studio.notices.closeErrors(); // of files before: this is another try
  for (const file of files) {
    if (isProject(file.name)) await openProject(studio, file);
    else if (isClip(file.name)) await openFile(studio, file.name, file);
    else studio.notices.error(`${file.name} is neither a .bvh clip nor a .json project of the studio.`);
  }
}

/** Open one clip from its file. */
export async function openFile(studio: Studio, name: string, data: Blob): Promise<void> {
  const most = studio.hello?.largest_upload ?? Infinity;
  if (data.size > most) {
    studio.notices.error(`${name} has ${megabytes(data.size)}; the studio takes ${megabytes(most)} at most.`);
    return;
  }
  if (data.size === 0) return studio.notices.error(`${name} is empty.`);
  const clip = await opened(studio, name, () => studio.api.openClip(name, data));
  if (clip) void keepFile(clip.id, clip.name, data);
}

export async function openSample(studio: Studio, name: string): Promise<void> {
  await opened(studio, name, () => studio.api.openSample(name));
}

async function opened(
  studio: Studio,
  name: string,
  ask: () => Promise<ClipInfo>,
): Promise<ClipInfo | undefined> {
  studio.opening += 1;
  try {
    const clip = await ask();
    const there = studio.clips.some(({ id }) => id === clip.id);
    studio.clips = there ? studio.clips : [...studio.clips, clip];
    await studio.select(clip.id);
    if (clip.problem) studio.notices.note(`${clip.name} can be looked at, not edited: the panel says why.`);
    return clip;
  } catch (problem) {
    studio.notices.error(withName(name, asSentence(problem)));
    return undefined;
  } finally {
    studio.opening -= 1;
  }
}

/** Close a clip. Its layers stay with the project, and come back with the file. */
export async function closeClip(studio: Studio, id: string): Promise<void> {
  const at = studio.clips.findIndex((clip) => clip.id === id);
  try {
    await studio.api.closeClip(id);
  } catch (problem) {
    return studio.notices.error(asSentence(problem));
  }
  studio.clips = studio.clips.filter((clip) => clip.id !== id);
  if (studio.current === id) await studio.select((studio.clips[at] ?? studio.clips.at(-1))?.id ?? "");
  else studio.keep();
}

/** Take over a project file; clips that are not open yet are named, to be opened. */
export async function openProject(studio: Studio, file: Blob & { name?: string }): Promise<void> {
  let project: Project;
  try {
    project = await studio.api.openProject(file);
    studio.clips = await studio.api.clips();
  } catch (problem) {
    return studio.notices.error(withName(file.name ?? "the project", asSentence(problem)));
  }
  await studio.take(project);
  const missing = project.clips.filter((clip) => !studio.clips.some(({ id }) => id === clip.id));
  if (missing.length) {
    const names = missing.map((clip) => clip.name).join(", ");
    studio.notices.error(`The project also uses ${names}: open ${missing.length > 1 ? "them" : "it"} too.`);
  }
}

/** Save the project as a file: clips by their hash, their layers, and the view. */
export function saveProject(studio: Studio, name = ""): void {
  const text = JSON.stringify(studio.project(), null, 1);
  const stem = stemOf(studio.clip?.name ?? "studio");
  give({ name: name || `${stem}.mien.json`, data: new Blob([text], { type: "application/json" }) });
  studio.notices.done("The project was saved to your downloads.");
}

/**
 * Have the server make a file, and save it, without a name by the one that the server gives it; says whether that
 * was done. Where `signal` ends it, nothing is said.
 */
export async function exportFile(
  studio: Studio,
  kind: ExportRequest["kind"],
  options: ExportRequest["options"],
  { name = "", signal }: { name?: string; signal?: AbortSignal } = {},
): Promise<boolean> {
  const { current: clip, stack } = studio;
  const end = studio.work.begin();
  try {
    const request = { clip, stack, kind, options, client: studio.answers.client };
    const made = await studio.api.exported(request, signal);
    const file = { ...made, name: name || made.name };
    give(file);
    studio.notices.done(`${file.name} was saved to your downloads.`);
    return true;
  } catch (problem) {
    if (!signal?.aborted) studio.notices.error(`Not exported: ${asSentence(problem)}`);
    return false;
  } finally {
    end();
  }
}

/** Hand a file to the browser, which saves it. */
export function give({ name, data }: Download): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(data);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

function isClip(name: string): boolean {
  return /\.bvh$/i.test(name);
}

function isProject(name: string): boolean {
  return /\.json$/i.test(name);
}

function megabytes(bytes: number): string {
  return `${(bytes / 2 ** 20).toFixed(0)} MB`;
}

/** The sentence with the file's name in front where it does not say it itself. */
export function withName(name: string, said: string): string {
  return said.toLowerCase().includes(name.toLowerCase()) ? said : `${name}: ${said}`;
}
