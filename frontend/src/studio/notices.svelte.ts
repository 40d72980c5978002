// Messages to the person: errors stay until closed, the rest goes by itself.

export interface Notice {
  id: number;
  kind: "error" | "note" | "done";
  text: string;
  action?: { label: string; run: () => void };
}

const SHOWN = 6000; // milliseconds

export class Notices {
  all = $state.raw<readonly Notice[]>([]);
  #count = 0;

  error(text: string, action?: Notice["action"]): void {
    this.#add("error", text, action);
  }

  note(text: string, action?: Notice["action"]): number {
    return this.#add("note", text, action);
  }

  done(text: string, action?: Notice["action"]): void {
    this.#add("done", text, action);
  }

  close(id: number): void {
    this.all = this.all.filter((notice) => notice.id !== id);
  }

  closeErrors(): void {
    this.all = this.all.filter(({ kind }) => kind !== "error");
  }

  #add(kind: Notice["kind"], text: string, action?: Notice["action"]): number {
    // The same error twice is one error.
    const there = this.all.find((notice) => notice.kind === kind && notice.text === text);
    if (there && kind === "error") return there.id;
    const id = ++this.#count;
    this.all = [...this.all, { id, kind, text, ...(action ? { action } : {}) }];
    // A note with something to press waits for it.
    if (kind !== "error" && !action) setTimeout(() => this.close(id), SHOWN);
    return id;
  }
}
