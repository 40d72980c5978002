// Files that were opened, in this browser's own database: to open them again, also after a server went.

export interface Kept {
  id: string;
  name: string;
  data: Blob;
  opened: number;
}

const ROOM = 12;
const LARGEST = 100_000_000; // bytes of one file; larger ones are not kept

function database(): Promise<IDBDatabase> {
  return new Promise((give, refuse) => {
    const asked = indexedDB.open("mien studio", 1);
    asked.onupgradeneeded = () => asked.result.createObjectStore("files", { keyPath: "id" });
    asked.onsuccess = () => give(asked.result);
    asked.onerror = () => refuse(asked.error);
  });
}

async function within<Answer>(
  mode: IDBTransactionMode,
  work: (files: IDBObjectStore) => IDBRequest<Answer>,
): Promise<Answer> {
  const open = await database();
  try {
    return await new Promise((give, refuse) => {
      const asked = work(open.transaction("files", mode).objectStore("files"));
      asked.onsuccess = () => give(asked.result);
      asked.onerror = () => refuse(asked.error);
    });
  } finally {
    open.close();
  }
}

/** The kept files, newest first; none where this browser keeps nothing. */
export async function recent(): Promise<Kept[]> {
  try {
    const all = await within<Kept[]>("readonly", (files) => files.getAll());
    return all.sort((one, other) => other.opened - one.opened);
  } catch {
    return [];
  }
}

/** Keep a file, and let go of the oldest. It is a comfort: where it cannot be done, nothing is said. */
export async function keepFile(id: string, name: string, data: Blob): Promise<void> {
  if (data.size > LARGEST) return;
  try {
    await within("readwrite", (files) => files.put({ id, name, data, opened: Date.now() } satisfies Kept));
    for (const old of (await recent()).slice(ROOM))
      await within("readwrite", (files) => files.delete(old.id));
  } catch {
    return;
  }
}
