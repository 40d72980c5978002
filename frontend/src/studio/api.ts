// What the page asks the server: with its token, never for ever, and every failure a sentence.
import type * as messages from "../messages";
import { decode, unpack, type Clip } from "../wire";

/** No connection; no answer in time; overtaken by a newer request; the server's own; the key is not valid. */
export type FailureKind = "lost" | "late" | "old" | "said" | "shut";

export class Failed extends Error {
  constructor(
    readonly kind: FailureKind,
    sentence: string,
    readonly status = 0,
  ) {
    super(sentence);
  }
}

/** A file that the server made, and the name it has there. */
export interface Download {
  name: string;
  data: Blob;
}

interface Options {
  method?: "GET" | "POST" | "PUT" | "DELETE";
  /** Sent as JSON. */
  json?: unknown;
  /** Sent as it is. */
  body?: BodyInit;
  seconds?: number;
  signal?: AbortSignal | undefined;
  /** Let the browser finish it while the page goes. */
  keepalive?: boolean;
}

const LOST = "the connection to mien is lost";
const SHUT = "this page's key is not valid any more: open the address that mien studio printed";

export class Api {
  readonly #token: string;
  readonly #fetch: typeof fetch;
  /** Called where the server cannot be reached. */
  onLost: () => void = () => undefined;
  /** Called where the server does not know this page's key. */
  onShut: () => void = () => undefined;

  constructor(token: string, ask: typeof fetch = (...given) => fetch(...given)) {
    this.#token = token;
    this.#fetch = ask;
  }

  hello = (signal?: AbortSignal) => this.#json<messages.Hello>("hello", { seconds: 15, signal });
  clips = () => this.#json<messages.ClipInfo[]>("clips");
  closeClip = (id: string) => this.#ask(`clips/${encodeURIComponent(id)}`, { method: "DELETE" });

