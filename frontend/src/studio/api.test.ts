import { expect, it } from "vitest";
import { Api, asSentence, Failed, fileName } from "./api";

function answering(answer: Response | Error): { api: Api; asked: Request[]; lost: () => number } {
  const asked: Request[] = [];
  let lost = 0;
  const api = new Api("secret", async (address, options) => {
    asked.push(new Request(new URL(String(address), "http://127.0.0.1"), options));
    if (answer instanceof Error) throw answer;
    return answer.clone();
  });
  api.onLost = () => (lost += 1);
  return { api, asked, lost: () => lost };
}

async function failure(promise: Promise<unknown>): Promise<Failed> {
  try {
    await promise;
  } catch (problem) {
    return problem as Failed;
  }
  throw new Error("it did not fail");
}

it("sends its token and names as part of the address", async () => {
  const { api, asked } = answering(Response.json({}));
  await api.openClip("a b&c.bvh", new Blob(["x"]));
  expect(asked[0]!.headers.get("Authorization")).toBe("Bearer secret");
  expect(new URL(asked[0]!.url).searchParams.get("name")).toBe("a b&c.bvh");
});

it("gives the server's own sentence", async () => {
  const { api } = answering(Response.json({ error: "walk.bvh line 3: no" }, { status: 422 }));
  expect(await failure(api.clips())).toMatchObject({ kind: "said", message: "walk.bvh line 3: no" });
});

it("knows overtaken, forbidden and wordless answers apart", async () => {
  expect((await failure(answering(new Response("", { status: 409 })).api.clips())).kind).toBe("old");
  expect((await failure(answering(new Response("", { status: 401 })).api.clips())).kind).toBe("shut");
  const wordless = await failure(answering(new Response("<h1>", { status: 500 })).api.clips());
  expect(wordless.message).toMatch(/500/);
});

it("says when the connection is lost", async () => {
  const { api, lost } = answering(new TypeError("fetch failed"));
  expect((await failure(api.clips())).kind).toBe("lost");
  expect(lost()).toBe(1);
});

it("reads the name of a file", () => {
  expect(fileName('attachment; filename="walk_tired.bvh"')).toBe("walk_tired.bvh");
  expect(fileName("attachment; filename*=UTF-8''m%C3%BCde.bvh")).toBe("müde.bvh");
  expect(fileName(null)).toBe("mien");
});

it("begins a sentence big, and leaves the names of files", () => {
  expect(asSentence(new Error("the file is empty"))).toBe("The file is empty");
  expect(asSentence(new Error("walk.bvh line 3: no"))).toBe("walk.bvh line 3: no");
  expect(asSentence("walk: no")).toBe("walk: no");
});
