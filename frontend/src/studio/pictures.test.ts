import { expect, it, vi } from "vitest";
import type { Api } from "./api";
import { pictures } from "./pictures";

it("asks for one at a time, once, and again for what failed", async () => {
  let open = 0;
  let most = 0;
  const presetPicture = vi.fn(async (name: string) => {
    most = Math.max(most, (open += 1));
    await Promise.resolve();
    open -= 1;
    if (name === "sad" && presetPicture.mock.calls.length < 3) throw new Error("gone");
    return `blob:${name}`;
  });
  const api = { presetPicture } as unknown as Api;
  const first = [pictures(api, "sad").catch(() => "none"), pictures(api, "old"), pictures(api, "old")];
  expect(await Promise.all(first)).toEqual(["none", "blob:old", "blob:old"]);
  expect(await pictures(api, "sad")).toBe("blob:sad");
  expect(presetPicture).toHaveBeenCalledTimes(3);
  expect(most).toBe(1);
});