  openClip = (name: string, data: Blob) =>
    this.#json<messages.ClipInfo>(`clips?name=${encodeURIComponent(name)}`, {
      method: "POST",
      body: data,
      seconds: 180,
    });

  openSample = (name: string) =>
    this.#json<messages.ClipInfo>(`samples/${encodeURIComponent(name)}`, { method: "POST" });

  joints = (id: string) => this.#json<messages.JointsInfo>(`clips/${encodeURIComponent(id)}/joints`);
  nameJoints = (id: string, roles: messages.RolesRequest["roles"]) =>
    this.#json<messages.ClipInfo>(`clips/${encodeURIComponent(id)}/roles`, {
      method: "POST",
      json: { roles },
      seconds: 120,
    });

  motion = async (id: string): Promise<Clip> =>
    decode(await this.#bytes(`clips/${encodeURIComponent(id)}/motion`, { seconds: 120 }));

  edit = async (request: messages.EditRequest, signal?: AbortSignal, seconds = 120): Promise<Clip> =>
    decode(await this.#bytes("edit", { method: "POST", json: request, seconds, signal }));

  square = async (request: messages.EditRequest) =>
    unpack<messages.Frames>(await this.#bytes("square", { method: "POST", json: request, seconds: 120 }));

  reading = (request: messages.EditRequest, signal?: AbortSignal, seconds = 120) =>
    this.#json<messages.Readings>("reading", { method: "POST", json: request, seconds, signal });

  checks = (request: messages.EditRequest, signal?: AbortSignal, seconds = 120) =>
    this.#json<messages.Checks>("checks", { method: "POST", json: request, seconds, signal });

  curves = (request: messages.CurvesRequest, signal?: AbortSignal) =>
    this.#json<messages.Curve[]>("curves", { method: "POST", json: request, seconds: 120, signal });

  copied = (request: messages.CopiedRequest) =>
    this.#json<messages.Copied>("copied", { method: "POST", json: request });

  /** The file and the name that the server gives it. */
  exported = async (request: messages.ExportRequest, signal?: AbortSignal): Promise<Download> => {
    const answer = await this.#ask("export", { method: "POST", json: request, seconds: 3600, signal });
    return { name: fileName(answer.headers.get("Content-Disposition")), data: await answer.blob() };
  };

  /** What the server works out for this page. */
  progress = (client: string) =>
    this.#json<messages.WorkInfo[]>(`progress?client=${encodeURIComponent(client)}`);

  /** An address that an <img> can show: pictures cannot carry the token in their header themselves. */
  presetPicture = async (name: string): Promise<string> => {
    const answer = await this.#ask(`presets/${encodeURIComponent(name)}.png`, { seconds: 60 });
    return URL.createObjectURL(await answer.blob());
  };

  project = () => this.#json<messages.Project>("project");
  keepProject = (project: messages.Project, keepalive = false) =>
    this.#ask("project", { method: "PUT", json: project, keepalive });
  openProject = (data: Blob) =>
    this.#json<messages.Project>("project/open", { method: "POST", body: data, seconds: 180 });

  async #json<Answer>(path: string, options: Options = {}): Promise<Answer> {
    return (await (await this.#ask(path, options)).json()) as Answer;
  }

  async #bytes(path: string, options: Options): Promise<ArrayBuffer> {
    return (await this.#ask(path, options)).arrayBuffer();
  }

  async #ask(path: string, options: Options = {}): Promise<Response> {
    const { method = "GET", json, body, seconds = 30, signal, keepalive = false } = options;
    const headers: Record<string, string> = { Authorization: `Bearer ${this.#token}` };
    if (json !== undefined) headers["Content-Type"] = "application/json";
    const late = AbortSignal.timeout(seconds * 1000);
    let answer: Response;
    try {
      answer = await this.#fetch(`/api/${path}`, {
        method,
        headers,
        keepalive,
        signal: signal ? AbortSignal.any([signal, late]) : late,
        ...(json !== undefined ? { body: JSON.stringify(json) } : body !== undefined ? { body } : {}),
      });
    } catch (problem) {
      if (signal?.aborted) throw new Failed("old", "overtaken");
      if (late.aborted) throw new Failed("late", `mien did not answer within ${seconds} seconds`);
      this.onLost();
      throw new Failed("lost", problem instanceof Failed ? problem.message : LOST);
    }
    if (answer.ok) return answer;
    const failed = await refusal(answer);
    if (failed.kind === "shut") this.onShut();
    throw failed;
  }
}

/** What the server said against it, in its own sentence where it has one. */
async function refusal(answer: Response): Promise<Failed> {
  const { status } = answer;
  if (status === 401 || status === 403) return new Failed("shut", SHUT, status);
  const said = (await answer.json().catch(() => null)) as messages.Failure | null;
  const sentence = said?.error ?? `mien answered ${status} ${answer.statusText}`.trim();
  return new Failed(status === 409 ? "old" : "said", sentence, status);
}

/** The name in a Content-Disposition, in either of its two ways of writing. */
export function fileName(disposition: string | null): string {
  const encoded = /filename\*=UTF-8''([^;]+)/i.exec(disposition ?? "")?.[1];
  if (encoded) return decodeURIComponent(encoded);
  return /filename="?([^";]+)"?/i.exec(disposition ?? "")?.[1] ?? "mien";
}

/** One sentence for people, from whatever was thrown; it begins big, unless with the name of a file. */
export function asSentence(problem: unknown): string {
  const words = problem instanceof Error ? problem.message : String(problem);
  return /^[a-z]+[\s,]/.test(words) ? words.charAt(0).toUpperCase() + words.slice(1) : words;
}

/** The token of the page's address, which then leaves it, so that it is in no history and no picture. */
export function takeToken(): string {
  const given = new URLSearchParams(location.hash.slice(1)).get("token");
  if (given) {
    sessionStorage.setItem("mien token", given);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return given ?? sessionStorage.getItem("mien token") ?? "";
}
